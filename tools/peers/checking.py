"""Did the peer simulate the same thing? Two questions, each with its bounds.

The law: the state after six single collisions (derived_cases.py) against fixdem's: speed and place along the normal, where
the three programs compute the same force, and speeds along the tangent, where their laws differ (bench/README.md).
The scene: kinetic energy, contacts and mean height of all particles after the timed run against fixdem's. A bed at rest
stays where it is, so it is bound tightly, except for what motion is left in it, which must be next to nothing in both.
The agitated scene is chaotic: two runs that differ in the last digit have nothing in common after 0.02 s but their
statistics. Its bounds are about three times the scatter of random starts (seeds 1 to 8): kinetic energy 0.7e-3 J of 14e-3 J,
mean height 0.09 mm; contacts are counted like rare events, with a scatter of the root of their number.
"""

import math
from dataclasses import dataclass

REBOUND_BOUND = 1e-3  # m/s along the normal; impacts are at 1 m/s
PLACE_BOUND = 2e-5  # diameters along the normal after the rebound: a stiffness wrong by 1 % moves it by 6e-5
SLIP_BOUND = {"lammps": 0.01, "liggghts": 0.05}  # m/s along the tangent, of the centre and of the surface by rotation
REST_ENERGY = 1e-6  # of the energy that it takes to lift every particle by its diameter


@dataclass(frozen=True)
class Check:
    what: str
    ours: float
    theirs: float
    bound: float  # maximum difference allowed
    unit: str
    next_to_nothing: bool = False  # both must be within the bound of zero

    @property
    def holds(self):
        differences = (self.ours, self.theirs) if self.next_to_nothing else (self.theirs - self.ours,)
        return all(abs(difference) <= self.bound for difference in differences)  # false for what is no number

    def line(self):
        verdict = "agrees" if self.holds else "DISAGREES"
        relation = "below" if self.next_to_nothing else "within"
        return f"{self.what:<18} fixdem {self.ours:<11.5g} peer {self.theirs:<11.5g} {self.unit:<4} {relation} {self.bound:.2g}: {verdict}"


def worst(what, bound, unit, ours, theirs):
    """The check of the two values that differ most; one that is no number differs most of all."""

    def difference(pair):
        apart = abs(pair[1] - pair[0])
        return math.inf if math.isnan(apart) else apart

    return Check(what, *max(zip(ours, theirs), key=difference), bound, unit)


def check_law(peer_name, case, ours, theirs):
    """The normal of every collision is along y, the slip along z, the spin about x."""
    d, slip_bound = case["diameter"], SLIP_BOUND[peer_name]

    def both(measure):
        return ([measure(state, i) for i in range(len(ours.positions))] for state in (ours, theirs))

    return [
        worst("rebound", REBOUND_BOUND, "m/s", *both(lambda state, i: state.velocities[i][1])),
        worst("place afterwards", PLACE_BOUND, "d", *both(lambda state, i: state.positions[i][1] / d)),
        worst("tangential speed", slip_bound, "m/s", *both(lambda state, i: state.velocities[i][2])),
        worst("speed of rotation", slip_bound, "m/s", *both(lambda state, i: state.spins[i][0] * d / 2)),
    ]


def check_bed(case, law, ours, theirs):
    gravity = math.hypot(*case["gravity"])
    rest = REST_ENERGY * law.mass * gravity * case["diameter"] * case["particle_count"]
    return [
        Check("residual energy", ours.kinetic_energy, theirs.kinetic_energy, rest, "J", next_to_nothing=True),
        Check("contacts", ours.contacts, theirs.contacts, 0.01 * ours.contacts, ""),
        Check("mean height", ours.mean_height, theirs.mean_height, 1e-4 * case["diameter"], "m"),
    ]


def check_agitated(case, law, ours, theirs):
    return [
        Check("kinetic energy", ours.kinetic_energy, theirs.kinetic_energy, 0.15 * ours.kinetic_energy, "J"),
        Check("contacts", ours.contacts, theirs.contacts, 4 * math.sqrt(ours.contacts + theirs.contacts + 1), ""),
        Check("mean height", ours.mean_height, theirs.mean_height, 0.03 * case["diameter"], "m"),
    ]
