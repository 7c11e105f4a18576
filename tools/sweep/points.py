"""From a sweep to its points, the cases that are compiled for them, and the runs that have to be made.

A point is one combination of values. Keys go to the base case; those of [particles] and [material] also to the cases that it
starts from, and so on along the chain; those of a random start to the case that has it, the last of the chain; a key with the
name of a case in front to that case alone.

Two keys are run-time values (RUN_TIME): options of a program, nothing that is compiled into it. Points that differ in
nothing else share a program, and points that start alike share the run that they start from. Each program is compiled
from a derived case, a file named after the values that vary: plug_u24-bulk_velocity_1p7-count_500. A run has the run-time
values in its name as well, its own and those of the run that it starts from.
"""

import copy
import itertools
import re
from dataclasses import dataclass
from pathlib import Path

from sweep_file import read_toml, refuse

RUN_TIME = {("start", "seed"): "--seed", ("run", "duration"): "--duration"}
FOLLOWED = ("particles", "material")  # tables in which the cases of a chain must agree
OWN = {("particles", "capacity")}  # of a line alone, which may start from another case
RANDOM_START = {("start", "seed"), ("start", "velocity")}


@dataclass
class Job:
    """One run."""

    name: str
    program: str  # name of the derived case
    options: list
    checked: dict  # the case with its run-time values as well: what casegen is asked about
    start: str | None = None  # name of the job whose final state it starts from
    stage: int = 0  # jobs of a stage start from jobs of earlier ones


@dataclass
class Plan:
    cases: dict  # name of a program -> its case, as TOML is read
    jobs: dict  # name -> Job, predecessors first
    points: list  # (values in order of the axes, name of the job)


def text_of(value):
    """A value for people."""
    if isinstance(value, list):
        return f"[{', '.join(map(text_of, value))}]"
    return f"{value:.12g}" if isinstance(value, float) else str(value).lower() if isinstance(value, bool) else str(value)


def name_of(value):
    """A value as part of the name of a case, which has letters, digits, _ and - only: 1.7 is 1p7."""
    return re.sub(r"[^A-Za-z0-9_-]+", "_", text_of(value).replace("+", "").replace(".", "p")).strip("_")


def short_names(keys):
    """The last part of each key, or as many as it takes to tell them apart."""
    names = {}
    for key in keys:
        same = [k for k in keys if k[-1] == key[-1]]
        names[key] = key[-1] if len(same) == 1 else ".".join(key)
    return names


def chain_of(sweep, base_case, start_from):
    """The base case and those that it starts from: [(name, contents)]."""
    chain, folder = [(sweep.base.stem, base_case)], sweep.base.parent
    while start_from is not None:
        path = Path(folder, f"{str(start_from).removesuffix('.toml')}.toml")  # a name, or a path from the case's folder
        if not path.is_file() or path.stem in [name for name, _ in chain]:
            refuse(
                sweep.path,
                "base",
                f"{chain[-1][0]} starts from '{start_from}': there is no case file {path}, or it leads round in a circle",
                "write the name of a case in the same folder, or the path of one from there; each of another name",
            )
        case = read_toml(path)
        chain.append((path.stem, case))
        folder = path.parent
        start_from = case.get("start", {}).get("from") if isinstance(case.get("start", {}), dict) else None
    return chain


def applies_to(key, name, place, length):
    """Whether a key of the sweep goes to the case of this name, at this place of a chain of that length."""
    if len(key) == 3:
        return key[0] == name
    if key in RANDOM_START:
        return place == length - 1
    return place == 0 or (key[0] in FOLLOWED and key not in OWN)


def with_values(case, values):
    """A copy of the case; what is no table where one is needed is left for casegen to refuse."""
    case = copy.deepcopy(case)
    for (table, name), value in values.items():
        if isinstance(case.setdefault(table, {}), dict):
            case[table][name] = value
    return case


class Planner:
    def __init__(self, sweep):
        self.sweep, self.base_case = sweep, read_toml(sweep.base)
        self.names = short_names(sweep.axes)
        self.plan = Plan({}, {}, [])
        self.chains = {}

    def chain(self, values):
        own = self.base_case.get("start", {})
        start_from = values.get(("start", "from"), own.get("from") if isinstance(own, dict) else None)
        if start_from not in self.chains:
            self.chains[start_from] = chain_of(self.sweep, self.base_case, start_from)
        return self.chains[start_from]

    def label(self, keys):
        """The part of a name that says which of several points this is; what stays the same is left out."""
        return "".join(f"-{name_of(self.names[key])}_{name_of(keys[key])}" for key in self.sweep.axes if key in keys)

    def all(self):
        fixed, axes = self.sweep.fixed, self.sweep.axes
        for key in (*fixed, *axes):
            values = {**fixed, **{k: v[0] for k, v in axes.items()}}
            names = [name for name, _ in self.chain(values)]
            if len(key) == 3 and key[0] not in names:
                refuse(self.sweep.path, ".".join(key), f"'{key[0]}' is not a case of this sweep", f"allowed: {', '.join(names)}")
        for combination in itertools.product(*axes.values()):
            self.plan.points.append((combination, self.add({**fixed, **dict(zip(axes, combination))})))
        return self.plan

    def add(self, values):
        """The jobs of a point, those that it starts from first; returns the name of its own."""
        chain, before, run_label, named = self.chain(values), None, "", {}
        for place in reversed(range(len(chain))):
            name, case = chain[place]
            mine = {key: value for key, value in values.items() if applies_to(key, name, place, len(chain))}
            compiled = {key: value for key, value in mine.items() if key[-2:] not in RUN_TIME}
            run_time = {key: value for key, value in mine.items() if key[-2:] in RUN_TIME}
            case = with_values(case, {key[-2:]: value for key, value in compiled.items()})
            if before:
                case["start"]["from"] = before.program
            named |= compiled  # also of those that it starts from
            program = self.program(name + self.label(named), case, compiled)
            run_label += self.label(run_time)
            before = self.job(program, program + run_label, {key[-2:]: value for key, value in run_time.items()}, before)
        return before.name

    def program(self, name, case, compiled):
        told = ", ".join(f"{'.'.join(key)} = {text_of(value)}" for key, value in compiled.items() if key in self.sweep.axes)
        title = case.get("title", name)
        case = {
            "title": f"{title}; {told}" if told and isinstance(title, str) else title,
            **{k: v for k, v in case.items() if k != "title"},
        }
        if self.plan.cases.setdefault(name, case) != case:
            refuse(
                self.sweep.path,
                "[vary]",
                f"two points would both be called {name}",
                "use values whose names differ in letters and digits",
            )
        return name

    def job(self, program, name, run_time, before):
        options = [
            text
            for key, value in run_time.items()
            for text in (RUN_TIME[key], text_of(value) if isinstance(value, int) else repr(value))
        ]
        job = Job(
            name,
            program,
            options,
            with_values(self.plan.cases[program], run_time),
            before and before.name,
            before.stage + 1 if before else 0,
        )
        known = self.plan.jobs.setdefault(name, job)
        if (known.program, known.options, known.start) != (job.program, job.options, job.start):
            refuse(
                self.sweep.path,
                "[vary]",
                f"two points would both be called {name}",
                "use values whose names differ in letters and digits",
            )
        return known


def plan_of(sweep):
    return Planner(sweep).all()
