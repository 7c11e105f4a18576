"""The files LAMMPS is given for a case and a state: `data` (the particles), `scene.in` (all but the steps), `steps.in` (output
and steps) and, without gas, `run.in`, which includes the two.

With gas there is no `run.in`: forces of the gas come from the program beside LAMMPS (gas_beside.cpp), which hangs itself
into `fix gas` between the two files. `steps` and `frames` are variables of the script that `-var` changes.

The contact law is that of tools/peers/lammps_law.py. What LAMMPS does its own way whatever the case says: it integrates
by velocity Verlet in double precision, and its contacts begin without history.
"""

import math

from case_values import spheres_of
from lammps_law import law_commands, refusal
from peer_inputs import data_file

SKIN = 0.05  # of the neighbour list, in diameters of the smallest sphere: between the fastest for beds and for particles in flight (bench/README.md)
NEAR_REACH = 1.1  # in diameters: who has no other centre within it may float (kernel/gas_slices.hpp)
COLUMNS = "id x y z vx vy vz omegax omegay omegaz"
SIZE_COLUMNS = " type radius"  # where there are several sizes: the type is the species
SUFFIX = ".part"  # of a file that is not complete yet


class Refused(Exception):
    """The case or state cannot be exported; the text says why and what to do."""


def check(case, state, repeat):
    reason = refusal(case)
    if reason is None and repeat > 1 and case["ends"] != "periodic":
        reason = 'REPEAT needs periodic ends: a closed pipe cannot be repeated; choose [pipe] ends = "periodic"'
    if reason is None and len(state.positions) != case["particle_count"]:
        reason = (
            f"the state has {len(state.positions)} particles and the case {case['particle_count']}; "
            "take a state of this case, or change [particles] count"
        )
    if reason is None and ("sizes" in case or state.diameters is not None):
        reason = other_particle(case, state)
    if reason:
        raise Refused(reason)


def other_particle(case, state):
    """The first particle that is another one in the state, in words; None where there is none."""
    for number, sphere in enumerate(spheres_of(case)):
        for what, there in (("diameter", state.diameters), ("density", state.densities)):
            here = getattr(sphere, what)
            if there is not None and there[number] != here:
                return (
                    f"particle {number} has {what} {there[number]:g} in the state and {here:g} in the case; allowed: the same diameters "
                    "and densities, number by number; take a state of this case"
                )
    return None


def columns(case):
    return COLUMNS + (SIZE_COLUMNS if "sizes" in case else "")


def whole_steps(case, seconds):
    return max(1, round(seconds / case["time_step"]))


def opening(case, origin, repeat):
    """What a reader of the script has to know."""
    copies = f", {repeat} times one behind the other" if repeat > 1 else ""
    lines = [
        f"# {case['title']}",
        f"# From case {case['name']} of fixdem and {origin}{copies}. SI units; x horizontal, y up, z along the pipe.",
        "# Contact histories start empty: tangential springs of contacts in the state are not carried over, because LAMMPS",
        "# cannot be given them. A bed at rest finds its friction again within some milliseconds.",
        f"# LAMMPS integrates by velocity Verlet in double precision; the case says {case['integrator']}, "
        f"{case['precision'].removesuffix('_precision')}.",
    ]
    if case["has_gas"]:
        lines.append("# The gas is a program beside LAMMPS, tools/lammps/gas_beside.cpp: make run-lammps")
    return lines


def boundary(case):
    # Without the pipe's wall nothing keeps particles in: the box grows with them.
    across = "f f" if case["has_wall"] else "m m"
    return f"boundary {across} {'p' if case['ends'] == 'periodic' else 'f'}"


def gas_commands(case):
    """The fix that passes on the forces of the gas, called whenever slices or floaters are due."""
    every = math.gcd(case["gas_update_interval"], case["gas_floater_interval"])
    return ["group floating empty", f"fix gas all external pf/callback {every} 1"]


def scene_script(case, origin, repeat=1):
    d, gravity = min(sphere.diameter for sphere in spheres_of(case)), case["gravity"]
    strength = math.hypot(*gravity)
    # Ghosts must reach whoever lies within 1.1 d now, though lists may be half a skin old on either side.
    reach = [f"comm_modify cutoff {(NEAR_REACH + 2 * SKIN) * d!r}"] if case["has_gas"] else []
    lines = [
        *opening(case, origin, repeat),
        "",
        "units si",
        "atom_style sphere",
        boundary(case),
        "newton off",
        "comm_modify vel yes",
        *reach,
        "processors 1 1 *  # ranks divide the pipe along its axis",
        "read_data data",
        *([f"replicate 1 1 {repeat}"] if repeat > 1 else []),
        f"neighbor {SKIN * d!r} bin",
        "neigh_modify every 1 delay 0 check yes",
        "",
        *law_commands(case),
        *(gas_commands(case) if case["has_gas"] else []),
        "fix spread all balance 1000 1.1 shift z 10 1.05  # a plug has three times the particles of the rest of the pipe",
        "fix move all nve/sphere",
        *([f"fix weight all gravity {strength!r} vector " + " ".join(map(repr, gravity))] if strength else []),
        f"timestep {case['time_step']!r}",
    ]
    return "\n".join(lines) + "\n"


def steps_script(case):
    """Output and the one run: a second one with set-up would convert the wall's damping twice (lammps_law.py)."""
    frames = whole_steps(case, case["frame_interval"]) if case["frame_interval"] else 0
    dump = 'dump frames all custom ${frames} frames.lammpstrj' + f" {columns(case)}"
    lines = [
        f"variable steps index {round(case['duration'] / case['time_step'])}",
        f"variable frames index {frames}  # steps from one to the next, 0: none",
        "",
        "compute translation all ke",
        "compute rotation all erotate/sphere",
        "thermo_style custom step time c_translation c_rotation",
        f"thermo {whole_steps(case, case['log_interval'])}",
        f"if '${{frames}} > 0' then '{dump}' 'dump_modify frames format float %.17g'",
        "run ${steps}",
        f"write_dump all custom final.lammpstrj {columns(case)} modify format float %.17g",
    ]
    return "\n".join(lines) + "\n"


def files(case, state, origin, repeat=1):
    """name -> text of every file."""
    check(case, state, repeat)
    texts = {"data": data_file(case, state), "scene.in": scene_script(case, origin, repeat), "steps.in": steps_script(case)}
    if not case["has_gas"]:
        texts["run.in"] = "include scene.in\ninclude steps.in\n"
    return texts
