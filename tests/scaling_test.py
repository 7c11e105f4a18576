#!/usr/bin/env python3
"""The cost model of tools/scaling against costs that are known; nothing is measured.

Usage: tests/scaling_test.py [COUNT_FILE]. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed.
"""

import sys
import unittest
from pathlib import Path

root = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path[:0] = [str(root / "tests"), str(root / "tools" / "scaling")]

import counted  # noqa: E402
from cost_model import OneCore, Ranks, ranks_from  # noqa: E402


class CostModel(unittest.TestCase):
    def test_cost_between_sizes_is_interpolated_and_constant_beyond(self):
        core = OneCore({1000: 2e-8, 100000: 8e-8})
        self.assertAlmostEqual(core.cost(10000), 4e-8, delta=1e-20)
        self.assertEqual((core.cost(10), core.cost(1e9)), (2e-8, 8e-8))
        self.assertEqual(core.step(1000), 2e-5)

    def test_constants_of_known_step_times_come_back(self):
        known = Ranks(per_particle=3e-7, per_step=4e-5)
        sizes = (1000, 10000, 100_000_000)
        found = ranks_from({n: known.per_particle * n for n in sizes}, {n: known.step(n, 2) for n in sizes}, 2)
        self.assertAlmostEqual(found.per_particle / known.per_particle, 1, places=5)
        self.assertAlmostEqual(found.per_step / known.per_step, 1, places=9)

    def test_exchange_is_never_less_than_nothing(self):
        self.assertEqual(ranks_from({1000: 1.0, 10000: 10.0}, {1000: 0.4, 10000: 4.0}, 2).per_step, 0)

    def test_one_size_tells_nothing(self):
        with self.assertRaisesRegex(ValueError, "two sizes"):
            ranks_from({1000: 1.0}, {1000: 1.0}, 2)

    def test_ranks_needed_reach_the_step_time_and_one_less_does_not(self):
        ranks = Ranks(per_particle=3e-7, per_step=4e-5)
        for particles in (10**5, 10**7, 10**9):
            count = ranks.needed(particles, 0.001)
            self.assertLessEqual(ranks.step(particles, count), 0.001 * (1 + 1e-12))
            self.assertGreater(ranks.step(particles, count - 1), 0.001)
        self.assertIsNone(ranks.needed(1000, 3e-5))


if __name__ == "__main__":
    counted.run_and_count(*sys.argv[1:2])
