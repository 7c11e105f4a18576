"""What a softer material changes: time steps of the long scenes come from it."""

from rows import Found, Row, Section
from scenes import of_plug, plug

# label: Young's modulus, time step of plug and of line; the integrator is `impulse` from 3e8 Pa on, as in the scenes of 3 mm.
MODULI = {"e3e8": ("3.0e8", "5.0e-6"), "e3e7": ("3.0e7", "2.0e-5"), "e1e7": ("1.0e7", "3.0e-5")}
KEYS = {"W": ("front_velocity", 0.07), "layer": ("layer_area_ratio", 0.05)}  # and the scatter of seeds


def softer(modulus, step):
    return (("material", "youngs_modulus", modulus), ("run", "time_step", step), ("run", "integrator", '"impulse"'), ("gas", "update_interval", f"{max(1, round(1e-5 / float(step)))}"))


def runs_of(label):
    return [plug(case, 1, label, softer(*MODULI[label])) for case in ("plug_u24", "plug_u17_d3", "plug_u24_d3")]


STIFF = [plug(case) for case in ("plug_u24", "plug_u17_d3", "plug_u24_d3")]


def unchanged(key, allowed):
    def find(figures):
        off = [of_plug(key)(soft) - of_plug(key)(stiff) if of_plug(key)(soft) is not None else None for soft, stiff in zip(figures[:3], figures[3:])]
        if any(value is None for value in off):
            return Found("a plug is lost", "-", False)
        return Found(", ".join(f"{value:+.3f}" for value in off), f"{max(off, key=abs):+.3f}", all(abs(value) <= allowed for value in off))

    return find


def rows():
    found = []
    for label, (modulus, step) in MODULI.items():
        for name, (key, allowed) in KEYS.items():
            found.append(Row(f"{label}-{name}", f"E = {float(modulus):g} Pa at {float(step):g} s: {'W, m/s' if name == 'W' else 'layer ratio'}, less that of 3e9 Pa at 2e-6 s", f"0 within {allowed:g} (scatter of seeds)", [*runs_of(label), *STIFF], unchanged(key, allowed)))
    return found


def section():
    return Section(
        "softer",
        "Softer particles",
        "The scenes of 3 mm and of 5 mm are of soft particles, because the time step follows from the contact time. Here the paper's three moving plugs, from the same stiff pile: `plug_u24`, `plug_u17_d3`, `plug_u24_d3`, softer by up to 300 times. "
        "The integrator is `impulse`, as in those scenes. A difference counts when it is beyond the scatter of seeds of the stiff plug (`paper/plug_u24-W`, `paper/plug_u24-layer`).",
        rows(),
    )
