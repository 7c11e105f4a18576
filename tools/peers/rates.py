"""Figures of many runs as a table and as JSON."""

import json
import platform
import re
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Row:
    scene: str
    program: str
    rates: tuple  # particle-steps/s of every run
    ratio: float  # best of fixdem over best of this program
    remark: str

    @property
    def best(self):
        return max(self.rates)

    @property
    def slowest(self):
        return min(self.rates)


def rows_of(scene, seconds, particle_steps, remarks):
    """seconds: program -> processor times of its runs."""
    best = {program: particle_steps / min(times) for program, times in seconds.items()}
    return [
        Row(scene, program, tuple(particle_steps / t for t in times), best["fixdem"] / best[program], remarks[program])
        for program, times in seconds.items()
    ]


def machine():
    """Name of the processor and the widest vectors it has."""
    name, flags = platform.processor() or platform.machine(), ""
    try:
        text = Path("/proc/cpuinfo").read_text()
        name = re.search(r"(?m)^model name\s*: (.*)$", text).group(1)
        flags = re.search(r"(?m)^flags\s*: (.*)$", text).group(1)
        family = re.search(r"(?m)^cpu family\s*: (.*)$", text).group(1)
        model = re.search(r"(?m)^model\s*: (.*)$", text).group(1)
        name += f" (family {family}, model {model})"
    except (OSError, AttributeError):
        pass
    vectors = "AVX-512" if " avx512f" in flags else "AVX2" if " avx2" in flags else "no AVX2"
    return f"{name}, {vectors}"


def table(rows):
    lines = [
        "| scene | program | runs | best, million particle-steps/s | slowest | fixdem / program, of the best | neighbour list |",
        "|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        slowest = f"{row.slowest * 1e-6:.2f} (-{1 - row.slowest / row.best:.0%})"
        figures = f"{len(row.rates)} | {row.best * 1e-6:.2f} | {slowest} | {row.ratio:.2f}"
        lines.append(f"| `{row.scene}` | {row.program} | {figures} | {row.remark} |")
    return "\n".join(lines)


# What to expect on a processor: a row for each machine, of fixdem beside the first peer.
EXPECTED = ["processor", "vectors", "settled bed, fixdem / LAMMPS", "in flight, fixdem / LAMMPS"]


def expected_row(rows):
    processor, _, vectors = machine().rpartition(", ")
    ratios = {row.scene: row.ratio for row in rows if row.program == "lammps"}
    return [processor, vectors, f"{ratios['bed']:.1f}", f"{ratios['agitated']:.1f}"]


def write_json(path, rows):
    entries = [
        {"scene": row.scene, "program": row.program, "particle_steps_per_second": row.best, "ratio": row.ratio} for row in rows
    ]
    Path(path).write_text(json.dumps(entries, indent=2) + "\n")
