"""Slug laws beside every moving plug: Lavrinec et al. (2020), W = 0.967 V_p + 0.5 sqrt(g D); Konrad's W = V_p + 0.54 sqrt(g D) with eq. (41);
and the layer from the balance of mass, 1 - V_p/W, beside the layer measured. Plugs of periodic pipes are means of a run, those of lines single ones."""

from dataclasses import dataclass

from drawing import Data, gnuplot
from plug_verdict import verdict
from report import table
from rows import Found, Row, Section
from scenes import LINES_10MM, LINES_3MM, plug, plugs, sweep

GRAVITY = 9.81
PLUGS = [run for case in ("plug_u24", "plug_u17_d3", "plug_u24_d3") for run in plugs(case)]
TRUE = [run for case in ("plug_d3_u17", "plug_d3_u24") for run in plugs(case)]
SIZES = [plug("plug_sizes"), plug("plug_two_sizes")]
LIMIT = 0.05  # of W: about what single plugs of the line scatter by


@dataclass
class Point:
    name: str
    diameter: float  # of the pipe, m
    front: float
    particles: float
    layer: float | None

    @property
    def froude(self):
        return (GRAVITY * self.diameter) ** 0.5

    @property
    def lavrinec(self):
        return 0.967 * self.particles + 0.5 * self.froude

    @property
    def konrad(self):
        return self.particles + 0.54 * self.froude

    @property
    def balance(self):
        return 1 - self.particles / self.front

    @property
    def eq41(self):
        return 1 / (1 + 1.84 * self.particles / self.froude)


def points(figures):
    name = figures["run"]
    diameter = 0.052 if name.startswith("line_d3") else 0.05
    if figures.get("plugs") is not None:
        return [Point(name, diameter, p["front_velocity"], p["particle_velocity"], p["layer_ratio"]) for p in figures["plugs"] if p["front_velocity"]]
    plug_found = figures["plug"]
    if verdict(plug_found) != "moves":
        return []
    return [Point(name, diameter, plug_found["front_velocity"], plug_found["particle_velocity"], plug_found["layer_area_ratio"])]


def law(of):
    def find(figures):
        found = [point for one in figures for point in points(one)]
        off = [of(point) / point.front - 1 for point in found]
        if not off:
            return Found("no plug moves")
        worst = max(off, key=abs)
        where = found[off.index(worst)]
        rms = (sum(value**2 for value in off) / len(off)) ** 0.5
        return Found(f"{len(off)} plugs: {100 * min(off):+.1f} to {100 * max(off):+.1f} %, {100 * rms:.1f} % rms", f"{100 * worst:+.1f} % (`{where.name}`, W {where.front:.2f} m/s)", abs(worst) <= LIMIT)

    return find


def mean_law(of):
    """Of single plugs of a line: their mean, because a plug of a line speeds up and slows down."""

    def find(figures):
        found = [point for one in figures for point in points(one)]
        if not found:
            return Found("no plug moves")
        off = [of(point) / point.front - 1 for point in found]
        mean = sum(off) / len(off)
        return Found(f"{len(off)} plugs: mean {100 * mean:+.1f} %, single ones {100 * min(off):+.0f} to {100 * max(off):+.0f} %", f"{100 * mean:+.1f} %", abs(mean) <= LIMIT).of_plugs(len(off))

    return find


def layer():
    def find(figures):
        found = [point for one in figures for point in points(one) if point.layer is not None]
        if not found:
            return Found("no plug moves")
        off = [point.layer - point.balance for point in found]
        return Found(f"{min(off):+.2f} to {max(off):+.2f}", f"{sum(off) / len(off):+.2f}")

    return find


def rows():
    groups = {"plugs": ("plugs of 10 mm", PLUGS, law), "true": ("plugs of 3 mm", TRUE, law), "sweep": ("sweep from 2.0 to 5.0 m/s", sweep(), law), "sizes": ("plugs of several sizes", SIZES, law),
              "line-10mm": ("single plugs of line_10mm", LINES_10MM, mean_law), "line-3mm": ("single plugs of line_d3_u24", LINES_3MM[1:], mean_law)}  # fmt: skip
    laws = {"lavrinec": ("W by Lavrinec et al. over W found", lambda point: point.lavrinec), "konrad": ("W by Konrad over W found", lambda point: point.konrad)}
    found = []
    for name, (words, of) in laws.items():
        for group, (which, runs, rule) in groups.items():
            found.append(Row(f"{name}-{group}", f"{which}: {words}", f"1, within {100 * LIMIT:.0f} %", runs, rule(of), group in ("true", "sweep")))
    for group, (which, runs, _) in groups.items():
        found.append(Row(f"balance-{group}", f"{which}: layer measured less that of the balance of mass", "0, if the layer is at rest", runs, layer(), group in ("true", "sweep")))
    return found


def every(results):
    for run in [*PLUGS, *TRUE, *sweep(), *SIZES, *LINES_10MM, *LINES_3MM]:
        figures = results.of(run)
        if figures:
            yield from ((run, point) for point in points(figures))


def single(results):
    lines = []
    for run, p in every(results):
        if run in LINES_10MM or run in LINES_3MM:
            continue
        layers = ("-" if p.layer is None else f"{p.layer:.2f}", f"{p.eq41:.2f}", f"{p.balance:.2f}")
        lines.append([f"`{p.name}`", f"{p.front:.2f}", f"{p.particles:.2f}", f"{p.lavrinec:.2f}", f"{100 * (p.lavrinec / p.front - 1):+.1f}", f"{p.konrad:.2f}", f"{100 * (p.konrad / p.front - 1):+.1f}", *layers])
    return table(["plug", "W, m/s", "V_p, m/s", "Lavrinec, m/s", "off, %", "Konrad, m/s", "off, %", "layer measured", "eq. (41)", "1 - V_p/W"], lines)


def group_of(run):
    return "open line, 10 mm" if run in LINES_10MM else "open line, 3 mm" if run in LINES_3MM else "periodic, 3 mm" if run in TRUE else "periodic, 10 mm"


def pictures(results, folder, draws):
    found = {}
    for run, p in every(results):
        found.setdefault(group_of(run), []).append((p.particles / p.froude, p.front / p.froude))
    if not found:
        return []
    if draws:
        draw(found, folder)
    return [("laws", "Velocity of plugs against that of their particles, beside two laws")]


def draw(found, folder):
    most = max(x for rows in found.values() for x, _ in rows)
    end = 0.5 * (int(2 * most) + 1)
    with Data() as data:
        curves = ["0.967*x + 0.5 with lines linewidth 2 linecolor 'black' title 'Lavrinec et al.'", "x + 0.54 with lines linewidth 2 dashtype 2 linecolor 'black' title 'Konrad'"]
        curves += [f"'{data.file(rows)}' with points pointtype {(6, 4, 7, 5)[k % 4]} linecolor {k + 1} title '{name}' noenhanced" for k, (name, rows) in enumerate(sorted(found.items()))]
        gnuplot(f"set xlabel 'V_p / (g D)^{{1/2}}'\nset ylabel 'W / (g D)^{{1/2}}'\nset xrange [0:{end}]\nset yrange [0:{end + 1}]\nset key left top\nplot {', '.join(curves)}", folder / "laws")


def section():
    return Section(
        "laws",
        "Slug laws",
        "Every plug that moves: of the paper's cases, of true 3 mm, of a sweep of gas velocities with both resistances of the bed, of several sizes, and of open lines. D is the bore, eq. (41) the layer by Konrad's balance of momentum.",
        rows(),
        single,
        pictures,
    )
