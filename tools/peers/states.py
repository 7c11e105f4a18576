"""States of all particles at one moment, whoever computed them, and what is compared of them.

Energy, contacts and height are computed here from positions and velocities by the same lines for every program, so a
difference is one of the simulation and not of what a program calls a contact.
"""

import math
import struct
from dataclasses import dataclass, field
from pathlib import Path

from case_values import spheres_of


@dataclass
class State:
    """In order of the particles' numbers; (x, y, z) each; m, m/s, rad/s."""

    positions: list
    velocities: list
    spins: list
    diameters: list = field(default=None, compare=False)  # m; None where the file does not say them one by one
    densities: list = field(default=None, compare=False)  # kg/m3


@dataclass(frozen=True)
class Observed:
    kinetic_energy: float  # J, translation and rotation
    contacts: int  # pairs and walls with an overlap
    mean_height: float  # m, of the centres above the bottom of the pipe


def read_final(path):
    """A final.fixdem; the layout is that of tools/run/state_file.hpp, versions 1 to 4."""
    data = Path(path).read_bytes()
    if data[:8] != b"FIXDEM\x1a\n":
        raise SystemExit(f"{path}: no state file of fixdem (wrong first bytes)")
    order = "<" if data[8:12] == b"\x04\x03\x02\x01" else ">"
    version, name_size = struct.unpack_from(order + "II", data, 12)
    if version not in (1, 2, 3, 4):  # what comes later in the file is not read
        raise SystemExit(f"{path}: state file of version {version}; this reads versions 1 to 4")
    at = 20 + name_size + 8 + 4 + 4
    (count,) = struct.unpack_from(order + "Q", data, at)
    at += 8 + 3 * 8 + 8
    has_sizes = version > 2
    if len(data) < at + (92 if has_sizes else 76) * count + 16:
        raise SystemExit(f"{path}: cut short: {len(data)} bytes for {count} particles")
    fields = []
    for _ in range(3):
        flat = struct.unpack_from(f"{order}{3 * count}d", data, at)
        fields.append([flat[3 * i : 3 * i + 3] for i in range(count)])
        at += 24 * count
    at += 4 * count  # crossings of the ends
    for _ in range(2 if has_sizes else 0):
        fields.append(list(struct.unpack_from(f"{order}{count}d", data, at)))
        at += 8 * count
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
    pipe, length = case["pipe_diameter"], case["pipe_length"]
    spheres = spheres_of(case | {"particle_count": len(positions)})
    largest = max(sphere.diameter for sphere in spheres)
    placed = [(z, x, y, sphere.diameter) for (x, y, z), sphere in zip(positions, spheres)]
    walls = sum(math.hypot(x, y) > (pipe - d) / 2 for _, x, y, d in placed) if case["has_wall"] else 0
    if case["ends"] == "periodic":
        along = sorted((z % length, *rest) for z, *rest in placed)
        along += [(z + length, *rest) for z, *rest in along if z < largest]
    else:
        along = sorted(placed)
        walls += sum(z < d / 2 or z > length - d / 2 for z, _, _, d in along)
    pairs = 0
    for i in range(len(positions)):
        z, x, y, d = along[i]
        for k in range(i + 1, len(along)):
            dz = along[k][0] - z
            if dz >= largest:
                break
            touching = (d + along[k][3]) / 2
            pairs += (along[k][1] - x) ** 2 + (along[k][2] - y) ** 2 + dz * dz < touching * touching
    return pairs + walls


def kinetic_energy(case, state):
    """Of all spheres of one kind together, then of all kinds."""
    squares = {}
    for sphere, v, w in zip(spheres_of(case), state.velocities, state.spins):
        translation, rotation = squares.get(sphere, (0, 0))
        squares[sphere] = (translation + sum(c * c for c in v), rotation + sum(c * c for c in w))
    return sum(0.5 * (kind.mass * t + 0.4 * kind.mass * kind.radius**2 * r) for kind, (t, r) in squares.items())


def observe(case, state):
    heights = [y for _, y, _ in state.positions]
    return Observed(
        kinetic_energy=kinetic_energy(case, state),
        contacts=count_contacts(case, state.positions),
        mean_height=case["pipe_diameter"] / 2 + math.fsum(heights) / len(heights),
    )
