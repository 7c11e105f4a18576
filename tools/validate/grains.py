"""The paper's own particles, 3 mm, beside its substitute for them: 10 mm particles with 3 mm put into eqs. (33) and (35)."""

from math import pi

from figure_plug_velocity import PLUG_VELOCITY_LABELS, layer_picture, means_picture
from plug_verdict import verdict
from report import table
from rows import Found, Row, Section, reported, said
from scenes import LINES_3MM, axial_velocity, front, of_plug, plug, plugs

PAIRS = {"1.7": ("plug_d3_u17", "plug_u17_d3"), "2.4": ("plug_d3_u24", "plug_u24_d3")}
GAP_3MM = [plug("plug_u17_d3", 1, "gap3", (("gas", "full_gap", "0.003"),)), plug("plug_u24_d3", 1, "gap3", (("gas", "full_gap", "0.003"),))]
GAP_10MM = plug("plug_d3_u17", 1, "gap10", (("gas", "full_gap", "0.010"),))
LONGER = plug("plug_d3_u17", 1, "solids15", (("particles", "count", "50000"),), (("particles", "count", "50000"), ("pipe", "length", "2.5")))
PROTOTYPE = {"W": (1.78, 2), "V_p": (1.26, 2), "length": (0.28, 2), "layer": (0.35, 2)}  # one seed, U = 2.4 m/s, another program
KEYS = {"W": "front_velocity", "V_p": "particle_velocity", "length": "length", "layer": "layer_area_ratio", "drop": "pressure_drop"}
NAMES = {"W": "plug velocity, m/s", "V_p": "particles in the plug, m/s", "length": "plug length, m", "layer": "layer ratio", "drop": "pressure drop over 0.8 m, kPa"}
# The solids of 1000 particles of 10 mm as a plug of void fraction 0.465 in the pipe of 50 mm: the length of the pile, m.
PILE = 1000 * pi / 6 * 0.01**3 / (0.535 * pi / 4 * 0.05**2)
PIPE = 0.8  # m


def scale(key):
    return 1e-3 if key == "drop" else 1.0


def beside(key):
    """The mean over seeds of the true particles less that of the substitute, as a share of the latter."""

    def find(figures):
        values = [(one["run"].startswith("plug_d3"), of_plug(KEYS[key], scale(key))(one)) for one in figures]
        if any(value is None for _, value in values):
            return Found("no plug is left")
        true, substitute = ([value for is_true, value in values if is_true == wanted] for wanted in (True, False))
        if not (true and substitute):
            return Found("one of the two has not been run")
        a, b = sum(true) / len(true), sum(substitute) / len(substitute)
        return Found(f"{a:.2f} ({min(true):.2f} to {max(true):.2f})", f"{100 * (a / b - 1):+.0f} % of {b:.2f} ({min(substitute):.2f} to {max(substitute):.2f})")

    return find


def outside_number(key):
    expected, digits = PROTOTYPE[key]

    def find(figures):
        values = [of_plug(KEYS[key])(one) for one in figures]
        if any(value is None for value in values):
            return Found("no plug is left", "-", False)
        worst = max((value / expected - 1 for value in values), key=abs)
        return Found(f"{sum(values) / len(values):.{digits}f}", f"{100 * worst:+.0f} % at most", abs(worst) <= 0.10)

    return Row(f"prototype-{key}", f"true 3 mm at 2.4 m/s: {NAMES[key]}", f"{expected:g} within 10 % (another program, one seed)", plugs("plug_d3_u24"), find, True)


def starving(figures):
    """Length by (S - a L)/(1 - a) less that found, over all plugs that are given."""
    off = []
    for one in figures:
        a = of_plug("layer_area_ratio")(one)
        if a is not None:
            off.append((PILE - a * PIPE) / (1 - a) - one["plug"]["length"])
    if not off:
        return Found("no plug is left")
    return Found(f"{min(off):+.3f} to {max(off):+.3f} m", f"{max(off, key=abs):+.3f}")


