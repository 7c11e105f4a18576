#!/usr/bin/env python3
"""Tests of the movie (make test-movie): spheres are painted where they are and hide what lies behind; the file plays as long as asked.

Usage: movie_test.py RUN SCRATCH, the folder of a run of settle; ends with "N passed, M failed".
"""

import json
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np

root = Path(__file__).parent.parent
for part in ("tools/movie", "tools/picture", "tools/report", "tools/python", "tests"):
    sys.path.insert(0, str(root / part))
import line_folder
import movie
from spheres import COLOURS, PIPE, Painter

passed = failed = 0


def check(what, right, found=""):
    global passed, failed
    passed, failed = passed + bool(right), failed + (not right)
    print(f"{'passed' if right else 'FAILED'}  {what}" + (f": {found}" if str(found) else ""))


def painting():
    def paint(position, shares, periodic=True, radius=0.01):
        painter = Painter(0.1, 0.4, periodic, radius, 400)
        image = painter.paint(np.array(position), np.array(shares))
        return image[painter.margin : -painter.margin, painter.margin : -painter.margin].astype(int), painter

    one, painter = paint([[0, 0, 0.2]], [1.0])
    drawn = (one != PIPE).any(axis=2)
    check("a sphere covers its circle", abs(drawn.sum() / (np.pi * (0.01 * painter.scale) ** 2) - 1) < 0.03, int(drawn.sum()))
    rows, columns = np.nonzero(drawn)
    check("... where it is", abs(columns.mean() - 0.2 * painter.scale) < 1 and abs(rows.mean() - 0.05 * painter.scale) < 1)
    middle = one[round(0.05 * painter.scale), round(0.2 * painter.scale)]
    check("... in its colour", np.abs(middle / middle.max() - COLOURS[255] / COLOURS[255].max()).max() < 0.03, middle)
    two, _ = paint([[0.03, 0, 0.2], [-0.03, 0, 0.2]], [0.0, 1.0])
    check("the nearer one hides the other", (two == one).all())
    again, _ = paint([[-0.03, 0, 0.2], [0.03, 0, 0.2]], [1.0, 0.0])
    check("... whatever their order", (again == one).all())
    end, _ = paint([[0, 0, 0.001]], [1.0])
    ring = (end != PIPE).any(axis=2)
    check("across joined ends it shows at both", ring[:, :10].any() and ring[:, -5:].any())
    closed, _ = paint([[0, 0, 0.001]], [1.0], periodic=False)
    check("... and not where they are closed", not (closed != PIPE).any(axis=2)[:, -5:].any())


    radii = np.array([0.01, 0.005])
    sized, painter = paint([[0, 0, 0.1], [0, 0, 0.3]], [1.0, 0.0], radius=radii)
    drawn = (sized != PIPE).any(axis=2)
    halves = drawn[:, : drawn.shape[1] // 2].sum(), drawn[:, drawn.shape[1] // 2 :].sum()
    off = [abs(half / (np.pi * (r * painter.scale) ** 2) - 1) for half, r in zip(halves, radii)]
    check("each sphere covers its own circle", max(off) < 0.05, halves)
    swapped, _ = paint([[0, 0, 0.1], [0, 0, 0.3]], [1.0, 0.0], radius=radii)
    painter = Painter(0.1, 0.4, True, radii[::-1], 400)
    others = painter.paint(np.array([[0, 0, 0.1], [0, 0, 0.3]]), np.array([1.0, 0.0]), radii)
    check("... that of the moment, where particles come and go", (others[painter.margin : -painter.margin, painter.margin : -painter.margin] == swapped).all())
    many = Painter(0.1, 0.4, True, np.linspace(0.004, 0.005, 1000), 400)
    check("many sizes share a few discs", len(many.discs) < 20 and len(many.disc_of) == 1000, len(many.discs))


def between():
    frames = {"times": [0.0, 1.0], "position": np.array([[[0, 0, 0.39]], [[0, 0, 0.01]]]), "velocity": np.array([[[0, 0, 1.0]], [[0, 0, 3.0]]])}
    middle = list(movie.moments(frames, 3, 0.4, True))[1]
    check("between frames the short way round", abs(middle[0][0, 2] % 0.4) < 1e-9 and middle[1][0] == 2.0, middle)


def in_pieces():
    painter = Painter(0.05, 2.0, False, 0.005, 800)
    image = painter.paint(np.array([[0, 0, 0.5], [0, 0, 1.9]]), np.array([1.0, 1.0]))
    pieces = movie.in_pieces(image, 2, painter.margin)
    check("a long line is cut into pieces", pieces.shape == (2 * image.shape[0], (image.shape[1] - 2 * painter.margin) // 2 + 2 * painter.margin, 3), pieces.shape)
    columns = [np.nonzero((part[painter.margin : -painter.margin] != PIPE).any(axis=(0, 2)) & (part[painter.margin : -painter.margin] != 255).any(axis=(0, 2)))[0] for part in np.split(pieces, 2)]
    width = pieces.shape[1] - 2 * painter.margin
    places = [(np.median(c[(c > painter.margin + 4) & (c < painter.margin + width - 4)]) - painter.margin) / width + k for k, c in enumerate(columns)]
    check("... with what is in them", abs(places[0] - 0.5) < 0.01 and abs(places[1] - 1.9) < 0.01, places)
    check("... and a short one is not", movie.in_pieces(image, 1, painter.margin) is image)


def playing_line(scratch):
    line = line_folder.Line(length=2.0, duration=1.0)
    run = scratch / "line"
    if not (run / "frames").exists():
        line_folder.write_line(run, line, frames=True)
    path = scratch / "line.mp4"
    movie.make(run, line.case(), path, 1)
    asked = ["ffprobe", "-v", "error", "-of", "json", "-show_entries", "stream=width,height", path]
    stream = json.loads(subprocess.run(asked, capture_output=True, text=True, check=True).stdout)["streams"][0]
    check("a line of forty diameters plays in two pieces", abs(stream["width"] - movie.WIDTH) < 30 and stream["height"] > 2 * movie.WIDTH / movie.PIECE, stream)


def playing(run, scratch):
    case = tomllib.loads((root / "cases" / "settle.toml").read_text())
    scratch.mkdir(parents=True, exist_ok=True)
    for kind, fps in movie.RATES.items():
        path = scratch / f"movie.{kind}"
        movie.make(run, case, path, 2)
        asked = ["ffprobe", "-v", "error", "-count_frames", "-of", "json", "-show_entries", "stream=width,height,nb_read_frames,r_frame_rate", path]
        stream = json.loads(subprocess.run(asked, capture_output=True, text=True, check=True).stdout)["streams"][0]
        check(f"{kind}: as many pictures as asked for", int(stream["nb_read_frames"]) == 2 * fps and stream["r_frame_rate"] == f"{fps}/1", stream)
        raw = subprocess.run(["ffmpeg", "-loglevel", "error", "-i", path, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"], capture_output=True, check=True).stdout
        pictures = np.frombuffer(raw, np.uint8).reshape(2 * fps, stream["height"], stream["width"], 3)
        check("... of the right width", stream["width"] == movie.NARROWEST, stream["width"])
        moved = (np.abs(pictures[0].astype(int) - pictures[-1]) > 60).any(axis=2)
        check("... in which things move", moved.mean() > 0.05, f"{100 * moved.mean():.0f} %")
        empty = case["pipe"]["diameter"], pictures[-1, movie.HEAD + 30 : movie.HEAD + 60, stream["width"] // 2 - 100 : stream["width"] // 2 + 100]
        check("... and settle", np.abs(empty[1].astype(int) - PIPE).max() < 30)
    check("nothing unfinished is left", not list(scratch.glob("unfinished-*")))


painting()
between()
in_pieces()
playing_line(Path(sys.argv[2]))
playing(Path(sys.argv[1]), Path(sys.argv[2]))
print(f"{passed} passed, {failed} failed")
sys.exit(failed > 0)
