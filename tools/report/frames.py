"""Reads what a run writes for ParaView: the list of frames (.pvd) and a frame (.vtp, binary data appended raw).

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


def read_frame(path):
    data = Path(path).read_bytes()
    start = data.find(b"<AppendedData")
    if start < 0 or b'encoding="raw"' not in data[start : start + 80]:
        raise SystemExit(f"{path}: no raw appended data: not a frame of fixdem")
    raw = data.index(b"_", start) + 1
    header = ElementTree.fromstring(data[:start] + b"</VTKFile>")
    order = "<" if header.get("byte_order") == "LittleEndian" else ">"
    length_code = CODES[header.get("header_type", "UInt32")]
    arrays = {}
    for parent in ("FieldData", "Points", "PointData"):
        for array in header.find(f".//{parent}").iter("DataArray"):
            if array.get("format") != "appended":
                continue
            code = CODES[array.get("type")]
            at = raw + int(array.get("offset"))
            (size,) = struct.unpack_from(order + length_code, data, at)
            count = size // struct.calcsize(code)
            values = struct.unpack_from(f"{order}{count}{code}", data, at + struct.calcsize(length_code))
            width = int(array.get("NumberOfComponents", "1"))
            name = "position" if parent == "Points" else re.sub(r"\W+", "_", array.get("Name"))
            arrays[name] = values if width == 1 else [values[i : i + width] for i in range(0, count, width)]
    return arrays


def frames_at(run, times):
    """(time, frame) of a run nearest to each time; a frame must lie within 10 ms of it."""
    available = frame_list(Path(run) / "frames.pvd")
    nearest = [min(available, key=lambda entry: abs(entry[0] - time)) for time in times]
    for time, (found, _) in zip(times, nearest):
        if abs(found - time) > 0.01:
            raise SystemExit(f"{run}: no frame near {time} s (the nearest is at {found} s)")
    return [(time, read_frame(path)) for time, path in nearest]
