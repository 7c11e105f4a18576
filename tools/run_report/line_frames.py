"""Frames of an open line, in which particles come and go: read for the page and the movie, and laid out in rows.

A particle has its serial number for its whole life, and a row of the arrays, frames x rows, from the frame in which it is first seen to
the last. Then the row stays empty for a frame at least, so that nobody takes two particles for one that has moved, and is
used again. Where a row is empty it repeats what was there before (or is there first), which costs nothing when packed.
"""

import heapq

import numpy as np
from columns import FixdemError
from fixdem import as_array
from frames import read_frame, some_frames
from run_folder import MOST_NUMBERS

NAMES = ("serial", "position", "velocity", "contacts", "radius", "species")


class LineFrames:
    """times (s); arrays: for each frame a dictionary of NAMES; gradients: of each frame (Pa/m by slices; None without gas); radii (m)
    that there are; most: particles in a frame; share: of all particles only every share-th has been read, by its serial number, so
    that frames are dense in time."""

    def __init__(self, run):
        listed = some_frames(run / "frames.pvd")
        largest = read_frame(max((path for _, path in listed), key=lambda path: path.stat().st_size), as_array)
        if "serial" not in largest:
            raise FixdemError(f"{run}: frames without serial numbers are not those of an open line: run the case again with this program")
        self.share = max(1, -(-len(listed) * len(largest["serial"]) * 7 // MOST_NUMBERS))
        self.most, self.times, self.arrays, self.gradients = len(largest["serial"]), [time for time, _ in listed], [], []
        for _, path in listed:
            frame = read_frame(path, as_array)
            kept = frame["serial"] % self.share == 0
            self.arrays.append({name: frame[name][kept] for name in NAMES if name in frame})
            self.gradients.append(frame.get("pressure_gradient"))
        self.radii = np.unique(np.concatenate([a["radius"] for a in self.arrays]))

    @property
    def drawn(self):
        """How many times as large as they are particles are drawn, so that a share of them fills the pipe as all do."""
        return self.share ** (1 / 3)

    def rows(self, every=1, share=1):
        """Times and arrays (frames x rows) of every `every`-th frame and `share`-th of the particles that were read; `serial` is one
        more than the number, 0 where a row is empty."""
        every_one = self.share * share
        frames = [{name: values[a["serial"] % every_one == 0] for name, values in a.items()} for a in self.arrays[::every]]
        serials = np.concatenate([a["serial"] for a in frames])
        moment = np.repeat(np.arange(len(frames)), [len(a["serial"]) for a in frames])
        known, which = np.unique(serials, return_inverse=True)
        first, last = np.full(len(known), len(frames)), np.full(len(known), -1)
        np.minimum.at(first, which, moment)
        np.maximum.at(last, which, moment)
        row = rows_by_life(first, last)[which]
        count = int(row.max(initial=0)) + 1
        present = np.zeros((len(frames), count), bool)
        present[moment, row] = True
        source = np.maximum.accumulate(np.where(present, np.arange(len(frames))[:, None], -1), axis=0)
        source = np.where(source < 0, np.argmax(present, axis=0), source)
        found = {"times": self.times[::every]}
        for name in frames[0]:
            values = np.concatenate([a[name] for a in frames])
            dense = np.zeros((len(frames), count, *values.shape[1:]), values.dtype)
            dense[moment, row] = values
            found[name] = dense[source, np.arange(count)]
        found["serial"] = np.where(present, found["serial"] + 1, 0)
        return found


def rows_by_life(first, last):
    """The row of each particle that is in frames first to last, as few rows as that takes."""
    free, rows, count = [], np.zeros(len(first), int), 0
    for k in np.lexsort((np.arange(len(first)), first)):
        if free and free[0][0] + 1 < first[k]:
            row = heapq.heappop(free)[1]
        else:
            row, count = count, count + 1
        rows[k] = row
        heapq.heappush(free, (int(last[k]), row))
    return rows


def between(rows, time, length):
    """What is seen of rows() at a time: positions, axial velocities and radii. A particle that is in one of two frames only is there
    until it is beyond `length` when it leaves, and from half of the time on when it comes."""
    times, serial = rows["times"], rows["serial"]
    k = min(max(int(np.searchsorted(times, time, "right")) - 1, 0), max(len(times) - 2, 0))
    there = min(k + 1, len(times) - 1)
    span = times[there] - times[k]
    part = (time - times[k]) / span if span > 0 else 0.0
    stays = serial[k] == serial[there]
    leaves = (serial[there] == 0) & ~stays
    position = rows["position"][k] + part * np.where(stays[:, None], rows["position"][there] - rows["position"][k], 0.0)
    position[leaves, 2] += part * span * rows["velocity"][k, leaves, 2]
    comes = ~stays & ~leaves
    position[comes] = rows["position"][there, comes]
    velocity = np.where(comes, rows["velocity"][there, :, 2], rows["velocity"][k, :, 2])
    velocity[stays] += part * (rows["velocity"][there, stays, 2] - rows["velocity"][k, stays, 2])
    radius = np.where(comes, rows["radius"][there], rows["radius"][k])
    shown = np.where(comes, part >= 0.5, serial[k] > 0) & (position[:, 2] < length)
    return position[shown], velocity[shown], radius[shown]
