"""The results of a run as NumPy arrays, for notebooks and scripts:

    import sys; sys.path.insert(0, "tools/python"); import fixdem
    run = fixdem.Run("out/plug_u24")
    run.log["pressure_drop"].mean(), run.log.units["pressure_drop"], run.frames.at(0.6).position

Files are read when they are asked for, and then once: of a run under way make another Run to see more. What is missing, damaged or cut
short is refused with a FixdemError that names the file, what is wrong and what to do. SI units. tools/README.md says what each name means.

The files themselves are read by columns.py, frames.py and slices.py with the standard library alone; NumPy is needed from the first
array on, pandas by dataframe() only.
"""

import json
import re
import sys
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path

from columns import RUN_FIRST, FixdemError, as_command, contents, plug_columns, probe_columns, read_columns
from frames import AGAIN, frame_list, read_frame
from slices import Slices

__all__ = ["FixdemError", "Run", "as_array", "as_command", "read_summary"]

CASE = (
    "case", "case_hash", "features", "precision", "integrator", "time_step", "seed", "duration", "kernel", "start_state",
    "material", "sizes", "species",
)  # fmt: skip
UNITS = {
    "position": "m", "velocity": "m/s", "angular_velocity": "rad/s", "radius": "m", "density": "kg/m3", "pressure_gradient": "Pa/m",
    "normal_force": "N", "tangential_force": "N", "force": "N", "dissipation": "W",
}  # fmt: skip


def numpy():
    try:
        import numpy as module
    except ImportError:
        what = f"{sys.executable} has no NumPy, which arrays need: install it (python3-numpy, or pip install numpy), or use a Python that has it"
        raise FixdemError(what) from None
    return module


def as_array(part, order, code, width):
    """For read_frame(): a NumPy array of its own from the bytes of one in a file."""
    values = numpy().frombuffer(part, order + code).astype(code)
    return values if width == 1 else values.reshape(-1, width)


def read_summary(run):
    """summary.json of a folder of results."""
    path = Path(run) / "summary.json"
    try:
        summary = json.loads(contents(path, RUN_FIRST))
    except (ValueError, RecursionError) as error:
        raise FixdemError(f"{path}: damaged ({error}): {AGAIN}") from None
    if not isinstance(summary, dict):
        raise FixdemError(f"{path}: not a summary of a run: {AGAIN}")
    return summary


class UnknownName(FixdemError, KeyError):
    __str__ = FixdemError.__str__  # a KeyError would put its message in quotation marks


class NamedArrays(Mapping):
    """Arrays by name, also as attributes: of["pressure"] or of.pressure; `units`, a dictionary; `path` of the file. A name may also be
    written as the file has it: "max overlap / radius"."""

    def __init__(self, path, arrays, units, written=()):
        self.path, self._arrays, self.units, self._written = Path(path), arrays, units, dict(written)

    def __getitem__(self, name):
        found = self._arrays.get(self._written.get(name, name))
        if found is None:
            raise UnknownName(f"{self.path}: no '{name}'; there are: {', '.join(self)}")
        return found

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except UnknownName as error:
            raise AttributeError(str(error)) from None

    def __iter__(self):
        return iter(self._arrays)

    def __len__(self):
        return len(self._arrays)

    def __dir__(self):
        return [*super().__dir__(), *self]

    def _ipython_key_completions_(self):
        return list(self)

    def __repr__(self):
        return f"<{self.path}: {', '.join(f'{name} [{self.units[name]}]' if self.units.get(name) else name for name in self)}>"


def plain_name(name):
    """'max speed [m/s]' -> 'max speed', 'max_speed', 'm/s'"""
    words, unit = re.fullmatch(r"(.*?)(?: \[([^][]*)\])?", name, re.DOTALL).groups()
    return words, re.sub(r"\W+", "_", words.replace(" / ", " over ")).strip("_"), unit or ""


class Table(NamedArrays):
    """Columns of a file of comma-separated values, under its names without units: "pressure drop [Pa]" is pressure_drop, "a / b" is a_over_b.
    What is not defined in a row is not a number."""

    def __init__(self, path, columns, words=()):
        """`words`: names of the columns that are not numbers."""
        np, arrays, units, written = numpy(), {}, {}, {}
        for name, values in columns.items():
            shown, key, unit = plain_name(name)
            while key in arrays:
                key += "_"
            for row, value in enumerate(values, 2):
                if isinstance(value, str) and key not in words:
                    raise FixdemError(f"{path}:{row}: '{value}' is no number of '{name}': damaged; run the case again")
            undefined, kind = ("", str) if key in words else (np.nan, float)
            arrays[key] = np.array([undefined if value is None else value for value in values], kind)
            units[key] = unit
            written |= {shown: key, name: key}
        super().__init__(path, arrays, units, written)

    def dataframe(self):
        """As a DataFrame of pandas; its `attrs` hold the units."""
        try:
            import pandas
        except ImportError:
            what = f"{sys.executable} has no pandas: install it (python3-pandas, or pip install pandas), or take the columns as they are, by name"
            raise FixdemError(what) from None
        frame = pandas.DataFrame(dict(self))
        frame.attrs["units"] = dict(self.units)
        return frame


