"""Single collisions (impact_cases.py) at several speeds and angles, for every form of the law that is exported.

Against the kernel's leapfrog, which integrates as LAMMPS does, with a step so small that the laws are compared.
"""

import re

from beside import read_header
from case_values import kinds_of
from impact_cases import LAWS, SIZES, SMALLER, impacts

HEAD_ON_BOUND = 5e-4  # of the impact speed: the same normal force, damped at half a step's distance
# Oblique: sliders differ. LAMMPS' spring is not capped by itself, so the stronger the damping is, the less it slides like
# the kernel's; and its force acts at the middle of the overlap instead of the radius.
OBLIQUE_BOUND, STRONGLY_DAMPED_BOUND = 0.012, 0.1
STRONGLY_DAMPED = ("impacts_e05", "impacts_critical")
RESTITUTION_BOUND = 1e-3


def after_impact(state, impact, radius):
    """Speeds along the normal and the slip relative to what was hit, and of the surface by rotation."""
    still = (0.0, 0.0, 0.0)
    other = state.velocities[impact.number - 1] if impact.kind == "pair" else still
    spin_axis = 3 - impact.normal - impact.slip
    velocity = state.velocities[impact.number]
    return (
        velocity[impact.normal] - other[impact.normal],
        velocity[impact.slip] - other[impact.slip],
        radius * state.spins[impact.number][spin_axis],
    )


def maximum_difference(ours, theirs, found, radius):
    """Of all speeds after these impacts, in impact speeds."""
    return max(
        abs(p - q) / impact.speed for impact in found for p, q in zip(*(after_impact(s, impact, radius) for s in (ours, theirs)))
    )


def asked_for(case, impact):
    """The restitution of this impact: walls may have one of their own."""
    return case["restitution" if impact.kind == "pair" else "wall_restitution"]


def restitution_words(case):
    words = f"{case['restitution']:g}"
    return words if case["wall_restitution"] == case["restitution"] else f"{words}, at walls {case['wall_restitution']:g}"


def less_damped(text, share):
    return re.sub(r"(tangential mindlin \S+) 1\.0", rf"\1 {share!r}", text)


def check_impacts(bench, checks):
    rows = []
    for name in LAWS:
        case = read_header(bench.header(name))
        start = bench.out / f"{name}.fixdem"
        bench.kernel(name, "start", start)
        steps = round(case["duration"] / case["time_step"])
        ours = bench.kernel_state(name, start, steps, "leapfrog")
        theirs = bench.lammps_state(name, start, steps)
        d = kinds_of(case)[0].diameter
        found, _ = impacts(d, case["pipe_diameter"], case["pipe_length"], SMALLER * d if name in SIZES else None)
        head_on = [impact for impact in found if impact.angle == 0]
        straight, oblique = (maximum_difference(ours, theirs, some, d / 2) for some in (head_on, found))
        checks.at_most(f"{name}: {len(head_on)} head-on impacts, of the impact speed", straight, HEAD_ON_BOUND)
        bound = STRONGLY_DAMPED_BOUND if name in STRONGLY_DAMPED else OBLIQUE_BOUND
        checks.at_most(f"{name}: all {len(found)} impacts, speeds and spin", oblique, bound)
        if case["damping"] == "restitution" and case["damping_mass"] == "reduced":
            apart = max(abs(after_impact(theirs, impact, 0)[0] / impact.speed - asked_for(case, impact)) for impact in head_on)
            checks.at_most(f"{name}: restitution {restitution_words(case)}", apart, RESTITUTION_BOUND)
        restitution = "-" if case["damping"] == "critical" else restitution_words(case)
        rows.append(f"| `{name}` | {restitution} | {straight:.1e} | {oblique:.1e} |")
        if name == "impacts":
            for share in (0.5, 0.0):
                less = bench.lammps_state(name, start, steps, change=lambda file, text: less_damped(text, share))
                apart = maximum_difference(ours, less, found, d / 2)
                checks.note(f"{name}: {share:g} of the tangential damping would be further off", apart > oblique, f"{apart:.2g}")
    return ["| impacts | e | head-on | all |", "|---|---|---|---|", *rows]
