"""Runs the test cases of a Python file and writes "PASSED FAILED" for tests/run.sh."""

import sys
import unittest
from pathlib import Path


def run_and_count(count_file=None):
    """All TestCases of the main module; ends the process with exit code 0 when all passed, 1 otherwise."""
    program = unittest.main(argv=sys.argv[:1], exit=False, verbosity=2)
    failed = len(program.result.failures) + len(program.result.errors)
    if count_file:
        Path(count_file).write_text(f"{program.result.testsRun - failed} {failed}\n")
    raise SystemExit(failed > 0)
