"""The slug of the Lethe example "dense pneumatic conveying" (after Lavrinec et al. 2021), computed there by CFD-DEM, and here."""

from math import pi

from drawing import Data, gnuplot
from report import table
from rows import Found, Row, Section
from scenes import plug

RUN = plug("slug_5mm")
COUNT, DIAMETER, BORE, LENGTH, DENSITY = 32194, 0.005, 0.084, 1.0, 890.0
SOLIDS = COUNT * pi / 6 * DIAMETER**3  # m3
AREA = pi / 4 * BORE**2
VOID = 1 - SOLIDS / (AREA * LENGTH)
THEIRS = {"front_velocity": ("slug velocity, m/s", 1.30, 0.02), "particle_velocity": ("particles in the slug, m/s", 0.83, 0.01), "length": ("slug length, m", 0.47, 0.01)}
RATE, RATE_SCATTER = 1.40, 0.01  # kg/s; their page gives no scatter: one in the last digit
MEAN_GAS = 3.0  # m/s, over the void
CORE_SECONDS = 2.25 * 3600 * 8 / 5  # per simulated second: 2.25 h on 8 cores for 5 s
LAST = 1.0  # s: theirs are means over the end of 5 s


def last(figures):
    return figures[0]["windows"][-1]


def beside(key, expected, scatter):
    """Within three times their scatter, or 5 %, whichever is more."""

    def find(figures):
        value = last(figures)[key]
        return Found(f"{value:.2f}", f"{100 * (value / expected - 1):+.0f} %", abs(value - expected) <= max(3 * scatter, 0.05 * expected))

    return find


def rate_of(window):
    return window["mean_axial_velocity"] * SOLIDS * DENSITY / LENGTH


def rate(figures):
    value = rate_of(last(figures))
    return Found(f"{value:.2f}", f"{100 * (value / RATE - 1):+.0f} %", abs(value - RATE) <= 0.05 * RATE)


def steady(figures):
    """The last two windows of a second."""
    before, now = figures[0]["windows"][-2:]
    off = {words: now[key] / before[key] - 1 for key, (words, _, _) in THEIRS.items()}
    worst = max(off, key=lambda words: abs(off[words]))
    return Found(f"{worst}: {100 * off[worst]:+.0f} %", f"{100 * off[worst]:+.0f} %", abs(off[worst]) <= 0.05)


def equivalent(figures):
    """Superficial velocity of gas and solids that corresponds to their mean over the void, with the solids flow found here."""
    solids = rate_of(last(figures)) / DENSITY / AREA
    value = MEAN_GAS * VOID + solids
    return Found(f"{MEAN_GAS * VOID:.2f} + {solids:.2f} = {value:.2f}", f"{2.14 - value:+.2f}")


def cost(figures):
    one = figures[0]
    seconds = one["performance"]["kernel_time"] / one["final"]["time"]
    return Found(f"{seconds:.0f}", f"1/{CORE_SECONDS / seconds:.0f}")


def rows():
    found = [Row("steady", "change from the last second but one to the last", "within 5 %: otherwise nothing here is a steady slug", [RUN], steady)]
    found += [Row(key.replace("_velocity", ""), f"last second: {words}", f"{value:.2f} ± {scatter:.2f} (Lethe)", [RUN], beside(key, value, scatter)) for key, (words, value, scatter) in THEIRS.items()]
    found.append(Row("rate", "last second: solids flow, kg/s", f"{RATE:.2f} (Lethe)", [RUN], rate))
    found.append(Row("gas", "U that their 3 m/s over the void is, less ours (2.14 m/s)", f"{MEAN_GAS:g} m/s x {VOID:.2f} + solids", [RUN], equivalent))
    found.append(Row("cost", "core-seconds per simulated second", f"{CORE_SECONDS:.0f} (Lethe, 8 cores)", [RUN], cost))
    return found


def seconds(results):
    figures = results.of(RUN)
    if figures is None:
        return ""
    lines = [[f"{w['from']:.0f} to {w['from'] + 1:.0f}", *(f"{w[key]:.2f}" for key in THEIRS), "-" if w["layer_area_ratio"] is None else f"{w['layer_area_ratio']:.2f}", f"{rate_of(w):.2f}"] for w in figures["windows"]]
    return table(["time, s", *(words for words, _, _ in THEIRS.values()), "layer ratio", "solids flow, kg/s"], lines)


def pictures(results, folder, draws):
    figures = results.of(RUN)
    if figures is None:
        return []
    if draws:
        draw(figures, folder)
    return [("slug_5mm", "The slug over time, means over a second; dashed: Lethe's figures for the end of 5 s")]


def draw(figures, folder):
    with Data() as data:
        curves = []
        for k, (key, (words, value, _)) in enumerate(THEIRS.items(), 1):
            rows_of = [(w["from"] + 0.5, w[key]) for w in figures["windows"]]
            curves += [f"'{data.file(rows_of)}' with linespoints linewidth 1.5 pointtype {5 + k} linecolor {k} title '{words}'", f"{value} with lines dashtype 2 linecolor {k} notitle"]
        gnuplot(f"set xlabel 'time, s'\nset ylabel 'm/s, m'\nset xrange [0:5]\nset yrange [0:2]\nset key outside top center horizontal\nplot {', '.join(curves)}", folder / "slug_5mm")


def section():
    return Section(
        "lethe",
        "A peer's slug: Lethe, dense pneumatic conveying",
        f"32 194 spheres of 5 mm in a pipe of 84 mm, 1 m periodic. What is not the same: their 3 m/s is a mean over the void, so U is {MEAN_GAS:g} x {VOID:.2f} m/s of gas and the volume flow of solids besides; "
        "their drag is Di Felice's and their gas flow is resolved, here Ergun's equation holds in slices of one diameter; their slug starts as a core of 0.5 m with ends of 45 degrees on a layer of a fifth of the section, "
        "here a bare pile sheds its layer; their rolling resistance is a constant torque, here a spring with the same limit. A row agrees within 5 %, or three times their scatter.",
        rows(),
        seconds,
        pictures,
    )
