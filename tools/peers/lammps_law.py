"""The contact law in the words of LAMMPS: `pair_style granular` between spheres, `fix wall/gran granular` at walls.

Written for the packaged version (29 Sep 2021), whose behaviour the traps are about:
- A stiffness K of F_n = K overlap^(3/2) is given as K / sqrt(R), R the effective radius that LAMMPS multiplies with: r/2
  between spheres, r at a flat wall, and inside a cylinder that of the sphere and of a radius of curvature of twice the
  cylinder's. `hertz/material` is never used: its stiffnesses at walls are wrong there.
- `damping tsuji` is eq. (26) with the reduced mass, but makes alpha from its argument by a polynomial. It is given the
  argument for which that returns the alpha wanted. (`coeff_restitution` came with a later version.)
- The damping of a wall is converted again by every `run` that makes a set-up: run once, or with `pre no`.

Tangential forms: `mindlin` keeps a displacement, `mindlin/force` a force, `mindlin_rescale/force` a force that is lowered
with the stiffness while unloading: the three of the kernel. Beyond Coulomb's bound LAMMPS caps the whole tangential force
along the trial force, as `slider = "clip"` and "exact" do, but without capping the spring before. It lets the force act at
the middle of the overlap instead of the radius.

`rolling sds k gamma mu` is a spring, a dashpot and a cap on the rolling displacement, whose rate is R (omega_i - omega_j) x n,
with the torque R n x q: the kernel's, with a constant k. R is the effective radius again, so inside a cylinder all three
coefficients are scaled to give the torque of a flat wall. LAMMPS caps by the whole normal force where the kernel takes its
elastic part, and does not cap the spring by itself, as with friction.

Spheres of several sizes: with Hertz, LAMMPS has each contact's own effective radius and reduced mass in stiffness and damping, and
the spheres' own radii in slip and rolling, as the kernel has, so that one line holds for all pairs. The dashpot of
the linear law has one coefficient for each pair of types, and a wall one for each type: the pipe's effective radius is another
for each sphere.
"""

from case_values import damping_ratio, kinds_of, law_of

TANGENTIAL = {"displacement": "mindlin", "force": "mindlin/force", "rescale": "mindlin_rescale/force"}
LOOK_LIKE = "{what} cannot be given to LAMMPS: {why}; {advice}"


def refusal(case):
    """Why LAMMPS cannot be given this law or scene; None where it can."""

    def words(what, why, advice):
        return LOOK_LIKE.format(what=what, why=why, advice=advice)

    if case["ends"] == "open":
        return words('ends = "open"', "nothing is fed there, and nothing leaves", 'choose [pipe] ends = "periodic" or "closed"')
    if case["has_gas"] and (reason := refusal_of_gas(case)):
        return words(*reason)
    if "sizes" in case and case["species_count"] == 0:
        return words("[particles.sizes]", "its walls have one coefficient for each kind of sphere", "choose [[particles.species]]")
    if "sizes" in case and case["has_gas"]:
        return words("gas with particles of several sizes", "the gas beside it counts equal spheres", "leave [gas] out, or take one size")
    if case["friction_limit"] != "total":
        return words('friction_limit = "elastic"', "it caps friction by the whole normal force", 'choose [contact] friction_limit = "total"')
    for key in ("rolling_friction", "wall_rolling_friction"):
        if case[key] > 0 and case["normal"] != "linear":
            return words(
                f"{key} = {case[key]:g} with normal = \"{case['normal']}\"", "its rolling spring has a constant stiffness",
                'choose [contact] normal = "linear", or leave rolling resistance out',
            )  # fmt: skip
    if case["friction"] == 0 and case["wall_friction"] == 0:
        pass  # neither slider nor tangential spring
    elif case["slider"] == "paper":
        return words('slider = "paper"', "it caps friction along the trial force", 'choose [contact] slider = "clip"')
    elif case["normal"] == "linear" and case["tangential"] != "displacement":
        return words(
            f'tangential = "{case["tangential"]}" with normal = "linear"', "its linear spring keeps a displacement",
            'choose [contact] tangential = "displacement", which is the same where the stiffness is constant',
        )  # fmt: skip
    if case["normal"] == "hertz":
        for key, alpha in zip(("restitution", "wall_restitution"), alphas(case), strict=True):
            if case[key] < 1 and not tsuji_polynomial(1.0) <= alpha <= tsuji_polynomial(0.0):
                return words(
                    f"{key} = {case[key]:g}",
                    f"alpha = {alpha:.4g} lies outside what `damping tsuji` can return, {tsuji_polynomial(1.0):.1g} to 1.27",
                    f"choose 1, or a [material] {key} between 0.12 and 0.9995",
                )
    return None


