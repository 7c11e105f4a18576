"""Fig. 7, particles settling in a drum (Table 1), and Fig. 8, their kinetic energy with several time steps.

Fig. 7 from the frames of settle; Fig. 8 from the kernel compiled for each time step (tools/stability/kernel_runs.cpp), which
starts all of them from the same positions and velocities.
"""

import csv
import subprocess

from drawing import Data, gnuplot, side_views
from frames import frames_at

TIMES = (0, 0.02, 0.05, 0.1, 0.2)  # s
AGREED = 0.15  # how far kinetic energy at 0.02 s may be from that of the smallest step to count as the same


def fig_7(run, pipe, out):
    panels = [(f"{time:g} s", frame, [False] * len(frame["position"])) for time, frame in frames_at(run, TIMES)]
    side_views(panels, pipe, out / "fig_07", 2400, len(panels), "seen from the side, gravity downwards")
    heights = [sum(y for _, y, _ in frame["position"]) / len(frame["position"]) + pipe["diameter"] / 2 for _, frame, _ in panels]
    return (
        "150 particles settle in a closed drum (Table 1)",
        f"From a random start with velocities of up to 0.5 m/s in each direction, after {', '.join(f'{t:g}' for t in TIMES)} s. The mean height above the bottom falls from "
        f"{1000 * heights[0]:.0f} to {1000 * heights[-1]:.0f} mm. Like the paper's, they form a heap that is all but at rest after 0.2 s.",
    )


def decay(program, folder, duration):
    """Rows of time and kinetic energy, and what became of the run."""
    path = folder / f"decay-{program.name.partition('@')[2]}.csv"
    said = subprocess.run([program, "decay", path, str(duration)], capture_output=True, text=True, check=True).stdout
    with path.open(newline="") as file:
        rows = [(float(row[0]), float(row[1])) for row in list(csv.reader(file))[1:]]
    return rows, said.rsplit(",", 2)[0]


def fig_8(programs, duration, out, folder):
    folder.mkdir(parents=True, exist_ok=True)
    runs = {float(program.name.partition("@")[2]): decay(program, folder, duration) for program in programs}
    runs = dict(sorted(runs.items()))
    with Data() as data:
        curves = [
            f"'{data.file((t, 1000 * e) for t, e in rows if 0 < e < 1e9)}' with lines linewidth 2 linecolor {k} dashtype {k} title '{step:g} s'"
            for k, (step, (rows, _)) in enumerate(runs.items(), 1)
        ]
        gnuplot(
            f"set xlabel 'time, s'\nset ylabel 'kinetic energy, mJ'\nset xrange [0:{duration:g}]\nset yrange [0.01:100]\nset logscale y\n"
            f"set format y '10^{{%T}}'\nset key outside right top title 'time step'\nplot {', '.join(curves)}",
            out / "fig_08",
        )
    least = next(iter(runs))
    early = {step: min(rows, key=lambda row: abs(row[0] - 0.02))[1] for step, (rows, _) in runs.items()}
    same = [s for s in runs if runs[s][1] == "done" and abs(early[s] / early[least] - 1) < AGREED and runs[s][0][-1][1] < 1e-4]
    off = [s for s in runs if s not in same and runs[s][1] == "done" and runs[s][0][-1][1] < early[least]]
    lost = [s for s in runs if s not in same and s not in off]

    def named(steps):
        return ", ".join(f"{s:g}" for s in steps) + " s"

    text = (
        f"The particles of Fig. 7 from the same start, the kernel compiled for each time step. {named(same)}: kinetic energy at 0.02 s is within {100 * AGREED:.0f} % of that of the "
        f"smallest step ({1000 * early[least]:.2f} mJ), and below 0.1 mJ at the end. "
    )
    if off:
        text += f"{named(off)}: more than that off, or not at rest in the end. "
    if lost:
        text += f"{named(lost)}: the energy does not decay. "
    text += "As in the paper, energy decays in the same way with every step that is small enough, and does not where it is too large. Late values scatter, because the scene is chaotic."
    return "Kinetic energy while they settle, for several time steps", text
