#!/usr/bin/env python3
"""Writes the LAMMPS input of a case and a state (make export-lammps): scene_files.py says which files and what is in them.

Exit code: 0 done, 2 wrong usage, 3 the case or the state cannot be exported, 6 a file cannot be read or written.
"""

import argparse
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "peers"))
from case_values import read_header
from ending import Failed, finish
from scene_files import SUFFIX, Refused, files
from states import read_final


def positive(text):
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{text}: a whole number of 1 or more")
    return number


def clear_results(folder):
    """Takes away what an earlier run has left, so that nothing is mixed up."""
    for old in ("final.lammpstrj", "frames.lammpstrj", "log.lammps", "summary.json", "plug.json", "slices.csv"):
        (folder / old).unlink(missing_ok=True)


def write_all(folder, texts):
    """Every file under another name first, so that none is ever half written."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in texts.items():
        (folder / (name + SUFFIX)).write_text(text)
    clear_results(folder)
    (folder / "run.in").unlink(missing_ok=True)
    for name in texts:
        os.replace(folder / (name + SUFFIX), folder / name)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--header", type=Path, required=True, help="the case's header, written by casegen")
    arguments.add_argument("--state", type=Path, required=True, help="final.fixdem of the state to start from")
    arguments.add_argument("--origin", help="what the script says of the state (default: its path)")
    arguments.add_argument("--repeat", type=positive, default=1, help="copies one behind the other along a periodic pipe")
    arguments.add_argument("--out", type=Path, required=True, help="folder of the files")
    chosen = arguments.parse_args()
    if not chosen.state.is_file():
        raise Failed(6, f"{chosen.state}: no such file; STATE is the final.fixdem of a run of this case (make run CASE=...), "
                        "and without STATE the export is of the case's own start")
    case, state = read_header(chosen.header), read_final(chosen.state)
    try:
        texts = files(case, state, chosen.origin or f"the state {chosen.state}", chosen.repeat)
    except Refused as refused:
        raise Failed(3, f"{case['source']}: {refused}") from None
    write_all(chosen.out, texts)
    particles = len(state.positions) * chosen.repeat
    print(f"{chosen.out}: {', '.join(texts)}; {particles} particles, contact histories start empty")


if __name__ == "__main__":
    finish("export-lammps", main)
