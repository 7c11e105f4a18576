"""Particles of several sizes: where two species end that fall together (settle_two_sizes), and plugs of them beside plug_u24.

The share of a species at a height is the exact volume of its spheres between two planes 5 mm apart over that of the tube. The bed is as high as
the highest large sphere; fine ones may still bounce above it.
"""

from math import pi

from drawing import Data, gnuplot, side_views
from fixdem import read_summary
from frames import frames_at

PLUGS = {"plug_u24": "equal, 10 mm", "plug_sizes": "10 mm +- 20 %", "plug_two_sizes": "10 and 7 mm"}
SLICE = 0.005  # m
SMALL = 0.0042  # m: radius, between the two species of plug_two_sizes
LOWEST = 0.020  # m: the layer on the floor


def below(z, r, plane):
    """Volume of a sphere at z below a plane."""
    h = min(max(plane - (z - r), 0), 2 * r)
    return pi * h * h * (r - h / 3)


def share(spheres, section, low, high):
    return sum(below(z, r, high) - below(z, r, low) for z, r in spheres) / (section * (high - low))


def packing(run, case, out):
    """`run`: folder of settle_two_sizes. Returns title and text."""
    time, pipe = case["run"]["duration"], case["pipe"]
    frame = frames_at(run, (time,))[-1][1]
    section, names = pi / 4 * pipe["diameter"] ** 2, [species["name"] for species in case["particles"]["species"]]
    everything = list(zip(frame["position"], frame["radius"], frame["species"], strict=True))
    large = max(frame["radius"])
    top = max(x[2] + r for x, r, _ in everything if r == large)
    of = {name: [(x[2], r) for x, r, s in everything if s == k] for k, name in enumerate(names)}
    at_floor = {name: share(pairs, section, 0, LOWEST) for name, pairs in of.items()}
    above = {name: share(pairs, section, LOWEST, top - LOWEST) for name, pairs in of.items()}
    means = {name: sum(z for z, _ in pairs) / len(pairs) for name, pairs in of.items()}
    planes = [k * SLICE for k in range(int(top / SLICE) + 1)]
    half = pipe["diameter"] / 2
    with Data() as data:
        circles, profiles = [], []
        for k, name in enumerate(names, 1):
            near = [(x[2], x[0], r) for x, r, s in everything if s == k - 1 and abs(x[1]) < r]
            circles.append(f"'{data.file(near)}' with circles linecolor {k} fill solid 0.3 notitle")
            profile = [(low + SLICE / 2, share(of[name], section, low, low + SLICE)) for low in planes]
            profiles.append(f"'{data.file(profile)}' with lines linewidth 2 linecolor {k} title '{name}'")
        gnuplot(
            f"set multiplot\nset xrange [0:{1.05 * top:.3f}]\nset xlabel 'height, m'\n"
            f"set origin 0,0.5\nset size ratio -1 1,0.5\nset yrange [{-half}:{half}]\nset ylabel 'm'\nplot {', '.join(circles)}\n"
            "set origin 0,0\nset size noratio 1,0.5\nset yrange [0:*]\nset ylabel 'share of the volume'\nset key top center\n"
            f"plot {', '.join(profiles)}\nunset multiplot",
            out / "two_sizes",
        )
    higher, lower = sorted(means, key=means.get, reverse=True)[:2]
    apart = means[higher] - means[lower]
    shares = "; ".join(f"{name}: {at_floor[name]:.3f} in the lowest {1000 * LOWEST:.0f} mm, {above[name]:.3f} above" for name in names)
    return (
        "Two sizes in an upright tube",
        f"{case['title']}, at {time:g} s: particles near the middle plane, and the share of the volume that each species fills ({shares}). They fell together, mixed. "
        + (f"The {lower} ones lie {1000 * apart:.0f} mm lower on average, in a bed {1000 * top:.0f} mm high: they have trickled down between the {higher} ones."
           if apart > 0.1 * top else f"They stay mixed: their mean heights differ by {1000 * apart:.0f} mm in a bed {1000 * top:.0f} mm high."),
    )  # fmt: skip


def sauter(case, summary):
    """Sauter diameter, mm."""
    return 1000 * (summary["sizes"]["sauter_diameter"] if "sizes" in summary else case["particles"]["diameter"])


def plugs(runs, cases, out):
    """`runs`: name -> folder of one run each, `cases`: name -> case. Returns title and text."""
    summaries = {name: read_summary(run) for name, run in runs.items()}
    panels = []
    for name, words in PLUGS.items():
        time, frame = frames_at(runs[name], (cases[name]["run"]["duration"],))[-1]
        panels.append((f"{words}, {time:.1f} s", frame, [r < SMALL for r in frame["radius"]]))
    side_views(panels, cases["plug_u24"]["pipe"], out / "plugs_of_sizes")

    keys = (("front_velocity", "front, m/s"), ("particle_velocity", "particles in the plug, m/s"), ("length", "length, m"), ("layer_area_ratio", "layer area ratio"))
    lines = ["| particles | Sauter diameter, mm | " + " | ".join(words for _, words in keys) + " |", "|---" * (len(keys) + 2) + "|"]
    found = {}
    for name, words in PLUGS.items():
        plug, found[name] = summaries[name]["plug"] or {}, sauter(cases[name], summaries[name])
        lines.append(f"| {words} (`{name}`) | {found[name]:.1f} | " + " | ".join("-" if plug.get(key) is None else f"{plug[key]:.2f}" for key, _ in keys) + " |")
    fronts = {name: (summaries[name]["plug"] or {}).get("front_velocity") for name in PLUGS}
    moving = [name for name in sorted(PLUGS, key=found.get) if fronts[name] is not None]
    falls = len(moving) == len(PLUGS) and all(fronts[a] > fronts[b] for a, b in zip(moving, moving[1:], strict=False))
    return (
        "Plugs of several sizes",
        f"The same volume of particles in the same gas; black: particles smaller than {2000 * SMALL:g} mm. One run each, means as in the table of the five plugs. "
        + ("The smaller the Sauter diameter, the faster the plug: Ergun's resistance grows as it falls." if falls else "The speeds do not follow the Sauter diameters.")
        + "\n\n" + "\n".join(lines),
    )  # fmt: skip
