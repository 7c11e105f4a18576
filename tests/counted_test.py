#!/usr/bin/env python3
"""What tests/counted.py counts, of tests that pass, fail, fail twice, and cannot be prepared.

Usage: tests/counted_test.py [COUNT_FILE]. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed.
"""

import io
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))

from counted import passed_and_failed, run_and_count  # noqa: E402


def counts_of(case):
    suite = unittest.defaultTestLoader.loadTestsFromTestCase(case)
    return passed_and_failed(unittest.TextTestRunner(stream=io.StringIO()).run(suite))


class Counting(unittest.TestCase):
    def test_passed_and_failed(self):
        class Mixed(unittest.TestCase):
            def test_good(self):
                pass

            def test_bad(self):
                self.fail()

            def test_broken(self):
                raise OSError

            def test_bad_in_parts(self):
                for part in range(3):
                    with self.subTest(part=part):
                        self.fail()

        self.assertEqual(counts_of(Mixed), (1, 3))

    def test_a_class_that_cannot_be_prepared_is_one_failure(self):
        class Unprepared(unittest.TestCase):
            @classmethod
            def setUpClass(cls):
                raise AssertionError

            def test_one(self):
                pass

            def test_two(self):
                pass

        self.assertEqual(counts_of(Unprepared), (0, 1))


if __name__ == "__main__":
    run_and_count(*sys.argv[1:2])
