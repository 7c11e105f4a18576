#!/usr/bin/env python3
"""A sweep in which one point ends with a fault: it is reported, the others are done, and make says that not all is well.

Usage: tests/sweep/failing_test.py SCRATCH [COUNT_FILE]. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed.
"""

import csv
import shutil
import sys
import unittest
from pathlib import Path

root = Path(__file__).resolve().parent.parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(root / "tests"))

from counted import run_and_count  # noqa: E402
from sweep_runs import SMALL, SweepRuns  # noqa: E402

scratch = Path(sys.argv[1]).resolve()


class OneFails(unittest.TestCase):
    def sweep(self, key, values):
        scratch.mkdir(parents=True, exist_ok=True)
        text, found = SMALL.read_text(), "gas.bulk_velocity = [1.7, 2.4]"
        self.assertIn(found, text)
        path = scratch / "failing.toml"
        path.write_text(text.replace(found, f'"{key}" = {values}'))
        sweep = SweepRuns(scratch / "out", path)
        shutil.rmtree(sweep.out / "runs", ignore_errors=True)
        code, said = sweep.call()
        self.assertNotEqual(code, 0, said)
        with (sweep.out / "points.csv").open() as file:
            return sweep, list(csv.DictReader(file)), said

    def test_a_point_that_fails_does_not_stop_the_others(self):
        sweep, rows, said = self.sweep("plug_u24.run.max_overlap", [0.5, 1e-6])
        self.assertEqual([(row["status"], row["exit_code"]) for row in rows], [("done", "0")] * 2 + [("failed", "5")] * 2, said)
        for row in rows[2:]:
            self.assertIn("overlap", row["message"])
            self.assertEqual(row["state_hash"], "")
        self.assertIn("2 points done, 2 failed, 0 missing", said)
        self.assertIn("failed: ", (sweep.out / "sweep.md").read_text())
        records = sweep.records()
        self.assertNotEqual(sweep.call()[0], 0)
        self.assertEqual(sweep.records(), records, "what has failed would fail again")

    def test_what_starts_from_a_failed_run_fails_with_its_message(self):
        _, rows, said = self.sweep("fill_1000.run.max_overlap", [0.5, 1e-6])
        self.assertEqual([row["status"] for row in rows], ["done"] * 2 + ["failed"] * 2, said)
        self.assertIn("starts from fill_1000-max_overlap_1e-06-seed_1, which failed: ", rows[2]["message"])


if __name__ == "__main__":
    run_and_count(*sys.argv[2:3])
