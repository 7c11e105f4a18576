#!/usr/bin/env python3
"""Writes the cases that are run side by side with other programs, each pipe_bed with another start: make bench-peers.

Usage: derived_cases.py CASE.toml FOLDER. Into the folder go a copy of CASE.toml and
  agitated    CASE from its own random start
  bed_settle  the settled bed laid down at rest, without contact histories: so do the peers have to begin
  bed         what bed_settle became, with velocities and histories
  impacts     a few particles, each pair or single one on its way to one collision: the contact law by itself
all without energy ledger, frames and rows of the log, which the peers do not have either.
"""

import math
import re
import sys
from pathlib import Path

TABLE = r"(?ms)^\[{name}\].*?(?=^\[|\Z)"


def with_table(text, name, lines):
    """The case with this table in place of the one of that name; appended when there is none."""
    table = f"[{name}]\n" + "\n".join(lines) + "\n\n"
    text, found = re.subn(TABLE.format(name=re.escape(name)), lambda _: table, text)
    return text if found else text.rstrip() + "\n\n" + table


def with_value(text, table, key, value):
    """The case with this value of one key; added to the table when it is not there."""
    found = re.search(TABLE.format(name=re.escape(table)), text)
    if not found:
        return with_table(text, table, [f"{key} = {value}"])
    body, changed = re.subn(rf"(?m)^{key}\s*=.*$", f"{key} = {value}", found.group())
    if not changed:
        body = body.rstrip() + f"\n{key} = {value}\n\n"
    return text[: found.start()] + body + text[found.end() :]


def value_in(text, table, key):
    body = re.search(TABLE.format(name=re.escape(table)), text)
    value = body and re.search(rf"(?m)^{key}\s*=\s*([-+.\deE_]+)", body.group())
    if not value:
        raise SystemExit(f"no number {key} in [{table}]: the scenes of bench-peers need a pipe of given size and spheres of given diameter")
    return float(value.group(1).replace("_", ""))


def impacts(text):
    """Head on and oblique (20 and 60 degrees from the normal), between two spheres and with the wall, at 1 m/s; no weight.

    Each starts 1e-4 d before contact; a tenth of the pipe apart, so that they never meet one another.
    """
    d, pipe, length = (value_in(text, *key) for key in (("particles", "diameter"), ("pipe", "diameter"), ("pipe", "length")))
    start = ["# generated: collisions of two spheres, then of one with the wall"]
    gap, count = 1e-4 * d, 0

    def particle(position, velocity):
        nonlocal start, count
        count += 1
        start += ["[[start.particle]]", f"position = {list(position)}", f"velocity = {list(velocity)}", ""]

    for place, angle in enumerate((0.0, 20.0, 60.0)):
        normal, slip = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        z = (2 * place + 1) * length / 10
        particle([0.0, 0.0, z], [0.0, 0.0, 0.0])
        particle([0.0, d + gap, z], [0.0, -normal, slip])
        particle([0.0, -(pipe - d) / 2 + gap, z + length / 10], [0.0, -normal, slip])
    text = re.sub(TABLE.format(name="start"), "", text)
    text = with_value(text, "particles", "count", count)
    text = with_value(text, "run", "gravity", "[0.0, 0.0, 0.0]")
    text = with_value(text, "run", "time_step", "1.0e-7")
    return text.rstrip() + "\n\n" + "\n".join(start)


def derived(text, name):
    """The text of CASE and its name in, the text of every derived case out."""
    bare = with_table(text, "output", ["log_interval = 1.0e6", "energy_ledger = false"])

    def titled(case, title):
        return re.sub(r'(?m)^title\s*=.*$', f'title = "{title}"', case)

    settle = with_table(bare, "start", [f'from = "{name}"', 'motion = "stop"'])
    bed = with_table(bare, "start", ['from = "bed_settle"', 'motion = "keep"'])
    return {
        "agitated": titled(bare, f"{name} as it starts"),
        "bed_settle": titled(settle, f"The settled {name} at rest, without contact histories"),
        "bed": titled(bed, f"The settled {name}"),
        "impacts": titled(impacts(bare), "Single collisions"),
    }


def main():
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    source, folder = Path(sys.argv[1]), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    text = source.read_text()
    for name, case in {source.stem: text, **derived(text, source.stem)}.items():
        file = folder / f"{name}.toml"
        if not file.exists() or file.read_text() != case:  # an unchanged case need not be compiled again
            file.write_text(case)


if __name__ == "__main__":
    main()
