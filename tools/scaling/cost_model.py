"""What a time step costs on one core of fixdem and on p ranks of LAMMPS, and from when on the ranks are worth having.

One core: t = N c(N), c between the measured sizes by interpolation of both logarithms, and constant beyond them.
Ranks: t = a N / p + b. a is what a particle costs its rank; b what a rank spends in each step on its neighbours, whatever
N is: ranks divide a pipe into slabs, so that each has the same two cross-sections to exchange however long the pipe. Both
come from runs on two ranks. Times in s, N particles.
"""

import math
import statistics
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


def ranks_from(step_times, ranks):
    """From N -> s per step on so many ranks: a and b of the straight line t p / N = a + b p / N, which weighs sizes alike."""
    if len(step_times) < 2:
        raise ValueError(f"two sizes or more are needed to tell a from b; there is {sorted(step_times)}")
    line = statistics.linear_regression(
        [ranks / particles for particles in step_times], [time * ranks / particles for particles, time in step_times.items()]
    )
    return Ranks(per_particle=line.intercept, per_step=max(0.0, line.slope))
