#!/usr/bin/env python3
"""Sweeps: points and programs that follow from a sweep file, what is refused, and a small sweep over GNU parallel, stopped and
killed in the middle, that must end in the bytes of an undisturbed one.

Usage: tests/sweep/sweep_test.py CASEGEN SCRATCH [COUNT_FILE]. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed.
"""

import csv
import fcntl
import os
import shutil
import signal
import subprocess
import sys
import unittest
from pathlib import Path

import tomli_w

root = Path(__file__).resolve().parent.parent.parent
sys.dont_write_bytecode = True
for folder in ("tools/sweep", "tests"):
    sys.path.insert(0, str(root / folder))

from counted import run_and_count  # noqa: E402
from points import plan_of  # noqa: E402
from sweep_file import Refused, read_sweep  # noqa: E402
from sweep_runs import SMALL, SweepRuns, different, interrupt, wait_for  # noqa: E402
from with_folder import WithFolder  # noqa: E402

CASES = root / "cases"
casegen, scratch = (Path(argument).resolve() for argument in sys.argv[1:3])
PLUG = 'base = "plug_u24"\n'


class WithPlan(WithFolder):
    def plan(self, text):
        return plan_of(read_sweep(self.write("sweep.toml", text), CASES))


class Points(WithPlan):
    def test_lists_and_ranges_give_all_combinations_in_order(self):
        plan = self.plan(
            PLUG + '[vary]\ngas.bulk_velocity = {from = 1.7, to = 2.4, points = 3}\n"gas.bed_diameter" = [0.01, 0.003]'
        )
        self.assertEqual([values for values, _ in plan.points], [(u, d) for u in (1.7, 2.05, 2.4) for d in (0.01, 0.003)])

    def test_a_range_by_step_is_rounded_and_ends_where_it_must(self):
        axes = read_sweep(
            self.write(
                "s.toml",
                PLUG + "[vary]\ngas.bulk_velocity = {from = 1.8, to = 2.4, step = 0.2}\n"
                "particles.count = {from = 100, to = 60, step = -15}",
            ),
            CASES,
        ).axes
        self.assertEqual(axes["gas", "bulk_velocity"], [1.8, 2.0, 2.2, 2.4])
        self.assertEqual(axes["particles", "count"], [100, 85, 70])
        self.assertTrue(all(isinstance(count, int) for count in axes["particles", "count"]))

    def test_points_that_differ_in_run_time_values_share_a_program(self):
        plan = self.plan(
            'base = "settle"\n[vary]\nstart.seed = [1, 2, 3]\nrun.duration = [0.1, 0.2]\nmaterial.friction = [0.2, 0.3]'
        )
        self.assertEqual((len(plan.points), len(plan.jobs), len(plan.cases)), (12, 12, 2))
        job = plan.jobs["settle-friction_0p2-seed_3-duration_0p1"]
        self.assertEqual((job.program, job.options), ("settle-friction_0p2", ["--seed", "3", "--duration", "0.1"]))

    def test_the_case_that_it_starts_from_gets_particles_material_and_seed_but_no_gas(self):
        plan = self.plan(
            PLUG
            + "[vary]\nparticles.count = [500, 1000]\nstart.seed = [1, 2]\ngas.bulk_velocity = [1.7, 2.4]\n[set]\nmaterial.friction = 0.2"
        )
        self.assertEqual((len(plan.points), len(plan.jobs), len(plan.cases)), (8, 12, 6))
        fill = plan.cases["fill_1000-count_500"]
        self.assertEqual((fill["particles"]["count"], fill["material"]["friction"], "gas" in fill), (500, 0.2, False))
        job = plan.jobs["plug_u24-count_500-bulk_velocity_1p7-seed_2"]
        self.assertEqual((job.start, job.options, job.stage), ("fill_1000-count_500-seed_2", [], 1))
        self.assertEqual(plan.jobs[job.start].options, ["--seed", "2"])
        self.assertEqual(plan.cases[job.program]["start"]["from"], "fill_1000-count_500")

    def test_values_may_be_tables_in_time_and_the_capacity_of_a_line_is_its_own(self):
        plan = self.plan(
            'base = "line_10mm"\n[vary]\ngas.bulk_velocity = [2.4, [[0.0, 1.5], [5.0, 3.0]]]\n'
            '[set]\nstart.from = "fill_1000"\nparticles.capacity = 3000'
        )
        self.assertEqual([name for _, name in plan.points], [f"line_10mm-bulk_velocity_{u}" for u in ("2p4", "0_1p5_5_3")])
        line = plan.cases["line_10mm-bulk_velocity_0_1p5_5_3"]
        self.assertEqual((line["gas"]["bulk_velocity"], line["particles"]["capacity"]), ([[0.0, 1.5], [5.0, 3.0]], 3000))
        self.assertNotIn("capacity", plan.cases["fill_1000"]["particles"])

    def test_the_case_that_it_starts_from_may_be_a_path(self):
        plan = self.plan(PLUG + '[set]\nstart.from = "../cases/fill_1000.toml"\n[vary]\nstart.seed = [1, 2]')
        self.assertEqual(plan.jobs["plug_u24-seed_2"].start, "fill_1000-seed_2")
        self.assertEqual(plan.cases["plug_u24"]["start"]["from"], "fill_1000")

    def test_a_key_with_the_name_of_a_case_goes_to_that_alone(self):
        plan = plan_of(read_sweep(SMALL, CASES))
        fill, plug = plan.cases["fill_1000"], plan.cases["plug_u24-bulk_velocity_2p4"]
        self.assertEqual((fill["pipe"]["length"], plug["pipe"]["length"]), (0.2, 0.2))
        self.assertEqual((fill["run"]["duration"], plug["run"]["duration"]), (1.2, 1.2))  # run-time values are not compiled in
        self.assertEqual(plan.jobs["fill_1000-seed_2"].options, ["--duration", "0.05", "--seed", "2"])

    def test_points_that_start_from_differing_cases_have_differing_names(self):
        plan = self.plan(PLUG + '[vary]\n"fill_1000.pipe.length" = [1.5, 2.0]\n"fill_1000.run.duration" = [1.0, 1.2]')
        self.assertEqual(len({name for _, name in plan.points}), 4)
        job = plan.jobs["plug_u24-length_1p5-duration_1p2"]
        self.assertEqual((job.program, job.start), ("plug_u24-length_1p5", "fill_1000-length_1p5-duration_1p2"))
        self.assertEqual(plan.cases[job.program]["pipe"]["length"], 0.8)

    def test_an_unchanged_base_case_keeps_every_value(self):
        plan = self.plan('base = "plug_u24"\n[vary]\nstart.seed = [1]')
        shutil.copy(CASES / "fill_1000.toml", self.folder)
        headers = []
        for label, text in (
            ("derived", tomli_w.dumps(plan.cases["plug_u24"])),
            ("shipped", (CASES / "plug_u24.toml").read_text()),
        ):
            path = self.write("plug_u24.toml", text)
            said = subprocess.run([casegen, path, "--print"], capture_output=True, text=True, check=True).stdout
            headers.append([line for line in said.splitlines() if "xxh64" not in line and "source_hash" not in line])
        self.assertEqual(*headers)


