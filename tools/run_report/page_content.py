"""What the page of a run says: verdicts with their rules, charts, energy ledger, speed, capacities; out of summary and log."""

import re
from html import escape

from page_parts import number, table
from plug_verdict import RULE, verdict


def entry(what, found, word, why, tone=""):
    return {"what": what, "found": found, "word": word, "why": why, "tone": tone}


def time_step_verdicts(stability):
    """Of the bound on the step, and of the steps that a contact has: a step that is too long for contacts is not called stable."""
    rows = []
    ratio, found, needed = (stability.get(key) for key in ("maximum_step_ratio", "steps_per_contact", "steps_per_contact_needed"))
    is_coarse = found is not None and found < needed
    if ratio is not None:
        word, tone = ("beyond the bound", "bad") if ratio > 1 else ("too long for its contacts", "bad") if is_coarse else ("stable", "good")
        rows.append(entry("time step", f"{ratio:.3g} of the stable one at most", word,
                          "stable up to 1, looked at with every row of the log, where contacts have steps enough", tone))  # fmt: skip
    if found is not None:
        word, tone = (f"fewer than {needed:g}: results may be wrong", "bad") if is_coarse else ("enough", "good")
        rows.append(entry("steps per contact", f"{found:.3g} at the deepest overlap", word, f"{needed:g} are needed for a true rebound", tone))
    return rows


def particle_count(case):
    """Of all species, where the case has some."""
    particles = case["particles"]
    return sum(kind["count"] for kind in particles["species"]) if "species" in particles else particles.get("count", 0)


def verdicts(summary, log, case):
    """A list of what was measured, a word for it, and the rule that the word follows from."""
    rows = []
    done = summary["status"] == "done"
    rows.append(
        entry("the run", f"{number(summary['steps'])} steps, {summary['final']['time']:.6g} s", summary["status"],
              "status of summary.json; done: to its end, without a fault", "good" if done else "bad")
    )  # fmt: skip
    rows += time_step_verdicts(summary.get("stability") or {})
    overlap = max((v for v in log["max overlap / radius"] if v is not None), default=None)
    if overlap is not None:
        limit = case.get("run", {}).get("overlap_warning", 0.1)
        word, tone = ("small", "good") if overlap <= limit else ("large", "bad")
        rows.append(entry("maximum overlap", f"{overlap:.2g} radii", word, f"small up to {limit:g}: Hertz' law holds for small ones", tone))
    error = summary["energy"]["balance_error"]
    if error is not None:
        rows.append(entry("energy balance", f"{100 * abs(error):.2g} % unaccounted", "for you to judge",
                          "of the largest term of the ledger below; falls with the time step"))  # fmt: skip
    fullest = max(summary["capacity"].items(), key=lambda item: item[1]["high_water"] / item[1]["limit"] if item[1]["limit"] and item[0] != "memory" else 0)
    use = fullest[1]
    rows.append(entry("fixed arrays", f"{fullest[0]}: {number(use['high_water'])} of {number(use['limit'])}", "room enough" if use["high_water"] <= use["limit"] else "too small",
                      "the fullest one; a run that needs more stops", "good"))  # fmt: skip
    plug = summary["plug"]
    if plug and "line" not in summary and particle_count(case) > 1:
        found = "no plug" if plug["front_velocity"] is None else (
            f"front {plug['front_velocity']:.2f} m/s, particles in it {plug['particle_velocity']:.2f} m/s, {plug['length']:.2f} m long, "
            f"layer area ratio {number(plug['layer_area_ratio'], 2)} (eq. 41: {number(plug['layer_area_ratio_eq41'], 2)})"
        )  # fmt: skip
        rows.append(entry("plug", found, verdict(plug), RULE.replace("*", "")))
    collision = summary["collision"]
    if collision and collision["restitution"] is not None:
        asked = case["material"]["restitution"]
        if particle_count(case) == 1:  # only a wall can have been hit
            asked = case["material"].get("wall_restitution", asked)
        off = collision["restitution"] - asked
        rows.append(entry("restitution of the first collision", f"{collision['restitution']:.5f}", f"{off:+.1e} from the case's", f"the case asks for {asked:g} along the normal"))
    return rows


