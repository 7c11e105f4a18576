"""What is kept of one run: figures of its summary, and what its other files say about plugs, windows of time, stresses. SI units."""

import json
import math
from dataclasses import asdict

from columns import read_columns, read_plugs
from slices import Slices

WINDOW = 1.0  # s
PACKED = 0.40  # solids fraction above which a slice is one of a plug
SUMMARY = ("status", "steps", "time_step", "seed", "plug", "line", "line_scatter", "line_verdict", "performance")
GRAVITY = 9.81  # m/s2


def mean(values):
    return sum(values) / len(values)


def slope(points):
    """Of the least-squares line through (x, y)."""
    x, y = mean([p[0] for p in points]), mean([p[1] for p in points])
    return sum((a - x) * (b - y) for a, b in points) / sum((a - x) ** 2 for a, _ in points)


def unwrapped(fronts, length):
    """Places on a ring, each within half of it of the one before."""
    found = []
    for front in fronts:
        found.append(front if not found else found[-1] + (front - found[-1] + length / 2) % length - length / 2)
    return found


def windows(log, case):
    """Of a periodic plug: means over one second after another, from rows of the log that show a plug."""
    names = ("time [s]", "plug front [m]", "plug length [m]", "plug particle velocity [m/s]", "layer area ratio", "mean axial velocity [m/s]")
    columns = read_columns(log, names)
    rows = [row for row in zip(*(columns[name] for name in names)) if row[1] is not None]
    found = []
    for k in range(math.floor(case["run"]["duration"] / WINDOW)):
        inside = [row for row in rows if k * WINDOW < row[0] <= (k + 1) * WINDOW * (1 + 1e-9)]
        if len(inside) < 5:
            continue
        fronts = unwrapped([row[1] for row in inside], case["pipe"]["length"])
        found.append(
            {
                "from": k * WINDOW,
                "front_velocity": slope([(row[0], front) for row, front in zip(inside, fronts)]),
                "length": mean([row[2] for row in inside]),
                "particle_velocity": mean([row[3] for row in inside]),
                "layer_area_ratio": mean([row[4] for row in inside if row[4] is not None]) if any(row[4] is not None for row in inside) else None,
                "mean_axial_velocity": mean([row[5] for row in inside]),
            }
        )
    return found


def energies(log, times):
    """Kinetic energy of translation (J) in the rows of the log nearest to these times; None after the end of the run."""
    names = ("time [s]", "kinetic energy translation [J]")
    columns = read_columns(log, names)
    rows = list(zip(*(columns[name] for name in names)))
    nearest = [min(rows, key=lambda row: abs(row[0] - time)) for time in times]
    return [energy if abs(time - found) < 1e-3 else None for time, (found, energy) in zip(times, nearest)]


def packed_parts(solids):
    """(first, past the last) of each stretch of 8 slices or more whose fraction is above that of a plug."""
    parts, begin = [], None
    for k, value in enumerate([*solids, 0.0]):
        if value > PACKED and begin is None:
            begin = k
        elif value <= PACKED and begin is not None:
            if k - begin >= 8:
                parts.append((begin, k))
            begin = None
    return parts


def ergun(case, solids, slip):
    """Pressure gradient of a packed section, Pa/m; slip: volume flux of gas and solids less the velocity of the particles, m/s."""
    gas = case["gas"]
    d, density = gas.get("bed_diameter", case["particles"]["diameter"]), gas.get("density", 1.2)
    void = 1 - solids
    viscous = 150 * solids**2 * gas["kinematic_viscosity"] * density * slip / (void**3 * d**2)
    return viscous + 1.75 * solids * density * slip * abs(slip) / (void**3 * d)