class Refusals(WithPlan):
    def refused(self, text, words):
        with self.assertRaisesRegex(Refused, words) as caught:
            self.plan(text)
        self.assertEqual(caught.exception.code, 3)
        self.assertIn(str(self.folder), str(caught.exception))

    def test_what_makes_no_sense_in_a_sweep_file(self):
        vary = "[vary]\nstart.seed = [1]\n"
        for text, words in (
            ("[vary\n", "not TOML: .*line 1"),
            ('base = "plug_u25"\n' + vary, "no case file .*\n  did you mean 'plug_u24'"),
            (vary, "base: None"),
            (PLUG, r"\[vary\]: nothing to vary"),
            (PLUG + "varied = 1\n" + vary, "varied: unknown key\n  did you mean 'vary'"),
            (PLUG + "checkpoint_interval = 0\n" + vary, "checkpoint_interval: 0\n"),
            (PLUG + "frames = 1\n" + vary, "frames: 1\n  allowed: true or false"),
            (PLUG + "[vary]\ncount = [1]", r"\[vary\] count: not the key of a case"),
            (PLUG + "[vary]\nstart.seed = 1", r"start.seed: 1\n  allowed: a list"),
            (PLUG + "[vary]\nstart.seed = []", "start.seed: "),
            (PLUG + "[vary]\nstart.seed = [1, 2, 1]", "start.seed: 1 twice"),
            (PLUG + "[vary]\nstart.seed = {from = 1, to = 3}", "incomplete range"),
            (PLUG + "[vary]\nstart.seed = {from = 1, to = 3, step = 0}", "step = 0 does not lead"),
            (PLUG + "[vary]\nstart.seed = {from = 1, to = 3, step = -1}", "step = -1 does not lead"),
            (PLUG + "[vary]\nstart.seed = {from = 1, to = 3, points = 1}", "points = 1\n"),
            (PLUG + "[vary]\nstart.seed = {from = 1, to = 1e9, step = 1}", "more than 100000 values"),
            (PLUG + "[vary]\nstart.seed = {from = 1, to = nan, points = 3}", "to = nan"),
            (PLUG + vary + "[set]\nstart.seed = 2", "start.seed: in .vary. and in .set."),
            (
                PLUG + vary + '[set]\n"fill_500.run.duration" = 2.0',
                "'fill_500' is not a case of this sweep\n  allowed: plug_u24, fill_1000",
            ),
            (PLUG + vary + '[plot]\nx = "gas.bulk_velocity"', "'gas.bulk_velocity' is not varied\n  allowed: start.seed"),
            (PLUG + '[vary]\nstart.motion = ["st op", "st_op"]', "two points would both be called"),
        ):
            with self.subTest(text=text):
                self.refused(text, words)

    def sweep(self, path, *options):
        command = [sys.executable, root / "tools/sweep/sweep.py", path, "--out", self.folder / "out", "--casegen", casegen,
                   "--programs", self.folder, "--make", "false", *options]  # fmt: skip
        done = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
        return done.returncode, done.stderr

    def test_casegen_refuses_what_makes_no_sense_in_a_case(self):
        for line, words in (
            ("gas.bulk_speed = [1.0]", "unknown key 'bulk_speed' in [gas]"),
            ("particles.count = [10, -1]", "fill_1000-count_-1"),
            ("run.duration = [-1.0]", "duration = -1 in [run] is out of range"),
            ("start.seed = [1.5]", "seed = 1.5 in [start] is a number with a point"),
        ):
            with self.subTest(line=line):
                code, said = self.sweep(self.write("sweep.toml", f"{PLUG}[vary]\n{line}\n"))
                self.assertEqual(code, 3, said)
                self.assertIn(words, said)
                place = next(word for word in said.split() if ".toml:" in word)
                self.assertTrue(
                    Path(place.split(".toml")[0] + ".toml").exists(), f"{place}: the file that is complained of is there"
                )
                self.assertFalse((self.folder / "out" / "cases").exists(), "nothing else is written")

    def test_wrong_usage_and_files_that_are_not_there(self):
        path = self.write("sweep.toml", PLUG + "[vary]\nstart.seed = [1]")
        self.assertEqual(self.sweep(path, "--jobs", "0")[0], 2)
        self.assertEqual(self.sweep(path, "--engine", "slurm", "--hosts", path)[0], 2)
        self.assertEqual(self.sweep(path, "--hosts", self.folder / "none")[0], 6)
        self.assertEqual(self.sweep(self.folder / "none.toml")[0], 6)

    def test_a_second_sweep_in_the_same_folder(self):
        path = self.write("sweep.toml", PLUG + "[vary]\nstart.seed = [1]")
        (self.folder / "out").mkdir()
        with (self.folder / "out" / "sweep.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            lock.write("process 1 on elsewhere")
            lock.flush()
            code, said = self.sweep(path)
        self.assertEqual(code, 6, said)
        self.assertIn("a sweep is under way there (process 1 on elsewhere)", said)
        self.assertFalse((self.folder / "out" / "cases").exists(), "nothing is written beside it")


class SmallSweep(unittest.TestCase):
    def test_stopped_and_killed_it_ends_in_the_same_bytes_and_nothing_is_run_twice(self):
        longer = SMALL.read_text().replace("run.duration = 0.2 ", "run.duration = 0.8 ")  # time to stop it in
        longer += '\n[plot]\ny = ["front_velocity", "mean_height"]\n'
        scratch.mkdir(parents=True, exist_ok=True)
        (scratch / "small.toml").write_text(longer)
        sweep = SweepRuns(scratch / "small", scratch / "small.toml", variables=["JOBS=2"])
        sweep.begin_anew()
        code, said = sweep.call()
        self.assertEqual(code, 0, said)
        self.assertIn("4 points, 3 programs, 6 runs in 2 stage(s)", said)
        expected, records = sweep.results(), sweep.records()
        with (sweep.out / "points.csv").open() as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([(row["gas.bulk_velocity"], row["start.seed"], row["status"]) for row in rows],
                         [(u, seed, "done") for u in ("1.7", "2.4") for seed in ("1", "2")])  # fmt: skip
        self.assertEqual(len({row["state_hash"] for row in rows}), 4)
        for picture in ("mean_height.svg", "mean_height.png"):
            self.assertTrue((sweep.out / picture).exists())
        self.assertFalse((sweep.out / "fig_13.svg").exists(), "so few particles make no plug: nothing to show")

        code, said = sweep.call()
        self.assertEqual(code, 0, said)
        self.assertIn("6 of 6 runs are there, 0 are missing", said)
        self.assertEqual(sweep.records(), records, "nothing was run")

        sweep.begin_anew()
        process = sweep.start()
        wait_for(lambda: sweep.running("plug"))
        self.assertNotEqual(interrupt(process), 0)
        stopped = [name for name, record in sweep.records().items() if record["state"] == "stopped"]
        under_way = [name for name in stopped if any((sweep.out / "runs" / name).glob("checkpoint-*"))]
        self.assertTrue(under_way, "Ctrl-C stops runs and leaves their checkpoints")  # those that had just begun have none
        over = {name: record for name, record in sweep.records().items() if record["state"] == "done"}

        process = sweep.start()
        name, _, watcher = wait_for(lambda: [run for run in sweep.running("plug") if run[0] not in stopped])[0]
        os.kill(watcher, signal.SIGKILL)
        self.assertEqual(process.wait(), 0, sweep.said())
        self.assertEqual(different(sweep.results(), expected), [])
        after = sweep.records()
        self.assertEqual({name: after[name] for name in over}, over, "what was done is not run again")
        for resumed in (*under_way, name):
            self.assertLess(after[resumed]["particle_steps"], records[resumed]["particle_steps"], "a part of the run only")


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # a test in the background must not pass on that it ignores it
    run_and_count(*sys.argv[3:4])
