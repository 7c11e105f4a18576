#!/usr/bin/env python3
"""A sweep over two hosts, one of which dies in the middle: no point is lost, and every file is that of a run on this machine.

Each host is a network namespace with a link, an address, a host name and an sshd of its own; it shares this machine's files, as
hosts of a cluster share a folder. It dies by SIGKILL for all its processes and a link that is taken down: connections hang, as
with a machine that has lost its power. Where namespaces are not allowed, both hosts are localhost by two names, and the death
of one is that of its sshd and all that it started; the test says so (FIXDEM_HOSTS=localhost asks for it).

Usage: tests/sweep/hosts_test.py SCRATCH [COUNT_FILE]; as root. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 all passed.
"""

import os
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

root = Path(__file__).resolve().parent.parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(root / "tests"))

from counted import run_and_count  # noqa: E402
from sweep_runs import SweepRuns, different, kill_tree, wait_for  # noqa: E402

scratch = Path(sys.argv[1]).resolve()
LEASE = 5  # s; how long a dead host's runs are left alone
SSHD = """Port {port}
ListenAddress {address}
HostKey {scratch}/host_key
AuthorizedKeysFile {scratch}/user_key.pub
PidFile {scratch}/{name}.pid
UsePAM no
StrictModes no
PasswordAuthentication no
SetEnv FIXDEM_LEASE={lease}
"""
SSH = """Host {name}
  HostName {address}
  Port {port}
  IdentityFile {scratch}/user_key
  IdentitiesOnly yes
  UserKnownHostsFile /dev/null
  StrictHostKeyChecking no
  LogLevel ERROR
  BatchMode yes
  ConnectTimeout 3
  ServerAliveInterval 1
  ServerAliveCountMax 3
"""


def has_namespaces():
    if os.environ.get("FIXDEM_HOSTS") == "localhost":
        return False
    name = f"fixdem{os.getpid()}probe"
    if subprocess.run(["ip", "netns", "add", name], capture_output=True, check=False).returncode != 0:
        return False
    subprocess.run(["ip", "netns", "del", name], check=True)
    return True


class Host:
    def __init__(self, number, in_namespace):
        self.name, self.in_namespace = f"fixdem-host{number}", in_namespace
        self.namespace, self.link = f"fixdem{os.getpid()}h{number}", f"fd{os.getpid() % 100000}h{number}"
        net = f"10.{200 + os.getpid() % 50}.{number}"
        self.address, self.port = (
            (f"{net}.2", 2222) if in_namespace else ("127.0.0.1", 22000 + os.getpid() % 2000 + 2000 * number)
        )
        if in_namespace:
            within = ["ip", "-n", self.namespace]
            for command in (["ip", "netns", "add", self.namespace],
                            ["ip", "link", "add", self.link, "type", "veth", "peer", "name", "up0", "netns", self.namespace],
                            ["ip", "addr", "add", f"{net}.1/30", "dev", self.link], ["ip", "link", "set", self.link, "up"],
                            [*within, "addr", "add", f"{net}.2/30", "dev", "up0"], [*within, "link", "set", "up0", "up"],
                            [*within, "link", "set", "lo", "up"]):  # fmt: skip
                subprocess.run(command, check=True)
        values = {"name": self.name, "address": self.address, "port": self.port, "scratch": scratch, "lease": LEASE}
        (scratch / f"{self.name}.sshd").write_text(SSHD.format(**values))
        with (scratch / "ssh_config").open("a") as file:
            file.write(SSH.format(**values))
        sshd = f"hostname {self.name} && exec /usr/sbin/sshd -D -f {scratch}/{self.name}.sshd -E {scratch}/{self.name}.log"
        within = ["ip", "netns", "exec", self.namespace] if in_namespace else []
        self.sshd = subprocess.Popen(
            [*within, "unshare", "--uts", "sh", "-c", sshd] if in_namespace else ["sh", "-c", sshd.split("&& ")[1]]
        )

    def answers(self):
        return (
            subprocess.run(["ssh", "-F", scratch / "ssh_config", self.name, "true"], capture_output=True, check=False).returncode
            == 0
        )

    def die(self):
        """At once, without a farewell."""
        if self.in_namespace:
            subprocess.run(["ip", "link", "set", self.link, "down"], check=True)
            for process in subprocess.run(
                ["ip", "netns", "pids", self.namespace], capture_output=True, text=True, check=True
            ).stdout.split():
                os.kill(int(process), signal.SIGKILL)
        else:
            kill_tree(self.sshd.pid)

    def remove(self):
        kill_tree(self.sshd.pid)
        self.sshd.wait()
        if self.in_namespace:
            for process in subprocess.run(
                ["ip", "netns", "pids", self.namespace], capture_output=True, text=True, check=False
            ).stdout.split():
                os.kill(int(process), signal.SIGKILL)
            subprocess.run(["ip", "netns", "del", self.namespace], check=False)
            subprocess.run(["ip", "link", "del", self.link], check=False, capture_output=True)  # goes with the namespace