def rows():
    found = [said("true-u17-word", "true 3 mm at 1.7 m/s: what becomes of the plug", "dies", plugs("plug_d3_u17"), lambda f: verdict(f["plug"]), " (another program)", True)]
    found += [outside_number(key) for key in PROTOTYPE]
    for gas, (true, substitute) in PAIRS.items():
        for key in KEYS:
            found.append(Row(f"u{gas.replace('.', '')}-{key}", f"true 3 mm at {gas} m/s: {NAMES[key]}", "as the substitute, if that is fair", [*plugs(true), *plugs(substitute)], beside(key), True))
    found.append(reported("true-u17-end", "true 3 mm at 1.7 m/s: mean axial velocity at 1.2 s, m/s", plugs("plug_d3_u17"), axial_velocity, 3, some=True))
    found.append(reported("gap-3mm-u17", "substitute at 1.7 m/s with a gap of 3 mm: plug velocity, m/s", GAP_3MM[:1], front, 2, "dies, if the gap is why"))
    found.append(reported("gap-3mm-u24", "substitute at 2.4 m/s with a gap of 3 mm: plug velocity, m/s", GAP_3MM[1:], front))
    found.append(reported("gap-10mm", "true 3 mm at 1.7 m/s with a gap of 10 mm: plug velocity, m/s", [GAP_10MM], front, 2, "moves, if the gap is why"))
    found.append(reported("solids", "true 3 mm at 1.7 m/s with 1.35 times the solids: plug velocity, m/s", [LONGER], front, 2, "moves, if it starves"))
    found.append(Row("starving", "length by (S - aL)/(1 - a) less that found, all plugs of 0.8 m that are left", "0, by the balance of solids",
                     [run for pair in PAIRS.values() for case in pair for run in plugs(case)] + plugs("plug_u24"), starving, True))  # fmt: skip
    return found


def substitutes(results):
    """One row for each run."""
    lines = []
    for gas, pair in PAIRS.items():
        for case in pair:
            for run in plugs(case):
                figures = results.of(run)
                values = [None if figures is None else of_plug(KEYS[key], scale(key))(figures) for key in KEYS]
                word = "not run yet" if figures is None else verdict(figures["plug"])
                end = "-" if figures is None else f"{axial_velocity(figures):.3f}"
                lines.append([gas, "true 3 mm" if case.startswith("plug_d3") else "substitute", str(run.seed), *("-" if v is None else f"{v:.2f}" for v in values), end, word])
    return table(["U, m/s", "particles", "seed", *NAMES.values(), "mean axial velocity at the end, m/s", "verdict"], lines)


def pictures(results, folder, draws):
    """Figs. 13 and 15 with true particles and lines."""
    plugs_of = {"10 mm": {1.7: "plug_u17", 2.4: "plug_u24"}, "10 mm, 3 mm in eq. (33)": {1.7: "plug_u17_d3", 2.4: "plug_u24_d3"}, "true 3 mm": {1.7: "plug_d3_u17", 2.4: "plug_d3_u24"}}
    fronts, layers = {}, {}
    for name, at in plugs_of.items():
        for gas, case in at.items():
            found = [one for one in map(results.of, plugs(case)) if one is not None]
            if found:
                fronts.setdefault(name, {})[gas] = [front(one) or 0.0 for one in found]
            moving = [one["plug"] for one in found if verdict(one["plug"]) == "moves"]
            layers.setdefault(name, []).extend((plug_found["particle_velocity"] / (9.81 * 0.05) ** 0.5, plug_found["layer_area_ratio"]) for plug_found in moving)
    for run, gas in zip(LINES_3MM, (1.7, 2.4)):
        one = results.of(run)
        if one and one["plugs"]:
            fronts.setdefault("open line, 3 mm", {})[gas] = [plug_found["front_velocity"] for plug_found in one["plugs"]]
            layers.setdefault("open line, 3 mm", []).extend((p["particle_velocity"] / (9.81 * 0.052) ** 0.5, p["layer_ratio"]) for p in one["plugs"] if p["layer_ratio"] is not None)
    layers = {name: rows_of for name, rows_of in layers.items() if rows_of}
    if not (fronts and layers):
        return []
    if draws:
        means_picture(fronts, folder / "fig_13", *PLUG_VELOCITY_LABELS, "set xrange [0:3]\nset yrange [0:2.5]\n", 0.03)
        layer_picture(layers, folder / "fig_15")
    return [("fig_13", "The paper's Fig. 13 with particles of 3 mm: mean of seeds, or of the single plugs of a line, with minimum and maximum; a plug that dies is shown at what its front did meanwhile"),
            ("fig_15", "The paper's Fig. 15 with particles of 3 mm: the layer against the velocity of the particles in the plug")]  # fmt: skip


def section():
    return Section(
        "grains",
        "Particles of 3 mm, and the paper's substitute for them",
        "The authors measured 3 mm particles and computed 10 mm ones with 3 mm in the Ergun equation. Here are both: 37 037 spheres of 3 mm with the same solids, and the substitute. "
        "A slice of gas counts as full when no further particle fits above the bed, so the gap through which gas escapes over a plug is 3 mm for the true particles and 10 mm for the substitute. "
        "In a periodic pipe of length L the solids of a pile of length S over a layer of ratio a make a plug of length (S - aL)/(1 - a): a slow plug, which leaves a thick layer, starves. An open line does not have that bound.",
        rows(),
        substitutes,
        pictures,
    )
