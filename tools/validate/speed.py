"""Speed: what each case costs on one core, beside the paper's machine and a peer's."""

from report import table
from rows import Found, Row, Section
from scenes import LINES_10MM, LINES_3MM, plug

PAPER = (8400 / 1.2, 9000 / 1.2)  # s of the computer per simulated second of 1000 particles
CASES = [plug("plug_u24"), plug("plug_u24_d3"), plug("plug_d3_u17"), plug("plug_d3_u24"), plug("slug_5mm"), LINES_10MM[0], *LINES_3MM]


def per_second(figures):
    return figures["performance"]["kernel_time"] / figures["final"]["time"]


def beside_paper(figures):
    value = per_second(figures[0])
    return Found(f"{value:.3g}", f"1/{PAPER[0] / value:.0f}")


def within_time(limit):
    def find(figures):
        value = figures[0]["performance"]["wall_time"]
        return Found(f"{value / 60:.1f}", f"{(value - limit) / 60:+.1f}", value <= limit)

    return find


def rows():
    found = [Row("paper", "`plug_u24`: core-seconds per simulated second", f"{PAPER[0]:.0f} to {PAPER[1]:.0f} (the paper's computer)", CASES[:1], beside_paper)]
    for run in CASES[2:4]:
        found.append(Row(run.base, f"`{run.base}`: minutes by the clock for the whole run", "at most 15", [run], within_time(900)))
    for run in LINES_3MM:
        found.append(Row(run.base, f"`{run.base}`: minutes by the clock for the whole run", "at most 180", [run], within_time(10800)))
    return found


def costs(results):
    lines = []
    for run in CASES:
        one = results.of(run)
        if one is None:
            lines.append([f"`{run.base}`", *["not run yet"] * 6])
            continue
        performance = one["performance"]
        rate, time = performance["particle_steps_per_second"], performance["kernel_time"]
        present = rate * time / one["steps"]
        lines.append([f"`{run.base}`", f"{present:.0f}", f"{one['time_step']:g}", f"{rate / 1e6:.1f}", f"{per_second(one):.0f}", f"{performance['wall_time'] / 60:.1f}", one["machine"]])
    return table(["case", "particles, mean", "time step, s", "million particle-steps/s", "core-seconds per simulated second", "minutes, whole run", "machine"], lines)


def section():
    return Section(
        "speed",
        "What it costs",
        "One core each; the machines were shared with other work, so these are upper bounds of time, and benchmarks are in [bench/README.md](../bench/README.md).",
        rows(),
        costs,
    )
