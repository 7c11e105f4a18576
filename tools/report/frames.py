"""Reads what a run writes for ParaView or OVITO: the list of frames (.pvd) and a frame (.vtp, data appended raw or as text).

Only the standard library is used. A frame becomes a dictionary: array name -> list of values, or of tuples for arrays
with several components; the particles' positions are the array named by Points, field data (one list per frame, such as
the pressure gradient of the gas) are among them by their names.
"""

import re
import struct
import xml.etree.ElementTree as ElementTree
from pathlib import Path

CODES = {"Float64": "d", "Float32": "f", "Int64": "q", "Int32": "i", "UInt64": "Q", "UInt32": "I", "Int8": "b", "UInt8": "B"}


def frame_list(pvd):
    """(time in s, path) of every frame, in order of time."""
    pvd = Path(pvd)
    entries = ElementTree.parse(pvd).getroot().iter("DataSet")
    return sorted((float(entry.get("timestep")), pvd.parent / entry.get("file")) for entry in entries)


class Appended:
    """Arrays behind the XML, each preceded by its size in bytes."""

    def __init__(self, path, data, start, header):
        self.path, self.data, self.at = path, data, data.index(b"_", start) + 1
        self.order = "<" if header.get("byte_order") == "LittleEndian" else ">"
        self.length_code = CODES[header.get("header_type", "UInt32")]

    def part(self, offset):
        """The bytes of one array."""
        at = self.at + offset
        (size,) = struct.unpack_from(self.order + self.length_code, self.data, at)
        at += struct.calcsize(self.length_code)
        if at + size > len(self.data):
            raise SystemExit(f"{self.path}: it is cut short: copy it again, or run the case again")
        return self.data[at : at + size]


def in_tuples(part, order, code, width):
    """Values of an array, or tuples of `width` of them, from its bytes."""
    values = struct.unpack(f"{order}{len(part) // struct.calcsize(code)}{code}", part)
    return values if width == 1 else [values[i : i + width] for i in range(0, len(values), width)]


def read_frame(path, unpack=in_tuples):
    """`unpack`: what makes an array of its bytes, for those who want another kind of array than lists."""
    data = Path(path).read_bytes()
    start = data.find(b"<AppendedData")
    if start >= 0 and b'encoding="raw"' not in data[start : start + 80]:
        raise SystemExit(f"{path}: its appended data are not raw: not a frame of fixdem")
    header = ElementTree.fromstring(data[:start] + b"</VTKFile>" if start >= 0 else data)
    appended = Appended(path, data, start, header) if start >= 0 else None
    arrays = {}
    for parent in ("FieldData", "Points", "PointData"):
        for array in header.find(f".//{parent}").iter("DataArray"):
            code = CODES[array.get("type")]
            if array.get("format") == "ascii":
                values = tuple(map(float if code in "df" else int, (array.text or "").split()))
                order, part = "<", struct.pack(f"<{len(values)}{code}", *values)
            else:
                order, part = appended.order, appended.part(int(array.get("offset")))
            name = "position" if parent == "Points" else re.sub(r"\W+", "_", array.get("Name"))
            arrays[name] = unpack(part, order, code, int(array.get("NumberOfComponents", "1")))
    return arrays


def frames_at(run, times):
    """(time, frame) of a run nearest to each time; a frame must lie within 10 ms of it."""
    available = frame_list(Path(run) / "frames.pvd")
    nearest = [min(available, key=lambda entry: abs(entry[0] - time)) for time in times]
    for time, (found, _) in zip(times, nearest):
        if abs(found - time) > 0.01:
            raise SystemExit(f"{run}: no frame near {time} s (the nearest is at {found} s)")
    return [(time, read_frame(path)) for time, path in nearest]
