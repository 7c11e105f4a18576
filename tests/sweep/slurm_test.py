#!/usr/bin/env python3
"""A sweep through Slurm: a controller, a node and munge, started here for the test, with all their files in its own folder.

A run is killed, then the node dies with all that runs on it and comes back: no point is lost, and every file is that of a run
without Slurm.

Usage: tests/sweep/slurm_test.py SCRATCH [COUNT_FILE]; as root. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 all passed.
"""

import os
import secrets
import shutil
import signal
import socket
import subprocess
import sys
import unittest
from pathlib import Path

root = Path(__file__).resolve().parent.parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(root / "tests"))

from counted import run_and_count  # noqa: E402
from sweep_runs import SweepRuns, different, interrupt, kill_tree, wait_for  # noqa: E402

scratch = Path(sys.argv[1]).resolve()
# cred_expire: a run that is queued again is held back until the credentials of its last start have expired, else two minutes.
CONFIG = """ClusterName=fixdemtest
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=15
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
SlurmdTimeout=10
KillWait=10
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def free_port():
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return found.getsockname()[1]


class Cluster:
    """munged, slurmctld and slurmd."""

    def __init__(self, folder):
        self.folder, self.started = folder, {}
        for name in ("state", "spool"):
            (folder / name).mkdir(parents=True)
        key = folder / "munge.key"
        key.write_bytes(secrets.token_bytes(128))
        key.chmod(0o400)
        config = folder / "slurm.conf"
        config.write_text(
            CONFIG.format(
                host=socket.gethostname(), folder=folder, controller_port=free_port(), node_port=free_port(), cores=os.cpu_count()
            )
        )
        os.environ["SLURM_CONF"] = str(config)
        self.start(
            "munged",
            "--foreground",
            "--force",
            f"--key-file={key}",
            f"--socket={folder}/munge.socket",
            f"--pid-file={folder}/munged.pid",
            f"--log-file={folder}/munged.log",
            f"--seed-file={folder}/munged.seed",
        )
        wait_for((folder / "munge.socket").exists, 20)
        self.start("slurmctld", "-D")
        self.start("slurmd", "-D")
        wait_for(self.is_idle, 60)

    def start(self, *command):
        with open(self.folder / f"{command[0]}.txt", "a") as said:
            self.started[command[0]] = subprocess.Popen(command, stdout=said, stderr=subprocess.STDOUT)

    def is_idle(self):
        return (
            "idle"
            in subprocess.run(["sinfo", "--noheader", "--format=%t"], capture_output=True, text=True, check=False).stdout.split()
        )

    def step_daemons(self):
        """Processes of slurmstepd that this slurmd has started; they live on without it."""
        found = subprocess.run(["ps", "-eo", "pid=,args="], capture_output=True, text=True, check=True).stdout.splitlines()
        steps = [int(line.split()[0]) for line in found if line.split(None, 1)[1].startswith("slurmstepd:")]
        return [pid for pid in steps if f"SLURM_CONF={self.folder}" in environment(pid)]

    def node_dies(self):
        steps = self.step_daemons()
        self.started["slurmd"].kill()
        self.started["slurmd"].wait()
        for step in steps:
            kill_tree(step)

    def remove(self):
        subprocess.run(["scancel", "--user=root"], capture_output=True, check=False)
        self.node_dies()
        for name in ("slurmctld", "munged"):
            if name in self.started:
                self.started[name].terminate()
                self.started[name].wait()


def environment(process):
    try:
        return Path(f"/proc/{process}/environ").read_bytes().decode(errors="replace")
    except OSError:
        return ""


class ThroughSlurm(unittest.TestCase):
    def setUp(self):
        shutil.rmtree(scratch, ignore_errors=True)
        scratch.mkdir(parents=True)
        self.cluster = Cluster(scratch / "cluster")
        self.addCleanup(self.cluster.remove)
        self.sweep = SweepRuns(scratch / "small")

    def wait_for_run(self, but=()):
        """(name, machine, process) of a plug that is running and has a checkpoint."""
        return wait_for(lambda: [run for run in self.sweep.running("plug") if run[0] not in but])[0]

    def test_a_killed_run_and_a_node_that_dies_lose_no_point(self):
        code, said = self.sweep.call()
        self.assertEqual(code, 0, said)
        expected, undisturbed = self.sweep.results(), self.sweep.records()

        self.sweep.begin_anew()
        process = self.sweep.start("ENGINE=slurm", "JOBS=1")
        killed, _, watcher = self.wait_for_run()
        os.kill(watcher, signal.SIGKILL)
        print(f"killed: {killed}")
        lost, _, _ = self.wait_for_run(but=(killed,))
        self.cluster.node_dies()
        print(f"the node died, with {lost}")
        self.cluster.start("slurmd", "-D")
        self.assertEqual(process.wait(), 0, self.sweep.said())
        print("\n".join(line for line in self.sweep.said().splitlines() if line.startswith(("Slurm job", "fixdem:"))))
        self.assertEqual(different(self.sweep.results(), expected), [])
        records = self.sweep.records()
        for name in (killed, lost):
            self.assertLess(
                records[name]["particle_steps"], undisturbed[name]["particle_steps"], "it was gone on with, not begun anew"
            )

        code, said = self.sweep.call("ENGINE=slurm")
        self.assertEqual((code, self.sweep.records()), (0, records), said)
        self.assertNotIn("Slurm job", said)

        self.sweep.begin_anew()
        process = self.sweep.start("ENGINE=slurm")
        self.wait_for_run()
        self.assertNotEqual(interrupt(process), 0)
        stopped = [name for name, record in self.sweep.records().items() if record["state"] == "stopped"]
        print(f"Ctrl-C stopped {', '.join(stopped)}")
        self.assertTrue(stopped)
        self.assertTrue(all(any((self.sweep.out / "runs" / name).glob("checkpoint-*")) for name in stopped))
        code, said = self.sweep.call("ENGINE=slurm")
        self.assertEqual(code, 0, said)
        self.assertEqual(different(self.sweep.results(), expected), [])


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    run_and_count(*sys.argv[2:3])
