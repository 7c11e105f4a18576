"""Fig. 11: velocities of particles in the moving plug, near the wall and near the centre plane, as arrows.

Near the wall: centres within a diameter of the wall, on the viewer's side; near the centre plane: centres within half a diameter
of the vertical plane through the axis. One moment of the run of Fig. 10.
"""

import numpy as np
from drawing import Data, gnuplot
from frames import frames_at

TIME = 0.6  # s
MILLIMETRES_PER_SPEED = 30  # an arrow of 1 m/s is so long


def chosen(frame, pipe):
    """name -> positions and velocities of those near that plane."""
    x, v = np.array(frame["position"]), np.array(frame["velocity"])
    d = 2 * frame["radius"][0]
    near_wall = (np.hypot(x[:, 0], x[:, 1]) > pipe["diameter"] / 2 - d) & (x[:, 0] < 0)
    return {"near the wall": (x[near_wall], v[near_wall]), "near the centre plane": (x[np.abs(x[:, 0]) < d / 2], v[np.abs(x[:, 0]) < d / 2])}


def mean_by_height(x, v, pipe):
    """Mean axial velocity of the lower, middle and upper third of the pipe's height, inside the plug only."""
    edges = np.linspace(-pipe["diameter"] / 2, pipe["diameter"] / 2, 4)
    thirds = [v[(x[:, 1] >= a) & (x[:, 1] < b), 2] for a, b in zip(edges, edges[1:])]
    return [float(third.mean()) if len(third) else float("nan") for third in thirds]


def inside(frame, front, length, pipe):
    """The frame without what lies outside the plug."""
    keep = [(front - z) % pipe["length"] < length for _, _, z in frame["position"]]
    return {name: [value for value, k in zip(values, keep) if k] for name, values in frame.items() if len(values) == len(keep)}


def fig_11(run, plug_at, pipe, out):
    """plug_at: time -> (front, length) of the plug, m."""
    ((time, frame),) = frames_at(run, [TIME])
    r, length_mm = 1000 * pipe["diameter"] / 2, 1000 * pipe["length"]
    script = ["set multiplot layout 2,1"]
    with Data() as data:
        for name, (x, v) in chosen(frame, pipe).items():
            rows = 1000 * x[:, 2], 1000 * x[:, 1], MILLIMETRES_PER_SPEED * v[:, 2], MILLIMETRES_PER_SPEED * v[:, 1]
            script.append(
                f"set title '{name}, {time:.2f} s'\nset size ratio -1\nset xrange [0:{length_mm}]\nset yrange [{-r}:{1.5 * r}]\nset ytics {-r},{r},{r}\n"
                f"set xlabel 'along the pipe, mm'\nset ylabel 'height, mm'\nunset key\nset label 1 '1 m/s' at {0.87 * length_mm},{1.25 * r} right\n"
                f"set arrow 1 from {0.88 * length_mm},{1.25 * r} to {0.88 * length_mm + MILLIMETRES_PER_SPEED},{1.25 * r} size 5,20 filled linewidth 1.5\n"
                f"plot {r} with lines linecolor '#888888', '{data.file(np.column_stack(rows))}' using 1:2:3:4 with vectors filled size 5,20 linewidth 1 linecolor 'black' title 'velocities'"
            )
        script.append("unset multiplot")
        gnuplot("\n".join(script), out / "fig_11", 1400, 460)
    front, length = plug_at(time)
    in_plug = inside(frame, front, length, pipe)
    wall, centre = (mean_by_height(*pair, pipe) for pair in chosen(in_plug, pipe).values())
    upwards = float(np.mean([v[1] for v in inside(frame, front, 0.05, pipe)["velocity"]]))
    rises = centre[2] > centre[0] and wall[2] > wall[0] and upwards > 0
    return (
        "Velocities in the plug near the wall and near the centre plane",
        f"The run of Fig. 10 at {time:.1f} s; particles drawn by their velocity only. Inside the plug, mean axial velocity in the lower, middle and upper third of the pipe: "
        f"{', '.join(f'{w:.2f}' for w in wall)} m/s near the wall, {', '.join(f'{c:.2f}' for c in centre)} m/s near the centre plane; "
        f"in its first 5 cm particles rise at {upwards:.2f} m/s on average. "
        + ("So velocity rises from the bottom to the top, near the wall as well as in the middle, and the front rolls over the layer." if rises else "Velocity does not rise from the bottom to the top everywhere."),
    )  # fmt: skip
