"""The published single contacts of cases/VALIDATION.md: tables and a picture of what the tests have recorded (tests/recorded.hpp).

`tables` reads the record, which has one figure a line, and returns for each published case its title, the text of its part of the
page, and its figures one by one; `picture` draws the rebounds of Chung & Ooi's test 4. A record that is damaged, or that lacks one
of the cases, is refused with its name and line. Verdicts: agrees, **differs**, and report only where nothing is promised.
"""

import csv
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "report"))
from report import table

HEAD = ["table", "row", "quantity", "unit", "expected", "found", "allowed", "source"]

# Name in the record -> title, and what is done. The order is that of the page.
CASES = {
    "chung-ooi-1": (
        "Chung & Ooi 1: two equal spheres, elastic",
        "R = 10 mm, head on at 10 m/s each, e = 1; `euler` at 1/1000 of the contact time.",
    ),
    "chung-ooi-2": (
        "Chung & Ooi 2: a sphere on a rigid wall, elastic",
        "R = 0.1 m, 0.2 m/s, e = 1; `euler` at 1/1000 of the contact time.",
    ),
    "chung-ooi-3": (
        "Chung & Ooi 3: the restitution that is asked",
        "Walls and pairs at 0.01, 0.1, 1 and 10 m/s, material of the shipped cases, on which it does not depend; `euler` at 1/1000 of the "
        "contact time of the fastest.",
    ),
    "chung-ooi-4": (
        "Chung & Ooi 4: oblique impact on a rigid wall",
        "Aluminium oxide, R = 2.5 mm, 3.9 m/s, mu = 0.092, e = 1; angles from the normal. e_t: rebound over impact tangential velocity of "
        "the centre. `displacement` form, `euler` at 1/1000 of the contact time. At grazing angles this form creates energy when k_t/k_n "
        "is as high as here (0.87): e_t above 1 at 2 degrees is the law's, not an error of the integration.",
    ),
    "chung-ooi-4-experiment": (
        "Chung & Ooi 4 and MFIX DEM05: the same beside an experiment",
        "The experiment is kept with MFIX DEM05. Its angles; real spheres are no part of the model, so nothing is promised.",
    ),
    "chung-ooi-5": (
        "Chung & Ooi 5: oblique impact, one normal and several tangential velocities",
        "mu = 0.4, e = 0.5, one sphere (aluminium alloy, R = 0.1 m, 0.2 m/s) for the paper's materials: as ratios to mu v_n the figures "
        "of sliding hold for any. v_t: tangential velocity before. From 5.25 on it slides throughout. `impulse`, elastic limit of "
        "friction.",
    ),
    "chung-ooi-6": (
        "Chung & Ooi 6: normal impact, several angular velocities",
        "The sphere of test 5, turning; v_t: velocity of its surface before. v_x is counted along the surface velocity.",
    ),
    "chung-ooi-7": (
        "Chung & Ooi 7: equal spheres that turn like gears",
        "The sphere of test 5; their surfaces do not slip, so nothing but the normal velocity changes.",
    ),
    "chung-ooi-8": (
        "Chung & Ooi 8: a turning sphere on a large one",
        "R = 0.1 m at 0.2 m/s on R = 0.5 m of 1000 times the density, aluminium alloy, mu = 0.4, e = 0.5; `impulse`, elastic limit of "
        "friction.",
    ),
    "mfix-dem01": (
        "MFIX DEM01: a ball dropped on a linear spring",
        "From 0.4 m above the wall, k_n = 10 kN/m, the mass of a ball of 0.2 m and 2600 kg/m3; `euler`, 1/5000 of the contact time.",
    ),
    "mfix-dem02": (
        "MFIX DEM02: a bouncing ball",
        "The ball of DEM01, k_n = 10 MN/m, e = 0.9; `impulse`. The published heights, e^(2k) h, are those of contacts without duration; "
        "what is promised are those of the spring, whose contact lasts 3 ms under the weight.",
    ),
    "mfix-dem03": (
        "MFIX DEM03: two balls pressed between walls",
        "1 mm, the lower one of twice the density, walls 1.8 mm apart, linear springs; `impulse`.",
    ),
    "mfix-dem04": (
        "MFIX DEM04: a ball that slides until it rolls",
        "v_0 = 0.1 m/s on a plane, 10 mm, no rolling resistance; `impulse` at 5 us. The time may differ by one step.",
    ),
    "mfix-dem06": (
        "MFIX DEM06: a grain in rising gas",
        "0.1 mm, 2000 kg/m3, gas at 0.4 m/s; its buoyancy, which the model leaves out, is given through the gravity.",
    ),
    "gross-sliding": (
        "Gross sliding: what friction takes",
        "10 mm, 1 m/s, 45 degrees, mu = 0.01. Limited by the total normal force, friction takes more than mu (1 + e) m v_n, because the "
        "force attracts at the end of a damped contact; limited by its elastic part it takes just that.",
    ),
    "own-walls": (
        "A wall with friction and restitution of its own",
        "10 mm, 1 m/s, 5 to 75 degrees, between particles mu = 0.3 and e = 0.9; `impulse` at 0.1 us, elastic limit of friction.",
    ),
    "unequal-spheres": (
        "Unequal spheres",
        "i at 1 m/s on j at rest; oblique ones turn, 20, 45 and 70 degrees, mu = 0.3; `impulse` at 20 ns, elastic limit of friction.",
    ),
    "rolling-plane": (
        "Rolling resistance: a sphere on a plane",
        "10 mm, e = 0.9; on the level mu = 0.3, mu_r = 0.05, v_0 = 0.1 m/s; on slopes mu = 0.5; `impulse`. The sphere stays where the "
        "tangent of the slope is below mu_r.",
    ),
    "rolling-impacts": (
        "Rolling resistance: impacts of turning spheres",
        "1 m/s straight on, mu = 0.3, mu_r = 0.1, four spins each; `impulse` at 20 ns.",
    ),
}


