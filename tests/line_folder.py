"""The folder of a run of an open line that never was, in the formats of the program: plugs are born one after another, run through
the pipe at one speed, pick up a layer in front and leave one behind. For what reads such folders. Only the standard library."""

import json
import math
import random
import struct
from pathlib import Path

W, V_P, LENGTH = 0.87, 0.54, 0.24  # fronts and particles in plugs, m/s; of a plug, m
LAYER, PLUG = 0.22, 0.56  # solids fractions
BORN_AT = 0.4  # m
SLICE_QUANTITIES = {"solids_fraction": "", "pressure": "Pa above the outlet", "particle_velocity": "m/s"}


class Line:
    """Of `length` m, with a plug every `every` s from the beginning on."""

    def __init__(self, length=2.0, diameter=0.05, duration=4.0, every=0.9, grain=0.01, slices=None):
        self.length, self.diameter, self.duration, self.every, self.grain = length, diameter, duration, every, grain
        self.slices = slices or round(length / grain)

    def plugs(self):
        """(number, born, gone)."""
        way = (self.length - BORN_AT) / W
        count = int(self.duration / self.every)
        return [(k, k * self.every, k * self.every + way) for k in range(count)]

    def fronts(self, time):
        return [BORN_AT + W * (time - born) for _, born, gone in self.plugs() if born <= time <= gone + LENGTH / W]

    def is_plug(self, z, time):
        return any(front - LENGTH <= z < front for front in self.fronts(time))

    def solids(self, time):
        dz = self.length / self.slices
        return [PLUG if self.is_plug((k + 0.5) * dz, time) else LAYER for k in range(self.slices)]

    def pressure(self, solids):
        """Above the outlet: 5 kPa/m in plugs, 0.5 kPa/m elsewhere."""
        dz, sum_, found = self.length / self.slices, 0.0, []
        for fraction in reversed(solids):
            sum_ += dz * (5000 if fraction > 0.4 else 500)
            found.append(sum_)
        return found[::-1]

    def case(self):
        return {
            "title": "A line that never was",
            "particles": {"count": 100, "diameter": self.grain, "density": 1000.0},
            "material": {"restitution": 0.9},
            "pipe": {"diameter": self.diameter, "length": self.length, "ends": "open"},
            "feed": {"rate": 0.2, "length": 0.1},
            "gas": {"bulk_velocity": [[1.0, 2.4], [2.0, 3.0]]},
            "run": {"duration": self.duration},
            "output": {"statistics_from": 1.0},
            "probe": [{"position": 0.5 * self.length}, {"position": 0.8 * self.length, "interval": 0.05}],
        }


def times(duration, interval):
    return [k * interval for k in range(round(duration / interval) + 1)]


def slices_bytes(line, interval=0.02, order="<"):
    about = {"what": "fixdem slices", "version": 1, "byte_order": "little" if order == "<" else "big", "slices": line.slices,
             "slice_length": line.length / line.slices, "quantities": [{"name": n, "unit": u} for n, u in SLICE_QUANTITIES.items()]}  # fmt: skip
    parts = [json.dumps(about).encode() + b"\n"]
    for time in times(line.duration, interval):
        solids = line.solids(time)
        velocities = [V_P if fraction > 0.4 else math.nan for fraction in solids]
        parts.append(struct.pack(f"{order}d", time))
        parts += [struct.pack(f"{order}{line.slices}f", *values) for values in (solids, line.pressure(solids), velocities)]
    return b"".join(parts)


PLUG_HEAD = (
    "plug,born [s],born at [m],split off from,fate,merged into,last seen [s],last seen at [m],samples,path [m],front velocity [m/s],"
    "particle velocity [m/s],length [m],pressure drop [Pa],layer ratio,counts\n"
)


def plug_rows(line):
    """One more at the end that has died young, and is not known much of."""
    rows = [PLUG_HEAD]
    for number, born, gone in line.plugs():
        last = min(gone, line.duration)
        at, fate = BORN_AT + W * (last - born), "left" if gone < line.duration else "present"
        rows.append(f"{number},{born:.6g},{BORN_AT},,{fate},,{last:.6g},{at:.6g},99,1.2,{W},{V_P},{LENGTH},1200,0.41,{int(last - born > 0.5)}\n")
    rows.append(f"{len(line.plugs())},1.11,0.1,0,merged,1,1.13,0.12,0,0,,,,,,0\n")
    return "".join(rows)


