#!/usr/bin/env python3
"""How `make test-systems` reads what commands print, keeps its table, and refuses; no root is made.

Usage: tests/systems/systems_test.py [COUNT_FILE]. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed.
"""

import contextlib
import io
import json
import sys
import unittest
from pathlib import Path
from unittest import mock

here = Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path[:0] = [str(here), str(here.parent), str(here.parent.parent / "tools" / "report")]

import counted  # noqa: E402
import outcome  # noqa: E402
import systems  # noqa: E402
from bare_root import BareRoot, NotTried, name_refused  # noqa: E402
from marked_part import KeptTable  # noqa: E402
from with_folder import WithFolder  # noqa: E402

COMPILED = """  compile kernel/step.hpp
/usr/include/c++/14/bits/stl_algobase.h:437:30: warning: 'void* memcpy()' writing 8 bytes [-Wstringop-overflow=]
/usr/include/c++/14/bits/stl_algobase.h:437:30: warning: 'void* memcpy()' writing 8 bytes [-Wstringop-overflow=]
clang++: warning: argument unused during compilation: '-x' [-Wunused-command-line-argument]
/usr/bin/ld: warning: x.o: missing .note.GNU-stack section
tests/a.cpp:3:1: note: the ABI for passing parameters with 64-byte alignment has changed in GCC 4.6
tests/a.cpp:3:1: note: declared here
cases/impulse.toml: warning: 12 steps per contact
dpkg: warning: ignoring option
2 warnings generated.
"""


def summary(state):
    return json.dumps({"final": {"state_hash": state}})


class ReadingOutput(unittest.TestCase):
    def test_warnings_of_compilers_count_once_and_those_of_cases_and_packages_not(self):
        begins = [line[: line.index(": ")] for line in outcome.warnings_in(COMPILED)]
        self.assertEqual(begins, ["/usr/include/c++/14/bits/stl_algobase.h:437:30", "clang++", "/usr/bin/ld", "tests/a.cpp:3:1"])

    def test_counts_are_those_of_the_last_line_and_the_exit_code_counts_too(self):
        said = "tests/a.cpp   3 passed, 0 failed (1 s)\n386 passed, 0 failed\n"
        for code, text, result, passed in (
            (0, said, "386 passed, 0 failed", True),
            (2, said, "386 passed, 0 failed", False),
            (2, "385 passed, 1 failed\n", "385 passed, 1 failed", False),
            (0, "385 passed, 1 failed\n", "385 passed, 1 failed", False),
            (0, "0 passed, 0 failed\n", "0 passed, 0 failed", False),
            (2, "make: *** [Makefile:74: test] Error 1\n", "no result, exit code 2", False),
        ):
            found = outcome.outcome_of_test(code, text, 60)
            self.assertEqual((found.result, found.passed, found.minutes), (result, passed, 1), (code, text))

    def test_a_run_has_passed_when_it_has_left_a_state(self):
        for code, left, result, passed in (
            (0, summary("0123abcd"), "state 0123abcd", True),
            (2, summary("0123abcd"), "exit code 2", False),
            (0, None, "no results", False),
        ):
            found = outcome.outcome_of_run(code, "", left, 60)
            self.assertEqual((found.result, found.passed), (result, passed))

    def test_versions_of_both_compilers_are_found(self):
        for said, version in (
            ("g++ (Debian 14.2.0-19) 14.2.0\nCopyright (C) 2024\n", "14.2.0"),
            ("Debian clang version 19.1.7 (3+b1)\nTarget: x86_64\n", "19.1.7"),
            ("sh: clang++: not found\n", "unknown"),
        ):
            self.assertEqual(outcome.version_in(said), version)