class TwoHosts(unittest.TestCase):
    def setUp(self):
        shutil.rmtree(scratch, ignore_errors=True)
        scratch.mkdir(parents=True)
        if not Path("/run/sshd").exists():  # sshd wants it
            Path("/run/sshd").mkdir()
            self.addCleanup(Path("/run/sshd").rmdir)
        for key in ("host_key", "user_key"):
            subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", scratch / key], check=True)
        self.namespaces = has_namespaces()
        print(
            "hosts: "
            + ("two network namespaces" if self.namespaces else "no network namespaces here: localhost twice, by two sshds")
        )
        self.hosts = []
        for number in (1, 2):
            host = Host(number, self.namespaces)
            self.addCleanup(host.remove)
            self.hosts.append(host)
        for host in self.hosts:
            wait_for(host.answers, 20)

    def test_a_host_that_dies_in_the_middle_loses_no_point(self):
        sweep = SweepRuns(scratch / "small", variables=["JOBS=1"])
        code, said = sweep.call()
        self.assertEqual(code, 0, said)
        expected, undisturbed = sweep.results(), sweep.records()

        sweep.begin_anew()
        hosts = scratch / "hosts"
        hosts.write_text("".join(f"{host.name}\n" for host in self.hosts))
        process = sweep.start(f"HOSTS={hosts}", f"SWEEP_SSH=ssh -F {scratch}/ssh_config")
        dying = self.hosts[0]
        if self.namespaces:
            name = wait_for(lambda: [name for name, machine, _ in sweep.running("plug") if machine == dying.name])[0]
        else:
            name = wait_for(lambda: [name for name, _, watcher in sweep.running("plug") if is_below(watcher, dying.sshd.pid)])[0]
        dying.die()
        died = time.monotonic()
        self.assertEqual(process.wait(), 0, sweep.said())
        print(f"{name} was running on {dying.name} when that died; the sweep was done {time.monotonic() - died:.0f} s later")
        self.assertEqual(different(sweep.results(), expected), [])
        records = sweep.records()
        self.assertEqual(set(records), set(undisturbed))
        self.assertLess(
            records[name]["particle_steps"], undisturbed[name]["particle_steps"], "it was gone on with, not begun anew"
        )
        if self.namespaces:
            machines = {run: record["owner"].split()[0] for run, record in records.items()}
            print("\n".join(f"  {run}: {machine}" for run, machine in machines.items()))
            self.assertEqual(machines[name], self.hosts[1].name)
            self.assertTrue(set(machines.values()) <= {host.name for host in self.hosts})
        code, said = sweep.call(f"HOSTS={hosts}", f"SWEEP_SSH=ssh -F {scratch}/ssh_config")
        self.assertEqual((code, sweep.records()), (0, records), said)


def is_below(process, ancestor):
    while process > 1 and process != ancestor:
        process = int(Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[1])
    return process == ancestor


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    run_and_count(*sys.argv[2:3])
