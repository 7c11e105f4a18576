"""What a time step costs on one core of fixdem and on p ranks of LAMMPS, and from when on the ranks are worth having.

One core: t = N c(N), c between the measured sizes by interpolation of both logarithms, and constant beyond them.
Ranks: t = a N / p + b. a is what a particle costs its rank; b what a rank spends in each step on its neighbours, whatever
N is: ranks divide a pipe into slabs, so that each has the same two cross-sections to exchange however long the pipe. a is
taken from the largest pipe on several ranks, where b does not count and all of them share the memory; b from the smallest,
where it counts most: what a step takes beyond its share of a step on one rank. Times in s, N particles.
"""

import math
from bisect import bisect_right
from dataclasses import dataclass


@dataclass(frozen=True)
class OneCore:
    costs: dict  # N -> s per particle-step

    def step(self, particles):
        return particles * self.cost(particles)

    def cost(self, particles):
        sizes = sorted(self.costs)
        if particles <= sizes[0]:
            return self.costs[sizes[0]]
        if particles >= sizes[-1]:
            return self.costs[sizes[-1]]
        at = bisect_right(sizes, particles)
        low, high = sizes[at - 1], sizes[at]
        share = math.log(particles / low) / math.log(high / low)
        return self.costs[low] ** (1 - share) * self.costs[high] ** share


@dataclass(frozen=True)
class Ranks:
    per_particle: float  # a, s
    per_step: float  # b, s

    def step(self, particles, ranks):
        return self.per_particle * particles / ranks + self.per_step

    def needed(self, particles, step_time):
        """Ranks for which a step takes so long, rounded up; None where no number of them is enough."""
        left = step_time - self.per_step
        return max(1, math.ceil(self.per_particle * particles / left)) if left > 0 else None


def ranks_from(alone, together, ranks):
    """From N -> s per step on one rank, and on so many: a of the largest N and b of the smallest."""
    if len(together) < 2 or set(alone) != set(together):
        raise ValueError(f"two sizes or more are needed, each on one rank and on {ranks}; there are {sorted(alone)} and {sorted(together)}")
    small, large = min(together), max(together)
    return Ranks(per_particle=together[large] * ranks / large, per_step=max(0.0, together[small] - alone[small] / ranks))
