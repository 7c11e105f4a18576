#!/usr/bin/env python3
"""A movie of a run, particles coloured by their axial velocity: make movie CASE=... [FORMAT=gif] [SECONDS=10]

Between the run's frames places are interpolated on a straight line, across joined ends the short way round. Pictures go to ffmpeg
through a pipe; nothing is left on the disk but the movie, and that only when it is complete. FORMAT mp4 (H.264) plays
anywhere; gif has half the pictures a second and 64 colours. An open line that is long is shown in pieces one below the other.
"""

import argparse
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

import numpy as np

for part in ("report", "run_report", "picture", "python"):
    sys.path.insert(0, str(Path(__file__).parent.parent / part))
from columns import as_command
from line_frames import LineFrames, between
from run_folder import read_frames
from spheres import COLOURS, FINER, Painter

WIDTH, HIGHEST = 1200, 560  # pixels of the pipe
HEAD, FOOT = 34, 30  # pixels of text above and below
NARROWEST = 760  # pixels of the picture: room for the text
PIECE = 20  # diameters: of a line that is longer, the most that is seen in one piece
BAR = 330, 256  # where the bar of colours begins, and how long it is
RATES = {"mp4": 30, "gif": 15}  # pictures per second


def moments(frames, count, length, periodic):
    """Positions, axial velocities and radii (None: as at the beginning) at `count` moments, evenly from the first frame to the last."""
    times = np.array(frames["times"])
    for time in np.linspace(times[0], times[-1], count):
        k = min(int(np.searchsorted(times, time, "right")) - 1, max(len(times) - 2, 0))
        part = (time - times[k]) / (times[k + 1] - times[k]) if len(times) > 1 else 0.0
        here, there = frames["position"][k], frames["position"][min(k + 1, len(times) - 1)]
        way = there - here
        if periodic:
            way[:, 2] -= length * np.rint(way[:, 2] / length)
        velocity = (1 - part) * frames["velocity"][k, :, 2] + part * frames["velocity"][min(k + 1, len(times) - 1), :, 2]
        yield here + part * way, velocity, None


def line_moments(line, count, length):
    rows = line.rows()
    for time in np.linspace(line.times[0], line.times[-1], count):
        position, velocity, radius = between(rows, time, length)
        yield position, velocity, radius * line.drawn


