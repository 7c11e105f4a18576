"""What LAMMPS and LIGGGHTS are given: a data file with the particles, and a script with the law, the run and the meter.

A run has a part that is not timed and one that is. Between them the program writes its own processor time, as the
kernel of the operating system counts it, so that neither start-up nor neighbours on the machine are in the figure. The
second part goes on without a new set-up (`pre no`), for two reasons: a set-up would be timed with it, and that of the
packaged LAMMPS converts the wall's damping a second time.

bench/README.md says which settings and why. A stiffness K of F_n = K overlap^(3/2) reaches LAMMPS as K / sqrt(R), R the
effective radius it multiplies with: r/2 between spheres and, inside a cylinder, that of sphere and cylinder together.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Stretch:
    """How long a run is: steps that are not timed, steps that are, s each, and every how many a frame is written."""

    untimed: int
    timed: int
    time_step: float
    frames_every: int = 0  # 0: only the final state


def data_file(case, state):
    """The same text for both programs: their columns of spheres agree. Type 2 is the material of the wall in LIGGGHTS."""
    half = 0.6 * case["pipe_diameter"]
    lines = ["spheres in a pipe", "", f"{len(state.positions)} atoms", "2 atom types", ""]
    lines += [f"{-half!r} {half!r} xlo xhi", f"{-half!r} {half!r} ylo yhi", f"0 {case['pipe_length']!r} zlo zhi", "", "Atoms", ""]
    for number, place in enumerate(state.positions, 1):
        lines.append(f"{number} 1 {case['diameter']!r} {case['density']!r} " + " ".join(map(repr, place)))
    lines += ["", "Velocities", ""]
    for number, (v, w) in enumerate(zip(state.velocities, state.spins), 1):
        lines.append(f"{number} " + " ".join(map(repr, (*v, *w))))
    return "\n".join(lines) + "\n"


def tsuji_polynomial(argument):
    """What LAMMPS makes of the argument of `damping tsuji`: a fit of alpha(e), meant for the whole mass of a sphere."""
    coefficients = (1.2728, -4.2783, 11.087, -22.348, 27.467, -18.022, 4.8218)
    return sum(c * argument**power for power, c in enumerate(coefficients))


def tsuji_argument(alpha):
    """The argument for which LAMMPS damps with this alpha (bisection; the polynomial falls from 0 to 1)."""
    low, high = 0.0, 1.0
    if not tsuji_polynomial(high) <= alpha <= tsuji_polynomial(low):
        raise SystemExit(f"damping: alpha = {alpha:.4g} cannot be given to LAMMPS (0.0003 to 1.27 can); raise [material] restitution")
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if tsuji_polynomial(middle) > alpha else (low, middle)
    return (low + high) / 2


def lammps_law(case, law):
    argument = tsuji_argument(law.alpha)
    cylinder = case["pipe_diameter"] / 2
    pair_root = (law.radius / 2) ** 0.5
    # Inside a cylinder the packaged version takes a radius of curvature of twice the cylinder's.
    wall_root = (law.radius * 2 * cylinder / (2 * cylinder - law.radius)) ** 0.5

    def contact(normal, tangential, root):
        return (
            f"hertz {normal / root!r} {argument!r} tangential mindlin {tangential / root!r} 1.0 {law.friction!r} damping tsuji"
        )

    pair = contact(law.normal_pair, law.tangential_pair, pair_root)
    wall = contact(law.normal_wall, law.tangential_wall, wall_root)
    return [
        "pair_style granular",
        f"pair_coeff * * {pair}",
        f"fix wall all wall/gran granular {wall} zcylinder {cylinder!r}",
    ]


def liggghts_law(case, law):
    def pairs(value):
        return " ".join([repr(value)] * 4)

    model = "model hertz tangential history"
    return [
        f"fix m1 all property/global youngsModulus peratomtype {case['youngs_modulus']!r} {case['wall_youngs_modulus']!r}",
        f"fix m2 all property/global poissonsRatio peratomtype {case['poisson_ratio']!r} {case['wall_poisson_ratio']!r}",
        f"fix m3 all property/global coefficientRestitution peratomtypepair 2 {pairs(case['restitution'])}",
        f"fix m4 all property/global coefficientFriction peratomtypepair 2 {pairs(law.friction)}",
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
        *(lammps_law(case, law) if lammps else liggghts_law(case, law)),
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
