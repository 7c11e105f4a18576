"""What LAMMPS and LIGGGHTS are given: a data file with the particles, and a script with the law, the run and the meter.

A run has a part that is not timed and one that is. Between them the program writes its own processor time, as the
kernel of the operating system counts it, so that neither start-up nor neighbours on the machine are in the figure. The
second part goes on without a new set-up (`pre no`), for two reasons: a set-up would be timed with it, and that of the
packaged LAMMPS converts the wall's damping a second time.

bench/README.md says which settings and why; LAMMPS' law is that of lammps_law.py.
"""

from dataclasses import dataclass

from case_values import kinds_of, spheres_of
from lammps_law import law_commands


@dataclass(frozen=True)
class Stretch:
    """How long a run is: steps that are not timed, steps that are, s each, and every how many a frame is written."""

    untimed: int
    timed: int
    time_step: float
    frames_every: int = 0  # 0: only the final state


def data_file(case, state):
    """The same text for both programs: their columns of spheres agree. A type is a species; type 2 of equal spheres is the
    material of the wall in LIGGGHTS."""
    half = 0.6 * case["pipe_diameter"]
    lines = ["spheres in a pipe", "", f"{len(state.positions)} atoms", f"{max(2, len(kinds_of(case)))} atom types", ""]
    lines += [f"{-half!r} {half!r} xlo xhi", f"{-half!r} {half!r} ylo yhi", f"0 {case['pipe_length']!r} zlo zhi", "", "Atoms", ""]
    for number, (sphere, place) in enumerate(zip(spheres_of(case), state.positions), 1):
        lines.append(f"{number} {sphere.species + 1} {sphere.diameter!r} {sphere.density!r} " + " ".join(map(repr, place)))
    lines += ["", "Velocities", ""]
    for number, (v, w) in enumerate(zip(state.velocities, state.spins), 1):
        lines.append(f"{number} " + " ".join(map(repr, (*v, *w))))
    return "\n".join(lines) + "\n"


def liggghts_law(case, law):
    def pairs(between, at_wall):
        return f"{between!r} {at_wall!r} {at_wall!r} {at_wall!r}"

    model = "model hertz tangential history"
    return [
        f"fix m1 all property/global youngsModulus peratomtype {case['youngs_modulus']!r} {case['wall_youngs_modulus']!r}",
        f"fix m2 all property/global poissonsRatio peratomtype {case['poisson_ratio']!r} {case['wall_poisson_ratio']!r}",
        f"fix m3 all property/global coefficientRestitution peratomtypepair 2 {pairs(case['restitution'], case['wall_restitution'])}",
        f"fix m4 all property/global coefficientFriction peratomtypepair 2 {pairs(law.friction, law.wall_friction)}",
        f"pair_style gran {model}",
        "pair_coeff * *",
        f"fix wall all wall/gran {model} primitive type 2 zcylinder {case['pipe_diameter'] / 2!r} 0 0",
    ]


def script(program, case, law, stretch, skin):
    """The input script of "lammps" or "liggghts"; it reads `data` and writes `before`, `after` and `dump` where it runs."""
    lammps = program == "lammps"
    gravity = case["gravity"]
    strength = sum(c * c for c in gravity) ** 0.5
    columns = "id x y z vx vy vz omegax omegay omegaz"
    formats = "float %.17g" if lammps else '"%d ' + " ".join(["%.17g"] * 9) + '"'
    dump = [f"dump states all custom {{every}} dump {columns}", f"dump_modify states format {formats}"]
    lines = [
        "units si",
        "atom_style sphere" if lammps else "atom_style granular",
        "boundary f f p",
        "newton off",
        *(["comm_modify vel yes"] if lammps else ["communicate single vel yes", "hard_particles yes"]),
        "read_data data",
        f"neighbor {skin!r} bin",
        "neigh_modify every 1 delay 0 check yes",
        *(law_commands(case) if lammps else liggghts_law(case, law)),
        "fix move all nve/sphere",
        *([f"fix weight all gravity {strength!r} vector " + " ".join(map(repr, gravity))] if strength else []),
        f"timestep {stretch.time_step!r}",
        "thermo_style custom step",
        "thermo 1000000000",
        *([line.format(every=stretch.frames_every) for line in dump] if stretch.frames_every else []),
        f"run {stretch.untimed}",
        "shell 'cat /proc/$PPID/schedstat > before'",
        f"run {stretch.timed} pre no",
        "shell 'cat /proc/$PPID/schedstat > after'",
    ]
    if not stretch.frames_every:  # a run of no steps afterwards: writing the dump is not timed
        lines += [line.format(every=1) for line in dump] + ["run 0"]
    return "\n".join(lines) + "\n"
