"""Pictures of a sweep: any figure of points.csv against a key, means and spread over all that is not told apart; and the paper's
Fig. 13 and Fig. 15 where points allow it, drawn as make figures draws them."""

import sys
from pathlib import Path

root = Path(__file__).resolve().parent.parent
for part in ("figures", "report"):
    sys.path.insert(0, str(root / part))
from figure_plug_velocity import GRAVITY, PLUG_VELOCITY_LABELS, layer_picture, means_picture  # noqa: E402
from points import short_names, text_of  # noqa: E402
from plug_verdict import verdict  # noqa: E402

GAS_VELOCITY = ("gas", "bulk_velocity")
SEED = ("start", "seed")
PLUG_VELOCITY = "Fig. 13: plug velocity against gas velocity"


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def axes_of_picture(sweep):
    """(x, keys that tell curves apart): as [plot] says, or the gas velocity, or the first key that is a number."""
    by_name = {".".join(key): key for key in sweep.axes}
    numbers = [key for key, values in sweep.axes.items() if all(map(is_number, values))]
    first = next((key for key in numbers if key[-2:] != SEED), next(iter(numbers), None))
    x = by_name[sweep.plot["x"]] if "x" in sweep.plot else GAS_VELOCITY if GAS_VELOCITY in numbers else first
    others = [key for key in sweep.axes if key != x and key[-2:] != SEED]
    return x, [by_name[name] for name in sweep.plot["series"]] if "series" in sweep.plot else others


def series_name(sweep, keys, values):
    names = short_names(sweep.axes)
    return ", ".join(f"{names[key]} = {text_of(values[key])}" for key in keys) or sweep.base.stem


def grouped(sweep, points, keys):
    """Name of the series -> its points, each with its values by key."""
    found = {}
    for point in points:
        values = dict(zip(sweep.axes, point.values))
        found.setdefault(series_name(sweep, keys, values), []).append((values, point))
    return found


def draw(sweep, points, out):
    """Draws what there is to draw; (caption, name of the picture) of each."""
    done = [point for point in points if point.summary]
    x, keys = axes_of_picture(sweep)
    if not done or x is None or not all(map(is_number, sweep.axes[x])):
        return []
    groups, pictures = grouped(sweep, done, keys), []
    with_gas = any(point.summary["plug"] for point in done)
    with_plug = any(point.figures().get("front_velocity") is not None for point in done)
    for figure in sweep.plot.get("y", ["front_velocity"] if with_gas else ["kinetic_energy"]):
        if figure == "front_velocity" and not with_plug:
            continue  # nothing but zeros
        series = {}
        for name, members in groups.items():
            at = series.setdefault(name, {})
            for values, point in members:
                value = point.figures().get(figure)
                value = 0.0 if value is None and figure == "front_velocity" else value  # no plug: as in Fig. 13
                if is_number(value):
                    at.setdefault(values[x], []).append(value)
        series = {name: at for name, at in series.items() if at}
        if not series:
            continue
        plug_velocity = figure == "front_velocity" and x == GAS_VELOCITY
        labels = PLUG_VELOCITY_LABELS if plug_velocity else (".".join(x), figure)
        name = "fig_13" if plug_velocity else figure
        means_picture(series, out / name, *labels, "set yrange [*<0:0.1<*]\n" if figure == "front_velocity" else "")
        spread = "means, bars from minimum to maximum" + ("; 0: no plug" if figure == "front_velocity" else "")
        pictures.append(
            (
                f"{PLUG_VELOCITY if plug_velocity else f'{figure} against {labels[0]}'}; {spread}",
                name,
            )
        )
    moving = {}
    for name, members in groups.items() if with_gas else ():
        for _, point in members:
            if verdict(point.summary["plug"]) == "moves":
                plug, scale = point.summary["plug"], (GRAVITY * point.case["pipe"]["diameter"]) ** 0.5
                moving.setdefault(name, []).append((plug["particle_velocity"] / scale, plug["layer_area_ratio"]))
    if moving:
        layer_picture(moving, out / "fig_15")
        pictures.append(("Fig. 15: the stationary layer against the velocity of the plug; every plug that moves", "fig_15"))
    return pictures
