"""Reads what a run writes for ParaView or OVITO: the list of frames (.pvd) and a frame (.vtp, data appended raw or as text).

Only the standard library is used. A frame becomes a dictionary: array name -> list of values, or of tuples for arrays
with several components; the particles' positions are the array named by Points, field data (one list per frame, such as
the pressure gradient of the gas) and, of a network of contacts, cell data are among them by their names.
"""

import math
import re
import struct
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from columns import FixdemError, contents

CODES = {"Float64": "d", "Float32": "f", "Int64": "q", "Int32": "i", "UInt64": "Q", "UInt32": "I", "Int8": "b", "UInt8": "B"}
INTERVALS = {"frames.pvd": "frame_interval", "contacts.pvd": "contact_interval"}
AGAIN = "copy it again, or run the case again"
DAMAGE = (ElementTree.ParseError, ValueError, LookupError, TypeError, OverflowError, struct.error)


def frame_list(pvd):
    """(time in s, path) of every frame, in order of time."""
    pvd = Path(pvd)
    data = contents(pvd, f"set {INTERVALS.get(pvd.name, 'frame_interval')} in [output] of the case and run it again")
    try:
        entries = ElementTree.fromstring(data).iter("DataSet")
        found = sorted((float(entry.get("timestep")), pvd.parent / entry.get("file")) for entry in entries)
        if not all(math.isfinite(time) for time, _ in found):
            raise ValueError("a time is no number")
    except DAMAGE as error:
        raise FixdemError(f"{pvd}: damaged ({error}): go on with the run (make run RESUME=1), or run the case again") from None
    return found


def some_frames(pvd):
    """frame_list() that is not empty."""
    found = frame_list(pvd)
    if not found:
        raise FixdemError(f"{pvd} lists no frames: go on with the run (make run RESUME=1), or run the case again")
    return found


class Appended:
    """Arrays behind the XML, each preceded by its size in bytes."""

    def __init__(self, data, start, header):
        self.data, self.at = data, data.index(b"_", start) + 1
        self.order = "<" if header.get("byte_order") == "LittleEndian" else ">"
        self.length_code = CODES[header.get("header_type", "UInt32")]

    def part(self, offset):
        """The bytes of one array."""
        at = self.at + offset
        if offset < 0 or at + struct.calcsize(self.length_code) > len(self.data):
            raise ValueError("it is cut short")
        (size,) = struct.unpack_from(self.order + self.length_code, self.data, at)
        at += struct.calcsize(self.length_code)
        if at + size > len(self.data):
            raise ValueError("it is cut short")
        return self.data[at : at + size]


def in_tuples(part, order, code, width):
    """Values of an array, or tuples of `width` of them, from its bytes."""
    values = struct.unpack(f"{order}{len(part) // struct.calcsize(code)}{code}", part)
    return values if width == 1 else [values[i : i + width] for i in range(0, len(values), width)]


def bytes_of(array, code, appended):
    """Order of bytes and bytes of a DataArray."""
    if array.get("format") != "ascii":
        if appended is None:
            raise ValueError("it is cut short: what it should have after its XML is not there")
        return appended.order, appended.part(int(array.get("offset")))
    values = tuple(map(float if code in "df" else int, (array.text or "").split()))
    return "<", struct.pack(f"<{len(values)}{code}", *values)


def decoded(data, unpack):
    start = data.find(b"<AppendedData")
    if start >= 0 and b'encoding="raw"' not in data[start : start + 80]:
        raise ValueError("its appended data are not raw: not a frame of fixdem")
    if start >= 0 and not data[-64:].rstrip().endswith(b"</VTKFile>"):
        raise ValueError("it is cut short")
    header = ElementTree.fromstring(data[:start] + b"</VTKFile>" if start >= 0 else data)
    appended = Appended(data, start, header) if start >= 0 else None
    piece = header.find(".//Piece")
    if piece is None or piece.find("Points") is None:
        raise ValueError("it has no points: not a frame of fixdem")
    points = int(piece.get("NumberOfPoints"))
    rows = {"Points": points, "PointData": points, "CellData": sum(int(piece.get(name, "0")) for name in ("NumberOfVerts", "NumberOfLines"))}
    arrays = {}
    for parent in ("FieldData", *rows):
        for array in header.iterfind(f".//{parent}/DataArray"):
            code, width = CODES[array.get("type")], int(array.get("NumberOfComponents", "1"))
            order, part = bytes_of(array, code, appended)
            size = width * struct.calcsize(code)
            if size <= 0 or len(part) % size or len(part) // size != rows.get(parent, len(part) // size):
                raise ValueError(f"{array.get('Name')} has {len(part)} bytes, which are not {rows.get(parent, 'a whole number')} of {size}")
            arrays["position" if parent == "Points" else re.sub(r"\W+", "_", array.get("Name"))] = unpack(part, order, code, width)
    return arrays


def read_frame(path, unpack=in_tuples):
    """`unpack`: what makes an array of its bytes, for those who want another kind of array than lists."""
    data = contents(path, AGAIN)
    try:
        return decoded(data, unpack)
    except DAMAGE as error:
        raise FixdemError(f"{path}: damaged ({error}): {AGAIN}") from None


def frames_at(run, times):
    """(time, frame) of a run nearest to each time; a frame must lie within 10 ms of it."""
    available = some_frames(Path(run) / "frames.pvd")
    nearest = [min(available, key=lambda entry: abs(entry[0] - time)) for time in times]
    for time, (found, _) in zip(times, nearest):
        if abs(found - time) > 0.01:
            raise FixdemError(f"{run}: no frame near {time} s (the nearest is at {found} s)")
    return [(time, read_frame(path)) for time, path in nearest]
