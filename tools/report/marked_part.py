"""The part of a Markdown file that a command writes anew: what stands between a line `<!-- NAME -->` and the next `<!-- end -->`; all
of it, or rows of a table in it."""

from pathlib import Path

END = "<!-- end -->"


class MarkedPart:
    """Looks for its lines at once, so that minutes of measurements are not lost to a file that lacks them."""

    def __init__(self, path, name):
        self.path, self.begin = Path(path), f"<!-- {name} -->"
        self._split()

    def _split(self):
        text = self.path.read_text()
        at = text.find(self.begin)
        end = text.find(END, at)
        if not 0 <= at < end:
            raise SystemExit(f"{self.path}: no line {self.begin} followed by a line {END}; restore them where the text belongs")
        return text[: at + len(self.begin)], text[at + len(self.begin) : end], text[end:]

    def write(self, text):
        """Everything around the part as it is in the file now, which may have changed since."""
        before, _, after = self._split()
        self.path.write_text(f"{before}\n{text.rstrip()}\n{after}")


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


class KeptTable(MarkedPart):
    """A table for results of many machines, which no single call of its command can bring: new rows replace those that begin with the
    same cells, the others stay. Sorted by these cells."""

    def __init__(self, path, name, head, key):
        """`head`: names of the columns; `key`: how many cells, from the first, say what a row is about."""
        super().__init__(path, name)
        self.head, self.key = head, key

    def rows(self):
        """A list of cells for each row that stands there."""
        lines = [line for line in self._split()[1].splitlines() if line.startswith("|")]
        return [cells(line) for line in lines[2:]]

    def put(self, new):
        """Writes `new` rows (lists of cells), and returns the whole table as text."""
        rows = {tuple(row[: self.key]): row for row in [*self.rows(), *new]}
        lines = [self.head, ["---"] * len(self.head), *(rows[key] for key in sorted(rows))]
        text = "\n".join(f"| {' | '.join(line)} |" for line in lines)
        self.write(text)
        return text
