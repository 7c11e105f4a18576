#!/usr/bin/env python3
"""Reads slices.bin, what a run of an open line wrote along its pipe at every slice_interval, and prints it as CSV.

Usage: slices.py RUN/slices.bin [QUANTITY ...] >slices.csv; without quantities all of them, a row for each moment and slice.

The file begins with one line of JSON: number and length of the slices, names and units of the quantities. Records follow, one for
each moment: the time as a double, then each quantity as a float for every slice from z = 0 on. What is not defined, such as
the velocity of particles where there are none, is not a number. Only the standard library is used; numpy takes the arrays as they are.

Here, too, are the fronts that slices show, and the track of a plug that follows them.
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

from columns import FixdemError, as_command, contents

PLUG = 0.40  # solids fraction above which a slice is one of a plug
REACH = 0.15  # m: how far from where it is expected a front is looked for
MOST = 10_000_000  # slices, and quantities times slices


class Slices:
    """times (s); values: quantity -> one array of floats for each moment; units; length of a slice (m) and how many there are."""

    def __init__(self, path):
        path = Path(path)
        head, end, data = contents(path, "set slice_interval in [output] of the case, which is that of a line, and run it again").partition(b"\n")
        self.path = path
        self._read_head(head)
        if not end:
            raise self._damage("its first line has no end: it is cut short")
        size = 8 + 4 * len(self.units) * self.count
        if len(data) % size:
            what = f"{len(data)} bytes after its first line are not a whole number of records of {size}"
            raise self._damage(f"{what}: it is cut short, or still being written")
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
        return FixdemError(f"{self.path}: {what}; go on with the run (make run RESUME=1), or run the case again")

    def _read_head(self, head):
        if not head:
            raise self._damage("it is empty")
        try:
            about = json.loads(head)
            is_ours = about["what"] == "fixdem slices"
        except (ValueError, KeyError, TypeError, RecursionError):
            is_ours = False
        if not is_ours:
            raise FixdemError(f"{self.path}: its first line does not say 'fixdem slices': not a file of slices, or damaged")
        if about.get("version") != 1:
            raise FixdemError(f"{self.path}: version {about.get('version')}, this program reads 1: use the program that came with it")
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
                raise FixdemError(f"{self.path}: no quantity '{name}'; there are: {', '.join(self.values)}")
        return self

    def write_csv(self, file, quantities):
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["time [s]", "z [m]", *(f"{name} [{self.units[name]}]" if self.units[name] else name for name in quantities)])
        for k, time in enumerate(self.times):
            rows = zip(self.centres(), *(self.values[name][k] for name in quantities))
            writer.writerows([f"{time:.9g}", *("" if v != v else f"{v:.7g}" for v in row)] for row in rows)


def fronts_of(solids, length):
    """Places (m) at which the solids fraction over three slices falls through PLUG, one list for each row of slices."""
    found = []
    for row in solids:
        smooth = [sum(part) / len(part) for part in (row[max(0, k - 1) : k + 2] for k in range(len(row)))]
        pairs = enumerate(zip(smooth, smooth[1:]))
        found.append([(k + 0.5 + (a - PLUG) / (a - b)) * length for k, (a, b) in pairs if a > PLUG >= b])
    return found


def track(plug, times, fronts):
    """(time, place of the front) of a plug from its birth to when it was last seen. In between, at each moment of the slices, the
    front that is nearest to where the plug's velocity would have brought it; where there is none near enough, that place."""
    span = plug.last - plug.born
    velocity = plug.front_velocity or ((plug.last_at - plug.born_at) / span if span else 0.0)
    points = [(plug.born, plug.born_at)]
    for time, there in zip(times, fronts):
        if not plug.born < time < plug.last:
            continue
        expected = points[-1][1] + velocity * (time - points[-1][0])
        nearest = min(there, key=lambda z: abs(z - expected), default=expected)
        points.append((time, nearest if abs(nearest - expected) < REACH else expected))
    return [*points, (plug.last, plug.last_at)] if span else points


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
    as_command(main)
