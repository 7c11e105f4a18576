"""States of all particles at one moment, whoever computed them, and what is compared of them.

Energy, contacts and height are computed here from positions and velocities by the same lines for every program, so a
difference is one of the simulation and not of what a program calls a contact.
"""

import math
import struct
from dataclasses import dataclass
from pathlib import Path


@dataclass
class State:
    """In order of the particles' numbers; (x, y, z) each; m, m/s, rad/s."""

    positions: list
    velocities: list
    spins: list


@dataclass(frozen=True)
class Observed:
    kinetic_energy: float  # J, translation and rotation
    contacts: int  # pairs and walls with an overlap
    mean_height: float  # m, of the centres above the bottom of the pipe


def read_final(path):
    """A final.fixdem; the layout is that of tools/run/state_file.hpp, versions 1 and 2."""
    data = Path(path).read_bytes()
    if data[:8] != b"FIXDEM\x1a\n":
        raise SystemExit(f"{path}: no state file of fixdem (wrong first bytes)")
    order = "<" if data[8:12] == b"\x04\x03\x02\x01" else ">"
    version, name_size = struct.unpack_from(order + "II", data, 12)
    if version not in (1, 2):  # what comes later in the file is not read
        raise SystemExit(f"{path}: state file of version {version}; this reads versions 1 and 2")
    at = 20 + name_size + 8 + 4 + 4
    (count,) = struct.unpack_from(order + "Q", data, at)
    at += 8 + 3 * 8 + 8
    if len(data) < at + 76 * count + 16:
        raise SystemExit(f"{path}: cut short: {len(data)} bytes for {count} particles")
    fields = []
    for _ in range(3):
        flat = struct.unpack_from(f"{order}{3 * count}d", data, at)
        fields.append([flat[3 * i : 3 * i + 3] for i in range(count)])
        at += 24 * count
    return State(*fields)


def read_dump(path):
    """The last frame of a LAMMPS text dump with the columns id x y z vx vy vz omegax omegay omegaz."""
    lines = Path(path).read_text().splitlines()
    starts = [i for i, line in enumerate(lines) if line.startswith("ITEM: ATOMS")]
    if not starts:
        raise SystemExit(f"{path}: no 'ITEM: ATOMS' in it: not a text dump")
    columns = lines[starts[-1]].split()[2:]
    wanted = ["id", "x", "y", "z", "vx", "vy", "vz", "omegax", "omegay", "omegaz"]
    if not set(wanted) <= set(columns):
        raise SystemExit(f"{path}: the columns are {' '.join(columns)}; needed are {' '.join(wanted)}")
    places = [columns.index(name) for name in wanted]
    rows = []
    for line in lines[starts[-1] + 1 :]:
        cells = line.split()
        if len(cells) != len(columns):
            break
        rows.append([float(cells[place]) for place in places])
    rows.sort()
    if [row[0] for row in rows] != list(range(1, len(rows) + 1)):
        raise SystemExit(f"{path}: particles are missing: {len(rows)} rows, the last one is particle {rows[-1][0]:.0f}")
    return State(*([tuple(row[k : k + 3]) for row in rows] for k in (1, 4, 7)))


def count_contacts(case, positions):
    """Pairs (across periodic ends, too) and walls with an overlap."""
    diameter, length = case["diameter"], case["pipe_length"]
    reach = (case["pipe_diameter"] - diameter) / 2
    walls = sum(math.hypot(x, y) > reach for x, y, _ in positions) if case["has_wall"] else 0
    if case["ends"] == "periodic":
        along = sorted((z % length, x, y) for x, y, z in positions)
        along += [(z + length, x, y) for z, x, y in along if z < diameter]
    else:
        along = sorted((z, x, y) for x, y, z in positions)
        walls += sum(z < diameter / 2 or z > length - diameter / 2 for z, _, _ in along)
    pairs = 0
    for i in range(len(positions)):
        z, x, y = along[i]
        for k in range(i + 1, len(along)):
            dz = along[k][0] - z
            if dz >= diameter:
                break
            pairs += (along[k][1] - x) ** 2 + (along[k][2] - y) ** 2 + dz * dz < diameter * diameter
    return pairs + walls


def observe(case, law, state):
    inertia = 0.4 * law.mass * law.radius**2
    translation = sum(sum(c * c for c in v) for v in state.velocities)
    rotation = sum(sum(c * c for c in w) for w in state.spins)
    heights = [y for _, y, _ in state.positions]
    return Observed(
        kinetic_energy=0.5 * (law.mass * translation + inertia * rotation),
        contacts=count_contacts(case, state.positions),
        mean_height=case["pipe_diameter"] / 2 + math.fsum(heights) / len(heights),
    )
