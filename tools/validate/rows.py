"""A row of the validation: what is expected and by whom, what was found, the difference, the verdict; and sections, which are rows with
words, tables and pictures around them.

A verdict is `agrees` or **differs** by a rule that the row states; `report only` where nothing outside gives a number to hold it
against; `not run yet` where a run is missing."""

from dataclasses import dataclass, field

from report import table

NOT_RUN = "not run yet"
ENOUGH_PLUGS = 10  # of a line, whose plugs come in bursts: fewer are reported without a verdict


@dataclass
class Found:
    """`agrees`: None for what is reported only."""

    text: str
    difference: str = "-"
    agrees: bool | None = None

    def of_plugs(self, count):
        """Without a verdict where they are too few."""
        return self if count >= ENOUGH_PLUGS else Found(f"{self.text} [{count} plugs, {ENOUGH_PLUGS} are needed]", self.difference)

    @property
    def verdict(self):
        return "report only" if self.agrees is None else "agrees" if self.agrees else "**differs**"


@dataclass
class Row:
    """`find` is given the figures of its runs, in their order; with `some`, of those that have been made, when there are any."""

    name: str
    what: str
    expected: str
    runs: list
    find: object
    some: bool = False

    def found(self, results):
        figures = [results.of(run) for run in self.runs]
        known = [one for one in figures if one is not None]
        if len(known) == len(figures):
            return self.find(figures)
        if not (self.some and known):
            return Found(NOT_RUN)
        found = self.find(known)
        return Found(f"{found.text} [{len(known)} of {len(figures)} runs]", found.difference, found.agrees)


@dataclass
class Section:
    """`tables(results)`: Markdown below the rows; `pictures(results, folder, draws)`: names with
    captions of what there is to show, drawn first when `draws`."""

    name: str
    title: str
    intro: str
    rows: list
    tables: object = None
    pictures: object = None
    extra_runs: list = field(default_factory=list)

    def runs(self):
        return [*(run for row in self.rows for run in row.runs), *self.extra_runs]

    def id(self, row):
        return f"{self.name}/{row.name}"

    def verdicts(self, results):
        found = [row.found(results) for row in self.rows]
        return [NOT_RUN if one.text == NOT_RUN else one.verdict for one in found]

    def row_table(self, results):
        cells = []
        for row in self.rows:
            found = row.found(results)
            verdict = NOT_RUN if found.text == NOT_RUN else found.verdict
            cells.append([f"`{self.id(row)}`", row.what, row.expected, found.text, found.difference, verdict])
        return table(["row", "what", "expected", "found", "difference", "verdict"], cells)


def spread(values, digits):
    """A value, or the mean of several with their minimum and maximum."""
    if len(values) == 1:
        return f"{values[0]:.{digits}f}"
    return f"{sum(values) / len(values):.{digits}f} ({min(values):.{digits}f} to {max(values):.{digits}f})"


def within(name, what, low, high, runs, value, digits=2, source=""):
    """Every run's value must lie between `low` and `high`."""

    def find(figures):
        values = [value(one) for one in figures]
        if any(v is None for v in values):
            return Found("none", "-", False)
        outside = [v - high if v > high else v - low for v in values if not low <= v <= high]
        worst = max(outside, key=abs, default=None)
        return Found(spread(values, digits), "inside" if worst is None else f"{worst:+.{digits}f}", worst is None)

    return Row(name, what, f"{low:g} to {high:g}{source}", runs, find)


def said(name, what, word, runs, value, source="", some=False):
    """Every run must show this word."""

    def find(figures):
        words = [value(one) for one in figures]
        return Found(", ".join(dict.fromkeys(words)), "-", all(found == word for found in words))

    return Row(name, what, word + source, runs, find, some)


def reported(name, what, runs, value, digits=2, expected="-", some=False):
    def find(figures):
        values = [value(one) for one in figures]
        return Found("none" if any(v is None for v in values) else spread(values, digits))

    return Row(name, what, expected, runs, find, some)
