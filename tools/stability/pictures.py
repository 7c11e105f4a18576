"""The pictures of stability.md: limits against restitution, kinetic energy against time, energy created at grazing incidence.

Each is one gnuplot script, drawn as SVG and as PNG.
"""

import subprocess
import tempfile
from pathlib import Path

TERMINALS = {
    "svg": "svg size 760,460 font 'sans-serif,14' background 'white'",
    "png": "pngcairo size 760,460 font 'sans,11' background 'white'",
}
COMMON = """
set border 3
set tics nomirror out
set grid linecolor '#dddddd'
set pointsize 1.1
"""


def gnuplot(script, stem):
    for kind, terminal in TERMINALS.items():
        head = f"set terminal {terminal}\nset output '{stem}.{kind}'\n{COMMON}"
        subprocess.run(["gnuplot"], input=head + script, text=True, check=True)


def data(folder, name, rows):
    path = Path(folder) / name
    path.write_text("".join(" ".join(str(x) for x in row) + "\n" for row in rows))
    return path


def draw_limits(content, out):
    with tempfile.TemporaryDirectory() as folder:
        curves = []
        for color, integrator in enumerate(dict.fromkeys(r["integrator"] for r in content["limits"]["rows"]), 1):
            rows = [r for r in content["limits"]["rows"] if r["scene"] == "settled bed" and r["integrator"] == integrator]
            rows = sorted((float(r["restitution"]), r["predicted step [s]"], r["measured limit [s]"], r["watched bound [s]"]) for r in rows)
            file = data(folder, f"{integrator}.dat", rows)
            curves.append(f"'{file}' using 1:2 with lines linewidth 2 linecolor {color} dashtype {color} title 'predicted, {integrator}'")
            curves.append(f"'{file}' using 1:3 with points pointtype {4 + 2 * color} linecolor {color} title 'measured, {integrator}'")
            if integrator == content["summary"]["integrator"]:
                curves.append(f"'{file}' using 1:4 with lines dashtype 2 linecolor 'black' title 'bound watched by programs'")
        curves.append(f"{content['summary']['time_step']} with lines dashtype 3 linecolor 'black' title 'time step of the case'")
        gnuplot(
            f"set title '{content['case']}: maximum stable time step of the settled bed' noenhanced\nset xlabel 'restitution'\n"
            "set ylabel 'time step, s'\nset logscale y\nset format y '10^{%T}'\nset mytics 10\nset xrange [0.15:1.02]\nset key at graph 0.98, 0.5\nplot "
            + ", ".join(curves),
            out / "limits",
        )


def draw_decays(content, out):
    with tempfile.TemporaryDirectory() as folder:
        curves = []
        rows = [line.split(",") for line in (out / "decay.csv").read_text().splitlines()[1:]]
        steps = list(dict.fromkeys(row[0] for row in rows))
        for k, step in enumerate(steps):
            file = data(folder, f"{k}.dat", [(t, e) for s, t, e in rows if s == step and float(e) > 0])
            shade = k / max(1, len(steps) - 1)
            color = f"#{int(255 * shade):02x}{int(90 * (1 - shade)):02x}{int(200 * (1 - shade)):02x}"
            curves.append(f"'{file}' with lines linewidth 2 linecolor '{color}' title '{step} s'")
        gnuplot(
            f"set title '{content['case']}: kinetic energy from its own start' noenhanced\nset xlabel 'time, s'\nset ylabel 'kinetic energy, J'\n"
            f"set xrange [0:{content['duration']}]\n"
            "set logscale y\nset format y '10^{%T}'\nset key outside right top title 'time step'\nplot " + ", ".join(curves),
            out / "decay",
        )


def draw_grazing(content, out):
    with tempfile.TemporaryDirectory() as folder:
        curves = []
        rows = [r for r in content["grazing"] if r["contact"] == "pair"]
        own = content["own_poisson_ratio"]
        kinds = [("displacement", nu) for nu in dict.fromkeys(r["poisson ratio"] for r in rows)] + [("force", own), ("rescale", own)]
        for color, (law, nu) in enumerate(kinds, 1):
            chosen = [r for r in rows if r["tangential law"] == law and r["poisson ratio"] == nu]
            points = [(r["degrees from the normal"], 100 * float(r["gained / tangential energy"])) for r in chosen]
            file = data(folder, f"{law}-{nu}.dat", points)
            dash = 1 if law == "displacement" else 2
            curves.append(f"'{file}' with lines linewidth 2 dashtype {dash} linecolor {color} title '{law}, k_t/k_n = {float(chosen[0]['k_t / k_n']):.2f}' noenhanced")
        gnuplot(
            f"set title '{content['case']}: kinetic energy gained in one impact of a pair without damping' noenhanced\n"
            "set xlabel 'angle of incidence from the normal, degrees'\nset ylabel 'gained, % of the tangential energy'\nset logscale x\n"
            "set xrange [0.25:90]\nset xzeroaxis linecolor 'black'\nset key below\nplot " + ", ".join(curves),
            out / "grazing",
        )


def draw(content, out):
    draw_limits(content, out)
    draw_decays(content, out)
    if content["grazing"]:
        draw_grazing(content, out)
