"""What a run leaves in its folder, read for the page: frames as arrays, solids fraction by slices."""

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent / "python"))
from fixdem import as_array
from frames import read_frame, some_frames

MOST_NUMBERS = 60_000_000  # of all frames together: beyond that, frames are skipped while reading (half a gigabyte)
MOST_SLICES = 400  # columns of a map; more would not be told apart


def read_frames(run):
    """times (s), position and velocity (frames x particles x 3), contacts (frames x particles), pressure gradients (frames x
    slices, Pa/m; None without gas), radius (m) and species (None without) of each particle; None if the run wrote no frames."""
    if not (run / "frames.pvd").exists():
        return None
    listed = some_frames(run / "frames.pvd")
    first = read_frame(listed[0][1], as_array)
    every = max(1, -(-len(listed) * len(first["position"]) * 7 // MOST_NUMBERS))
    listed = listed[::every]
    frames = {"times": [time for time, _ in listed], "position": [], "velocity": [], "contacts": [], "pressure_gradient": []}
    for _, path in listed:
        frame = read_frame(path, as_array)
        for name in frames.keys() - {"times"}:
            if name in frame:
                frames[name].append(frame[name])
    frames = {name: np.array(values) if values else None for name, values in frames.items()}
    return frames | {name: first.get(name) for name in ("radius", "species")}


def slices_of(pipe, frames):
    """As many as the gas has, otherwise as many of the largest particle's diameter as fit; no more than a map shows."""
    gradients = frames["pressure_gradient"]
    fitting = max(1, round(pipe["length"] / (2 * float(frames["radius"].max()))))
    return min(MOST_SLICES, gradients.shape[1] if gradients is not None else fitting)


def solids_fraction(pipe, places, radii, slices):
    """frames x slices: volume of the particles whose centres are in a slice, over that of the slice; places, radii: z and radius
    of the particles in each frame."""
    volume = np.pi / 4 * pipe["diameter"] ** 2 * pipe["length"] / slices
    edges = np.linspace(0, pipe["length"], slices + 1)
    found = [np.histogram(np.clip(z, 0, pipe["length"]), edges, weights=4 / 3 * np.pi * r**3)[0] for z, r in zip(places, radii)]
    return np.array(found) / volume


def by_slices(values, slices):
    """frames x slices: means over neighbouring slices of the gas where there are more than `slices`."""
    edges = np.rint(np.linspace(0, values.shape[1], slices + 1)).astype(int)
    return np.add.reduceat(values, edges[:-1], axis=1) / np.diff(edges)
