#!/usr/bin/env python3
"""Runs that are made once (tools/report/kept_run.py): when one is made again, resumed, waited for or taken over.

Usage: tests/kept_run_test.py [COUNT_FILE]. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed.
"""

import os
import subprocess
import sys
from pathlib import Path

root = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
for folder in ("tools/report", "tests/sweep"):
    sys.path.insert(0, str(root / folder))

import kept_run  # noqa: E402
from counted import run_and_count  # noqa: E402
from kept_run import KeptRun  # noqa: E402
from sweep_runs import wait_for  # noqa: E402
from with_folder import WithFolder  # noqa: E402


class MadeOnce(WithFolder):
    """A run of a program that only counts how often it is started."""

    def setUp(self):
        super().setUp()
        self.run = KeptRun(self.folder / "run", self.folder / "program", ("--seed", "1"))
        self.program("exit 0")

    def program(self, end):
        path = self.write(
            "program",
            f'#!/bin/sh\necho "$@" >>{self.folder}/calls\nmkdir -p {self.run.folder}\n'
            f'cd {self.run.folder}\necho "{{}}" >summary.json\ntouch final.fixdem\n{end}\n',
        )
        path.chmod(0o755)

    def calls(self):
        return (self.folder / "calls").read_text().splitlines()

    def test_a_run_that_is_done_is_left_alone_until_program_options_or_start_change(self):
        for _ in range(2):
            self.assertEqual(self.run.complete()["state"], "done")
        self.assertEqual(len(self.calls()), 1)
        self.run.options = ("--seed", "2")
        self.run.complete()
        self.program("exit 0 # another")
        self.run.complete()
        self.run.start_state = self.write("state", "1")
        self.run.complete()
        self.write("state", "23")
        self.run.complete()
        self.run.complete()
        self.assertEqual(len(self.calls()), 5)
        self.assertFalse(any("--resume" in call for call in self.calls()), "another input begins at the beginning")
        (self.run.folder / "final.fixdem").unlink()
        self.run.complete()
        self.assertEqual(len(self.calls()), 6, "a result that has gone is made again")

    def test_a_failure_for_good_is_not_repeated_and_any_other_is_resumed(self):
        self.program("echo too fast >&2; exit 5")
        for _ in range(2):
            record = self.run.complete()
        self.assertEqual(
            (record["state"], record["exit_code"], record["message"], len(self.calls())), ("failed", 5, "too fast", 1)
        )
        self.program("exit 6")
        self.assertEqual(self.run.complete()["state"], "stopped")
        self.assertEqual(self.run.complete()["state"], "stopped")
        self.assertEqual(["--resume" in call for call in self.calls()], [False, False, True])

    def test_a_checkpoint_that_is_refused_does_not_stand_in_the_way(self):
        self.program('case "$*" in *--resume*) echo damaged >&2; exit 3;; esac; [ -e again ] || { touch again; exit 6; }')
        self.run.complete()
        record = self.run.complete()
        self.assertEqual((record["state"], len(self.calls())), ("done", 3))

    def test_one_that_is_running_is_waited_for_and_one_whose_owner_is_gone_is_taken_over(self):
        gone = subprocess.Popen(["true"])
        gone.wait()
        here = os.uname().nodename
        self.run.write(state="running", owner=f"{here} {gone.pid} x")
        self.assertTrue(self.run.is_abandoned(f"{here} {gone.pid} x"))
        self.assertFalse(self.run.is_abandoned(f"{here} {os.getpid()} x"))
        self.assertFalse(self.run.is_abandoned("elsewhere 1 x"))
        os.utime(self.run.record_path, (1e9, 1e9))
        self.assertTrue(self.run.is_abandoned("elsewhere 1 x"), "nobody has touched the record for long")
        self.run.folder.mkdir()
        (self.run.folder / "lock").write_text("process 1 on host elsewhere\n")
        self.assertEqual(self.run.complete()["state"], "done")
        self.assertFalse((self.run.folder / "lock").exists(), "the lock of the machine that is gone")

    def test_one_that_was_taken_over_stops_its_program(self):
        self.program("trap 'exit 143' TERM; while :; do sleep 0.1; done")
        beat, kept_run.BEAT = kept_run.BEAT, 0.2
        try:
            fork = os.fork()
            if fork == 0:
                code = 1
                try:
                    self.run.complete()
                except kept_run.Superseded:
                    code = 7
                os._exit(code)
            wait_for(lambda: self.run.read().get("state") == "running" and (self.folder / "calls").exists())
            self.run.write(state="running", owner="elsewhere 1 x")
            self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(fork, 0)[1]), 7)
            self.assertEqual(self.run.read()["owner"], "elsewhere 1 x", "the record is the other's")
        finally:
            kept_run.BEAT = beat


if __name__ == "__main__":
    run_and_count(*sys.argv[1:2])
