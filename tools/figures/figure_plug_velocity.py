"""Fig. 13, plug velocity against gas velocity with and without the 3 mm modification, and Fig. 15, the stationary layer.

Each point is the mean over the seeds of the fill, each bar reaches from minimum to maximum of them. Fig. 15 has every run of a
plug that moves by itself, beside eq. (41), A_d/A = 1/(1 + 1.84 V_p/sqrt(g D)), V_p the velocity of the particles in the plug.
"""

from drawing import Data, gnuplot
from plug_verdict import verdict

GRAVITY = 9.81  # m/s2
SERIES = {"10 mm": {1.7: "plug_u17", 2.4: "plug_u24"}, "3 mm": {1.7: "plug_u17_d3", 2.4: "plug_u24_d3"}}
PLUG_VELOCITY_LABELS = ("gas velocity U, m/s", "plug velocity, m/s")
POINTS = (7, 4, 9, 5, 11)  # gnuplot's point types


def layer_of_plug(velocity):
    """Eq. (41): A_d / A behind a plug whose particles move at `velocity`, in units of sqrt(g D)."""
    return 1 / (1 + 1.84 * velocity)


def velocities(summaries, case):
    return [s["plug"]["front_velocity"] or 0.0 for (name, _), s in summaries.items() if name == case]


def mean(values):
    return sum(values) / len(values)


def means_picture(series, path, x_label, y_label, ranges="", apart=None):
    """series: name -> {x: values there}. A point for the mean, a bar from minimum to maximum; series stand `apart` so that bars
    do not hide one another. `ranges`: commands of gnuplot."""
    every = [x for at in series.values() for x in at]
    apart = 0.01 * (max(every) - min(every)) if apart is None else apart
    with Data() as data:
        curves = []
        for k, (name, at) in enumerate(series.items()):
            shift = apart * (k - (len(series) - 1) / 2)
            rows = [(x + shift, mean(values), min(values), max(values)) for x, values in sorted(at.items())]
            look = f"linewidth 1.5 pointtype {POINTS[k % len(POINTS)]} linecolor {k % 7 + 1} dashtype {k % 5 + 1}"
            curves.append(f"'{data.file(rows)}' with yerrorlines {look} title '{name}' noenhanced")
        gnuplot(f"set xlabel '{x_label}' noenhanced\nset ylabel '{y_label}' noenhanced\n{ranges}set key left top\nplot {', '.join(curves)}", path)


def layer_picture(points, path):
    """points: name -> [(V_p / sqrt(g D), area ratio)], beside eq. (41)."""
    curve = [(0.01 * k, layer_of_plug(0.01 * k)) for k in range(301)]
    with Data() as data:
        curves = [f"'{data.file(curve)}' with lines linewidth 2 linecolor 'black' title 'eq. (41)'"]
        curves += [
            f"'{data.file(rows)}' with points pointtype {POINTS[k % len(POINTS)]} linecolor {k % 7 + 1} title '{name}' noenhanced"
            for k, (name, rows) in enumerate(points.items())
        ]
        gnuplot(
            "set xlabel 'V_p / (g D)^{1/2}'\nset ylabel 'area of the layer over that of the pipe, A_d / A'\n"
            f"set xrange [0:3]\nset yrange [0:1]\nset key right top\nplot {', '.join(curves)}",
            path,
        )


def fig_13(summaries, out):
    seeds = sorted({seed for _, seed in summaries})
    found = {name: {gas: velocities(summaries, case) for gas, case in cases.items()} for name, cases in SERIES.items()}
    series = {f"d = {name} in eq. (33)": at for name, at in found.items()}
    means_picture(series, out / "fig_13", *PLUG_VELOCITY_LABELS, "set xrange [0:3]\nset yrange [0:2]\n", 0.02)
    modified, plain = mean(found["3 mm"][1.7]), mean(found["10 mm"][2.4])
    died = all(verdict(s["plug"]) == "dies" for (name, _), s in summaries.items() if name == "plug_u17")
    return (
        "Plug velocity against gas velocity, with and without the 3 mm modification",
        f"Means over {len(seeds)} seeds of the fill; bars from minimum to maximum. "
        + ("At 1.7 m/s and 10 mm the plug dies with every seed, as in the paper (its point is what its front did meanwhile); " if died else "At 1.7 m/s and 10 mm the paper's plug dies, here not with every seed; ")
        + f"with 3 mm it moves at {modified:.2f} m/s. At 2.4 m/s and 10 mm it moves at {plain:.2f} m/s, with 3 mm at {mean(found['3 mm'][2.4]):.2f}: faster, as in the paper. "
        + ("What differs: the paper has the plugs at 1.7 m/s with 3 mm and at 2.4 m/s with 10 mm both as fast as measured, so the second the faster one; here it is the first." if modified > plain else "As in the paper, that at 2.4 m/s with 10 mm is faster than that at 1.7 m/s with 3 mm."),
    )  # fmt: skip


def fig_15(summaries, pipe, out):
    scale = (GRAVITY * pipe["diameter"]) ** 0.5
    points, off = {}, []
    for (case, _), summary in summaries.items():
        plug = summary["plug"]
        if verdict(plug) == "moves":
            points.setdefault(case, []).append((plug["particle_velocity"] / scale, plug["layer_area_ratio"]))
            off.append(plug["layer_area_ratio"] - layer_of_plug(plug["particle_velocity"] / scale))
    layer_picture(points, out / "fig_15")
    slow = [abs(o) for o, (case, _) in zip(off, [(c, p) for c, ps in points.items() for p in ps]) if case != "plug_u24_d3"]
    fast = [o for o, (case, _) in zip(off, [(c, p) for c, ps in points.items() for p in ps]) if case == "plug_u24_d3"]
    return (
        "The stationary layer against the velocity of the plug",
        f"Every plug that moves, one point for each seed; the layer is measured as the solids fraction outside the plug over that inside. The plugs at 1.7 m/s with 3 mm and at 2.4 m/s with 10 mm lie within {max(slow):.2f} of eq. (41): "
        f"the layer is lower the faster the plug, as in the paper. The fastest plugs' layers are up to {max(fast):.2f} above the curve: part of what lies outside the plug is still moving there.",
    )  # fmt: skip
