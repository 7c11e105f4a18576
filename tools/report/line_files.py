"""What a run of an open line leaves beside its slices: plugs.csv, and probe_N.csv of each station. SI units.

The formats are those of tools/run/plug_tracks.hpp and tools/run/line_station.hpp. Only the standard library is used.
"""

from dataclasses import dataclass

from columns import read_columns

PLUG = 0.40  # solids fraction above which a slice is one of a plug
REACH = 0.15  # m: how far from where it is expected a front is looked for

PLUG_COLUMNS = {
    "number": "plug", "born": "born [s]", "born_at": "born at [m]", "parent": "split off from", "fate": "fate", "into": "merged into",
    "last": "last seen [s]", "last_at": "last seen at [m]", "front_velocity": "front velocity [m/s]", "particle_velocity": "particle velocity [m/s]",
    "length": "length [m]", "pressure_drop": "pressure drop [Pa]", "layer_ratio": "layer ratio", "counts": "counts",
}  # fmt: skip
PROBE_COLUMNS = {"time": "time [s]", "pressure": "pressure [Pa]", "solids": "solids fraction", "flow": "mass flow [kg/s]", "passages": "plug passages"}


@dataclass
class Plug:
    """A row of plugs.csv; None for what is not defined."""

    number: int
    born: float
    born_at: float
    parent: int | None
    fate: str
    into: int | None
    last: float
    last_at: float
    front_velocity: float | None
    particle_velocity: float | None
    length: float | None
    pressure_drop: float | None
    layer_ratio: float | None
    counts: bool


def whole(value):
    return None if value is None else int(value)


def read_plugs(run):
    """In order of birth, as they are written when they end."""
    path = run / "plugs.csv"
    columns = read_columns(path, PLUG_COLUMNS.values())
    found = [Plug(*row) for row in zip(*(columns[name] for name in PLUG_COLUMNS.values()))]
    for plug in found:
        needed = (plug.number, plug.born, plug.born_at, plug.last, plug.last_at, plug.counts)
        if not all(isinstance(value, float) for value in needed) or plug.last < plug.born:
            raise SystemExit(f"fixdem: {path}: damaged where plug {plug.number} should be; run the case again")
        plug.number, plug.parent, plug.into, plug.counts = int(plug.number), whole(plug.parent), whole(plug.into), plug.counts == 1
    return sorted(found, key=lambda plug: plug.number)


@dataclass
class Probe:
    """A station: its place (m) and lists of time (s), pressure (Pa above the outlet), solids fraction, mass flow (kg/s; None at first),
    and how many plugs have passed."""

    position: float
    time: list
    pressure: list
    solids: list
    flow: list
    passages: list


def read_probes(run, case):
    """case: as read from its file."""
    found = []
    for number, station in enumerate(case.get("probe", [])):
        columns = read_columns(run / f"probe_{number}.csv", PROBE_COLUMNS.values())
        found.append(Probe(station["position"], *(columns[name] for name in PROBE_COLUMNS.values())))
    return found


def fronts_of(solids, length):
    """Places (m) at which the solids fraction over three slices falls through PLUG, one list for each row of slices."""
    found = []
    for row in solids:
        smooth = [sum(part) / len(part) for part in (row[max(0, k - 1) : k + 2] for k in range(len(row)))]
        pairs = enumerate(zip(smooth, smooth[1:]))
        found.append([(k + 0.5 + (a - PLUG) / (a - b)) * length for k, (a, b) in pairs if a > PLUG >= b])
    return found


def track(plug, times, fronts):
    """(time, place of the front) of a plug from its birth to when it was last seen. In between, at each moment of the slices, the
    front that is nearest to where the plug's velocity would have brought it; where there is none near enough, that place."""
    span = plug.last - plug.born
    velocity = plug.front_velocity or ((plug.last_at - plug.born_at) / span if span else 0.0)
    points = [(plug.born, plug.born_at)]
    for time, there in zip(times, fronts):
        if not plug.born < time < plug.last:
            continue
        expected = points[-1][1] + velocity * (time - points[-1][0])
        nearest = min(there, key=lambda z: abs(z - expected), default=expected)
        points.append((time, nearest if abs(nearest - expected) < REACH else expected))
    return [*points, (plug.last, plug.last_at)] if span else points
