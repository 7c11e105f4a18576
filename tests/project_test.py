#!/usr/bin/env python3
"""What the project says of itself: one version everywhere, and links in its documents that lead somewhere.

Usage: tests/project_test.py BUILD_FOLDER [COUNT_FILE]. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed.
"""

import json
import re
import subprocess
import sys
import unittest
from pathlib import Path

root = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True

from counted import run_and_count  # noqa: E402

build = Path(sys.argv[1]).resolve()
OURS = [path for path in root.rglob("*.md") if not {"build", "out", "node_modules", ".git"} & set(path.relative_to(root).parts)]


def headings(text):
    """Anchors as GitHub makes them."""
    found = re.findall(r"(?m)^#+ +(.*)$", re.sub(r"(?ms)^```.*?^```", "", text))
    return {re.sub(r"[^\w\- ]", "", heading.strip().lower().replace("`", "")).replace(" ", "-") for heading in found}


class Project(unittest.TestCase):
    def test_one_version(self):
        said = subprocess.run([build / "casegen", "--version"], capture_output=True, text=True, check=True).stdout
        version = re.search(r"\d+\.\d+\.\d+", said).group()
        self.assertIn(f"\nversion: {version}\n", (root / "CITATION.cff").read_text())
        self.assertEqual(json.loads((root / "codemeta.json").read_text())["version"], version)
        self.assertEqual(re.search(r"(?m)^## (\S+)", (root / ".github" / "CHANGELOG.md").read_text()).group(1), version)
        self.assertIn(f'"{version}"', (root / "tools" / "run" / "options.hpp").read_text())

    def test_links_lead_somewhere(self):
        self.assertGreater(len(OURS), 10)
        for path in OURS:
            text = re.sub(r"(?ms)^```.*?^```", "", path.read_text())
            for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`\n]*`", "", text)):
                if re.match(r"[a-z]+:", target):
                    continue
                place, _, anchor = target.partition("#")
                there = (path.parent / place).resolve() if place else path
                with self.subTest(document=str(path.relative_to(root)), link=target):
                    self.assertTrue(there.exists(), "no such file")
                    if anchor and there.suffix == ".md":
                        self.assertIn(anchor, headings(there.read_text()), "no such heading")


if __name__ == "__main__":
    run_and_count(sys.argv[2] if len(sys.argv) > 2 else None)
