"""The open line of the paper's Fig. 9 with its own particles, beside laws and beside plugs that were set up by hand."""

import tomllib

from figure_lines import line as draw_line
from rows import Found, Row, Section, said
from scenes import LINES_10MM, LINES_3MM, front, plugs

FROUDE = (9.81 * 0.052) ** 0.5
WHICH = {"u17": (LINES_3MM[0], "1.7"), "u24": (LINES_3MM[1], "2.4")}
QUANTITIES = {
    "W": ("plug velocity, m/s", "plug_velocity", 1, 2),
    "V_p": ("particles in plugs, m/s", "plug_particle_velocity", 1, 2),
    "length": ("plug length, m", "plug_length", 1, 2),
    "layer": ("layer ratio", "layer_ratio", 1, 2),
    "frequency": ("plugs per second at the middle", "plug_frequency", 1, 2),
    "pressure": ("pressure at the inlet, kPa", "inlet_pressure", 1e-3, 2),
    "rate": ("accepted of 0.2 kg/s, kg/s", "accepted_rate", 1, 3),
    "holdup": ("holdup, kg", "holdup", 1, 2),
}


def of_line(key, scale, digits):
    def find(figures):
        values = [one["line"].get(key) for one in figures]
        if any(value is None for value in values):
            return Found("none")
        scatter = figures[0]["line_scatter"].get(key) if len(figures) == 1 else None
        return Found(" ".join(f"{scale * value:.{digits}f}" for value in values) + ("" if scatter is None else f" ± {scale * scatter:.{digits}f}"))

    return find


def froude_part(figures):
    """W - 0.967 V_p over sqrt(g D), which the laws say is 0.5."""
    line = figures[0]["line"]
    if line["plug_velocity"] is None:
        return Found("no plug")
    value = (line["plug_velocity"] - 0.967 * line["plug_particle_velocity"]) / FROUDE
    return Found(f"{value:.2f}", f"{value - 0.5:+.2f}", abs(value - 0.5) <= 0.07).of_plugs(line["plugs"])


def eq41(figures):
    line = figures[0]["line"]
    if line["layer_ratio"] is None or line["layer_ratio_eq41"] is None:
        return Found("no plug")
    off = line["layer_ratio"] - line["layer_ratio_eq41"]
    return Found(f"{line['layer_ratio']:.2f} beside {line['layer_ratio_eq41']:.2f}", f"{off:+.2f}", abs(off) <= 0.05).of_plugs(line["plugs"])


def beside_periodic(figures):
    line, others = figures[0]["line"], [front(one) for one in figures[1:]]
    if not line or line["plug_velocity"] is None or not others or any(value is None for value in others):
        return Found("no plug in one of them")
    return Found(f"{line['plug_velocity']:.2f} beside {sum(others) / len(others):.2f}", f"{line['plug_velocity'] - sum(others) / len(others):+.2f}")


def rows():
    found = [said("u24-word", "3 mm at 2.4 m/s: what the line does", "flows in plugs", [WHICH["u24"][0]], lambda f: f["line_verdict"], " (paper)"),
             reported_word("u17-word", "3 mm at 1.7 m/s: what the line does", [WHICH["u17"][0]])]  # fmt: skip
    for name, (run, gas) in WHICH.items():
        found += [Row(f"{name}-{key}", f"3 mm at {gas} m/s: {words}", "-", [run], of_line(of, scale, digits)) for key, (words, of, scale, digits) in QUANTITIES.items()]
        found.append(Row(f"{name}-froude", f"3 mm at {gas} m/s: (W - 0.967 V_p) over sqrt(g D)", "0.5 within 0.07 (Lavrinec; the band of 10 mm lines)", [run], froude_part))
        found.append(Row(f"{name}-eq41", f"3 mm at {gas} m/s: layer ratio beside eq. (41)", "within 0.05 (the band of 10 mm lines)", [run], eq41))
        found.append(Row(f"{name}-periodic", f"3 mm at {gas} m/s: W beside the plug set up by hand, m/s", "-", [run, *plugs(f"plug_d3_{name}")], beside_periodic, True))
    found.append(Row("10mm-pressure", "10 mm at 2.4 m/s, three seeds: pressure at the inlet, kPa", "1.7 to 2.5 (another program)", LINES_10MM, band("inlet_pressure", 1e-3, 1.7, 2.5)))
    found.append(Row("10mm-W", "10 mm at 2.4 m/s, three seeds: W, m/s", "0.75 to 0.95 (another program)", LINES_10MM, band("plug_velocity", 1, 0.75, 0.95)))
    found.append(Row("10mm-layer", "10 mm at 2.4 m/s, three seeds: layer ratio", "0.37 to 0.46 (another program)", LINES_10MM, band("layer_ratio", 1, 0.37, 0.46)))
    return found


def reported_word(name, what, runs):
    return Row(name, what, "-", runs, lambda figures: Found(figures[0]["line_verdict"]))


def band(key, scale, low, high):
    def find(figures):
        values = [scale * one["line"][key] for one in figures]
        outside = [v - high if v > high else v - low for v in values if not low <= v <= high]
        return Found(" ".join(f"{v:.3f}" for v in values), f"{max(outside, key=abs):+.3f}" if outside else "inside", not outside)

    return find


def pictures(results, folder, draws):
    """Of runs whose files are here; the picture of one made elsewhere stays."""
    found = []
    for run in LINES_3MM:
        here = results.places.folder(run)
        if draws and (here / "slices.bin").exists() and (here / "summary.json").exists() and results.of(run):
            draw_line(here, tomllib.loads(results.places.text(run)), folder / run.base)
        if (folder / f"{run.base}.svg").exists():
            found.append((run.base, f"`{run.base}`: solids along the line against time, with the fronts of plugs; below, what the line does"))
    return found


def section():
    return Section(
        "lines",
        "The open line with particles of 3 mm",
        "The line of the paper's Fig. 9: 52 mm, 5 m, 3 mm polystyrene fed with 0.2 kg/s behind a layer at random, outlet open to the air. No plug is set up. The paper measured plug velocities in such a line and gives no numbers in words.",
        rows(),
        None,
        pictures,
    )
