"""The page of one case: tables, picture and the sentences between them. All numbers are those of a Result."""

import math

import report
from measure import ANGLES, lyapunov_time
from report import number, table

OWN = 1000  # the case's own time step and gas interval
OBLIQUE = 2  # first oblique kind of impact
MOMENTS = {1: "1 ms", 2: "5 ms", 3: "10 ms"}
HORIZON = 0.02  # of the way travelled: from there on chaos, not the method, makes the error
LIMITS = (0.01, 0.001)
HALVED = (1000, 5000)  # steps of which the double is there too


def label(curve):
    words = curve.removeprefix("gas.").split(".")
    return " ".join([words[0], *([] if words[1] == "clip" else [f"{words[1]} slider"]), *words[2:]])


def slope(points):
    """Least-squares slope of log y against log x."""
    points = [(math.log(x), math.log(y)) for x, y in points if y > 0]
    if len(points) < 2:
        return math.nan
    mean_x, mean_y = (sum(p[k] for p in points) / len(points) for k in (0, 1))
    return sum((x - mean_x) * (y - mean_y) for x, y in points) / sum((x - mean_x) ** 2 for x, _ in points)


def velocity_errors(errors):
    """Root mean square over head-on kinds of impact, and over oblique ones."""
    groups = (range(OBLIQUE), range(OBLIQUE, len(ANGLES)))
    return tuple(math.sqrt(sum(errors[k][0] ** 2 for k in group) / len(group)) for group in groups)


class Point:
    """One setting: what it costs and how far off it is. run_time: processor seconds for a second of the scene."""

    def __init__(self, result, curve, setting):
        self.curve, (self.factor, self.gas) = curve, setting
        self.step = result.facts.time_step * self.factor / 1000
        self.run_time = result.times[curve][setting] / self.step
        self.position = result.errors.get(curve, {}).get(setting, {})
        errors = result.impacts.get(curve.removeprefix("gas."), ({},))[0].get(self.factor)
        self.head_on, self.oblique = velocity_errors(errors) if errors else (math.nan, math.nan)
        steps = max(1, int(result.facts.gas_interval * self.gas / self.factor + 0.5))  # as setting.hpp
        self.gas_steps = steps if result.facts.has_gas else None

    def error(self, moment):
        return self.position[moment][0] if moment in self.position else math.nan

    def relative(self, moment):
        return self.error(moment) / self.position[moment][2] if moment in self.position else math.nan

    def name(self):
        gas = f", gas every {self.gas_steps} steps" if self.gas_steps else ""
        return f"`{label(self.curve)}` at {number(self.step)} s{gas}"


def pareto(points, error):
    """Those that no other beats in both run time and error."""
    valid = [p for p in points if not math.isnan(error(p))]
    return [p for p in valid if not any(q.run_time <= p.run_time and error(q) < error(p) for q in valid)]


