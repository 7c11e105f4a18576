"""Runs the test cases of a Python file and writes "PASSED FAILED" for tests/run.sh."""

import sys
import unittest
from pathlib import Path


def passed_and_failed(result):
    """A class whose preparation fails is one failure, and none of its tests has run: unittest lists it among the errors
    without counting it as run. A test that fails in several subtests is one failure too."""
    bad = [test for test, _ in result.failures + result.errors] + result.unexpectedSuccesses
    failed = {getattr(test, "test_case", test).id() for test in bad if isinstance(test, unittest.TestCase)}
    prepared_badly = sum(not isinstance(test, unittest.TestCase) for test in bad)
    return result.testsRun - len(failed), len(failed) + prepared_badly


def write_count(result, count_file):
    passed, failed = passed_and_failed(result)
    Path(count_file).write_text(f"{passed} {failed}\n")


def run_and_count(count_file=None):
    """All TestCases of the main module; ends the process with exit code 0 when all passed, 1 otherwise."""
    program = unittest.main(argv=sys.argv[:1], exit=False, verbosity=0)
    if count_file:
        write_count(program.result, count_file)
    raise SystemExit(not program.result.wasSuccessful())
