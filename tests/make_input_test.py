#!/usr/bin/env python3
"""Odd input to make: code in variables, paths and names of files; names and values that mean nothing. Each is refused in one line.

Usage: tests/make_input_test.py BUILD_FOLDER CXX SCRATCH [COUNT_FILE]. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed.
"""

import re
import sys

sys.dont_write_bytecode = True
from counted import run_and_count  # noqa: E402
from make_checkout import Made, checkout, copy_checkout, make, root, scratch  # noqa: E402


def setUpModule():
    copy_checkout()


class Input(Made):
    """Values that a shell or make would read as something else, and names that nobody knows."""

    def variables(self):
        return re.findall(r"^kind\.(\w+) :=", (root / "tools" / "make" / "variables.mk").read_text(), re.MULTILINE)

    def test_no_variable_runs_code(self):
        self.assertGreater(len(self.variables()), 30)
        for name in self.variables():
            with self.subTest(name=name):
                self.refused("run", f"{name}=1`>pwned`;>pwned;$(shell >pwned)' >pwned '\n>pwned", saying=f"fixdem: {name}=")
        for value in ("1`>pwned`", "1;>pwned", "$(shell >pwned)", "1' >pwned '", "1\n>pwned", "$$(>pwned)", "1|>pwned", "1&>pwned"):
            for name in ("SEED", "ARGS"):
                with self.subTest(name=name, value=value):
                    self.refused("run", f"{name}={value}", saying=f"fixdem: {name}=")
        code, _, said = make("help", CASE="x`>pwned`.toml")
        self.assertEqual(code, 2, said)

    def test_a_file_in_cases_whose_name_is_code(self):
        for name in ("x`>pwned`.toml", "x;>pwned;.toml", "$(shell >pwned).toml", "x y.toml", "x%.toml"):
            odd = checkout / "cases" / name
            odd.write_text("")
            with self.subTest(name=name):
                self.refused("cases", saying="the name of a file holds .*rename it: cases/")
            odd.unlink()

    def test_characters_in_the_path_of_a_case(self):
        for character, words in (
            (" ", "a blank"), ("\t", "a blank"), ("%", "%"), (":", ":"), ("=", "="), ("#", "#"), ("'", "'"), (";", ";"), ("&", "&"),
            ("$", r"\$"), ('"', '"'), ("(", r"\("), ("*", r"\*"), ("?", r"\?"), ("~", "~"), ("\\", r"\\"), ("|", r"\|"), ("!", "!"),
        ):  # fmt: skip
            with self.subTest(character=character):
                self.refused("run", f"CASE=my{character}case.toml", saying=f"CASE=.*{words} cannot be in a path .*ln -s")
        self.refused("run", "CASE=-x.toml", saying=r"write \./-x")

    def test_a_checkout_in_a_path_with_a_blank(self):
        code, out, said = make("header", "CASE=settle")
        self.assertEqual(code, 0, said)
        self.assertIn("struct settle", out)
        self.assertEqual([line for line in said.splitlines() if "settle" not in line and "contact" not in line and "Rayleigh" not in line], [])
        quoted = scratch / "it's"
        quoted.mkdir()
        (quoted / "Makefile").symlink_to(checkout / "Makefile")
        (quoted / "tools").symlink_to(checkout / "tools")
        self.refused("cases", cwd=quoted, saying="the character ' is in the path of this folder")

    def test_names_that_no_target_knows(self):
        for given, name in (("case=settle", "CASE"), ("RESUM=1", "RESUME"), ("seed=1", "SEED"), ("EXTENT=1", "EXTEND")):
            self.refused("run", given, saying=f"no target knows a variable {given.split('=')[0]}: did you mean {name}")
        self.refused("run", "CXXFLAGS=-O0", saying=r"no target knows a variable CXXFLAGS \(make help")
        self.made("-n", "header", "CASE=settle", case="settle", RESUM="1")  # of the environment

    def test_values_that_mean_nothing(self):
        for given, words in (
            ("SEED=-1", "whole number"), ("SEED=1.5", "whole number"), ("EXTEND=0.3s", "a number"), ("LANES=3", "one of 1 2 4 8"),
            ("SAN=address", "one of 1 memory"), ("SAN=0", "one of"), ("QUICK=0", "QUICK=1, or leave it out"), ("RESUME=0", "RESUME=1"),
            ("ENGINE=make", "one of parallel slurm"), ("FORMAT=avi", "one of mp4 gif"),
            ("ARCH=avx2", "native scalar x86-64-v4 .*did you mean x86-64-v3"), ("ARCH=avx512", "did you mean x86-64-v4"),
            ("ARCH=sse2", "did you mean x86-64"), ("ARCH=nativ", "did you mean native"), ("ARCH=lanes2", "no such instruction set"),
        ):  # fmt: skip
            with self.subTest(given=given):
                self.refused("run", given, saying=words)
        self.refused("run", "RESUME=1", "FRESH=1", saying="exclude one another")
        self.made("-n", "header", "CASE=settle", "SEED=2", "ARGS=--duration 0.1 --no-frames")

    def test_clean_removes_nothing_of_others(self):
        precious = checkout / "precious"
        (precious / "g++-native").mkdir(parents=True)
        code, _, said = make("clean", "BUILD=precious")
        self.assertEqual(code, 2)
        self.assertIn("nothing is removed", said)
        self.assertTrue(precious.exists())


if __name__ == "__main__":
    run_and_count(*sys.argv[4:5])
