"""What became of a plug, in one word, by one rule: for every table and page that says so. Figures are those of summary.json."""

MOVING = 0.5  # m/s: no front found lies between 0.25 and 0.85
RULE = (
    f"*moves*: there is a plug whose front moves at {MOVING} m/s or more; *dies*: there is a plug, slower than that; "
    "*collapses*: no plug is left to measure."
)


def verdict(plug):
    """plug: the entry `plug` of summary.json, or None where there is none."""
    if plug is None or plug["front_velocity"] is None:
        return "collapses"
    return "moves" if plug["front_velocity"] >= MOVING else "dies"
