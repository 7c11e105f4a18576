"""What a command has come to, read from what it printed and left, as a row of the table of all systems. Rows of systems and compilers
that are tried anew replace those of the same names, all others stay, each with the commit it was tried at."""

import json
import re
from dataclasses import dataclass

HEAD = ["system", "compiler", "release", "version", "`make run`", "warnings", "min", "`make test`", "warnings", "min", "commit"]
KEY = 2
NOT_TRIED = "not tried: "
# Of compilers, linkers and make, and gcc's remarks on calling conventions. Those of package installations and casegen's on a case,
# which begin with its file, are left out.
WARNING = re.compile(r"(?<!\w)warning: |: note: (?:parameter passing|the ABI)", re.IGNORECASE)
OTHERS = re.compile(r"\.toml(?::\d+)*: warning: |^(?:apt|dpkg|debconf|perl|update-alternatives|invoke-rc\.d)\b")


@dataclass
class Outcome:
    """One command on one system with one compiler."""

    result: str
    passed: bool
    warnings: list
    minutes: float


def warnings_in(said):
    """The different warnings in an output, as they came."""
    found = (line.strip() for line in said.splitlines() if WARNING.search(line) and not OTHERS.search(line))
    return list(dict.fromkeys(found))


def outcome_of_run(code, said, summary, seconds):
    """Of `make run`: its exit code, output and the text of summary.json, None where there is none."""
    if code or summary is None:
        result = f"exit code {code}" if code else "no results"
    else:
        result = "state " + json.loads(summary)["final"]["state_hash"]
    return Outcome(result, result.startswith("state "), warnings_in(said), seconds / 60)


def outcome_of_test(code, said, seconds):
    """Of `make test`: what its last line says; any exit code but 0 is a failure, whatever the line says."""
    counts = re.findall(r"^(\d+) passed, (\d+) failed$", said, re.MULTILINE)
    result = "{} passed, {} failed".format(*counts[-1]) if counts else f"no result, exit code {code}"
    passed = code == 0 and bool(counts) and int(counts[-1][0]) > 0 and counts[-1][1] == "0"
    return Outcome(result, passed, warnings_in(said), seconds / 60)


def version_in(said):
    """14.2.0 from the first line of `g++ --version` or `clang++ --version`."""
    numbers = re.findall(r"\d+\.\d+\.\d+", said.partition("\n")[0])
    return numbers[-1] if numbers else "unknown"


def row(names, run, test, commit):
    """`names`: system, compiler, release and the compiler's version."""
    cells = [*names]
    for outcome in (run, test):
        cells += [outcome.result, str(len(outcome.warnings)), f"{outcome.minutes:.1f}"]
    return [*cells, commit]


def row_not_tried(system, compiler, why, commit):
    cells = [system, compiler, "-", "-", f"{NOT_TRIED}{why.replace('|', '/')}"]
    return cells + ["-"] * (len(HEAD) - len(cells) - 1) + [commit]


def new_rows(rows, new):
    """A row that says why something could not be tried this time does not displace what came out at another."""
    tried = any(row[:KEY] == new[:KEY] and not row[4].startswith(NOT_TRIED) for row in rows)
    return [] if tried and new[4].startswith(NOT_TRIED) else [new]


def states_that_differ(rows):
    """Complaints about rows of one commit whose runs ended in different states."""
    states = {}
    for cells in rows:
        if cells[4].startswith("state "):
            states.setdefault(cells[-1], set()).add(cells[4])
    return [f"commit {commit}: {', '.join(sorted(found))}" for commit, found in states.items() if len(found) > 1]