def damaged(path, number, what):
    raise SystemExit(f"fixdem: {path}:{number}: {what}: damaged; remove it and make it again")


def read(path):
    """The figures of a record, in its order: dicts of the columns, with numbers where there are numbers; allowed is None where it is empty."""
    path = Path(path)
    if not path.exists():
        raise SystemExit(f"fixdem: {path} is missing: make {path}")
    with path.open(newline="", errors="replace") as file:
        lines = csv.reader(line.replace("\0", "\ufffd") for line in file)
        if next(lines, None) != HEAD:
            damaged(path, 1, f"the columns are not {','.join(HEAD)}")
        figures = []
        for cells in lines:
            if len(cells) != len(HEAD):
                damaged(path, lines.line_num, f"{len(cells)} values in {len(HEAD)} columns")
            figure = dict(zip(HEAD, cells))
            try:
                for name in ("expected", "found", "allowed"):
                    figure[name] = float(figure[name]) if figure[name] or name != "allowed" else None
            except ValueError:
                damaged(path, lines.line_num, f"{name} is no number, '{figure[name]}'")
            if not math.isfinite(figure["expected"]) or not (figure["allowed"] is None or 0 <= figure["allowed"] < math.inf):
                damaged(path, lines.line_num, "what is expected or allowed cannot be")
            if figure["table"] not in CASES:
                damaged(path, lines.line_num, f"no case is called '{figure['table']}'")
            figures.append(figure)
    return figures


def verdict(figure):
    if figure["allowed"] is None:
        return "report only"
    return "agrees" if abs(figure["found"] - figure["expected"]) <= figure["allowed"] else "**differs**"


def result(figure):
    """A figure as the page counts it."""
    name = "/".join(figure[key] for key in ("table", "row", "quantity"))
    return {
        "id": name,
        "expected": figure["expected"],
        "found": figure["found"],
        "difference": figure["found"] - figure["expected"],
        "allowed": figure["allowed"],
        "verdict": verdict(figure),
    }


