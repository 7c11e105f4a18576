"""The part of a Markdown file that a command writes anew: what stands between a line `<!-- NAME -->` and the next `<!-- end -->`."""

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
        return text[: at + len(self.begin)], text[end:]

    def write(self, text):
        """Everything around the part as it is in the file now, which may have changed since."""
        before, after = self._split()
        self.path.write_text(f"{before}\n{text.rstrip()}\n{after}")