class Table(WithFolder):
    def setUp(self):
        super().setUp()
        document = self.write("document.md", "before\n<!-- systems table -->\n<!-- end -->\nafter\n")
        self.table = KeptTable(document, "systems table", outcome.HEAD, outcome.KEY)

    def row(self, compiler, state, commit):
        run = outcome.outcome_of_run(0, "a.cpp:1:1: warning: b\n", summary(state), 90)
        test = outcome.outcome_of_test(0, "5 passed, 0 failed\n", 600)
        return outcome.row(("debian:trixie", compiler, "13.1", "14.2.0"), run, test, commit)

    def test_rows_tried_anew_replace_their_like_and_others_stay(self):
        self.table.put([outcome.row_not_tried("ubuntu:noble", "g++", "no mirror", "c1"), self.row("g++", "aa", "c1")])
        said = self.table.put([self.row("g++", "bb", "c2"), self.row("clang++", "bb", "c2")])
        rows = self.table.rows()
        begun = [(row[0], row[1], row[-1]) for row in rows]
        self.assertEqual(begun, [("debian:trixie", "clang++", "c2"), ("debian:trixie", "g++", "c2"), ("ubuntu:noble", "g++", "c1")])
        self.assertEqual(rows[1][4:-1], ["state bb", "1", "1.5", "5 passed, 0 failed", "0", "10.0"])
        self.assertEqual(rows[2][4], "not tried: no mirror")
        self.assertEqual({len(row) for row in rows}, {len(outcome.HEAD)})
        self.assertEqual(self.table.path.read_text(), f"before\n<!-- systems table -->\n{said}\n<!-- end -->\nafter\n")
        self.assertEqual(self.table.put([]), said)

    def test_what_could_not_be_tried_this_time_does_not_displace_what_came_out_before(self):
        why = outcome.row_not_tried("debian:trixie", "g++", "no mirror", "c2")
        for rows, new, kept in (
            ([self.row("g++", "aa", "c1")], why, []),
            ([self.row("clang++", "aa", "c1")], why, [why]),
            ([why], why, [why]),
            ([why], self.row("g++", "aa", "c3"), [self.row("g++", "aa", "c3")]),
        ):
            self.assertEqual(outcome.new_rows(rows, new), kept)

    def test_states_that_differ_at_one_commit_are_told(self):
        same = [self.row("g++", "aa", "c1"), self.row("clang++", "aa", "c1")]
        self.assertEqual(outcome.states_that_differ(same), [])
        other = outcome.states_that_differ([*same, self.row("clang++", "bb", "c1")])
        self.assertEqual(other, ["commit c1: state aa, state bb"])
        self.assertEqual(outcome.states_that_differ([*same, self.row("clang++", "bb", "c2")]), [])


class Refusals(WithFolder):
    def test_what_is_no_system_or_lacks_mirror_or_keyring_is_told(self):
        bare = BareRoot("ubuntu:noble", self.folder, "http://mirror.invalid/", self.folder / "none.gpg")
        with self.assertRaisesRegex(NotTried, "none.gpg; name the keyring that signs ubuntu: UBUNTU_KEYRING=FILE"):
            bare.make(self.folder / "log")
        bare.mirror = None
        with self.assertRaisesRegex(NotTried, "no mirror of ubuntu; name one: UBUNTU_MIRROR=URL"):
            bare.make(self.folder / "log")
        for name in ("trixie", "fedora:41", "debian:", "debian:../etc", ":"):
            self.assertIn(f"'{name}' is no system; allowed: debian:SUITE, ubuntu:SUITE", name_refused(name))
        self.assertEqual([name_refused(name) for name in ("debian:trixie", "ubuntu:noble")], [None, None])

    def test_without_root_it_refuses_in_words(self):
        command = ["systems.py", "debian:trixie", "--folder", str(self.folder / "new"), "--document", "none.md"]
        said = io.StringIO()
        with mock.patch("os.geteuid", return_value=1000), mock.patch("sys.argv", command), contextlib.redirect_stderr(said):
            self.assertEqual(systems.main(), 2)
        self.assertIn("sudo make test-systems", said.getvalue())
        self.assertFalse((self.folder / "new").exists())


if __name__ == "__main__":
    counted.run_and_count(*sys.argv[1:2])
