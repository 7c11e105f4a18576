#!/usr/bin/env python3
"""Checks the quick form of `make frontier` on a case: exact impacts, orders, the slider that does not converge, the files.

Usage: tests/frontier_test.py FOLDER [COUNT_FILE], FOLDER being that of the quick report. Writes "PASSED FAILED" to COUNT_FILE.
Exit code: 0 when all passed.
"""

import csv
import sys
import unittest
from pathlib import Path

root = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path[:0] = [str(root / part) for part in ("tests", "tools/report", "tools/frontier")]

import counted  # noqa: E402
import measure  # noqa: E402
import page  # noqa: E402

FOLDER = Path()


def rows_of(name):
    with (FOLDER / "report" / name).open() as file:
        return list(csv.DictReader(file))


class ExactImpacts(unittest.TestCase):
    exact = None

    def setUp(self):
        ExactImpacts.exact = ExactImpacts.exact or measure.Exact(FOLDER / "exact")

    def test_do_not_depend_on_the_tolerance(self):
        self.assertEqual(set(self.exact.doubt), {"displacement", "force", "rescale"})
        for doubt in self.exact.doubt.values():
            self.assertLess(doubt, 1e-10)

    def test_return_the_restitution_asked(self):
        for law in self.exact.outcomes.values():
            for n in range(2 * measure.REPEATS):  # pairs and walls, head on
                self.assertAlmostEqual(law[n][0] / measure.speed_of(n), 0.9, delta=1e-9)

    def test_that_slide_throughout_obey_the_law_of_momentum(self):
        # Steep: e_t = 1 - mu (1 + e) / tan(theta) holds for the elastic law; with damping friction is less at the end, never more.
        for n in range(7 * measure.REPEATS, 8 * measure.REPEATS):
            normal, tangential, spin, *_ = self.exact.outcomes["displacement"][n]
            speed = measure.speed_of(n)
            lost = speed * 0.984807753012208 - tangential
            self.assertAlmostEqual(spin, -2.5 * lost, delta=1e-10 * speed)  # eqs. (1), (2): the same force turns and brakes
            self.assertGreater(lost, 0.3 * (normal + 0.17364817766693033 * speed) * (1 - 1e-9))
            self.assertLess(lost, 0.3 * (normal + 0.17364817766693033 * speed) * 1.1)


class Kernel(unittest.TestCase):
    def error(self, setting, step):
        found = [r for r in rows_of("frontier_impacts.csv") if r["setting"] == setting and r["impact"] == "all" and abs(float(r["time_step_s"]) / step - 1) < 1e-3]
        self.assertEqual(len(found), 1)
        return float(found[0]["velocity"])

    def test_approaches_the_exact_rebound(self):
        for setting in ("euler.clip.double", "leapfrog.clip.double"):
            self.assertLess(self.error(setting, 2e-6), 2e-3)
            order = page.slope([(step, self.error(setting, step)) for step in (2e-7, 2e-6, 1e-5)])
            self.assertGreater(order, 1.0)
            self.assertLess(order, 1.6)

    def test_does_not_with_the_slider_of_the_paper(self):
        self.assertGreater(self.error("euler.paper.double", 2e-7), 20 * self.error("euler.clip.double", 2e-7))
        self.assertGreater(self.error("euler.paper.double", 2e-7), 0.8 * self.error("euler.paper.double", 2e-6))

    def test_approaches_the_trajectory_of_the_reference(self):
        rows = {(r["integrator"], round(float(r["time_step_s"]) * 1e6)): float(r["position_rms_error_1ms_m"]) for r in rows_of("frontier.csv")}
        for integrator in ("euler", "leapfrog"):
            self.assertLess(rows[integrator, 2], 2e-7)
            self.assertGreater(rows[integrator, 10], 3 * rows[integrator, 2])

    def test_report_is_complete(self):
        text = (FOLDER / "report" / "frontier.md").read_text()
        self.assertIn("For this scene, the cheapest setting", text.splitlines()[-1])
        for picture in ("frontier.svg", "frontier.png"):
            self.assertGreater((FOLDER / "report" / picture).stat().st_size, 1000)


class Page(unittest.TestCase):
    class Point:
        def __init__(self, run_time, error):
            self.run_time, self.value = run_time, error

    def test_pareto_set_is_what_nothing_beats(self):
        a, b, c, d = (self.Point(*p) for p in ((1, 3), (2, 2), (3, 2.5), (4, float("nan"))))
        self.assertEqual(page.pareto([a, b, c, d], lambda p: p.value), [a, b])

    def test_growth_is_found(self):
        import math

        points = [(t * 1e-3, 1e-12 * math.exp(t / 1.5)) for t in range(20)]
        self.assertAlmostEqual(measure.lyapunov_time(points, 1e-7), 1.5e-3, places=9)
        self.assertAlmostEqual(page.slope([(x, 3 * x**1.2) for x in (1, 2, 5)]), 1.2, places=9)


if __name__ == "__main__":
    FOLDER = Path(sys.argv[1])
    counted.run_and_count(*sys.argv[2:3])
