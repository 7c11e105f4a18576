"""A heap with and without rolling resistance (heap_rolling, heap_sliding): particles near its middle plane, and its slope.

The surface over a distance from the axis is the highest top of the particles in a ring one diameter wide. The slope is that of the
straight line through the rings between a fifth and four fifths of the radius that holds nine tenths of the particles.
"""

from math import atan, degrees, hypot

from drawing import Data, gnuplot
from frames import frames_at

NAMES = {"heap_rolling": "rolling resistance 0.2", "heap_sliding": "without"}


def surface(positions, radius):
    """Distance from the axis and height of the surface, ring by ring, as far as the heap reaches."""
    rings = {}
    for x, y, z in positions:
        ring = int(hypot(x, y) / (2 * radius))
        rings[ring] = max(rings.get(ring, 0), z + radius)
    return [((ring + 0.5) * 2 * radius, rings[ring]) for ring in sorted(rings)]


def slope(rings, reach):
    """Of the straight line through the surface, and its height at the axis; none where the heap is too small for one."""
    used = [(r, z) for r, z in rings if 0.2 * reach < r < 0.8 * reach]
    if len(used) < 3:
        return 0.0, 0.0
    mean_r, mean_z = (sum(column) / len(used) for column in zip(*used, strict=True))
    steepness = sum((r - mean_r) * (z - mean_z) for r, z in used) / sum((r - mean_r) ** 2 for r, _ in used)
    return -steepness, mean_z - steepness * mean_r


def measured(run, time):
    frame = frames_at(run, (time,))[-1][1]
    positions, radius = frame["position"], frame["radius"][0]
    distances = sorted(hypot(x, y) for x, y, _ in positions)
    reach = distances[int(0.9 * len(distances))]
    rings = surface(positions, radius)
    return {
        "circles": [(x, z, radius) for x, y, z in positions if abs(y) < radius],
        "height": max(z for _, z in rings),
        "reach": reach,
        "line": slope(rings, reach),
    }


def angle(seen):
    return abs(round(degrees(atan(seen["line"][0]))))


def heap(runs, case, out):
    """`runs`: name -> folder; `case`: of the heap with rolling resistance. Returns title and text."""
    time, pipe = case["run"]["duration"], case["pipe"]
    found = {name: measured(run, time) for name, run in runs.items()}
    half = pipe["diameter"] / 2
    with Data() as data:
        panels = []
        for name, seen in found.items():
            steepness, top = seen["line"]
            line = [(s * r, top - steepness * r) for s, r in ((-1, 0.8 * seen["reach"]), (1, 0), (1, 0.8 * seen["reach"]))]
            line[1] = (0, top)
            panels.append(
                f"set title '{NAMES[name]}: slope {angle(seen)} degrees'\n"
                f"plot '{data.file(seen['circles'])}' with circles linecolor 1 fill solid 0.3 notitle, "
                f"'{data.file(line)}' with lines linewidth 3 linecolor 3 notitle"
            )
        gnuplot(
            f"set xrange [{-half}:{half}]\nset yrange [0:0.1]\nset size ratio -1\nset xlabel 'm'\nset ylabel 'm'\n"
            "set multiplot layout 2,1\n" + "\n".join(panels) + "\nunset multiplot",
            out / "heap",
        )
    words = [
        f"{NAMES[name]}: {1000 * seen['height']:.0f} mm high, nine tenths within {1000 * seen['reach']:.0f} mm of the axis, slope {angle(seen)} degrees"
        for name, seen in found.items()
    ]
    return (
        "A heap with and without rolling resistance",
        f"The upright pile of {case['start']['from']} after its tube is gone, at {time:g} s; particles near the middle plane, and the line through the surface. "
        + "; ".join(words)
        + f". Friction is {case['material']['friction']:g} in both: without rolling resistance spheres roll away, and no heap is left.",
    )