def charts(log):
    """Those charts whose columns the log has; a column's name in the log is its key on the page, too."""
    is_line = "holdup [kg]" in log
    species = {name: name.removesuffix(" [m/s]") for name in log if name.startswith("mean axial velocity of ")}
    every = [
        ("Mass in, out and in the pipe", "kg", "", {"mass fed [kg]": "fed", "mass that has left [kg]": "has left", "holdup [kg]": "in the pipe", "backlog [kg]": "waits to be fed"}, ""),
        ("Mass flow", "kg/s", "", {"asked rate [kg/s]": "asked for", "accepted rate [kg/s]": "fed", "leaving rate [kg/s]": "leaves"}, "Since the row of the log before."),
        ("Particles in the pipe", "", "", {"present": "present"}, ""),
        ("Kinetic energy", "J", "log", {"kinetic energy translation [J]": "translation", "kinetic energy rotation [J]": "rotation"}, ""),
        ("Coordination number", "", "", {"coordination number": "contacts of a particle"}, "Two for a pair, one for a wall, over the particles."),
        ("Pressure drop over the pipe", "Pa", "", {"pressure drop [Pa]": "pressure drop"}, ""),
        ("The longest plug" if is_line else "Where the plug is", "m", "points", {"plug front [m]": "front", "plug length [m]": "length"},
         "Of each moment; the table below follows one after another." if is_line else "Leaving at one end, the front enters at the other."),
        ("Velocities", "m/s", "", {"max speed [m/s]": "maximum speed", "plug particle velocity [m/s]": "particles in the plug",
                                    "mean axial velocity [m/s]": "mean axial", **species}, ""),
        ("Stationary layer", "", "", {"layer area ratio": "layer area ratio"}, "Solids fraction outside the plug over that inside."),
        ("Maximum overlap and time step", "", "log", {"max overlap / radius": "overlap over radius", "time step / stable step": "time step over the stable one"}, ""),
        ("Energy ledger", "J", "", {"gas work [J]": "work of the gas", "gravity work [J]": "work of gravity", "dissipated by damping [J]": "lost by damping",
                                    "dissipated by sliding [J]": "lost by sliding", "dissipated by rolling [J]": "lost by rolling", "made by the tangential law [J]": "made by the tangential law", "kinetic": "kinetic", "elastic energy [J]": "elastic"}, ""),
        ("Energy of particles fed and gone", "J", "", {"energy fed [J]": "fed", "energy that has left [J]": "has left"}, "Kinetic and elastic; entries of the ledger."),
    ]  # fmt: skip
    found = []
    for title, unit, form, lines, note in every:
        shown = {name: any(v is not None and (v > 0 or form != "log") for v in log.get(name, [])) for name in lines}
        present = [{"column": name, "label": label} for name, label in lines.items() if shown[name]]
        if present:
            found.append({"id": "chart-" + re.sub(r"\W+", "-", title.lower()), "title": title, "unit": unit, "log": form == "log",
                          "points": form == "points", "lines": present, "note": note})  # fmt: skip
    return found


def ledger(summary, log):
    """Where the energy came from and where it went, with what is missing in the end."""
    energy = summary["energy"]
    if energy["balance_error"] is None:
        return "<p>The case keeps no energy ledger.</p>"
    start = log["kinetic"][0] + log["elastic energy [J]"][0]
    came = [("kinetic and elastic at the start", start), ("work of gravity", energy["gravity_work"]), ("work of the gas", energy["gas_work"]),
            ("made by the tangential law (below zero: lost)", energy["made_by_law"])]  # fmt: skip
    went = [("kinetic", energy["kinetic"]), ("elastic", energy["elastic"]), ("lost by damping", energy["dissipated_damping"]),
            ("lost by sliding", energy["dissipated_sliding"])]
    if "rolling" in energy:
        went.append(("lost by rolling", energy["rolling"]))
    if "entered" in energy:
        came.append(("with particles that were fed", energy["entered"]))
        went.append(("with particles that have left", energy["left_with"]))
    missing = sum(v or 0 for _, v in went) - sum(v or 0 for _, v in came)
    rows = [(name, "came in", number(value, 4)) for name, value in came if value is not None]
    rows += [(name, "went out or is there", number(value, 4)) for name, value in went]
    rows.append(("more than came in" if missing > 0 else "less than came in", "not accounted for", f"{missing:.3g}"))
    return table("energy ledger", ("over the whole run", "which", "J"), rows)


def performance(summary, version):
    p = summary["performance"]
    rows = [
        ("kernel", f"{p['particle_steps_per_second'] / 1e6:.1f} million particle-steps per second"),
        ("time in the kernel", f"{p['kernel_time']:.2f} s"),
        ("time with all outputs", f"{p['wall_time']:.2f} s"),
        ("simulated", f"{summary['final']['time']:.6g} s, {summary['final']['time'] / p['wall_time']:.3g} times as fast as nature" if p["wall_time"] else "-"),
    ] + [(name, version[name]) for name in ("instruction set", "compiler") if name in version]  # fmt: skip
    return table("speed", ("speed", "measured"), rows)


def capacity(summary):
    rows = [(name.replace("_", " "), number(use["high_water"]), number(use["limit"])) for name, use in summary["capacity"].items()]
    return table("fixed arrays", ("array", "maximum use", "room"), rows)


def facts(summary, case):
    """The case as it was written, table by table, and what was compiled in."""
    rows = []

    def add(name, values):
        plain = {key: value for key, value in values.items() if key != "particle" and not isinstance(value, dict) and key != "species"}
        words = [f"{key} = {value:g}" if isinstance(value, float) else f"{key} = {value}" for key, value in plain.items()]
        if words or name == "[start]":
            rows.append((name, escape(", ".join(words) or "particles placed one by one")))

    for name, values in case.items():
        if isinstance(values, dict):
            add(f"[{name}]", values)
            for kind in values.get("species", []):
                add(f"[[{name}.species]]", kind)
            if "sizes" in values:
                add(f"[{name}.sizes]", values["sizes"])
        elif isinstance(values, list):
            for part in values:
                add(f"[[{name}]]", part)
    rows.append(("compiled in", " ".join(summary["features"]).replace("_", " ") + f", {summary['precision']} precision"))
    rows.append(("final state", f"hash {summary['final']['state_hash']}"))
    return table("the case", ("part", "values, SI units"), rows)
