"""The runs of the plugs and lines that several sections look at."""

from runs import Run

SEEDS = (1, 2, 3)
FILLS = {"plug_u24_n500": "fill_500", "plug_d3_u17": "fill_d3", "plug_d3_u24": "fill_d3", "slug_5mm": "fill_5mm", "plug_sizes": "fill_sizes", "plug_two_sizes": "fill_two_sizes"}
PAPER = ("plug_u17", "plug_u24", "plug_u17_d3", "plug_u24_d3", "plug_u24_n500")


def plug(base, seed=1, label="", keys=(), fill_keys=()):
    """A plug from a fill of this seed; `fill_keys` are those of the fill, which is then one of its own."""
    start = Run(FILLS.get(base, "fill_1000"), label if fill_keys else "", tuple(fill_keys), seed)
    return Run(base, label, tuple(keys), seed, start)


def plugs(base, seeds=SEEDS):
    return [plug(base, seed) for seed in seeds]


def line(base, seed=1):
    """Another seed is one of feed and start; a case of its own."""
    return Run(base, f"seed{seed}", (("feed", "seed", str(seed)), ("start", "seed", str(seed))), seed) if seed > 1 else Run(base)


# Gas velocities of the sweep, m/s, for the bed's resistance of 10 mm particles and for the paper's modification.
SWEEP = {"plug_u24": (2.0, 2.8, 3.2, 4.0, 5.0), "plug_u24_d3": (2.0, 2.8, 3.2, 4.0, 5.0)}


def sweep():
    return [plug(base, 1, f"u{10 * u:.0f}", (("gas", "bulk_velocity", f"{u}"),)) for base, gas in SWEEP.items() for u in gas]


LINES_10MM = [line("line_10mm", seed) for seed in SEEDS]
LINES_3MM = [line("line_d3_u17"), line("line_d3_u24")]


def front(figures):
    return figures["plug"] and figures["plug"]["front_velocity"]


def of_plug(key, scale=1.0):
    """A quantity of the plug; None where there is none."""

    def value(figures):
        found = figures["plug"] and figures["plug"][key]
        return None if found is None else scale * found

    return value


def axial_velocity(figures):
    return figures["final"]["mean_axial_velocity"]
