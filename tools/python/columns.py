"""Files of comma-separated values as columns: log.csv, and of a line plugs.csv and probe_N.csv; and how damaged results are refused.

The formats are those of tools/run/log.cpp, plug_tracks.hpp and line_station.hpp. SI units. Only the standard library is used.
"""

import csv
import io
from dataclasses import dataclass
from pathlib import Path

PLUG_COLUMNS = {
    "number": "plug", "born": "born [s]", "born_at": "born at [m]", "parent": "split off from", "fate": "fate", "into": "merged into",
    "last": "last seen [s]", "last_at": "last seen at [m]", "front_velocity": "front velocity [m/s]", "particle_velocity": "particle velocity [m/s]",
    "length": "length [m]", "pressure_drop": "pressure drop [Pa]", "layer_ratio": "layer ratio", "counts": "counts",
}  # fmt: skip
PROBE_COLUMNS = {
    "time": "time [s]", "pressure": "pressure [Pa]", "solids": "solids fraction", "flow": "mass flow [kg/s]", "passages": "plug passages",
}  # fmt: skip
RUN_FIRST = "run the case first, or give its folder as OUT=..."
RUN_A_LINE = 'only a line has it (ends = "open" in [pipe]): ' + RUN_FIRST


class FixdemError(Exception):
    """A file of results is missing, damaged or lacks what is asked for: which one, what is wrong, what to do."""


def as_command(main):
    """The main function of a command, whose message a FixdemError is; exit code 1."""
    try:
        return main()
    except FixdemError as error:
        raise SystemExit(f"fixdem: {error}") from None


def contents(path, missing):
    """The bytes of a file; `missing`: what to do when it is not there."""
    try:
        return Path(path).read_bytes()
    except FileNotFoundError:
        raise FixdemError(f"{path} is missing: {missing}") from None
    except OSError as error:
        raise FixdemError(f"{path} cannot be read ({error.strerror}): look at its permissions, or copy it again") from None


def value(cell):
    """A number, None where the cell is empty, or the word that it is."""
    try:
        return float(cell) if cell else None
    except ValueError:
        return cell


def read_columns(path, expected=(), missing=RUN_FIRST):
    """Column name -> list of values; refuses a file that is damaged or lacks columns that are expected."""
    text = contents(path, missing).decode(errors="replace").replace("\0", "\ufffd")
    try:
        rows = list(csv.reader(io.StringIO(text, newline="")))
    except csv.Error as error:
        raise FixdemError(f"{path}: {error}: damaged; run the case again") from None
    if not rows or not any(rows[0]):
        raise FixdemError(f"{path} is empty: go on with the run (make run RESUME=1), or run the case again")
    head, *rows = rows
    for name in expected:
        if name not in head:
            raise FixdemError(f"{path}:1: no column '{name}'; there are: {', '.join(head)}: run the case again with this program")
    for number, row in enumerate(rows, 2):
        if len(row) != len(head):
            raise FixdemError(f"{path}:{number}: {len(row)} values in {len(head)} columns: damaged, or still being written; run the case again")
    if not text.endswith("\n"):
        raise FixdemError(f"{path}:{len(rows) + 1}: the line has no end: cut short, or still being written; run the case again")
    return {name: [value(row[k]) for row in rows] for k, name in enumerate(head)}


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


def plug_columns(run):
    """Those of plugs.csv, rows in order of birth (they are written when plugs end)."""
    path = run / "plugs.csv"
    columns = read_columns(path, PLUG_COLUMNS.values(), RUN_A_LINE)
    needed = [columns[PLUG_COLUMNS[name]] for name in ("number", "born", "born_at", "last", "last_at", "counts")]
    for row in zip(*needed):
        if not all(isinstance(value, float) for value in row) or row[3] < row[1]:
            raise FixdemError(f"{path}: damaged where plug {row[0]} should be; run the case again")
    order = sorted(range(len(needed[0])), key=needed[0].__getitem__)
    return {name: [values[k] for k in order] for name, values in columns.items()}


def read_plugs(run):
    """In order of birth."""
    columns = plug_columns(run)
    found = [Plug(*row) for row in zip(*(columns[name] for name in PLUG_COLUMNS.values()))]
    for plug in found:
        plug.number, plug.parent, plug.into, plug.counts = int(plug.number), whole(plug.parent), whole(plug.into), plug.counts == 1
    return found


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


def probe_columns(run, number):
    return read_columns(run / f"probe_{number}.csv", PROBE_COLUMNS.values())


def read_probes(run, case):
    """case: as read from its file."""
    found = []
    for number, station in enumerate(case.get("probe", [])):
        columns = probe_columns(run, number)
        found.append(Probe(station["position"], *(columns[name] for name in PROBE_COLUMNS.values())))
    return found
