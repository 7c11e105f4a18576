"""The frames of a run, made small enough to travel inside a page: whole numbers of few bits, differences in time, deflate.

Positions are 16-bit numbers over the box that holds all frames (0.8 m: steps of 12 um), axial velocity, speed and contacts
8-bit ones over their range. Each array is laid out frame after frame, each frame as the difference to the one before
(modulo 2^16 or 2^8), positions as a plane of low and a plane of high bytes: neighbours in the stream are then alike. What a
particle keeps comes once, at the end: where sizes differ, diameters as 16-bit numbers and, of species, 8-bit numbers. The page
undoes it (source/frames.js). Where frames are too many, every second, third ... is left out; then particles, likewise.
"""

import base64
import zlib

import numpy as np

BUDGET = 9_500_000  # bytes after deflate: 12.7 MB as base64, which leaves room for the rest of a page of 15 MB
SMALLEST_SERIES = 60  # frames: below that, particles are left out instead


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
    """The bytes of 16-bit numbers: all low ones, then all high ones."""
    return (numbers & 0xFF).astype(np.uint8).tobytes() + (numbers >> 8).astype(np.uint8).tobytes()


def encode_own(own):
    """Bytes of what each particle keeps, and what the page has to know of them."""
    stream, about = [], {}
    if "diameter" in own:
        numbers, low, step = quantised(own["diameter"], 65536)
        stream.append(planes(numbers))
        about["diameter"] = {"low": low, "step": step, "high": float(own["diameter"].max())}
    if "species" in own:
        stream.append(own["species"].astype(np.uint8).tobytes())
        about["species"] = {"low": 0, "step": 1, "high": len(own["names"]) - 1, "names": own["names"]}
    return stream, about


def encode(times, position, velocity, contacts, own):
    """position, velocity: frames x particles x 3; contacts: frames x particles; own: see pack(). What the page needs, ready for
    JSON."""
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
    packed = zlib.compress(b"".join(stream + own_stream), 9)
    about = {"times": [float(f"{time:.9g}") for time in times], "particles": position.shape[1], "scale": scale}
    return about | ({"own": own_scale} if own_scale else {}), packed


def pack(times, position, velocity, contacts, budget=BUDGET, own=None):
    """encode() of as much as fits: the description with what was left out, and the frames as base64 text. own: `diameter` (m) and
    `species` of each particle and the `names` of the species, as far as particles differ in them."""
    every, share = 1, 1
    own = own or {}
    while True:
        kept = slice(None, None, every)
        own_kept = {name: values if name == "names" else values[::share] for name, values in own.items()}
        about, packed = encode(times[kept], position[kept, ::share], velocity[kept, ::share], contacts[kept, ::share], own_kept)
        if len(packed) <= budget:
            about |= {"every": every, "share": share, "of_frames": len(times), "of_particles": position.shape[1]}
            return about, base64.b64encode(packed).decode()
        if len(about["times"]) > SMALLEST_SERIES:
            every += 1
        else:
            share += 1
