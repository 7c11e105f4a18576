#!/usr/bin/env python3
"""A scene pays for what it uses: each feature that is taken out of the scene of tools/footprint lowers its memory, the code
of its step and the instructions of a particle-step, and no function of the feature is left.

That arrays are gone is asserted where the scenes are (tools/footprint/strips.hpp): it would not compile.

Usage: tests/footprint_test.py COUNT_FILE FOLDER CXX FLAGS...   FOLDER takes what is compiled.
Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed.
"""

import platform
import subprocess
import sys
import unittest
from pathlib import Path

root = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path[:0] = [str(root / "tests"), str(root / "tools" / "footprint")]

from counted import write_count  # noqa: E402
from footprint import STRIPS  # noqa: E402
from measuring import Calls, instructions_per_particle_step, output, size  # noqa: E402

program, compiler = Path("strips"), ["g++"]  # main() sets them

# What must be gone from a strip on, as parts of the names of functions.
GONE = {
    "one_size": ("search_by_sizes",),
    "without_gas": ("find_floaters", "update_slices", "solve_slices", "drag_on_floater"),
    "without_friction": ("sliding_contact_rows",),
    "without_wall": ("PipeSurface", "WallSide", "wall_contacts", "is_near_pipe"),
}


# What an open line alone may have.
OF_LINE = ("begin_feeding", "find_place", "let_leave", "take_out_gone")
FALLING = [name for name in STRIPS if name != "line"]


class Footprint(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        program.parent.mkdir(parents=True, exist_ok=True)
        # callgrind knows AVX2 at most; -O1 compiles in a third of the time of -O3.
        flags = [flag for flag in compiler[1:] if not flag.startswith(("-march", "-O", "-DFIXDEM_LANES"))]
        if platform.machine() == "x86_64":
            flags.append("-march=x86-64-v3")
        subprocess.run([compiler[0], *flags, "-O1", root / "tools" / "footprint" / "strips.cpp", "-o", program], check=True)
        cls.calls = Calls(program)

    def assert_falls(self, values, what):
        for (name, value), (next_name, next_value) in zip(values, values[1:], strict=False):
            self.assertLess(next_value, value, f"{what} of {next_name} against {name}")

    def test_memory_falls_with_every_part(self):
        self.assert_falls([(name, size(program, k)[0]) for k, name in enumerate(FALLING)], "bytes")

    def test_code_falls_with_every_part(self):
        calls = self.calls
        self.assert_falls([(name, calls.bytes_of(calls.step_of(name))) for name in FALLING], "code")

    def test_instructions_fall_with_every_part(self):
        counts = [
            (name, instructions_per_particle_step(program, k, particles=size(program, k)[1], steps=40))
            for k, name in enumerate(FALLING)
        ]
        self.assert_falls(counts, "instructions")

    def test_no_function_of_a_missing_part_is_left(self):
        everything = " ".join(self.calls.step_of("everything"))
        for first, names in GONE.items():
            self.assertTrue(any(name in everything for name in names), f"{names} are looked for under wrong names")
            for strip in FALLING[FALLING.index(first) :]:
                left = [f for f in self.calls.step_of(strip) if any(name in f for name in names)]
                self.assertFalse(left, strip)

    def test_only_a_line_has_what_a_line_needs(self):
        line = " ".join(self.calls.step_of("line"))
        for name in OF_LINE:
            self.assertIn(name, line)
            for strip in FALLING:
                self.assertFalse([f for f in self.calls.step_of(strip) if name in f], strip)


def main():
    global program, compiler
    count_file, program = Path(sys.argv[1]), Path(sys.argv[2]) / "strips"
    compiler = [part for part in sys.argv[3:] if "sanitize" not in part]
    suite = unittest.defaultTestLoader.loadTestsFromTestCase(Footprint)
    result = unittest.TextTestRunner(verbosity=0).run(suite)
    write_count(result, count_file)
    return 0 if result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
