"""What every report needs: Markdown tables, files of comma-separated values, pictures by gnuplot, the name of the machine."""

import csv
import re
import subprocess
from pathlib import Path


def table(head, rows):
    """A Markdown table; cells are text."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def write_csv(path, head, rows):
    with Path(path).open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(head)
        writer.writerows([f"{v:.6g}" if isinstance(v, float) else v for v in row] for row in rows)


def number(value, digits=2):
    """Two digits by default, without an exponent where that is short; '-' for what is not defined."""
    if value is None or value != value:
        return "-"
    if value == 0 or 1e-3 <= abs(value) < 1e4:
        return f"{value:.{digits}g}" if abs(value) < 10**digits else f"{value:.0f}"
    return f"{value:.{digits - 1}e}".replace("e-0", "e-").replace("e+0", "e")


def gnuplot(script, path, width=1000, height=440):
    """Draws `script` (everything but terminal and output) into path.svg and path.png."""
    for terminal, ending in ((f"svg size {width},{height} font 'sans-serif,13' background 'white'", "svg"),
                             (f"pngcairo size {width},{height} font 'sans-serif,10'", "png")):
        text = f"set terminal {terminal}\nset output '{path}.{ending}'\n{script}"
        subprocess.run(["gnuplot"], input=text, text=True, check=True)


def machine():
    info = Path("/proc/cpuinfo")
    model = re.search(r"^model name\s*:\s*(.*)$", info.read_text(), re.M) if info.exists() else None
    return model.group(1) if model else "this machine"
