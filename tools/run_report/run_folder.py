"""What a run leaves in its folder, read for the page: summary, log as columns, frames as arrays, solids fraction by slices."""

import csv
import json
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent / "report"))
from frames import frame_list, read_frame

MOST_NUMBERS = 60_000_000  # of all frames together: beyond that, frames are skipped while reading (half a gigabyte)
MOST_SLICES = 400  # columns of a map; more would not be told apart


def read_summary(run):
    path = run / "summary.json"
    if not path.exists():
        raise SystemExit(f"fixdem: {path} is missing: run the case first, or give its folder as OUT=...")
    return json.loads(path.read_text())


def read_log(run):
    """Column name -> list of values, None where a cell is empty."""
    with (run / "log.csv").open(newline="") as file:
        head, *rows = csv.reader(file)
    return {name: [float(row[k]) if row[k] else None for row in rows] for k, name in enumerate(head)}


def read_frames(run):
    """times (s), position and velocity (frames x particles x 3), contacts (frames x particles), pressure gradients (frames x
    slices, Pa/m; None without gas), radius (m) and species (None without) of each particle; None if the run wrote no frames."""
    if not (run / "frames.pvd").exists():
        return None
    listed = frame_list(run / "frames.pvd")
    first = read_frame(listed[0][1])
    every = max(1, -(-len(listed) * len(first["position"]) * 7 // MOST_NUMBERS))
    listed = listed[::every]
    frames = {"times": [time for time, _ in listed], "position": [], "velocity": [], "contacts": [], "pressure_gradient": []}
    for _, path in listed:
        frame = read_frame(path)
        for name in frames.keys() - {"times"}:
            if name in frame:
                frames[name].append(np.array(frame[name]))
    frames = {name: np.array(values) if values else None for name, values in frames.items()}
    return frames | {name: np.array(first[name]) if name in first else None for name in ("radius", "species")}


def slices_of(pipe, frames):
    """As many as the gas has, otherwise as many of the largest particle's diameter as fit; no more than a map shows."""
    gradients = frames["pressure_gradient"]
    fitting = max(1, round(pipe["length"] / (2 * float(frames["radius"].max()))))
    return min(MOST_SLICES, gradients.shape[1] if gradients is not None else fitting)


def solids_fraction(pipe, frames, slices):
    """frames x slices: volume of the particles whose centres are in a slice, over that of the slice."""
    volume = np.pi / 4 * pipe["diameter"] ** 2 * pipe["length"] / slices
    edges = np.linspace(0, pipe["length"], slices + 1)
    solids = 4 / 3 * np.pi * frames["radius"] ** 3
    found = [np.histogram(np.clip(z, 0, pipe["length"]), edges, weights=solids)[0] for z in frames["position"][:, :, 2]]
    return np.array(found) / volume


def gradient_by_slices(frames, slices):
    """frames x slices: means over neighbouring slices of the gas where there are more than `slices`."""
    parts = np.array_split(frames["pressure_gradient"], slices, axis=1)
    return np.array([part.mean(axis=1) for part in parts]).T
