"""Pressure drop along a plug beside Ergun's equation, and stresses beside a balance after Janssen and Konrad. From the slices of open lines."""

from drawing import Data, gnuplot
from rows import Found, Row, Section, spread
from scenes import LINES_10MM, LINES_3MM

RUNS = {"10mm": ("10 mm, U = 2.4 m/s", LINES_10MM), "3mm": ("3 mm, U = 2.4 m/s", LINES_3MM[1:])}


def stresses(figures):
    """Of the runs that had plugs."""
    return [one["stresses"] for one in figures if one.get("stresses")]


def of(key, digits, expected=None, allowed=None):
    def find(figures):
        values = [found[key] for found in stresses(figures)]
        if not values:
            return Found("no plug")
        off = max((value - (expected or 0) for value in values), key=abs)
        return Found(spread(values, digits), "-" if expected is None else f"{off:+.{digits}f}", None if allowed is None else abs(off) <= allowed)

    return find


def janssen(figures):
    """A straight line, if the ratio of stresses is a property of the material."""
    found = stresses(figures)
    if not found:
        return Found("no plug")
    ratios, correlations = ([one[key] for one in found] for key in ("ratio", "correlation"))
    return Found(f"{spread(ratios, 2)}, correlation {min(correlations):.2f}", "-", min(ratios) >= 0.2 and max(ratios) <= 1 and min(correlations) > 0.7)


def rows():
    found = []
    for name, (words, runs) in RUNS.items():
        found.append(Row(f"ergun-{name}", f"{words}: pressure drop along plugs over that by Ergun's equation", "1 within 0.05", runs, of("drop_over_ergun", 3, 1, 0.05)))
        found.append(Row(f"mobilised-{name}", f"{words}: shear on the wall over friction times normal force", "1, if the plug slides all round", runs, of("mobilised", 2, 1)))
        found.append(Row(f"axial-{name}", f"{words}: mean axial stress in plugs, Pa", "-", runs, of("axial_stress", 0)))
        found.append(Row(f"wall-{name}", f"{words}: mean normal stress on the wall beyond weight, Pa", "-", runs, of("wall_stress", 0)))
        found.append(Row(f"janssen-{name}", f"{words}: slope of wall stress against axial stress", "0.2 to 1, correlation above 0.7 (Janssen: one ratio)", runs, janssen))
    return found


def pictures(results, folder, draws):
    profiles = {name: stresses([one for one in map(results.of, runs) if one]) for name, (_, runs) in RUNS.items()}
    profiles = {name: found for name, found in profiles.items() if found}
    if not profiles:
        return []
    if draws:
        with Data() as data:
            curves = []
            for name, found in profiles.items():
                title = name.replace("mm", " mm")
                for which, words in enumerate(("axial", "on the wall")):
                    rows_of = [(k + 0.5, sum(one["profile"][k][which] for one in found) / len(found)) for k in range(10)]
                    curves.append(f"'{data.file(rows_of)}' with linespoints linewidth 1.5 pointtype {4 + len(curves)} linecolor {len(curves) + 1} title '{title}, {words}'")
            gnuplot(f"set xlabel 'tenths of the plug, from rear to front'\nset ylabel 'stress, Pa'\nset xrange [0:10]\nset yrange [0:*]\nset key outside top center horizontal\nplot {', '.join(curves)}", folder / "stresses")
    return [("stresses", "Stress along plugs, mean over all plugs of a line: axial, and on the wall beyond what weight makes")]


def section():
    return Section(
        "balance",
        "Pressure drop and stresses along plugs",
        "Sums over the packed slices of all plugs in the followed part of a line. Ergun's equation is what the model puts in where a slice is full; the row shows how much of a plug is. "
        "Axial stress: from the balance of forces of slices that move steadily, from the free rear on. Wall stress: normal forces over the wall's area, less what weight alone makes; both are means over tenths of the plugs. "
        "Janssen's and Konrad's balances take the ratio of the two as a constant of the material.",
        rows(),
        None,
        pictures,
    )
