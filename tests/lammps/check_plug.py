"""plug_u24 from its start, 1.2 s with gas, beside cases/README.md's seeds; and a plug repeated a hundred times along the pipe."""

import re

from beside import ROUNDING, distances, read_dump, read_header, root, run_lammps

BIG = 100  # copies of the plug


def seeds_of(name):
    """(front velocity, layer ratio) of every seed in the table of cases/README.md."""
    rows = re.findall(rf"(?m)^\| `{name}` \| \d+ \| (\S+) \| \S+ \| \S+ \| (\S+) \|", (root / "cases" / "README.md").read_text())
    return [tuple(map(float, row)) for row in rows]


def widened(values):
    """From minimum to maximum, and as much again on either side: three seeds do not show all the scatter."""
    low, high = min(values), max(values)
    return low - (high - low), high + (high - low)


def check_plug(bench, checks):
    name = "plug_u24"
    _, outcome = bench.lammps(name, bench.states / f"{name}-start" / "final.fixdem", None)
    seeds = seeds_of(name)
    checks.between(f"{name}: front velocity, m/s", outcome["plug"]["front_velocity"], *widened([s[0] for s in seeds]))
    checks.between(f"{name}: layer area ratio", outcome["plug"]["layer_area_ratio"], *widened([s[1] for s in seeds]))
    plug = outcome["plug"]
    if plug["front_velocity"] is None:
        return []
    return [
        f"`{name}` over {outcome['final']['time']:g} s with gas: front {plug['front_velocity']:.2f} m/s, layer area ratio "
        f"{plug['layer_area_ratio']:.2f}; seeds of the kernel: {', '.join(f'{front:g} m/s and {ratio:g}' for front, ratio in seeds)}."
    ]


def check_size(bench, checks):
    name, states = "plug_u24", []
    case = read_header(bench.header(name))
    for ranks in (1, 2):
        folder, outcome = bench.lammps(name, bench.state(name), 200, ranks, BIG)
        states.append(read_dump(folder / "final.lammpstrj"))
        checks.say(run_lammps.describe(outcome))
    checks.note("size: particles", len(states[0].positions) == BIG * case["particle_count"], f"{len(states[0].positions)}")
    checks.at_most("size: 1 and 2 ranks, maximum, in d", max(distances(case, *states, BIG)), ROUNDING)
    small = bench.lammps_state(name, bench.state(name), 200)
    count = case["particle_count"]
    for copy in (0, BIG - 1):
        part = states[1]
        part = type(part)(part.positions[copy * count : (copy + 1) * count], [], [])
        checks.at_most(f"size: copy {copy + 1} moves as the plug alone, maximum, in d", max(distances(case, part, small)), 1e-6)
