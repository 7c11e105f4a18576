"""What starts the runs of a sweep: GNU parallel, on this machine or on hosts, or Slurm job arrays.

Either is given lists of numbers of runs, one list per stage (job.py makes run N), and comes back when nothing of them is left to
start. What has become of each run is in its record; an engine need not tell. Runs that are still missing then are given to
it again, as often as ROUNDS says.

Hosts and nodes share the folder of the results, at the same path, as clusters do.
"""

import shlex
import subprocess
import sys
import time
from pathlib import Path

JOB = Path(__file__).resolve().with_name("job.py")
LARGEST_ARRAY = 1000  # Slurm's MaxArraySize is 1001 by default
POLL = 2.0  # s
# A host that no longer answers is given up after 15 s; its runs go elsewhere.
SSH = "ssh -o BatchMode=yes -o ConnectTimeout=10 -o ServerAliveInterval=5 -o ServerAliveCountMax=3"


class Parallel:
    """As many runs at a time as `jobs` says, on each host; by default one for every core."""

    ROUNDS = 2

    def __init__(self, out, jobs=None, hosts=None, ssh=SSH):
        self.out, self.jobs, self.hosts, self.ssh = out, jobs, hosts, ssh

    def run(self, stages):
        for numbers in stages:
            if numbers:
                self.run_stage(numbers)

    def run_stage(self, numbers):
        # The program writes a checkpoint when it is told to stop, and has ten seconds for it.
        command = ["parallel", "--will-cite", "--line-buffer", "--retries", "3", "--termseq", "TERM,10000,KILL,25"]
        command += ["--jobs", str(self.jobs or "100%")]
        if self.hosts:
            command += ["--sshloginfile", str(Path(self.hosts).resolve()), "--ssh", self.ssh, "--workdir", str(Path.cwd())]
        command += [shlex.join(["python3", str(JOB), str(self.out)])]  # for the shell of each run
        process = subprocess.Popen(command, stdin=subprocess.PIPE, text=True)
        try:
            process.communicate("".join(f"{number}\n" for number in numbers))
        except KeyboardInterrupt:
            process.terminate()  # once more ends what it started; until then it would wait for it
            process.wait()
            raise


class Slurm:
    """Job arrays, as many tasks of one at a time as `jobs` says; each stage after the one before. sbatch takes partition, time
    limit and the like from its own variables (SBATCH_PARTITION, SBATCH_TIMELIMIT ...)."""

    ROUNDS = 3

    def __init__(self, out, jobs=None):
        self.out, self.jobs = Path(out), jobs
        self.folder = self.out / "slurm"

    def run(self, stages):
        self.folder.mkdir(parents=True, exist_ok=True)
        submitted, before = [], []
        try:
            for numbers in stages:
                chunks = [numbers[k : k + LARGEST_ARRAY] for k in range(0, len(numbers), LARGEST_ARRAY)]
                here = []
                for chunk in chunks:
                    here.append(self.submit(chunk, before))
                    submitted.append(here[-1])
                before = here or before
            self.wait(submitted)
        except KeyboardInterrupt:
            if submitted:
                subprocess.run(["scancel", *submitted], check=False)
                self.wait(submitted)  # they write checkpoints
            raise

    def submit(self, numbers, before):
        """The script of an array; task K makes the run on line K of a list beside it. Returns the number of the job."""
        count = sum(1 for _ in self.folder.glob("*.sh"))
        listed, script = self.folder / f"{count}.txt", self.folder / f"{count}.sh"
        listed.write_text("".join(f"{number}\n" for number in numbers))
        script.write_text(
            f'#!/bin/sh\nexec {shlex.join(["python3", str(JOB), str(self.out)])} '
            f'"$(sed -n "${{SLURM_ARRAY_TASK_ID}}p" {shlex.quote(str(listed))})"\n'
        )
        command = [
            "sbatch",
            "--parsable",
            "--requeue",
            f"--job-name=fixdem-{self.out.name}",
            f"--output={self.folder}/%A_%a.txt",
            f"--array=1-{len(numbers)}" + (f"%{self.jobs}" if self.jobs else ""),
        ]
        command += [f"--dependency=afterany:{':'.join(before)}"] if before else []
        done = subprocess.run([*command, str(script)], check=False, capture_output=True, text=True)
        if done.returncode != 0:
            raise OSError(f"sbatch: exit code {done.returncode}: {done.stderr.strip()}")
        job = done.stdout.strip().split(";")[0]
        print(f"Slurm job {job}: {len(numbers)} runs", flush=True)
        return job

    def wait(self, submitted):
        """Until the queue knows of none of them; a controller that does not answer is asked again."""
        while True:
            asked = subprocess.run(
                ["squeue", "--noheader", "--jobs", ",".join(submitted)], check=False, capture_output=True, text=True
            )
            over = asked.returncode == 0 and not asked.stdout.strip()
            if over or "Invalid job id" in asked.stderr:
                return
            if asked.returncode != 0:
                print(f"squeue: {asked.stderr.strip()}", file=sys.stderr, flush=True)
            time.sleep(POLL)