class SliceArrays(NamedArrays):
    """Quantities of slices.bin, moments x slices; `times` (s), `z` (m) of the slices' centres and their `length` (m)."""

    def __init__(self, path):
        np, slices = numpy(), Slices(path)
        shape = (len(slices.times), slices.count)
        super().__init__(path, {name: np.array(rows, np.float32).reshape(shape) for name, rows in slices.values.items()}, slices.units)
        self.times, self.z, self.length = np.array(slices.times), np.array(slices.centres()), slices.length


class Frame(NamedArrays):
    """Particles (or contacts) at one moment, read when the first array is asked for; `time` (s) and `step`. Of n contacts `position` is
    n x 2 x 3: the owner's centre, and that of the partner or the wall."""

    def __init__(self, time, path):
        self.time, self.path, self._written = time, path, {}

    @cached_property
    def _read(self):
        arrays = read_frame(self.path, as_array)
        if "owner" in arrays:
            arrays["position"] = arrays["position"].reshape(-1, 2, 3)
        arrays.pop("TimeValue", None)
        return arrays.pop("step", None), arrays

    @property
    def _arrays(self):
        return self._read[1]

    @property
    def units(self):
        return {name: UNITS.get(name, "") for name in self}

    @property
    def step(self):
        """None where the file does not say it."""
        return None if self._read[0] is None else int(self._read[0][0])

    def __repr__(self):
        return f"<{self.path} at {self.time:g} s>"


class Frames(Sequence):
    """Frame after frame in order of time, none of them read before it is used; `times` (s). A part, frames[::10], is of the same kind."""

    def __init__(self, path, listed=None):
        self.path = Path(path)
        self._listed = frame_list(path) if listed is None else listed
        self._last = None, None  # so that run.frames[3].position and run.frames[3].velocity read the file once

    @cached_property
    def times(self):
        return numpy().array([time for time, _ in self._listed])

    def __len__(self):
        return len(self._listed)

    def __getitem__(self, k):
        if isinstance(k, slice):
            return Frames(self.path, self._listed[k])
        k = range(len(self))[k]
        if self._last[0] != k:
            self._last = k, Frame(*self._listed[k])
        return self._last[1]

    def at(self, time):
        """The frame that is nearest to this time; its own is its `time`."""
        if not self._listed:
            raise FixdemError(f"{self.path}: there are no frames of which one could be near {time} s: go on with the run (make run RESUME=1)")
        return self[min(range(len(self)), key=lambda k: abs(self._listed[k][0] - time))]

    def __repr__(self):
        return f"<{self.path}: {len(self)} frames>"


class Run:
    """A folder of results.

    summary   summary.json, a dictionary; case: what of it says which case was run, and how
    log       columns of log.csv
    frames    of particles; contacts: of contacts
    slices    of a line: along the pipe, at every slice_interval
    plugs     of a line: columns of plugs.csv, a row for each plug in order of birth
    probes    of a line: columns of probe_N.csv, a list of all stations; where they are the case file says
    """

    def __init__(self, folder):
        self.folder = Path(folder)
        if not self.folder.is_dir():
            raise FixdemError(f"{folder} is no folder: run the case first (make run CASE=...), or give the folder that holds its summary.json")

    @cached_property
    def summary(self):
        return read_summary(self.folder)

    @cached_property
    def case(self):
        return {name: self.summary[name] for name in CASE if name in self.summary}

    @cached_property
    def log(self):
        return Table(self.folder / "log.csv", read_columns(self.folder / "log.csv", ["time [s]"]))

    @cached_property
    def frames(self):
        return Frames(self.folder / "frames.pvd")

    @cached_property
    def contacts(self):
        return Frames(self.folder / "contacts.pvd")

    @cached_property
    def slices(self):
        return SliceArrays(self.folder / "slices.bin")

    @cached_property
    def plugs(self):
        return Table(self.folder / "plugs.csv", plug_columns(self.folder), words=("fate",))

    @cached_property
    def probes(self):
        count = len(list(self.folder.glob("probe_*.csv")))
        return [Table(self.folder / f"probe_{number}.csv", probe_columns(self.folder, number)) for number in range(count)]

    def __repr__(self):
        return f"<run in {self.folder}>"
