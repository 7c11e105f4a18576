"""Fig. 3, velocity against displacement during an impact, and Fig. 4, alpha against the restitution that follows from it.

From impacts of the kernel on a flat wall (impacts.cpp), scaled as in eq. (30). alpha and restitution are also compared with
alpha = -sqrt(5) ln e / sqrt(pi^2 + ln^2 e), eq. (30) solved.
"""

import csv
import math
import subprocess

from drawing import Data, gnuplot

SHOWN = (1, 0.9, 0.7, 0.5, 0.3, 0.1)  # restitutions of Fig. 3


def read(program):
    """impacts: [(alpha, asked, found)]; paths: alpha -> [(overlap, velocity)]"""
    text = subprocess.run([program], capture_output=True, text=True, check=True).stdout
    impacts, paths = [], {}
    for kind, alpha, *values in csv.reader(text.splitlines()):
        alpha = abs(float(alpha))
        if kind == "impact":
            impacts.append((alpha, *map(float, values)))
        else:
            paths.setdefault(alpha, []).append(tuple(map(float, values)))
    return impacts, paths


def closed_form(e):
    return -math.sqrt(5) * math.log(e) / math.sqrt(math.pi**2 + math.log(e) ** 2)


def fig_3(impacts, paths, out):
    chosen = [(alpha, asked) for alpha, asked, _ in impacts if asked in SHOWN]
    with Data() as data:
        curves = [
            f"'{data.file(paths[alpha])}' with lines linewidth 2 linecolor {k} dashtype {k} title '{alpha:.3f} ({asked:g})'"
            for k, (alpha, asked) in enumerate(chosen, 1)
        ]
        gnuplot(
            "set xlabel 'displacement x'\nset ylabel 'velocity v'\nset xrange [0:1.05]\nset yrange [-1.05:1.05]\nset xzeroaxis\n"
            f"set key outside right top title 'alpha (restitution)'\nplot {', '.join(curves)}",
            out / "fig_03",
        )
    deepest = max(x for x, _ in paths[0.0])
    without_damping = impacts[0][2]
    return (
        "Velocity against displacement during an impact on a wall, for several alpha",
        f"Eq. (30) in its scaled form, by the kernel at a tenth of the usual time step. Without damping the maximum displacement is {deepest:.4f}, "
        f"where it must be 1, and the particle leaves at {without_damping:.4f} of its velocity. Damping reduces the overlap and the "
        "velocity of the rebound; the curves end at x = 0, with the small attraction at the end of a contact not cut off, as eq. (30) has it.",
    )


def fig_4(impacts, out):
    curve = [(e, closed_form(e)) for e in (0.01 * k for k in range(2, 101))]
    with Data() as data:
        gnuplot(
            "set xlabel 'coefficient of restitution e'\nset ylabel 'alpha'\nset xrange [0:1.02]\nset yrange [0:2]\nset key right top\n"
            f"plot '{data.file(curve)}' with lines linewidth 2 linecolor 1 title 'closed form', '{data.file((f, a) for a, _, f in impacts)}' "
            "with points pointtype 7 pointsize 1.2 linecolor 'black' title 'impacts by the kernel'",
            out / "fig_04",
        )
    worst = max(abs(found - asked) for _, asked, found in impacts)
    return (
        "alpha against the coefficient of restitution",
        f"Each point is an impact by the kernel. The restitution found differs from the one that the closed form promises by {worst:.1g} at most.",
    )
