"""The paper's words and figures, beside this program's and beside those of an independent program that made the same choices."""

from plug_verdict import RULE, verdict
from rows import Found, Row, Section, reported, said, within
from runs import Run
from scenes import axial_velocity, front, of_plug, plugs

INDEPENDENT = " (independent program)"
# Ranges over seeds that an independent program of the same model found: W, V_p, length, layer ratio.
RANGES = {
    "plug_u24": ((0.85, 0.99), (0.49, 0.62), (0.23, 0.31), (0.39, 0.50)),
    "plug_u17_d3": ((1.05, 1.16), (0.70, 0.82), (0.28, 0.34), (0.34, 0.43)),
    "plug_u24_d3": ((1.68, 1.83), (1.30, 1.45), (0.29, 0.36), (0.29, 0.39)),
}
QUANTITIES = (("W", "plug velocity, m/s", "front_velocity"), ("V_p", "particles in the plug, m/s", "particle_velocity"), ("length", "plug length, m", "length"),
              ("layer", "layer ratio", "layer_area_ratio"))  # fmt: skip
WORDS = {"plug_u24": "moves", "plug_u17": "dies", "plug_u17_d3": "moves", "plug_u24_d3": "moves", "plug_u24_n500": "collapses"}
SMALL_STEPS, LARGE_STEP = (1e-5, 2e-5), 3.5e-5  # s, beside the 2e-6 s of the case


def word(figures):
    return verdict(figures["plug"])


def settle(step):
    return Run("settle", f"step{step:g}", (("run", "time_step", f"{step:g}"), ("run", "stability_limit", "inf"), ("run", "max_overlap", "0.99")))


def energies(figures):
    """The early value must be right; late ones scatter, because the scene is chaotic."""
    found = [1000 * value for value in figures[0]["kinetic_energy"]]
    return Found(", ".join(f"{value:.3g}" for value in found) + " mJ", f"{100 * (found[0] / 4.25 - 1):+.0f} % at 0.02 s", 0.85 * 4.2 <= found[0] <= 1.15 * 4.3 and found[2] < 0.1)


def decay(figures):
    found = [1000 * value for one in figures for value in one["kinetic_energy"][:1]]
    late = [1000 * value for one in figures for value in one["kinetic_energy"][2:]]
    within_range = all(0.85 * 4.2 <= value <= 1.15 * 4.3 for value in found) and all(value < 0.1 for value in late)
    text = f"{min(found):.2f} to {max(found):.2f} mJ at 0.02 s, {min(late):.3f} to {max(late):.3f} at 0.20 s"
    return Found(text, "-", within_range)


def no_decay(figures):
    late = figures[0]["kinetic_energy"][2]
    stopped = figures[0]["status"] != "done"
    text = f"the run stops: {figures[0]['status']}" if stopped else f"{1000 * late:.3g} mJ at 0.20 s"
    return Found(text, "-", stopped or late > 1e-3)


def order(figures):
    """Of plug velocities at 1.7 m/s with 3 mm and at 2.4 m/s with 10 mm, three of each."""
    slow, fast = (sum(map(front, part)) / len(part) for part in (figures[:3], figures[3:]))
    return Found(f"{slow:.2f} and {fast:.2f}", f"{slow - fast:+.2f}", slow < fast)


def off_eq41(figures):
    off = [one["plug"]["layer_area_ratio"] - one["plug"]["layer_area_ratio_eq41"] for one in figures]
    worst = max(off, key=abs)
    return Found(f"{min(off):+.3f} to {max(off):+.3f}", f"{worst:+.3f}", all(abs(value) <= 0.05 for value in off))


def rows():
    found = [said(f"{case}-word", f"`{case}`: what becomes of the plug", WORDS[case], plugs(case), word, " (paper)") for case in WORDS]
    for case, ranges in RANGES.items():
        for (name, what, key), (low, high) in zip(QUANTITIES, ranges):
            found.append(within(f"{case}-{name}", f"`{case}`: {what}", low, high, plugs(case), of_plug(key), 2, INDEPENDENT))
    found.append(within("plug_u17-velocity", "`plug_u17`: mean axial velocity at 1.2 s, m/s", 0, 0.06, plugs("plug_u17"), axial_velocity, 3, INDEPENDENT))
    found.append(Row("fig-13-order", "W at 1.7 m/s with 3 mm, and at 2.4 m/s with 10 mm, m/s", "the second larger (paper: both as measured)", [*plugs("plug_u17_d3"), *plugs("plug_u24")], order))
    found += [Row(f"fig-15-{case}", f"`{case}`: layer ratio less eq. (41)", "within 0.05 of 0 (the width that open lines keep)", plugs(case), off_eq41) for case in RANGES]
    found.append(Row("fig-08-shipped", "kinetic energy (translation) of Table 1 at 0.02, 0.10 and 0.20 s", "4.2 to 4.3 mJ within 15 %, 0.9 to 1.3, 0.01 to 0.04 (independent program)", [Run("settle")], energies))
    found.append(Row("fig-08-decay", "kinetic energy (translation) of Table 1 at steps of 2e-6 to 2e-5 s", "4.2 to 4.3 mJ at 0.02 s, within 15 %; at rest at 0.20 s (paper: decays alike)",
                     [Run("settle"), *(settle(step) for step in SMALL_STEPS)], decay))  # fmt: skip
    found.append(Row("fig-08-unstable", "the same at 3.5e-5 s", "does not decay (paper)", [settle(LARGE_STEP)], no_decay))
    found.append(reported("plug_u24-drop", "`plug_u24`: pressure drop over 0.8 m, kPa", plugs("plug_u24"), of_plug("pressure_drop", 1e-3)))
    return found


def section():
    return Section(
        "paper",
        "The paper's words and figures",
        f"Three seeds of each fill: mean, minimum and maximum. {RULE} The paper says more in pictures than in numbers; the pictures are in "
        "[README.md](README.md#the-papers-figures) (`make figures`). Numbers to hold against are those of an independent program of the same model, by ranges over its seeds.",
        rows(),
    )
