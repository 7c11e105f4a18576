#!/usr/bin/env python3
"""`make validate` (tools/validate/): a short run that must agree, the page against what is kept, rules and refusals.

Usage: tests/validate_test.py BUILD_FOLDER [COUNT_FILE], from the top folder; BUILD_FOLDER has casegen and the programs of all cases.
Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed.
"""

import json
import shutil
import subprocess
import sys
from pathlib import Path

root = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(root / "tools" / "validate"))

from counted import run_and_count  # noqa: E402
from runs import Places, Results, Run  # noqa: E402  first: it finds the modules of other folders
import extract  # noqa: E402
import laws  # noqa: E402
import paper  # noqa: E402
import rows  # noqa: E402
import tension  # noqa: E402
import validate  # noqa: E402
from with_folder import WithFolder  # noqa: E402

build = Path(sys.argv[1]).resolve()
KEPT = root / "cases" / "validation"


class WithResults(WithFolder):
    def setUp(self):
        super().setUp()
        self.places = Places(root / "cases", build, self.folder / "out", ["false"])

    def results(self, path=None):
        return Results(path or self.folder / "results.json", self.places)

    def validate(self, *options, results=None):
        command = [root / "tools/validate/validate.py", self.folder / "page.md", "--cases", root / "cases", "--build", build, "--out", self.folder / "out",
                   "--results", results or self.folder, "--make", "true", "--no-pictures", *options]  # fmt: skip
        return subprocess.run(command, capture_output=True, text=True, cwd=root)


class Command(WithResults):
    def test_a_short_run_agrees(self):
        done = self.validate("--quick")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"paper/fig-08-shipped: .*\n .*; agrees")
        text = (self.folder / "page.md").read_text()
        self.assertTrue(text.startswith("# Validation\n\n**1 rows agree, 0 differ, "), text[:200])
        figures = json.loads((self.folder / "results.json").read_text())["settle-seed1"]["figures"]
        self.assertEqual(figures["steps"], 100_000)

    def test_what_is_kept_is_not_run_again(self):
        self.validate("--quick")
        shutil.rmtree(self.folder / "out")
        done = self.validate("--quick")
        self.assertNotIn("runs", done.stdout.split("paper/")[0])
        self.assertFalse((self.folder / "out").exists())

    def test_the_page_is_what_the_kept_results_give(self):
        done = self.validate("--kept", results=KEPT)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "page.md").read_text(), (root / "cases" / "VALIDATION.md").read_text(), "run make validate KEPT=1")

    def test_unknown_rows_and_sections_are_refused(self):
        for option, value, there in (("--row", "paper/nothing", "paper/plug_u24-W"), ("--row", "nothing", "paper/..."), ("--section", "nothing", "tension"), ("--row", "contacts/nothing", "contacts/chung-ooi-4")):
            done = self.validate("--kept", option, value)
            self.assertEqual(done.returncode, 1)
            self.assertIn(value, done.stderr)
            self.assertIn(there, done.stderr)
            self.assertFalse((self.folder / "page.md").exists())

    def test_damaged_results_are_refused(self):
        self.write("results.json", "{")
        done = self.validate("--kept")
        self.assertEqual(done.returncode, 1)
        self.assertIn("results.json", done.stderr)
        self.assertEqual((self.folder / "results.json").read_text(), "{")


