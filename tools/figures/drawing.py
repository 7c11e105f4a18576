"""What the figures share: gnuplot with one look, data for it in temporary files, side views with marked particles in black."""

import sys
import tempfile
from pathlib import Path

root = Path(__file__).parent.parent
for part in ("report", "picture", "python"):
    sys.path.insert(0, str(root / part))
import report
from side_view import axis, document, save, save_png

# Dark enough to be told from white, and apart from each other for the colour-blind, with dashes besides.
COLOURS = ("#5b329a", "#0f7a75", "#a8470a", "#1f5fb4", "#93145f", "#4c6411", "#000000")
LOOK = "".join(f"set linetype {k} linecolor '{colour}'\n" for k, colour in enumerate(COLOURS, 1))
LOOK += "set border 3\nset tics nomirror out\nset grid linecolor '#dddddd'\nset pointsize 1.2\n"
STYLES = {"plain": "#ffffff", "marked": "#000000"}


def gnuplot(script, path, width=760, height=460):
    report.gnuplot(LOOK + script, path, width, height)
    print(f"{path}.svg, .png")


def picture_of(script, path, width, height):
    """The same of what has too many colours for lines: the SVG holds an image, and the PNG is made of it with fewer colours."""
    report.gnuplot(LOOK + script, path, width, height)
    save_png(path)


class Data:
    """Columns for gnuplot in files that live as long as the block."""

    def __enter__(self):
        self.folder, self.count = tempfile.TemporaryDirectory(), 0
        return self

    def __exit__(self, *_):
        self.folder.cleanup()

    def file(self, rows):
        self.count += 1
        path = Path(self.folder.name) / f"{self.count}.dat"
        path.write_text("".join(" ".join(f"{x:.7g}" for x in row) + "\n" for row in rows))
        return path

    def binary(self, values):
        """An array as it is."""
        self.count += 1
        path = Path(self.folder.name) / f"{self.count}.bin"
        path.write_bytes(values.tobytes())
        return path


def side_views(panels, pipe, path, scale=1300, columns=1, note="along the pipe, m; gas flows from left to right"):
    """panels: (label, frame, marked), marked: whether each particle is drawn in black."""

    def foot(left, top):
        words = f'<text x="{left}" y="{top + (40 if columns == 1 else 20)}">{note}</text>'
        return (axis(pipe["length"], scale, left, top) if columns == 1 else "") + words

    kinds = [(label, frame, ["marked" if m else "plain" for m in marked]) for label, frame, marked in panels]
    save(document(kinds, pipe, STYLES, scale, (50 if columns == 1 else 30, foot), columns), path, 16)
