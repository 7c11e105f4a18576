"""Pressure drop along a plug beside Ergun's equation, and stresses beside a balance after Janssen and Konrad. From the slices of open lines."""

from rows import Found, Row, Section
from scenes import LINES_10MM, LINES_3MM

RUNS = {"10mm": ("10 mm, U = 2.4 m/s", LINES_10MM[0]), "3mm": ("3 mm, U = 2.4 m/s", LINES_3MM[1])}


def of(key, digits, expected=None, allowed=None):
    def find(figures):
        found = figures[0].get("stresses")
        if not found:
            return Found("no plug")
        value = found[key]
        return Found(f"{value:.{digits}f}", "-" if expected is None else f"{value - expected:+.{digits}f}", None if allowed is None else abs(value - expected) <= allowed)

    return find


def janssen(figures):
    """A line through the origin with a slope of 0.2 to 1, if the ratio of stresses is a property of the material."""
    found = figures[0].get("stresses")
    if not found:
        return Found("no plug")
    return Found(f"{found['ratio']:.2f}, correlation {found['correlation']:.2f}", "-", 0.2 <= found["ratio"] <= 1 and found["correlation"] > 0.7)


def rows():
    found = []
    for name, (words, run) in RUNS.items():
        found.append(Row(f"ergun-{name}", f"{words}: pressure drop along plugs over that by Ergun's equation", "1 within 0.05", [run], of("drop_over_ergun", 3, 1, 0.05)))
        found.append(Row(f"mobilised-{name}", f"{words}: shear on the wall over friction times normal force", "1, if the plug slides all round", [run], of("mobilised", 2, 1)))
        found.append(Row(f"axial-{name}", f"{words}: mean axial stress in plugs, Pa", "-", [run], of("axial_stress", 0)))
        found.append(Row(f"wall-{name}", f"{words}: mean normal stress on the wall beyond weight, Pa", "-", [run], of("wall_stress", 0)))
        found.append(Row(f"janssen-{name}", f"{words}: slope of wall stress against axial stress", "0.2 to 1, correlation above 0.7 (Janssen: one ratio)", [run], janssen))
    return found


def section():
    return Section(
        "balance",
        "Pressure drop and stresses along plugs",
        "Sums over the packed slices of all plugs in the followed part of a line. Ergun's equation is what the model puts in where a slice is full; the row shows how much of a plug is. "
        "Axial stress: from the balance of forces of slices that move steadily, from the free rear on. Wall stress: normal forces over the wall's area, less what weight alone makes. "
        "Janssen's and Konrad's balances take the ratio of the two as a constant of the material.",
        rows(),
    )