def shown(value, digits):
    return f"{value + 0.0:.{digits}g}".replace("e-0", "e-").replace("e+0", "e")


def text_of(words, figures):
    """What is done and from where the expected figures come, then the table; the source has a column where there are several."""
    sources = list(dict.fromkeys(figure["source"] for figure in figures))
    head = ["impact", "quantity", "expected", "found", "difference", "allowed", ""] + (["expected from"] if len(sources) > 1 else [])
    rows = []
    for figure in figures:
        quantity = figure["quantity"] + (f", {figure['unit']}" if figure["unit"] else "")
        numbers = [shown(figure["expected"], 8), shown(figure["found"], 8), shown(figure["found"] - figure["expected"], 2)]
        allowed = "" if figure["allowed"] is None else shown(figure["allowed"], 2)
        rows.append([figure["row"], quantity, *numbers, allowed, verdict(figure)] + ([figure["source"]] if len(sources) > 1 else []))
    origin = f" Expected: {sources[0]}." if len(sources) == 1 else ""
    return f"{words}{origin}\n\n{table(head, rows)}"


def tables(csv_path, cases=tuple(CASES)):
    """[(title, Markdown text, [{id, expected, found, difference, allowed, verdict}])] of the cases asked for, all by default."""
    figures = read(csv_path)
    missing = [name for name in cases if not any(figure["table"] == name for figure in figures)]
    if missing:
        raise SystemExit(f"fixdem: {csv_path}: nothing is recorded of {', '.join(missing)}: a test has not run, or was renamed")
    parts = []
    for name in cases:
        title, words = CASES[name]
        own = [figure for figure in figures if figure["table"] == name]
        parts.append((title, text_of(words, own), [result(figure) for figure in own]))
    return parts


def picture(csv_path, folder):
    """contacts.svg and contacts.png in `folder`: e_t against the angle in Chung & Ooi's test 4, and the experiment."""
    sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "figures"))
    from drawing import Data, gnuplot

    figures = [figure for figure in read(csv_path) if figure["table"].startswith("chung-ooi-4") and figure["quantity"].startswith("e_t")]

    def points(column, keep):
        return sorted((float(figure["row"].split()[0]), figure[column]) for figure in figures if keep(figure))

    kernel = points("found", lambda figure: "force" not in figure["quantity"])
    force = points("found", lambda figure: "force" in figure["quantity"])
    reference = points("expected", lambda figure: figure["source"].startswith("reference"))
    experiment = points("expected", lambda figure: "displacement" in figure["quantity"])
    # mu = 0.092, e = 1: sliding throughout where tan(angle) > 7 mu.
    first = math.degrees(math.atan(7 * 0.092))
    sliding = [(angle, 1 - 2 * 0.092 / math.tan(math.radians(angle))) for angle in (first + (62 - first) * k / 100 for k in range(101))]
    with Data() as data:
        curves = (
            f"'{data.file(sliding)}' with lines linewidth 2 linecolor 4 title 'closed form, sliding throughout'",
            f"'{data.file(reference)}' with points pointtype 6 pointsize 2.2 linewidth 1.5 linecolor 2 title 'reference integration'",
            f"'{data.file(kernel)}' with points pointtype 7 pointsize 0.9 linecolor 1 title 'kernel, displacement form'",
            f"'{data.file(force)}' with points pointtype 2 pointsize 1.1 linewidth 1.5 linecolor 3 title 'kernel, force form'",
            f"'{data.file(experiment)}' with points pointtype 4 pointsize 1.5 linewidth 1.5 linecolor 'black' title 'experiment (MFIX DEM05)'",
        )
        gnuplot(
            "set xlabel 'angle from the normal, degrees'\nset ylabel 'e_t, rebound over impact tangential velocity' noenhanced\n"
            "set xrange [0:62]\nset yrange [0.5:1.05]\nset key at graph 0.62, graph 0.98 top right reverse Left samplen 2\n"
            f"plot {', '.join(curves)}",
            Path(folder) / "contacts",
        )
