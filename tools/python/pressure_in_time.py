#!/usr/bin/env python3
"""Draws the pressure along a line against time, from the slices of a run: pressure_in_time.py RUN PICTURE writes PICTURE.svg and .png."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "report"))
import fixdem
from report import gnuplot


def draw(run, picture):
    slices = fixdem.Run(run).slices
    every = max(1, len(slices.times) // 600)
    times, pressure = slices.times[::every], slices["pressure"][::every]
    rows = "\n".join(" ".join(f"{value:.5g}" for value in slice_) for slice_ in pressure.T / 1000)
    step = (times[-1] - times[0]) / max(1, len(times) - 1) or 1.0
    gnuplot(
        f"$kPa << END\n{rows}\nEND\nset autoscale fix\n"
        "set xlabel 'time, s'\nset ylabel 'along the pipe, m'\nset cblabel 'pressure above the outlet, kPa'\n"
        f"plot $kPa matrix using ({times[0]} + $1 * {step}):({slices.z[0]} + $2 * {slices.length}):3 with image notitle",
        picture,
    )


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    fixdem.as_command(lambda: draw(*sys.argv[1:]))
