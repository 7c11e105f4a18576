#!/usr/bin/env python3
"""Reads slices.bin, what a run of an open line wrote along its pipe at every slice_interval, and prints it as CSV.

Usage: slices.py RUN/slices.bin [QUANTITY ...] >slices.csv; without quantities all of them, a row for each moment and slice.

The file begins with one line of JSON: number and length of the slices, names and units of the quantities. Records follow, one for
each moment: the time as a double, then each quantity as a float for every slice from z = 0 on. What is not defined, such as
the velocity of particles where there are none, is not a number. Only the standard library is used; numpy takes the arrays as they are.
"""

import argparse
import csv
import json
import math
import signal
import struct
import sys
from array import array
from pathlib import Path

MOST = 10_000_000  # slices, and quantities times slices


class Slices:
    """times (s); values: quantity -> one array of floats for each moment; units; length of a slice (m) and how many there are."""

    def __init__(self, path):
        path = Path(path)
        if not path.exists():
            raise SystemExit(f"fixdem: {path} is missing: set slice_interval in [output] of the case and run it again")
        head, _, data = path.read_bytes().partition(b"\n")
        self.path = path
        self._read_head(head)
        size = 8 + 4 * len(self.units) * self.count
        if len(data) % size:
            raise self._damage(f"{len(data)} bytes after its first line are not a whole number of records of {size}: it is cut short, or still being written")
        self.times, self.values = [], {name: [] for name in self.units}
        for at in range(0, len(data), size):
            self.times.append(struct.unpack_from(self.order + "d", data, at)[0])
            at += 8
            for rows in self.values.values():
                row = array("f", data[at : at + 4 * self.count])
                if self.order != ("<" if sys.byteorder == "little" else ">"):
                    row.byteswap()
                rows.append(row)
                at += 4 * self.count
        if not all(math.isfinite(t) and t > before for t, before in zip(self.times, [-math.inf, *self.times])):
            raise self._damage("its times do not ascend")

    def _damage(self, what):
        return SystemExit(f"fixdem: {self.path}: {what}; go on with the run (make run RESUME=1), or run the case again")

    def _read_head(self, head):
        if not head:
            raise self._damage("it is empty")
        try:
            about = json.loads(head)
            is_ours = about["what"] == "fixdem slices"
        except (ValueError, KeyError, TypeError):
            is_ours = False
        if not is_ours:
            raise SystemExit(f"fixdem: {self.path}: its first line does not say 'fixdem slices': not a file of slices, or damaged")
        if about.get("version") != 1:
            raise SystemExit(f"fixdem: {self.path}: version {about.get('version')}, this program reads 1: use the program that came with it")
        try:
            self.order = {"little": "<", "big": ">"}[about["byte_order"]]
            self.count, self.length = about["slices"], float(about["slice_length"])
            self.units = {quantity["name"]: quantity["unit"] for quantity in about["quantities"]}
            is_whole = isinstance(self.count, int) and 0 < self.count * max(1, len(self.units)) <= MOST and 0 < self.length < math.inf
        except (KeyError, TypeError, ValueError):
            is_whole = False
        if not is_whole or len(self.units) != len(about["quantities"]):
            raise self._damage("its first line is damaged")

    def centres(self):
        """z of the middle of each slice, m."""
        return [(k + 0.5) * self.length for k in range(self.count)]

    def at_least(self, *quantities):
        """Itself, when it has these."""
        for name in quantities:
            if name not in self.values:
                raise SystemExit(f"fixdem: {self.path}: no quantity '{name}'; there are: {', '.join(self.values)}")
        return self

    def write_csv(self, file, quantities):
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["time [s]", "z [m]", *(f"{name} [{self.units[name]}]" if self.units[name] else name for name in quantities)])
        for k, time in enumerate(self.times):
            rows = zip(self.centres(), *(self.values[name][k] for name in quantities))
            writer.writerows([f"{time:.9g}", *("" if v != v else f"{v:.7g}" for v in row)] for row in rows)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("slices", type=Path, help="slices.bin of a run")
    arguments.add_argument("quantities", nargs="*", help="which; all without")
    chosen = arguments.parse_args()
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # whoever reads may have enough
    slices = Slices(chosen.slices)
    quantities = chosen.quantities or list(slices.values)
    slices.at_least(*quantities).write_csv(sys.stdout, quantities)


if __name__ == "__main__":
    main()