def refusal_of_gas(case):
    """What the gas beside LAMMPS (tools/lammps/gas_beside.cpp) does not know: what, why and what to do; None where it knows all."""
    if "gas_velocity_in_time" in case:
        return "bulk_velocity in time", "the gas beside it has one velocity", "choose [gas] bulk_velocity = a number"
    if case.get("gas_compressible"):
        return "compressible = true", "the gas beside it has one density", "leave [gas] compressible out"
    x, y, z = case["gravity"]
    if case["particle_count"] > 1 and not (x == 0 and y < 0 and z == 0):
        return "gas in an inclined pipe", "the gas beside it takes the height of the bed along y", "choose gravity = [0, -g, 0], or leave [gas] out"
    return None


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


def alphas(case):
    """Of pairs and of walls, for the reduced mass that LAMMPS takes."""
    alpha, wall_alpha = (5**0.5 * damping_ratio(case[key]) for key in ("restitution", "wall_restitution"))
    return alpha * (2**0.5 if case["damping_mass"] == "particle" else 1), wall_alpha


def hertz_contact(case, normal, tangential, root, alpha, friction):
    """root: of the effective radius, which LAMMPS multiplies both stiffnesses with."""
    damping = f"{tsuji_argument(alpha)!r}" if alpha else "0.0"
    form = TANGENTIAL[case["tangential"]]
    spring = f"{form} {tangential / root!r} 1.0 {friction!r}" if friction else "linear_nohistory 0.0 0.0"
    return f"hertz {normal / root!r} {damping} tangential {spring} damping {'tsuji' if alpha else 'velocity'}"


def rolling(stiffness, damping, friction, lever):
    """`lever`: the kernel's R* over the effective radius of LAMMPS."""
    return f" rolling sds {stiffness * lever**2!r} {damping * lever**2!r} {friction * lever!r}" if friction else ""


def linear_contact(case, law, mass, friction, restitution, rolling_friction, critical_mass, lever=1.0):
    """mass: that of the damping; critical_mass: that of critical damping."""
    if case["damping"] == "critical":  # eq. (23), in both directions
        damping, share = 2 * (critical_mass * law.normal_pair) ** 0.5, (law.tangential_pair / law.normal_pair) ** 0.5
    else:
        damping, share = 2 * damping_ratio(restitution) * (mass * law.normal_pair) ** 0.5, 1.0
    spring = f"linear_history {law.tangential_pair!r} {share!r} {friction!r}" if friction else "linear_nohistory 0.0 0.0"
    spring += rolling(law.tangential_pair, damping * share, rolling_friction, lever)
    return f"hooke {law.normal_pair!r} {damping!r} tangential {spring} damping velocity"


def pair_commands(case, kinds):
    """One for all pairs, or with the linear law one for each pair of types."""
    law = law_of(case, kinds[0])
    if case["normal"] != "linear":
        contact = hertz_contact(case, law.normal_pair, law.tangential_pair, (law.radius / 2) ** 0.5, alphas(case)[0], law.friction)
        return [f"pair_coeff * * {contact}"]

    def contact(reduced_mass):
        mass = reduced_mass * (2 if case["damping_mass"] == "particle" else 1)
        return linear_contact(case, law, mass, law.friction, case["restitution"], case["rolling_friction"], 2 * reduced_mass)

    if len(kinds) == 1:
        return [f"pair_coeff * * {contact(law.mass / 2)}"]
    masses = [kind.mass for kind in kinds]
    pairs = [(i, j) for i in range(len(kinds)) for j in range(i, len(kinds))]
    return [f"pair_coeff {i + 1} {j + 1} {contact(masses[i] * masses[j] / (masses[i] + masses[j]))}" for i, j in pairs]


def wall_commands(case, kind, group, suffix):
    """`wall` is the pipe, `ends` both flat ends of a closed one, for the spheres of a group."""
    law, cylinder = law_of(case, kind), case["pipe_diameter"] / 2
    end_root, pipe_root = law.radius**0.5, (law.radius * 2 * cylinder / (2 * cylinder - law.radius)) ** 0.5
    if case["normal"] == "linear":
        pipe, end = (
            linear_contact(case, law, law.mass, law.wall_friction, case["wall_restitution"], case["wall_rolling_friction"], law.mass, lever)
            for lever in ((end_root / pipe_root) ** 2, 1.0)
        )
    else:
        pipe, end = (
            hertz_contact(case, law.normal_wall, law.tangential_wall, root, alphas(case)[1], law.wall_friction) for root in (pipe_root, end_root)
        )
    lines = []
    if case["has_wall"]:
        lines.append(f"fix wall{suffix} {group} wall/gran granular {pipe} zcylinder {cylinder!r}")
    if case["ends"] == "closed":
        lines.append(f"fix ends{suffix} {group} wall/gran granular {end} zplane 0.0 {case['pipe_length']!r}")
    return lines


def law_commands(case):
    """Pair style, and a fix for each wall there is, of several kinds of spheres one for each."""
    kinds = kinds_of(case)
    lines = ["pair_style granular", *pair_commands(case, kinds)]
    if len(kinds) == 1:
        return lines + wall_commands(case, kinds[0], "all", "")
    for kind in kinds:
        number = kind.species + 1
        walls = wall_commands(case, kind, f"kind_{number}", f"_{number}")
        lines += [f"group kind_{number} type {number}", *walls] if walls else []
    return lines