def in_pieces(image, pieces, margin):
    """A long picture cut into equal pieces, one below the other; `margin`: pixels around the pipe in it, kept around each piece."""
    if pieces == 1:
        return image
    width = -(-(image.shape[1] - 2 * margin) // pieces)
    rows = []
    for k in range(pieces):
        piece = np.full((image.shape[0], width + 2 * margin, 3), 255, np.uint8)
        part = image[:, k * width + (margin if k else 0) : (k + 1) * width + (2 * margin if k == pieces - 1 else margin)]
        piece[:, margin if k else 0 :][:, : part.shape[1]] = part
        rows.append(piece)
    return np.concatenate(rows)


def dressed(image, head, foot):
    """With room for text above and below, and the bar of colours in the foot; rows and columns even, as H.264 wants."""
    rows, columns = image.shape[0] + FINER * (head + foot), max(image.shape[1], FINER * NARROWEST)
    page = np.full((-(-rows // (2 * FINER)) * 2 * FINER, -(-columns // (2 * FINER)) * 2 * FINER, 3), 255, np.uint8)
    left = (columns - image.shape[1]) // 2
    page[FINER * head : FINER * head + image.shape[0], left : left + image.shape[1]] = image
    top, (begin, length) = page.shape[0] - FINER * (foot - 8), BAR
    page[top : top + FINER * 12, FINER * begin : FINER * (begin + length)] = np.repeat(COLOURS, FINER, axis=0).astype(np.uint8)
    return page


def words(folder, texts, seconds, shown):
    """ffmpeg's filter: scale down, write title, time and what the colours mean. Texts go through files: nothing to be quoted."""
    clock = f"%{{eif\\:t*{1000 * shown / seconds:.6g}\\:d}} ms"
    look = "font=Sans:fontcolor=black:fontsize=18"
    filters = [f"scale=iw/{FINER}:ih/{FINER}:flags=area", f"drawtext={look}:x=w-text_w-14:y=9:text='{clock}'"]
    for k, (place, text) in enumerate(texts):
        file = Path(folder) / str(k)
        file.write_text(text)
        filters.append(f"drawtext={look}:{place}:textfile={file}:expansion=none")
    return ",".join(filters)


def encoder(kind):
    if kind == "gif":
        return ",split[a][b];[a]palettegen=max_colors=64[p];[b][p]paletteuse=dither=none", []
    return "", ["-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "20", "-preset", "veryfast", "-movflags", "+faststart"]


def make(run, case, path, seconds):
    kind = path.suffix[1:]
    if kind not in RATES:
        raise SystemExit(f"fixdem: {path}: the format is one of {', '.join(RATES)}")
    pipe = case["pipe"]
    is_line, periodic = pipe["ends"] == "open", pipe["ends"] == "periodic"
    frames = (LineFrames if is_line else read_frames)(run) if (run / "frames.pvd").exists() else None
    if frames is None:
        raise SystemExit(f"fixdem: {run} has no frames: set frame_interval in [output] of the case and run it again")
    pieces = -(-pipe["length"] // (PIECE * pipe["diameter"])) if is_line else 1
    width = min(WIDTH, HIGHEST * pipe["length"] / pipe["diameter"]) * pieces
    if is_line:
        radius, times, speeds = frames.radii * frames.drawn, frames.times, np.concatenate([a["velocity"][:, 2] for a in frames.arrays] or [np.zeros(1)])
    else:
        radius, times, speeds = frames["radius"], frames["times"], frames["velocity"][:, :, 2]
    painter = Painter(pipe["diameter"], pipe["length"], periodic, radius, width)
    low, high = float(speeds.min()), float(np.percentile(speeds, 99.5))
    fps, count = RATES[kind], max(2, round(RATES[kind] * seconds))
    part = path.with_name("unfinished-" + path.name)
    with tempfile.TemporaryDirectory() as folder:
        below = f"y=h-{FOOT - 6}"
        texts = [
            ("x=12:y=9", case.get("title", run.name)),
            (f"x={BAR[0]}-text_w-8:{below}", f"axial velocity, m/s:  {low:.2f}"),
            (f"x={sum(BAR) + 8}:{below}", f"{high:.2f} and more"),
        ]
        filters = words(folder, texts, count / fps, times[-1] - times[0])
        more, options = encoder(kind)
        ffmpeg = None
        seen = line_moments(frames, count, pipe["length"]) if is_line else moments(frames, count, pipe["length"], periodic)
        for position, velocity, radii in seen:
            image = painter.paint(position, (velocity - low) / (high - low or 1), radii)
            page = dressed(in_pieces(image, int(pieces), painter.margin), HEAD, FOOT)
            if ffmpeg is None:
                size = f"{page.shape[1]}x{page.shape[0]}"
                command = ["ffmpeg", "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", size, "-r", str(fps), "-i", "-"]
                command += ["-vf", filters + more, *options, str(part)]
                ffmpeg = subprocess.Popen(command, stdin=subprocess.PIPE)
            try:
                ffmpeg.stdin.write(page.tobytes())
            except BrokenPipeError:
                break
        ffmpeg.stdin.close()
        if ffmpeg.wait() != 0:
            part.unlink(missing_ok=True)
            raise SystemExit(f"fixdem: ffmpeg could not make {path}")
    part.replace(path)
    print(f"{path}: {path.stat().st_size / 1e6:.2f} MB, {count} pictures from {len(times)} frames, {count / fps:g} s")


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("run", type=Path, help="folder of a run")
    arguments.add_argument("movie", type=Path, help="where to write: .mp4 or .gif")
    arguments.add_argument("--case", type=Path, required=True, help="the case file")
    arguments.add_argument("--seconds", type=float, default=10, help="how long it plays")
    chosen = arguments.parse_args()
    make(chosen.run, tomllib.loads(chosen.case.read_text()), chosen.movie, chosen.seconds)


if __name__ == "__main__":
    as_command(main)