def stresses(folder, case):
    """Of a line, summed over the packed stretches of its slices that lie within the followed part of the pipe: pressure drop found and by
    Ergun's equation; shear on the wall over friction times normal force; and axial and wall stress in tenths of the plugs from rear to
    front, mean over all plugs and moments, because a single slice holds too few contacts.

    The axial stress follows from the balance of forces of slices that move steadily, from the rear, which is free, to the front:
    d(stress)/dz = (force of the gas - shear on the wall)/(area dz). The normal stress on the wall is the sum of forces over its area, less
    what weight alone makes, solids * density * g * D/4 on average over the circumference.
    """
    slices = Slices(folder / "slices.bin").at_least("solids_fraction", "pressure", "particle_velocity", "gas_velocity", "wall_force", "wall_shear")
    v, dz = slices.values, slices.length
    diameter, mu = case["pipe"]["diameter"], case["material"].get("wall_friction", case["material"]["friction"])
    area, around = math.pi * diameter**2 / 4, math.pi * diameter
    since = case["output"].get("statistics_from", case["run"]["duration"] / 2)
    drop = by_ergun = shear = normal = 0.0
    tenths = [[] for _ in range(10)]
    for at, time in enumerate(slices.times):
        if time < since:
            continue
        solids, pressure = v["solids_fraction"][at], v["pressure"][at]
        for begin, end in packed_parts(solids):
            if begin * dz < 0.4 or (end - begin) * dz < 0.1 or end * dz > slices.count * dz - 0.2:
                continue
            inner = range(begin + 2, end - 2)
            velocity = mean([v["particle_velocity"][at][k] for k in inner])
            drop += pressure[begin + 2] - pressure[end - 2]
            by_ergun += sum(dz * ergun(case, solids[k], v["gas_velocity"][at][k] - velocity) for k in inner)
            shear += sum(v["wall_shear"][at][k] for k in inner)
            normal += sum(v["wall_force"][at][k] for k in inner)
            axial = 0.0
            for number, k in enumerate(inner):
                push = (pressure[k] - pressure[k + 1]) * area
                axial += (push - v["wall_shear"][at][k]) / area
                weight = solids[k] * case["particles"]["density"] * GRAVITY * diameter / 4
                tenths[10 * number // len(inner)].append((axial, v["wall_force"][at][k] / (around * dz) - weight))
    if not all(tenths):
        return None
    profile = [(mean([a for a, _ in part]), mean([b for _, b in part])) for part in tenths]
    x, y = mean([a for a, _ in profile]), mean([b for _, b in profile])
    spread = math.sqrt(sum((a - x) ** 2 for a, _ in profile) * sum((b - y) ** 2 for _, b in profile))
    return {
        "slices": sum(map(len, tenths)),
        "drop_over_ergun": drop / by_ergun,
        "mobilised": abs(shear) / (mu * normal),
        "axial_stress": x,
        "wall_stress": y,
        "profile": profile,
        "ratio": slope(profile),
        "correlation": sum((a - x) * (b - y) for a, b in profile) / spread,
    }


def line_figures(folder, case):
    since = case["output"].get("statistics_from", case["run"]["duration"] / 2)
    plugs = [asdict(plug) for plug in read_plugs(folder) if plug.counts and plug.born >= since]
    keys = ("front_velocity", "particle_velocity", "length", "layer_ratio", "pressure_drop")
    found = {"plugs": [{key: plug[key] for key in keys} for plug in plugs]}
    if (folder / "slices.bin").exists():
        found["stresses"] = stresses(folder, case)
    return found


def figures_of(folder, case):
    summary = json.loads((folder / "summary.json").read_text())
    found = {key: summary.get(key) for key in SUMMARY}
    found["final"] = {key: summary["final"][key] for key in ("time", "mean_axial_velocity", "state_hash")}
    found["steps_per_contact"] = summary["stability"]["steps_per_contact"]
    if found["line"]:
        found |= line_figures(folder, case)
    elif "gas" in case and case["run"]["duration"] >= 2 * WINDOW:
        found["windows"] = windows(folder / "log.csv", case)
    elif "gas" not in case:
        found["kinetic_energy"] = energies(folder / "log.csv", (0.02, 0.10, 0.20))
    return found
