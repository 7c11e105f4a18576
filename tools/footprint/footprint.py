#!/usr/bin/env python3
"""Measures the stripped scene and every case, and rewrites the two tables in kernel/README.md: make footprint."""

import argparse
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "report"))
from marked_part import MarkedPart
from measuring import Calls, instructions_per_particle_step, output, size

STRIPS = ["everything", "one_size", "without_rolling", "without_gas", "without_friction", "without_wall", "without_ends", "without_ledger", "pairs_only", "line"]


def measured(program, case, *arguments):
    """The figures of a row: bytes of the simulation, per particle, of code; instructions and cycles."""
    total, particles = size(program, *arguments)
    calls = Calls(program)
    code = calls.bytes_of(calls.step_of(case))
    count = instructions_per_particle_step(program, *arguments, particles=particles)
    cycles = min(float(output(program, *arguments, "time")) for _ in range(8))
    return f"{total / 1024:.1f} | {total / particles:.0f} | {code / 1024:.1f} | {count:.0f} | {cycles}"


def parts_of(header):
    """What of the kernel a case has compiled in, from its generated header."""

    def is_set(text):
        return text in header

    return ", ".join(
        name
        for name, present in [
            ("gas", is_set("has_gas = true")),
            ("several sizes", is_set("SizeRun sizes[]")),
            ("rolling resistance", is_set("rolling_friction")),
            ("friction", any(value != "0x0p+0" for value in re.findall(r" (?:wall_)?friction = ([^;]+);", header))),
            ("wall", is_set("has_wall = true")),
            ("closed ends" if is_set("Ends::closed") else "an open line" if is_set("Ends::open") else "periodic ends", True),
            ("ledger", is_set("energy_ledger = true")),
            ("leapfrog", is_set("Integrator::leapfrog")),
            ("impulses", is_set("Integrator::impulse")),
            ("mixed precision", is_set("Precision::mixed")),
        ]
        if present
    )


def tables(strips, cases, folder, headers):
    unit = "KiB | bytes per particle | code of the step, KiB | instructions | cycles"
    line = "|---|---|---|---|---|---|"
    yield f"| stripped one by one | {unit} |"
    yield line
    for number, (case, name) in enumerate(zip(STRIPS, output(strips).splitlines(), strict=True)):
        yield f"| {name} | {measured(strips, case, number)} |"
    yield ""
    yield f"| case | compiled in | {unit} |"
    yield "|---" + line
    for case in cases:
        text = (headers / f"{case}.hpp").read_text()
        struct = text.split("struct ", 1)[1].split(" ", 1)[0]
        yield f"| `{case}` | {parts_of(text)} | {measured(folder / case, struct)} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--strips", type=Path, required=True)
    parser.add_argument("--programs", type=Path, required=True, help="folder of one program per case")
    parser.add_argument("--headers", type=Path, required=True, help="folder of their headers")
    parser.add_argument("--readme", type=Path, required=True)
    parser.add_argument("cases", nargs="+")
    options = parser.parse_args()
    part = MarkedPart(options.readme, "footprint")
    text = "\n".join(tables(options.strips, options.cases, options.programs, options.headers))
    print(text)
    part.write(text)


if __name__ == "__main__":
    main()
