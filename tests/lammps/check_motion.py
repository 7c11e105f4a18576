"""settle and pipe_bed in motion, 1000 steps from the same state, histories empty on both sides, and the same on 2 ranks.

LAMMPS is to lie no further from the kernel's leapfrog than the kernel's Euler does, root mean square over particles; and from
Euler no further than twice that. So what differs in the law counts for less than the choice of the integrator. Two ranks agree
to rounding.
"""

from beside import ROUNDING, STEPS, distances, read_final, read_header, rms


def check_trajectories(bench, checks):
    rows = []
    for name in ("settle", "pipe_bed"):
        case, state = read_header(bench.header(name)), bench.state(name)
        euler, leapfrog = (bench.kernel_state(name, state, STEPS, integrator) for integrator in ("euler", "leapfrog"))
        one, two = (bench.lammps_state(name, state, STEPS, ranks) for ranks in (1, 2))
        integrators = rms(distances(case, euler, leapfrog))
        from_leapfrog, from_euler = (rms(distances(case, one, ours)) for ours in (leapfrog, euler))
        path = rms(distances(case, one, read_final(state)))
        checks.at_most(f"{name}: {STEPS} steps, from leapfrog, rms in d; euler is as far from it", from_leapfrog, integrators)
        checks.at_most(f"{name}: {STEPS} steps, from euler, rms in d", from_euler, 2 * integrators)
        checks.at_most(f"{name}: {STEPS} steps on 2 ranks, maximum, in d", max(distances(case, one, two)), ROUNDING)
        checks.note(f"{name}: the scene moves", path > 100 * integrators, f"{path:.3g} d in that time")
        rows.append(f"| `{name}` | {path:.2g} | {integrators:.2g} | {from_leapfrog:.2g} | {from_euler:.2g} |")
    return ["| scene | way | euler - leapfrog | LAMMPS - leapfrog | LAMMPS - euler |", "|---|---|---|---|---|", *rows]