def probe_rows(line, position, interval=0.01):
    rows, passed, was_plug = ["time [s],pressure [Pa],solids fraction,mass flow [kg/s],plug passages\n"], 0, False
    for k, time in enumerate(times(line.duration, interval)):
        is_plug = line.is_plug(position, time)
        passed, was_plug = passed + (is_plug and not was_plug), is_plug
        flow = "" if k == 0 else f"{0.6 if is_plug else 0:g}"
        rows.append(f"{time:.12g},{1000 * (line.length - position):.6g},{PLUG if is_plug else LAYER},{flow},{passed}\n")
    return "".join(rows)


LOG = ["time [s]", "kinetic energy translation [J]", "kinetic energy rotation [J]", "coordination number", "max overlap / radius", "max speed [m/s]",
       "mean axial velocity [m/s]", "time step / stable step", "pressure drop [Pa]", "plug front [m]", "plug length [m]", "present", "fed", "left", "holdup [kg]",
       "asked rate [kg/s]", "accepted rate [kg/s]", "leaving rate [kg/s]", "backlog [kg]", "blocked time [s]", "elastic energy [J]"]  # fmt: skip


def log_rows(line, interval=0.1):
    rows = [",".join(LOG) + "\n"]
    for k, time in enumerate(times(line.duration, interval)):
        rate = "" if k == 0 else "0.2"
        pressure = line.pressure(line.solids(time))[0]
        rows.append(f"{time:.9g},0.1,0.01,2.5,0.01,1.1,0.2,0.5,{pressure:.6g},1,0.24,2500,{int(400 * time)},{int(380 * time)},1.25,{rate},{rate},{rate},0,0,0.001\n")
    return "".join(rows)


def summary(line):
    means = {"holdup": 1.25, "plug_velocity": W, "plug_particle_velocity": V_P, "plug_length": LENGTH, "layer_ratio": 0.41, "inlet_pressure": 2050.0}
    return {
        "case": "never", "case_hash": "0", "status": "done", "steps": 80000, "features": ["gas"], "precision": "double", "integrator": "euler", "time_step": 5e-5,
        "final": {"time": line.duration, "state_hash": "0"}, "stability": {}, "plug": None, "collision": None,
        "capacity": {"particles": {"limit": 5000, "high_water": 2700}},
        "performance": {"particle_steps_per_second": 4e6, "kernel_time": 50.0, "wall_time": 55.0},
        "energy": {"kinetic": 0.1, "elastic": 0.01, "dissipated_damping": 1.0, "dissipated_sliding": 2.0, "made_by_law": 0.0, "gravity_work": 0.5, "gas_work": 2.6,
                   "entered": 0.2, "left_with": 0.3, "balance_error": 0.0},
        "line": {"at_start": 100, "fed": 1600, "left": 1520, "present": 180, "asked_rate": 0.2, "accepted_rate": 0.2, "backlog": 0.0, "blocked_time": 0.0,
                 "layer_ratio_eq41": 0.42, "plug_frequency": 1 / line.every, "plugs": len(line.plugs()) - 2, **means},
        "line_scatter": {name: 0.1 * value for name, value in means.items()},
        "line_verdict": "flows in plugs",
    }  # fmt: skip


def particles(line, interval=0.05, feed=40.0, seed=1):
    """(time, list of (serial, position, velocity)): moved by plugs, fed at `feed` per second, gone at the end of the pipe."""
    chance, radius, there, serial, frames = random.Random(seed), line.diameter / 2 - line.grain / 2, {}, 0, []

    def enter(z):
        nonlocal serial
        there[serial] = [chance.uniform(-0.7, 0.7), chance.uniform(-0.7, 0.7), z]
        serial += 1

    for _ in range(int(4 * feed)):
        enter(chance.uniform(0.1, line.length))
    steps = 5
    for number, time in enumerate(times(line.duration, interval)):
        frame = []
        for key, (x, y, z) in there.items():
            moves = line.is_plug(z, time)
            height = y if moves else -1 + 0.5 * (y + 0.7)
            frame.append((key, (radius * x, radius * height, z), (0.0, 0.0, V_P if moves else 0.0)))
        frames.append((time, frame))
        for step in range(steps):
            for place in there.values():
                place[2] += interval / steps * (V_P if line.is_plug(place[2], time + step * interval / steps) else 0.1 if place[2] < BORN_AT else 0.0)
        there = {key: place for key, place in there.items() if place[2] < line.length}
        for _ in range(int(feed * interval * (number + 1)) - int(feed * interval * number)):
            enter(chance.uniform(0.0, 0.1))
    return frames


