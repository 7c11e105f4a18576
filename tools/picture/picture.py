#!/usr/bin/env python3
"""Draws a run at several times, one side view above the other: make pictures.

The gas flows from left to right; particles are coloured by their axial velocity.
"""

import argparse
import sys
import tomllib
from pathlib import Path

for part in ("report", "python"):
    sys.path.insert(0, str(Path(__file__).parent.parent / part))
from columns import as_command
from frames import frames_at
from side_view import axis, document, save

PIXELS_PER_METRE = 1300.0  # a pipe of 0.8 m is 1040 wide
SHADES = 32
# Dark violet (at rest) over green to yellow: even steps of lightness, also for the colour-blind and in grey print.
STOPS = [(86, 50, 140), (59, 92, 150), (33, 145, 140), (94, 201, 98), (253, 231, 37)]


def colour(fraction):
    place = min(max(fraction, 0.0), 1.0) * (len(STOPS) - 1)
    k = min(int(place), len(STOPS) - 2)
    return "#" + "".join(f"{round(a + (b - a) * (place - k)):02x}" for a, b in zip(STOPS[k], STOPS[k + 1]))


def shade(speed, fastest):
    return min(SHADES - 1, max(0, int(speed / fastest * SHADES)))


def foot(pipe, fastest):
    """The axis along the pipe and the colour bar."""

    def draw(left, top):
        parts = [axis(pipe["length"], PIXELS_PER_METRE, left, top)]
        parts.append(f'<text x="{left}" y="{top + 40}">along the pipe, m; gas flows from left to right</text>')
        bar, step = left + pipe["length"] * PIXELS_PER_METRE / 2 + 120, 8
        for k in range(SHADES):
            parts.append(f'<rect x="{bar + k * step}" y="{top + 30}" width="{step + 1}" height="12" fill="{colour(k / (SHADES - 1))}"/>')
        parts.append(f'<text x="{bar - 6}" y="{top + 40}" text-anchor="end">axial velocity, m/s: 0</text>')
        parts.append(f'<text x="{bar + SHADES * step + 6}" y="{top + 40}">{fastest:g}</text>')
        return "".join(parts)

    return 66, draw


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("run", type=Path, help="folder of a run: frames.pvd")
    arguments.add_argument("picture", type=Path, help="where to write, without .svg and .png")
    arguments.add_argument("--case", type=Path, required=True, help="the case file, for the size of the pipe")
    arguments.add_argument("--times", type=float, nargs="+", default=[0, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2], help="s")
    arguments.add_argument("--fastest", type=float, default=1.2, help="end of the colour scale, m/s")
    chosen = arguments.parse_args()

    pipe = tomllib.loads(chosen.case.read_text())["pipe"]
    frames = frames_at(chosen.run, chosen.times)
    panels = [(f"{time:.2f} s", frame, [f"p{shade(v[2], chosen.fastest)}" for v in frame["velocity"]]) for time, frame in frames]
    styles = {f"p{k}": colour(k / (SHADES - 1)) for k in range(SHADES)}
    svg = document(panels, pipe, styles, PIXELS_PER_METRE, foot(pipe, chosen.fastest))
    save(svg, chosen.picture)


if __name__ == "__main__":
    as_command(main)
