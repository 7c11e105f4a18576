"""Gas: slices and the force on every particle of one update against the kernel's; a falling particle; 1 and 2 ranks."""

import re

from beside import ROUNDING, STEPS, distances, read_header, rms, scene_files

GAS_BOUND = 1e-12  # of the maximum value


def with_stored_forces(name, text):
    """Forces as they are before and after those of the gas, into the final dump."""
    if name == "scene.in":
        return re.sub(r"(?m)^(fix gas .*)$", r"fix before all store/force\n\1\nfix after all store/force", text)
    if name == "steps.in":
        forces = " ".join(f"f_{fix}[{k}]" for fix in ("before", "after") for k in (1, 2, 3))
        return text.replace("final.lammpstrj " + scene_files.COLUMNS, f"final.lammpstrj {scene_files.COLUMNS} {forces}")
    return text


def gas_forces(dump):
    """number -> force of the gas, N."""
    lines = dump.read_text().splitlines()
    start = next(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
    rows = [list(map(float, line.split())) for line in lines[start + 1 :]]
    return {int(row[0]): [row[13 + k] - row[10 + k] for k in range(3)] for row in rows}


def check_gas(bench, checks):
    name = "plug_u24"
    lines = [line.split(",") for line in bench.kernel(name, "gas", bench.state(name)).splitlines()]
    slices = [list(map(float, line[2:])) for line in lines if line[0] == "slice"]
    forces = {int(line[1]): list(map(float, line[3:])) for line in lines if line[0] == "force"}
    floaters = sum(int(line[2]) for line in lines if line[0] == "force")
    checks.note("gas: the state has floaters, a bed and slices of both", 0 < floaters < len(forces) / 2, f"{floaters} float")
    for ranks in (1, 2):
        folder, _ = bench.lammps(name, bench.state(name), 0, ranks, change=with_stored_forces)
        found = [list(map(float, line.split(",")[1:])) for line in (folder / "slices.csv").read_text().splitlines()[1:]]
        worst = 0.0
        for ours, theirs in zip(zip(*slices), zip(*found)):
            worst = max(worst, max(abs(a - b) for a, b in zip(ours, theirs)) / max(map(abs, ours)))
        checks.note(f"gas, {ranks} ranks: number of slices", len(found) == len(slices), f"{len(found)}")
        checks.at_most(f"gas, {ranks} ranks: numbers, velocities, heights, areas, voids, gradients, flows", worst, GAS_BOUND)
        theirs = gas_forces(folder / "final.lammpstrj")
        maximum = max(abs(f) for force in forces.values() for f in force)
        worst = max(abs(a - b) for number, force in forces.items() for a, b in zip(force, theirs[number]))
        checks.at_most(f"gas, {ranks} ranks: force on each of {len(forces)} particles", worst / maximum, GAS_BOUND)
    check_falling(bench, checks)
    case = read_header(bench.header(name))
    one, two = (bench.lammps_state(name, bench.state(name), STEPS, ranks) for ranks in (1, 2))
    checks.at_most(f"gas: {STEPS} steps on 1 and 2 ranks, maximum, in d", max(distances(case, one, two)), ROUNDING)


def check_falling(bench, checks):
    """A single particle in the gas, against the kernel's leapfrog and its Euler as trajectories are."""
    name, steps = "drag_single", 10 * STEPS
    case, start = read_header(bench.header(name)), bench.states / "drag_single-start" / "final.fixdem"
    euler, leapfrog = (bench.kernel_state(name, start, steps, integrator) for integrator in ("euler", "leapfrog"))
    theirs = bench.lammps_state(name, start, steps)
    apart, integrators = (rms(distances(case, leapfrog, other)) for other in (theirs, euler))
    checks.at_most(f"{name}: {steps} steps, from leapfrog, in d; euler is as far from it", apart, integrators)
