"""Reads a sweep file: a base case, and lists or ranges of its keys (format: tools/sweep/README.md).

Whatever is wrong with it is refused with a message that names file and key, what is allowed and what to do (exit code 3). Keys
of the case itself are casegen's business.
"""

import difflib
import math
from dataclasses import dataclass, field
from pathlib import Path

try:
    import tomllib
except ModuleNotFoundError:  # Python before 3.11
    import tomli as tomllib

MOST_POINTS = 100_000
RANGE = {"from", "to", "step", "points"}
TOP = ("title", "base", "frames", "checkpoint_interval", "vary", "set", "plot")
PLOT = ("x", "y", "series")


class Refused(Exception):
    """Something the user has to change; `code` is the exit code."""

    def __init__(self, message, code=3):
        super().__init__(message)
        self.code = code


@dataclass
class Sweep:
    path: Path
    title: str
    base: Path  # the base case's file
    axes: dict  # key -> its values; a key is (table, name), or (case, table, name) for a case that the base starts from
    fixed: dict  # key -> its one value
    frames: bool = False
    checkpoint_interval: float | None = None  # s of simulated time; None: the case's own
    plot: dict = field(default_factory=dict)

    @property
    def name(self):
        return self.path.stem

    def refuse(self, key, what, advice):
        refuse(self.path, key, what, advice)


def refuse(path, key, what, advice):
    raise Refused(f"{path}: {key}: {what}\n  {advice}")


def nearest(name, allowed):
    found = difflib.get_close_matches(name, allowed, 1)
    return (f"did you mean '{found[0]}'? " if found else "") + "allowed: " + ", ".join(allowed)


def read_toml(path):
    """The file's contents; Refused with file and line when it is not TOML, with code 6 when it cannot be read."""
    try:
        return tomllib.loads(path.read_bytes().decode())
    except OSError as error:
        raise Refused(f"{path}: {error.strerror}", 6) from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise Refused(f"{path}: not TOML: {error}\n  see https://toml.io") from None


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def is_range(value):
    return isinstance(value, dict) and "to" in value and set(value) <= RANGE


def flat(path, heading, table, before=()):
    """(key, value) of a table with quoted or dotted keys, or both."""
    for name, value in table.items():
        key = (*before, *name.split("."))
        if isinstance(value, dict) and not is_range(value):
            yield from flat(path, heading, value, key)
        elif not 2 <= len(key) <= 3 or not all(key):
            refuse(
                path,
                f"[{heading}] {'.'.join(key)}",
                "not the key of a case",
                'allowed: table.key, as in "gas.bulk_velocity", or case.table.key for a case that the base starts from',
            )
        else:
            yield key, value


def values_of_range(path, key, given):
    """from, from + step, ... up to `to`, or so many `points` from end to end; whole numbers stay whole."""
    for name, value in given.items():
        if not is_number(value) or not math.isfinite(value):
            refuse(path, key, f"{name} = {value!r} in a range", "allowed: a finite number")
    if "from" not in given or ("step" in given) == ("points" in given):
        refuse(path, key, "an incomplete range", "allowed: {from = .., to = .., step = ..} or {from = .., to = .., points = ..}")
    first, last = given["from"], given["to"]
    if "points" in given:
        count = given["points"]
        if not isinstance(count, int) or count < 2:
            refuse(path, key, f"points = {count!r}", "allowed: a whole number, two or more")
        step = (last - first) / (count - 1)
    else:
        step = given["step"]
        if step == 0 or (last - first) / step < 0:
            refuse(
                path, key, f"step = {step!r} does not lead from {first!r} to {last!r}", "allowed: a step towards `to`, not zero"
            )
        count = int(min((last - first) / step + 1e-9, MOST_POINTS)) + 1
    if count > MOST_POINTS:
        refuse(path, key, f"more than {MOST_POINTS} values", "choose a larger step")
    whole = all(isinstance(x, int) for x in (first, last, given.get("step", 0))) and float(step).is_integer()
    return [first + k * int(step) if whole else float(f"{first + k * step:.12g}") for k in range(count)]


