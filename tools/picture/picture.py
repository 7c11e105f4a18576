#!/usr/bin/env python3
"""Draws a run at several times, one side view above the other: make pictures.

Seen from the side (-x), the gas flowing from left to right (+z), y up. Every particle is a circle true to scale, coloured
by its axial velocity; nearer particles cover farther ones, and a particle of which nothing shows is left out, which keeps
the file small. The SVG is written here; rsvg-convert and pngquant make the PNG of it, so both show the same.
"""

import argparse
import subprocess
import sys
import tomllib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "report"))
from frames import frame_list, read_frame

PIXELS_PER_METRE = 1300.0  # a pipe of 0.8 m is 1040 wide
MARGIN_LEFT, MARGIN_RIGHT, MARGIN_TOP, GAP, FOOT = 66, 14, 10, 12, 66
SHADES = 32
# Dark violet (at rest) over green to yellow: even steps of lightness, also for the colour-blind and in grey print.
STOPS = [(86, 50, 140), (59, 92, 150), (33, 145, 140), (94, 201, 98), (253, 231, 37)]


def colour(fraction):
    place = min(max(fraction, 0.0), 1.0) * (len(STOPS) - 1)
    k = min(int(place), len(STOPS) - 2)
    return "#" + "".join(f"{round(a + (b - a) * (place - k)):02x}" for a, b in zip(STOPS[k], STOPS[k + 1]))


def shade(speed, fastest):
    return min(SHADES - 1, max(0, int(speed / fastest * SHADES)))


def visible(particles, width, height):
    """Those of which at least three pixels show, nearest last. particles: (x, column, row, radius, speed) in pixels."""
    taken = set()
    seen = []
    for particle in sorted(particles):  # smallest x, that is nearest, first
        _, column, row, radius, _ = particle
        shown = 0
        for j in range(max(0, int(row - radius)), min(int(height), int(row + radius) + 1)):
            for i in range(max(0, int(column - radius)), min(int(width), int(column + radius) + 1)):
                inside = (i + 0.5 - column) ** 2 + (j + 0.5 - row) ** 2 < radius * radius
                if inside and (i, j) not in taken:
                    taken.add((i, j))
                    shown += 1
        if shown >= 3:
            seen.append(particle)
    return reversed(seen)


def panel(frame, length, diameter, fastest):
    """One time: the particles as SVG, in a frame of reference that starts at the pipe's upper left corner."""
    width, height = length * PIXELS_PER_METRE, diameter * PIXELS_PER_METRE
    particles = []
    for (x, y, z), velocity, radius in zip(frame["position"], frame["velocity"], frame["radius"]):
        for image in (z - length, z, z + length):  # a particle across the periodic end shows at both
            if -radius < image < length + radius:
                row = (diameter / 2 - y) * PIXELS_PER_METRE
                particles.append((x, image * PIXELS_PER_METRE, row, radius * PIXELS_PER_METRE, velocity[2]))
    circles = (f'<use href="#p{shade(v, fastest)}" x="{c:.1f}" y="{r:.1f}"/>' for _, c, r, _, v in visible(particles, width, height))
    return f'<rect width="{width:.1f}" height="{height:.1f}" class="pipe"/><g clip-path="url(#pipe)">' + "".join(circles) + "</g>"


def scales(length, fastest, top):
    """The axis along the pipe and the colour bar, below the last panel."""
    parts = []
    for k in range(int(length / 0.1 + 1e-9) + 1):
        x = MARGIN_LEFT + 0.1 * k * PIXELS_PER_METRE
        parts.append(f'<path d="M{x:.1f} {top}v5" stroke="#444"/><text x="{x:.1f}" y="{top + 18}" text-anchor="middle">{0.1 * k:.1f}</text>')
    middle = MARGIN_LEFT + length * PIXELS_PER_METRE / 2
    parts.append(f'<text x="{MARGIN_LEFT}" y="{top + 40}">along the pipe, m; gas flows from left to right</text>')
    bar, step = middle + 120, 8
    for k in range(SHADES):
        parts.append(f'<rect x="{bar + k * step}" y="{top + 30}" width="{step + 1}" height="12" fill="{colour(k / (SHADES - 1))}"/>')
    parts.append(f'<text x="{bar - 6}" y="{top + 40}" text-anchor="end">axial velocity, m/s: 0</text>')
    parts.append(f'<text x="{bar + SHADES * step + 6}" y="{top + 40}">{fastest:g}</text>')
    return "".join(parts)


