"""Files of comma-separated values as columns: log.csv, plugs.csv, probe_N.csv. Only the standard library is used."""

import csv
from pathlib import Path


def value(cell):
    """A number, None where the cell is empty, or the word that it is."""
    try:
        return float(cell) if cell else None
    except ValueError:
        return cell


def read_columns(path, expected=()):
    """Column name -> list of values; refuses a file that is damaged or lacks columns that are expected."""
    path = Path(path)
    if not path.exists():
        raise SystemExit(f"fixdem: {path} is missing: run the case first, or give its folder as OUT=...")
    with path.open(newline="", errors="replace") as file:
        rows = list(csv.reader(line.replace("\0", "\ufffd") for line in file))
    if not rows or not any(rows[0]):
        raise SystemExit(f"fixdem: {path} is empty: go on with the run (make run RESUME=1), or run the case again")
    head, *rows = rows
    for name in expected:
        if name not in head:
            raise SystemExit(f"fixdem: {path}:1: no column '{name}'; there are: {', '.join(head)}: run the case again with this program")
    for number, row in enumerate(rows, 2):
        if len(row) != len(head):
            raise SystemExit(f"fixdem: {path}:{number}: {len(row)} values in {len(head)} columns: damaged, or still being written; run the case again")
    return {name: [value(row[k]) for row in rows] for k, name in enumerate(head)}