def values_of(path, key, given):
    if is_range(given):
        return values_of_range(path, key, given)
    if not isinstance(given, list) or not given:
        refuse(
            path, key, f"{given!r}", "allowed: a list with at least one value, or a range; what stays the same belongs in [set]"
        )
    for k, value in enumerate(given):
        if value in given[:k]:
            refuse(path, key, f"{value!r} twice", "each value gives a point: name it once")
    return given


def read_table(path, contents, name, allowed=None):
    table = contents.get(name, {})
    if not isinstance(table, dict):
        refuse(path, name, f"{table!r}", f"allowed: a table, [{name}]")
    for key in table if allowed else ():
        if key not in allowed:
            refuse(path, f"[{name}] {key}", "unknown key", nearest(key, allowed))
    return table


def base_path(path, name, cases):
    """A name in the folder of cases, or a path as seen from the sweep file."""
    if not isinstance(name, str) or not name:
        refuse(path, "base", f"{name!r}", "needed: the name of a case in cases/, or the path of a case file in double quotes")
    found = path.parent / name if name.endswith(".toml") else cases / f"{name}.toml"
    if not found.is_file():
        refuse(path, "base", f"there is no case file {found}", nearest(name, sorted(p.stem for p in cases.glob("*.toml"))))
    return found


def read_sweep(path, cases):
    contents = read_toml(path)
    for key in contents:
        if key not in TOP:
            refuse(path, key, "unknown key", nearest(key, TOP))
    checks = {
        "title": (str, "a text in double quotes"),
        "frames": (bool, "true or false"),
        "checkpoint_interval": ((int, float), "a time in s, above 0, or inf"),
    }
    for key, (kind, allowed) in checks.items():
        value = contents.get(key)
        wrong = value is not None and (
            not isinstance(value, kind) or (key == "checkpoint_interval" and not (is_number(value) and value > 0))
        )
        if wrong:
            refuse(path, key, f"{value!r}", f"allowed: {allowed}")
    axes = {
        key: values_of(path, f"[vary] {'.'.join(key)}", value)
        for key, value in flat(path, "vary", read_table(path, contents, "vary"))
    }
    if not axes:
        refuse(path, "[vary]", "nothing to vary", 'needed: at least one key, as in "start.seed" = [1, 2, 3]')
    if math.prod(map(len, axes.values())) > MOST_POINTS:
        refuse(path, "[vary]", f"more than {MOST_POINTS} points", "vary fewer values at a time")
    fixed = dict(flat(path, "set", read_table(path, contents, "set")))
    for key, value in fixed.items():
        if isinstance(value, dict):
            refuse(path, f"[set] {'.'.join(key)}", "a range", "allowed: one value; ranges belong in [vary]")
        if key in axes:
            refuse(path, ".".join(key), "in [vary] and in [set]", "name it in one of them")
    sweep = Sweep(
        path,
        contents.get("title", path.stem),
        base_path(path, contents.get("base"), cases),
        axes,
        fixed,
        contents.get("frames", False),
        contents.get("checkpoint_interval"),
        read_table(path, contents, "plot", PLOT),
    )
    check_plot(sweep)
    return sweep


def check_plot(sweep):
    varied = [".".join(key) for key in sweep.axes]
    for name in ("x", "y", "series"):
        given = sweep.plot.get(name)
        keys = [given] if name == "x" else given
        if given is None:
            continue
        if not isinstance(keys, list) or not all(isinstance(key, str) for key in keys):
            sweep.refuse(
                f"[plot] {name}", f"{given!r}", "allowed: a key in double quotes" if name == "x" else "allowed: a list of texts"
            )
        for key in keys if name != "y" else ():
            if key not in varied:
                sweep.refuse(f"[plot] {name}", f"'{key}' is not varied", nearest(key, varied))