class Result:
    def __init__(self, case, facts, is_quick):
        self.case, self.facts, self.is_quick = case, facts, is_quick
        self.impacts, self.errors, self.stopped, self.still = {}, {}, {}, {}

    def points(self):
        return [Point(self, curve, setting) for curve in self.times for setting in sorted(self.times[curve])]

    # What the page is made of.

    def main_table(self):
        points = self.points()
        best = {"head on": pareto(points, lambda p: p.head_on), "oblique": pareto(points, lambda p: p.oblique), "positions": pareto(points, lambda p: p.error(1))}
        head = ["integrator, precision", "time step, s", *(["gas every, steps"] if self.facts.has_gas else []), "run time, s", "rebound, head on", "oblique",
                *(f"positions, {m}, m" for m in MOMENTS.values()), "maximum, 1 ms, m", "Pareto"]
        rows = []
        for p in points:
            marks = [name for name, of_name in best.items() if p in of_name]
            cells = [label(p.curve), number(p.step) + (" **(own)**" if (p.factor, p.gas) == (OWN, OWN) else "")]
            if self.facts.has_gas:
                cells.append(str(p.gas_steps))
            cells += [number(p.run_time, 3), number(p.head_on), number(p.oblique)]
            for m in MOMENTS:
                cells.append(number(p.error(m)) + (" ~" if p.relative(m) > HORIZON else ""))
            cells += [number(p.position[1][1]) if 1 in p.position else "-", ", ".join(marks)]
            rows.append(cells)
        return table(head, rows)

    def cheapest(self, limit, error, what):
        fine = [p for p in self.points() if error(p) < limit]
        if not fine:
            return f"none of the settings has an error below {limit * 100:g} % of {what}"
        best = min(fine, key=lambda p: p.run_time)
        return f"the cheapest setting with error below {limit * 100:g} % of {what} is {best.name()} ({number(best.run_time, 3)} s for a simulated second)"

    def last_line(self):
        parts = [self.cheapest(LIMITS[0], lambda p, m=m: p.relative(m), f"the way travelled in {MOMENTS[m]}") for m in (1, 2)]
        parts += [self.cheapest(limit, error, f"the impact speed in {what} rebounds") for limit in LIMITS for error, what in ((lambda p: p.head_on, "head-on"), (lambda p: p.oblique, "oblique"))]
        return "For this scene, " + "; ".join(parts) + "."

    def orders_of_impacts(self):
        rows = []
        for curve, (errors, stopped, _) in self.impacts.items():
            if ".paper." in curve:
                continue
            fitted = [f for f in errors if 100 <= f <= 5000]
            cells = [label(curve), *(number(slope([(f, velocity_errors(errors[f])[k]) for f in fitted])) for k in (0, 1))]
            cells += [number(slope([(f, errors[f][None][which]) for f in fitted])) for which in (1, 2, 3)]
            cells += [" / ".join(map(number, velocity_errors(errors[f]))) if f in errors else "-" for f in (100, OWN, 5000)]
            cells.append("; ".join(f"{number(f / 1000 * self.facts.time_step)} s: {why}" for f, why in stopped.items()) or "-")
            rows.append(cells)
        step = self.facts.time_step
        steps = f"{number(0.1 * step)} to {number(5 * step)} s"
        head = ["setting", "order: velocity, head on", "oblique", "spin", "contact time", "maximum overlap", *(f"errors at {number(k * step)} s" for k in (0.1, 1, 5)), "stopped"]
        return f"Orders are slopes fitted from {steps}; errors of the velocity, head on / oblique.\n\n" + table(head, rows)

    def impacts_by_kind(self):
        rows, step = [], self.facts.time_step
        kinds = ["pair, head on", "wall, head on", *(f"wall, {a}°" for a in ANGLES[2:])]
        for curve, (errors, _, _) in self.impacts.items():
            if curve.count(".") > 2 or ".paper." in curve or OWN not in errors:
                continue
            for which, what in enumerate(("velocity", "spin", "contact time", "overlap")):
                rows.append([label(curve), what, *(number(errors[OWN][k][which]) for k in range(len(kinds)))])
        return f"At the case's own step of {number(step)} s:\n\n" + table(["setting", "error of", *kinds], rows)

    def impacts_by_step(self):
        curves = [c for c in self.impacts if c.count(".") == 2 and ".paper." not in c]
        factors = sorted({f for c in curves for f in (*self.impacts[c][0], *self.impacts[c][1])})
        rows = [[number(f / 1000 * self.facts.time_step), *(" / ".join(map(number, velocity_errors(self.impacts[c][0][f]))) if f in self.impacts[c][0] else "stopped" for c in curves)] for f in factors]
        return table(["time step, s", *map(label, curves)], rows)

    def paper_slider(self):
        rows = []
        for curve, (_, _, spins) in self.impacts.items():
            if curve.count(".") != 2 or not curve.endswith("double"):
                continue
            kind = ANGLES.index(35)
            numbers = [n for n in self.exact_spin if n // 24 == kind]
            factors = sorted(f for f in spins if all(n in spins[f] for n in numbers))
            for coarse, fine in zip(factors[1:], factors):
                def mean(change):
                    return math.sqrt(sum(change(n) ** 2 for n in numbers) / len(numbers))
                moved = mean(lambda n: spins[coarse][n] - spins[fine][n])
                off = self.spin_error(spins, fine, numbers)
                rows.append([label(curve), number(coarse / 1000 * self.facts.time_step), number(fine / 1000 * self.facts.time_step), number(moved), number(off)])
        return table(["setting", "from step, s", "to step, s", "change of spin", "error of the finer one"], rows)

    def spin_error(self, spins, factor, numbers):
        from measure import speed_of

        return math.sqrt(sum((spins[factor][n] - self.exact_spin[n][2] / speed_of(n)) ** 2 for n in numbers) / len(numbers))

    def order_of_bodies(self):
        rows = []
        for curve, errors in self.errors.items():
            if curve.startswith("gas."):
                continue
            cells = [label(curve)]
            for fine in HALVED:
                a, b = errors.get((fine, OWN), {}), errors.get((2 * fine, OWN), {})
                cells += [number(b[m][0] / a[m][0]) if m in a and m in b else "-" for m in (1, 2)]
            rows.append(cells)
        steps = [f"{number(2 * f / 1000 * self.facts.time_step)} to {number(f / 1000 * self.facts.time_step)} s" for f in HALVED]
        return table(["setting", *(f"{s}, {MOMENTS[m]}" for s in steps for m in (1, 2))], rows)

    def long_table(self):
        names = ["height, mm", "coordination number", "decay time, s", "plug velocity, m/s", "layer area ratio"]
        scale = [1e3, 1, 1, 1, 1]
        first = next(iter(self.long))
        base = self.long[first][min(self.long[first])]
        rows, marked, tested = [], 0, 0
        for curve, settings in self.long.items():
            for setting, by_seed in sorted(settings.items()):
                cells = [label(curve), number(setting[0] / 1000 * self.facts.time_step), str(len(by_seed))]
                for k in range(5):
                    mean, scatter, count = statistics(by_seed, k)
                    base_mean, base_scatter, base_count = statistics(base, k)
                    mark = ""
                    if by_seed is not base and count > 1 and base_count > 1:
                        doubt = math.hypot(scatter / math.sqrt(count), base_scatter / math.sqrt(base_count))
                        differs = abs(mean - base_mean) > 2 * doubt
                        tested, marked, mark = tested + 1, marked + differs, " *" if differs else ""
                    cells.append("-" if count == 0 else f"{number(mean * scale[k], 4)} ± {number(scatter * scale[k])}{mark}")
                rows.append(cells)
        kept = [k for k in range(5) if any(row[3 + k] != "-" for row in rows)]
        rows = [[*row[:3], *(row[3 + k] for k in kept)] for row in rows]
        verdict = (f"{marked} of {tested} means (*) differ from those of `{label(first)}` at the smallest step by more than twice the standard "
                   "error of the difference; one in twenty would by chance alone.")
        return table(["setting", "time step, s", "seeds", *(names[k] for k in kept)], rows) + "\n\n" + verdict

    def still_table(self):
        factors = sorted({f for speeds in self.still.values() for f in speeds})
        rows = [[label(c), *(f"{s[f]:.1e}" if f in s else "-" for f in factors)] for c, s in self.still.items()]
        return table(["maximum speed, m/s, with steps of", *(f"{number(f / 1000 * self.facts.time_step)} s" for f in factors)], rows)

    # Files.

    def picture(self, path):
        """Three panels over run time: errors of rebounds, error of positions after 1 ms."""
        points = self.points()
        blocks, panels, own = [], [], []
        curves = list(dict.fromkeys(p.curve for p in points))
        for k, (title, error) in enumerate((("rebound, head on", lambda p: p.head_on), ("rebound, oblique", lambda p: p.oblique), ("positions after 1 ms", lambda p: p.error(1) / self.facts.diameter))):
            draws = []
            for n, curve in enumerate(curves):
                if curve.startswith("gas.") and k < 2:
                    continue
                kept = [p for p in points if p.curve == curve and not math.isnan(error(p))]
                if not kept:
                    continue
                blocks.append(f"$d{k}_{n} << EOD\n" + "".join(f"{p.run_time} {error(p)}\n" for p in kept) + "EOD")
                name = "other gas intervals" if curve.startswith("gas.") else label(curve)
                style = "points pointtype 2 pointsize 1.2" if curve.startswith("gas.") else f"linespoints pointtype {5 if 'mixed' in curve else 7} dashtype {2 if 'mixed' in curve else 1} pointsize 0.8"
                draws.append(f"$d{k}_{n} with {style} linewidth 2 linecolor {n // 2 + 1 if not curve.startswith('gas.') else 8} title '{name}'")
                own += [(k, p.run_time, error(p)) for p in kept if (p.factor, p.gas) == (OWN, OWN)]
            blocks.append(f"$own{k} << EOD\n" + "".join(f"{x} {y}\n" for j, x, y in own if j == k) + "EOD")
            draws.append(f"$own{k} with points pointtype 6 pointsize 2.2 linewidth 1.5 linecolor 'black' title '{number(self.facts.time_step)} s'")
            unit = "rms error / impact speed" if k < 2 else "rms error / diameter"
            panels.append(f"set title '{title}'\nset ylabel '{unit}'\nplot " + ", ".join(draws))
        style = ("set border 3\nset tics nomirror out\nset logscale xy\nset format y '10^{%T}'\nset grid xtics ytics linecolor '#dddddd'\n"
                 "set xlabel 'processor time for a simulated second, s'\nset key bottom left spacing 0.9 samplen 2 font ',10'\nset offsets 0, 0, graph 0.1, graph 0.6\nset multiplot layout 1,3\n")
        report.gnuplot("\n".join(blocks) + "\n" + style + "\n".join(panels) + "\nunset multiplot\n", path, 1250, 460)

    def csv(self, folder):
        head = ["integrator", "slider", "precision", "time_step_s", "gas_interval_steps", "run_time_per_simulated_second_s", "head_on_rebound_rms_error", "oblique_rebound_rms_error",
                *(f"position_{kind}_error_{m.replace(' ', '')}_m" for m in MOMENTS.values() for kind in ("rms", "maximum"))]
        rows = []
        for p in self.points():
            position = [v for m in MOMENTS for v in (p.position.get(m, (math.nan,) * 3)[:2])]
            rows.append([*p.curve.removeprefix("gas.").split("."), p.step, p.gas_steps or "", p.run_time, p.head_on, p.oblique, *position])
        report.write_csv(folder / "frontier.csv", head, rows)
        rows = [[curve, f / 1000 * self.facts.time_step, "all" if kind is None else f"{'pair' if kind == 0 else 'wall'} {ANGLES[kind]}", *values]
                for curve, (errors, _, _) in self.impacts.items() for f, by_kind in errors.items() for kind, values in by_kind.items()]
        report.write_csv(folder / "frontier_impacts.csv", ["setting", "time_step_s", "impact", "velocity", "spin", "contact_time", "overlap"], rows)
        rows = [[curve, s[0] / 1000 * self.facts.time_step, seed, *values] for curve, settings in self.long.items() for s, by_seed in settings.items() for seed, values in by_seed.items()]
        report.write_csv(folder / "frontier_long.csv", ["setting", "time_step_s", "seed", "height_m", "coordination_number", "decay_time_s", "plug_velocity_m_s", "layer_area_ratio"], rows)

    def write(self, folder):
        from page_text import text

        self.picture(folder / "frontier")
        self.csv(folder)
        (folder / "frontier.md").write_text(text(self))

    def lyapunov(self):
        return lyapunov_time(self.separation, 1e-5 * self.facts.diameter)


def statistics(by_seed, k):
    values = [v[k] for v in by_seed.values() if not math.isnan(v[k])]
    if not values:
        return math.nan, math.nan, 0
    mean = sum(values) / len(values)
    scatter = math.sqrt(sum((v - mean) ** 2 for v in values) / (len(values) - 1)) if len(values) > 1 else math.nan
    return mean, scatter, len(values)