def vtp_bytes(numbers, arrays, as_text=False, order="<"):
    """A file for ParaView as the program writes it. numbers: of points, cells; arrays: (part, name, type, its code, width, values)."""
    data, lines = b"", {}
    for part, name, kind, code, width, values in arrays:
        words = f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{width}" format='
        if as_text:
            lines.setdefault(part, []).append(f'{words}"ascii">{" ".join(map(repr, values))}</DataArray>')
            continue
        lines.setdefault(part, []).append(f'{words}"appended" offset="{len(data)}"/>')
        packed = struct.pack(f"{order}{len(values)}{code}", *values)
        data += struct.pack(order + "Q", len(packed)) + packed
    parts = {part: f"<{part}>{''.join(text)}</{part}>" for part, text in lines.items()}
    fields = parts.pop("FieldData", "")
    head = (f'<?xml version="1.0"?>\n<VTKFile type="PolyData" version="1.0" byte_order="{"Little" if order == "<" else "Big"}Endian" header_type="UInt64"><PolyData><Piece {numbers}>'
            f'{"".join(parts.values())}</Piece>{fields}</PolyData>\n')  # fmt: skip
    return head.encode() + (b"" if as_text else b'<AppendedData encoding="raw">\n_' + data + b"\n</AppendedData>") + b"</VTKFile>\n"


def frame_bytes(frame, grain, gradient, **how):
    count = len(frame)
    flat = lambda k: [value for particle in frame for value in particle[k]]  # noqa: E731
    arrays = [("Points", "Points", "Float64", "d", 3, flat(1)), ("PointData", "velocity", "Float64", "d", 3, flat(2)),
              ("PointData", "radius", "Float64", "d", 1, [grain / 2] * count), ("PointData", "contacts", "Int32", "i", 1, [2] * count),
              ("PointData", "id", "Int32", "i", 1, list(range(count))), ("PointData", "serial", "Int64", "q", 1, [p[0] for p in frame]),
              ("FieldData", "pressure_gradient", "Float64", "d", 1, gradient)]  # fmt: skip
    return vtp_bytes(f'NumberOfPoints="{count}"', arrays, **how)


def contact_bytes(contacts, step, **how):
    """contacts: (owner, partner, from, to, force on the partner)."""
    count = len(contacts)
    arrays = [("Points", "Points", "Float64", "d", 3, [x for c in contacts for x in (*c[2], *c[3])]),
              ("CellData", "owner", "Int64", "q", 1, [c[0] for c in contacts]), ("CellData", "partner", "Int64", "q", 1, [c[1] for c in contacts]),
              ("CellData", "normal_force", "Float64", "d", 1, [math.hypot(*c[4]) for c in contacts]), ("CellData", "force", "Float64", "d", 3, [x for c in contacts for x in c[4]]),
              ("Lines", "connectivity", "Int64", "q", 1, list(range(2 * count))), ("FieldData", "step", "Int64", "q", 1, [step])]  # fmt: skip
    return vtp_bytes(f'NumberOfPoints="{2 * count}" NumberOfVerts="0" NumberOfLines="{count}"', arrays, **how)


def write_frames(folder, line, frames):
    (folder / "frames").mkdir(parents=True)
    sets = []
    for k, (time, frame) in enumerate(frames):
        name = f"frames/frame_{k:06}.vtp"
        gradient = [5000.0 if fraction > 0.4 else 500.0 for fraction in line.solids(time)]
        (folder / name).write_bytes(frame_bytes(frame, line.grain, gradient))
        sets.append(f'<DataSet timestep="{time:.12g}" part="0" file="{name}"/>')
    (folder / "frames.pvd").write_text(f'<VTKFile type="Collection" version="0.1"><Collection>{"".join(sets)}</Collection></VTKFile>')


def write_line(folder, line, frames=False):
    """All files of its folder."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "summary.json").write_text(json.dumps(summary(line)))
    (folder / "log.csv").write_text(log_rows(line))
    (folder / "slices.bin").write_bytes(slices_bytes(line))
    (folder / "plugs.csv").write_text(plug_rows(line))
    for k, probe in enumerate(line.case()["probe"]):
        (folder / f"probe_{k}.csv").write_text(probe_rows(line, probe["position"], probe.get("interval", 0.01)))
    if frames:
        write_frames(folder, line, particles(line))
    return folder