class Kept(WithResults):
    def test_results_of_another_case_or_kernel_are_not_known(self):
        results, run = self.results(), Run("settle")
        results.put(run, {"status": "done"})
        self.assertEqual(self.results().of(run), {"status": "done", "run": "settle-seed1"})
        self.assertIsNone(self.results().of(Run("settle", seed=2)))
        cases = self.folder / "cases"
        shutil.copytree(root / "cases", cases, ignore=shutil.ignore_patterns("gallery", "validation"))
        (self.folder / "tests" / "golden").mkdir(parents=True)
        pinned = self.folder / "tests" / "golden" / "states.txt"
        shutil.copyfile(root / "tests" / "golden" / "states.txt", pinned)
        self.places.cases = cases
        case = cases / "settle.toml"
        text = case.read_text()
        for changed, is_known in ((text.replace("friction = 0.3", "friction = 0.31"), False), ("# words\n" + text.replace("title = ", "title = 'other' #"), True), (text, True)):
            case.write_text(changed)
            self.assertEqual(self.results().of(run) is not None, is_known)
        pinned.write_text(pinned.read_text().replace("settle double 20000 ", "settle double 20000 0"))
        self.assertIsNone(self.results().of(run))

    def test_two_tables_that_are_filled_at_once_lose_nothing(self):
        one, other = self.results(), self.results()
        one.put(Run("settle"), {"status": "done"})
        other.put(Run("pipe_bed"), {"status": "done"})
        self.assertEqual(sorted(self.results().kept), ["pipe_bed-seed1", "settle-seed1"])

    def test_every_run_has_a_case_that_casegen_takes(self):
        places = Places(root / "cases", build, self.folder / "out", ["true"])
        every = {run for part in validate.sections() for run in part.runs()}
        every |= {run.start for run in every if run.start}
        Results(self.folder / "results.json", places).build(every)
        self.assertGreater(len(every), 60)
        for run in every:
            done = subprocess.run([build / "casegen", places.file(run), "--output", self.folder / "case.hpp"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, f"{run.name}: {done.stderr}")


class Rules(WithResults):
    def found(self, row, *figures):
        return row.find(list(figures))

    def test_within(self):
        row = rows.within("name", "what", 1.0, 2.0, [], lambda figures: figures["v"])
        self.assertEqual([self.found(row, {"v": v}).agrees for v in (0.9, 1.0, 2.0, 2.1)], [False, True, True, False])
        self.assertEqual(self.found(row, {"v": 1.5}, {"v": 2.5}).difference, "+0.50")
        self.assertFalse(self.found(row, {"v": None}).agrees)

    def test_a_row_without_its_runs_is_not_run_yet(self):
        row = rows.said("name", "what", "moves", [Run("settle")], lambda figures: "moves")
        self.assertEqual(row.found(self.results()).text, rows.NOT_RUN)

    def test_a_row_with_some_of_its_runs_says_how_many(self):
        results = self.results()
        results.put(Run("settle"), {"v": 1.0})
        row = rows.reported("name", "what", [Run("settle"), Run("settle", seed=2)], lambda figures: figures["v"], some=True)
        self.assertEqual(row.found(results).text, "1.00 [1 of 2 runs]")

    def test_few_plugs_of_a_line_are_reported_only(self):
        found = rows.Found("0.50", "+0.00", True)
        self.assertEqual([found.of_plugs(count).verdict for count in (9, 10)], ["report only", "agrees"])

    def test_the_order_of_fig_13(self):
        figures = [{"plug": {"front_velocity": v}} for v in (1.1, 1.1, 1.1, 0.9, 0.9, 0.9)]
        self.assertFalse(paper.order(figures).agrees)
        self.assertTrue(paper.order(figures[::-1]).agrees)
        self.assertEqual(tension.order([{"plug": None}, figures[0]]).difference, "a plug is lost")

    def test_laws_are_the_published_ones(self):
        point = laws.Point("name", 0.05, 1.0, 0.6, 0.4)
        froude = (9.81 * 0.05) ** 0.5
        self.assertAlmostEqual(point.lavrinec, 0.967 * 0.6 + 0.5 * froude)
        self.assertAlmostEqual(point.konrad, 0.6 + 0.54 * froude)
        self.assertAlmostEqual(point.balance, 0.4)
        self.assertAlmostEqual(point.eq41, 1 / (1 + 1.84 * 0.6 / froude))

    def test_fronts_are_unwrapped(self):
        places = extract.unwrapped([0.7, 0.79, 0.08, 0.17, 0.75], 0.8)
        for found, expected in zip(places, [0.7, 0.79, 0.88, 0.97, 0.75]):
            self.assertAlmostEqual(found, expected)

    def test_packed_stretches(self):
        self.assertEqual(extract.packed_parts([0.1] * 3 + [0.5] * 8 + [0.1] + [0.5] * 7 + [0.5] * 2), [(3, 11), (12, 21)])

    def test_ergun(self):
        case = {"gas": {"density": 1.2, "kinematic_viscosity": 1.5e-5}, "particles": {"diameter": 0.01}}
        xi = 0.6 / 0.4**3 * (150 * 0.6 * 1.5e-5 / (0.01 * 0.8) + 1.75)
        self.assertAlmostEqual(extract.ergun(case, 0.6, 0.8), xi * 1.2 * 0.8**2 / 0.01, places=6)


if __name__ == "__main__":
    run_and_count(sys.argv[2] if len(sys.argv) > 2 else None)
