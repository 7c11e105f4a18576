#!/usr/bin/env python3
"""What tools/validate/contacts.py makes of a record of the single contacts: verdicts, and what is refused.

Usage: tests/validate_contacts_test.py [COUNT_FILE]. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed.
"""

import sys
from pathlib import Path

root = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(root / "tools" / "validate"))

import contacts  # noqa: E402
from counted import run_and_count  # noqa: E402
from with_folder import WithFolder  # noqa: E402

HEAD = ",".join(contacts.HEAD) + "\n"
AGREES = 'chung-ooi-1,glass,"maximum overlap",um,274.113,274.12,0.14,closed form (Hertz)\n'
DIFFERS = "mfix-dem06,in the end,velocity,m/s,-0.0574,-0.0575,1e-05,published\n"
REPORTED = "chung-ooi-4-experiment,2.03 degrees,e_t,,0.794,1.003,,experiment\n"


class Contacts(WithFolder):
    def of(self, text, *cases):
        return contacts.tables(self.write("contacts.csv", text), cases)

    def refuses(self, text, *words):
        with self.assertRaises(SystemExit) as said:
            self.of(text, "chung-ooi-1")
        for word in words:
            self.assertIn(str(word), str(said.exception))

    def test_verdicts(self):
        parts = self.of(HEAD + REPORTED + DIFFERS + AGREES, "chung-ooi-1", "chung-ooi-4-experiment", "mfix-dem06")
        self.assertEqual([title.partition(":")[0] for title, _, _ in parts], ["Chung & Ooi 1", "Chung & Ooi 4 and MFIX DEM05", "MFIX DEM06"])
        agrees, reported, differs = (rows[0] for _, _, rows in parts)
        self.assertEqual([row["verdict"] for row in (agrees, reported, differs)], ["agrees", "report only", "**differs**"])
        self.assertEqual((agrees["id"], agrees["expected"], agrees["allowed"]), ("chung-ooi-1/glass/maximum overlap", 274.113, 0.14))
        self.assertAlmostEqual(differs["difference"], -1e-4)
        self.assertIsNone(reported["allowed"])
        self.assertIn("| glass | maximum overlap, um | 274.113 | 274.12 | 0.007 | 0.14 | agrees |", parts[0][1])
        self.assertIn("| 0.21 |  | report only |", parts[1][1])
        self.assertIn("Expected: closed form (Hertz).", parts[0][1])

    def test_what_is_no_number_differs(self):
        ((_, _, (row,)),) = self.of(HEAD + AGREES.replace("274.12", "nan"), "chung-ooi-1")
        self.assertEqual(row["verdict"], "**differs**")

    def test_several_sources_have_a_column(self):
        ((_, text, _),) = self.of(HEAD + AGREES + AGREES.replace("closed form (Hertz)", "published"), "chung-ooi-1")
        self.assertIn("| expected from |", text)

    def test_damage_is_named(self):
        path = self.folder / "contacts.csv"
        with self.assertRaises(SystemExit):
            contacts.tables(path)
        for text, words in (
            ("", ":1: the columns"),
            ("a,b\n" + AGREES, ":1: the columns"),
            (HEAD + AGREES + AGREES[:30] + "\n", ":3: "),
            (HEAD + AGREES.replace("274.12,", "x,"), ":2: found is no number, 'x'"),
            (HEAD + AGREES + DIFFERS.replace("-0.0574,", ","), ":3: expected is no number, ''"),
            (HEAD + AGREES.replace("0.14", "-1"), ":2: what is expected or allowed cannot be"),
            (HEAD + AGREES.replace("0.14", "nan"), ":2: what is expected or allowed cannot be"),
            (HEAD + AGREES.replace("chung-ooi-1", "chung-ooi-9"), ":2: no case is called 'chung-ooi-9'"),
        ):
            self.refuses(text, f"{path}{words}")
        self.refuses(HEAD + DIFFERS, path, "nothing is recorded of chung-ooi-1")

    def test_every_case_is_known(self):
        """The names in the tests' sources and those that the page knows are the same."""
        sources = "".join(path.read_text() for path in (root / "tests").glob("*_test.cpp"))
        for name in contacts.CASES:
            self.assertIn(f'"{name}"', sources)


if __name__ == "__main__":
    run_and_count(*sys.argv[1:2])
