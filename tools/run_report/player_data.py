"""The frames of a run, made small enough to travel inside a page: whole numbers of few bits, differences in time, deflate.

Positions are 16-bit numbers over the box that holds all frames (0.8 m: steps of 12 um), axial velocity, speed and contacts
8-bit ones over their range. Each array is laid out frame after frame, each frame as the difference to the one before
(modulo 2^16 or 2^8), positions as a plane of low and a plane of high bytes: neighbours in the stream are then alike. What a
particle keeps comes once, at the end: where sizes differ, diameters as 16-bit numbers and, of species, 8-bit numbers. The page
undoes it (source/frames.js). Where frames are too many, every second, third ... is left out; then particles, likewise.

In an open line particles come and go (line_frames.py): what a particle keeps is laid out like positions then, for a row of the
arrays has one particle after another, and serial numbers follow at the end, 32-bit ones in four planes. A pipe that is long is seen in
parts, in which particles soon are missed less than a smooth way: frames stay and particles are left out first.
"""

import base64
import zlib

import numpy as np

BUDGET = 9_500_000  # bytes after deflate: 12.7 MB as base64, which leaves room for the rest of a page of 15 MB
SMALLEST_SERIES = 60  # frames: below that, particles are left out instead
SMALLEST_LINE_SERIES = 240  # the same of a line


def quantised(values, levels):
    """Whole numbers from 0 to levels - 1, with the lowest value and the size of a step."""
    low, high = float(values.min()), float(values.max())
    step = (high - low) / (levels - 1) or 1.0
    return np.rint((values - low) / step).astype(np.uint16 if levels > 256 else np.uint8), low, step


def differences(numbers):
    """Along the first axis, in the same unsigned type: wraps round, as its sum does."""
    result = numbers.copy()
    result[1:] -= numbers[:-1]
    return result


def planes(numbers):
    """The bytes of numbers of several: the lowest of all, then the next."""
    return b"".join((numbers >> 8 * k & 0xFF).astype(np.uint8).tobytes() for k in range(numbers.itemsize))


def encode_own(own):
    """Bytes of what each particle keeps, or each in a row of a line, and what the page has to know of them."""
    stream, about = [], {}
    laid_out = differences if own and next(iter(own.values())).ndim > 1 else np.array
    if "diameter" in own:
        numbers, low, step = quantised(own["diameter"], 65536)
        stream.append(planes(laid_out(numbers)))
        about["diameter"] = {"low": low, "step": step, "high": float(own["diameter"].max())}
    if "species" in own:
        stream.append(laid_out(own["species"].astype(np.uint8)).tobytes())
        about["species"] = {"low": 0, "step": 1, "high": len(own["names"]) - 1, "names": own["names"]}
    return stream, about


def encode(times, position, velocity, contacts, own, serial=None):
    """position, velocity: frames x particles x 3; contacts: frames x particles; own: see pack(); serial: see pack_line(). What the
    page needs, ready for JSON."""
    stream, scale = [], {}
    for axis, name in enumerate("xyz"):
        numbers, low, step = quantised(position[:, :, axis], 65536)
        stream.append(planes(differences(numbers)))
        scale[name] = {"low": low, "step": step}
    speed = np.sqrt((velocity**2).sum(axis=2))
    for name, values in (("axial", velocity[:, :, 2]), ("speed", speed), ("contacts", np.minimum(contacts, 255))):
        numbers, low, step = quantised(values, 256)
        if name == "contacts":  # small whole numbers stay what they are
            numbers, low, step = values.astype(np.uint8), 0.0, 1.0
        stream.append(differences(numbers).tobytes())
        scale[name] = {"low": low, "step": step, "high": float(values.max())}
    own_stream, own_scale = encode_own(own)
    about = {"times": [float(f"{time:.9g}") for time in times], "particles": position.shape[1], "scale": scale}
    about |= {"own": own_scale} if own_scale else {}
    if serial is not None:
        own_stream.append(planes(differences(serial.astype(np.uint32))))
        about["last_serial"] = int(serial.max()) - 1
    return about, zlib.compress(b"".join(stream + own_stream), 9)


def fitted(encoded, of_frames, budget, fewest):
    """encoded(every, share), as much of it as fits: description and frames as base64 text, with what was left out."""
    every, share = 1, 1
    while True:
        about, packed = encoded(every, share)
        if len(packed) <= budget:
            return about | {"every": every, "share": share, "of_frames": of_frames}, base64.b64encode(packed).decode()
        over = len(packed) / budget
        if len(about["times"]) > fewest:
            every = max(every + 1, min(int(every * over), of_frames // fewest))
        else:
            share = max(share + 1, int(share * over))


def pack(times, position, velocity, contacts, budget=BUDGET, own=None):
    """encode() of as much as fits: the description with what was left out, and the frames as base64 text. own: `diameter` (m) and
    `species` of each particle and the `names` of the species, as far as particles differ in them."""
    own = own or {}

    def encoded(every, share):
        own_kept = {name: values if name == "names" else values[::share] for name, values in own.items()}
        return encode(times[::every], position[::every, ::share], velocity[::every, ::share], contacts[::every, ::share], own_kept)

    about, text = fitted(encoded, len(times), budget, SMALLEST_SERIES)
    return about | {"of_particles": position.shape[1]}, text


def pack_line(line, budget=BUDGET, names=None):
    """The same of LineFrames; names: of the species. A share of the particles is drawn larger, so that they fill the pipe as all do."""

    def encoded(every, share):
        rows = line.rows(every, share)
        own = {"diameter": 2 * rows["radius"]} if names or len(line.radii) > 1 else {}
        own |= {"species": rows["species"], "names": names} if names else {}
        return encode(rows["times"], rows["position"], rows["velocity"], rows["contacts"], own, rows["serial"])

    about, text = fitted(encoded, len(line.times), budget, SMALLEST_LINE_SERIES)
    about["share"] *= line.share
    return about | {"of_particles": line.most, "drawn": about["share"] ** (1 / 3)}, text
