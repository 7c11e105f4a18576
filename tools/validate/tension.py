"""The open tension: the paper has W at 1.7 m/s with 3 mm and at 2.4 m/s with 10 mm both as measured, so the second the faster one; here
it is the first. What each reading of the paper changes."""

from report import table
from rows import Found, Row, Section
from scenes import front, of_plug, plug

BOTH = ("plug_u17_d3", "plug_u24")
WIDER = (("pipe", "diameter", "0.052"),)
SMOOTH = (("material", "friction", "0.05"),)
READINGS = {  # label: (what it reads differently, keys of the plug, keys of its fill)
    "": ("as it is", (), ()),
    "mass": ("damping with the particle's mass, as eq. (26) is printed", (("contact", "damping_mass", '"particle"'),), (("contact", "damping_mass", '"particle"'),)),
    "bore52": ("a bore of 52 mm, that of the experiment", WIDER, WIDER),
    "dense": ("a denser pile at the start, filled with friction 0.05", (), SMOOTH),
    "hard": ('a slice is full at once: bed_height = "hard"', (("gas", "bed_height", '"hard"'),), ()),
    "strict": ('a slice is full only when it is: bed_height = "strict"', (("gas", "bed_height", '"strict"'),), ()),
    "gap3": ("a slice is full below a gap of 3 mm", (("gas", "full_gap", "0.003"),), ()),
    "wall01": ("walls with friction 0.1", (("material", "wall_friction", "0.1"),), (("material", "wall_friction", "0.1"),)),
    "wall02": ("walls with friction 0.2", (("material", "wall_friction", "0.2"),), (("material", "wall_friction", "0.2"),)),
    "wall05": ("walls with friction 0.5", (("material", "wall_friction", "0.5"),), (("material", "wall_friction", "0.5"),)),
    "walle": ("walls with restitution 0.5", (("material", "wall_restitution", "0.5"),), (("material", "wall_restitution", "0.5"),)),
    "slider": ('eqs. (10) to (12) to the letter: slider = "paper"', (("contact", "slider", '"paper"'),), (("contact", "slider", '"paper"'),)),
    "rescale": ('a tangential spring that makes no energy: tangential = "rescale"', (("contact", "tangential", '"rescale"'),), (("contact", "tangential", '"rescale"'),)),
    "slices20": ("slices of two diameters", (("gas", "slice_length", "0.02"),), ()),
    "elastic": ("friction limited by the elastic force", (("contact", "friction_limit", '"elastic"'),), (("contact", "friction_limit", '"elastic"'),)),
}


def pair(label):
    _, keys, fill_keys = READINGS[label]
    return [plug(base, 1, label, keys, fill_keys) for base in BOTH]


def order(figures):
    slow, fast = map(front, figures)
    if slow is None or fast is None or min(slow, fast) < 0.5:
        return Found(" and ".join("none" if v is None else f"{v:.2f}" for v in (slow, fast)), "a plug is lost", False)
    return Found(f"{slow:.2f} and {fast:.2f}", f"{slow - fast:+.2f}", slow < fast)


def shown(figures):
    """Without a verdict: what would remove the tension is looked for, not promised."""
    found = order(figures)
    return Found(found.text, found.difference + (", removed" if found.agrees else ""))


def rows():
    return [Row(label or "as-it-is", words, "the second larger, both moving", pair(label), shown) for label, (words, _, _) in READINGS.items()]


def quantities(results):
    keys = ("front_velocity", "particle_velocity", "length", "layer_area_ratio")
    lines = []
    for label, (words, _, _) in READINGS.items():
        cells = []
        for run in pair(label):
            figures = results.of(run)
            cells += ["-" if figures is None or of_plug(key)(figures) is None else f"{of_plug(key)(figures):.2f}" for key in keys]
        lines.append([words, *cells])
    names = ("W", "V_p", "length", "layer")
    return table(["reading", *(f"1.7 m/s: {name}" for name in names), *(f"2.4 m/s: {name}" for name in names)], lines)


def verdict(results):
    """In words, from what was found."""
    found = {words: order([results.of(run) for run in pair(label)]) for label, (words, _, _) in READINGS.items() if all(map(results.of, pair(label)))}
    if len(found) < len(READINGS):
        return "Not all readings have been run yet."
    as_it_is, mended = found.pop("as it is"), [words for words, one in found.items() if one.agrees]
    lost = [words for words, one in found.items() if one.difference == "a plug is lost"]
    least = min((float(one.difference), words) for words, one in found.items() if words not in lost)
    said = f"removed by {'; '.join(f'{words} ({found[words].text} m/s)' for words in mended)}" if mended else f"removed by none of {len(found)} readings"
    return (
        f"**Verdict**: the tension, {as_it_is.difference} m/s as it is, is {said}. "
        + ("" if mended else f"The least difference is {least[0]:+.2f} m/s, with {least[1]}. ")
        + (f"A plug is lost with: {'; '.join(lost)}. " if lost else "")
        + f"All other readings leave {min(rest(found, mended, lost)):+.2f} to {max(rest(found, mended, lost)):+.2f} m/s."
    )


def rest(found, mended, lost):
    return [float(one.difference) for words, one in found.items() if words not in mended and words not in lost]


def section():
    return Section(
        "tension",
        "The open tension, and what each reading of the paper changes",
        "W at 1.7 m/s with 3 mm in eq. (33), and at 2.4 m/s with 10 mm; m/s, one seed each. Seeds change W by 0.07 m/s at most (`paper/plug_u24-W`).",
        rows(),
        lambda results: quantities(results) + "\n\n" + verdict(results),
    )