def picture(frames, length, diameter, fastest):
    width = MARGIN_LEFT + length * PIXELS_PER_METRE + MARGIN_RIGHT
    pitch = diameter * PIXELS_PER_METRE + GAP
    height = MARGIN_TOP + pitch * len(frames) + FOOT - GAP
    radius = frames[0][1]["radius"][0] * PIXELS_PER_METRE
    shades = "".join(f'<circle id="p{k}" r="{radius - 0.3:.2f}" fill="{colour(k / (SHADES - 1))}"/>' for k in range(SHADES))
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" width="{width:.0f}" height="{height:.0f}">',
        "<style>text{font:13px sans-serif;fill:#222}.pipe{fill:#f4f4f2;stroke:#444}circle{stroke:#000;stroke-width:.6}</style>",
        f'<defs>{shades}<clipPath id="pipe"><rect width="{length * PIXELS_PER_METRE:.1f}" '
        f'height="{diameter * PIXELS_PER_METRE:.1f}"/></clipPath></defs><rect width="100%" height="100%" fill="#fff"/>',
    ]
    for k, (time, frame) in enumerate(frames):
        top = MARGIN_TOP + k * pitch
        label = f'<text x="{MARGIN_LEFT - 8}" y="{top + pitch / 2:.0f}" text-anchor="end">{time:.2f} s</text>'
        parts.append(f'{label}<g transform="translate({MARGIN_LEFT} {top:.1f})">{panel(frame, length, diameter, fastest)}</g>')
    parts.append(scales(length, fastest, MARGIN_TOP + pitch * len(frames) - GAP + 1))
    return "\n".join(parts) + "</svg>\n"


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("run", type=Path, help="folder of a run: frames.pvd")
    arguments.add_argument("picture", type=Path, help="where to write, without .svg and .png")
    arguments.add_argument("--case", type=Path, required=True, help="the case file, for the size of the pipe")
    arguments.add_argument("--times", type=float, nargs="+", default=[0, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2], help="s")
    arguments.add_argument("--fastest", type=float, default=1.2, help="end of the colour scale, m/s")
    chosen = arguments.parse_args()

    pipe = tomllib.loads(chosen.case.read_text())["pipe"]
    available = frame_list(chosen.run / "frames.pvd")
    nearest = [min(available, key=lambda entry: abs(entry[0] - time)) for time in chosen.times]
    for time, (found, _) in zip(chosen.times, nearest):
        if abs(found - time) > 0.01:
            raise SystemExit(f"{chosen.run}: no frame near {time} s (the nearest is at {found} s)")
    frames = [(time, read_frame(path)) for time, path in nearest]
    svg, png = chosen.picture.with_suffix(".svg"), chosen.picture.with_suffix(".png")
    svg.parent.mkdir(parents=True, exist_ok=True)
    svg.write_text(picture(frames, pipe["length"], pipe["diameter"], chosen.fastest))
    subprocess.run(["rsvg-convert", "--zoom", "1.2", str(svg), "--output", str(png)], check=True)
    subprocess.run(["pngquant", "--force", "--strip", "--output", str(png), "128", str(png)], check=True)
    print(f"{svg} ({svg.stat().st_size // 1000} kB), {png} ({png.stat().st_size // 1000} kB)")


if __name__ == "__main__":
    main()
