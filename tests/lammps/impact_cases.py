#!/usr/bin/env python3
"""Writes cases of single collisions, one for each form of the law that LAMMPS is given: make test-lammps.

Usage: impact_cases.py CASE.toml FOLDER. Each case is CASE with its material, in a closed pipe without weight: at every speed of
SPEEDS and every angle of ANGLES (from the normal) one collision of two spheres, one with the pipe's wall and one with a
flat end. In those of SIZES the sphere at rest is SMALLER times as large as the others. Each starts 1e-4 d before contact and never meets another one. `slip` is along z, at the ends along x.
"""

import math
import re
import sys
from dataclasses import dataclass
from pathlib import Path

root = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(root / "tools" / "peers"))
from derived_cases import TABLE, value_in, with_table, with_value  # noqa: E402

SPEEDS = (0.1, 1.0, 4.0)  # m/s
ANGLES = (0.0, 20.0, 60.0)  # degrees
TIME_STEP = 1.0e-7  # s
DURATION = 3.0e-4  # s: every collision is over, the slowest too
SMALLER = 0.5
LINEAR = {"normal": '"linear"', "normal_stiffness": "1.0e6", "tangential_stiffness": "8.0e5"}

# name -> values of [material] and [contact] that differ from the case's
LAWS = {
    "impacts": ({}, {}),
    "impacts_e05": ({"restitution": "0.5"}, {}),
    "impacts_elastic": ({"restitution": "1.0"}, {}),
    "impacts_force": ({}, {"tangential": '"force"'}),
    "impacts_rescale": ({}, {"tangential": '"rescale"'}),
    "impacts_smooth": ({"friction": "0"}, {}),
    "impacts_mass": ({}, {"damping_mass": '"particle"'}),
    "impacts_linear": ({}, LINEAR),
    "impacts_critical": ({}, {**LINEAR, "damping": '"critical"'}),
    "impacts_walls": ({"wall_friction": "0.1", "wall_restitution": "0.6"}, {}),
    "impacts_sizes": ({}, {}),
    # Softer, so that a contact of the small spheres has as many steps as the others.
    "impacts_sizes_linear": ({}, {**LINEAR, "normal_stiffness": "2.0e5", "tangential_stiffness": "1.6e5"}),
}
SIZES = ("impacts_sizes", "impacts_sizes_linear")


@dataclass(frozen=True)
class Impact:
    """Particle `number` (from 0) hits another one, the pipe or an end; the normal is along axis `normal`."""

    number: int
    kind: str
    speed: float
    angle: float
    normal: int
    slip: int

    @property
    def normal_speed(self):
        return self.speed * math.cos(math.radians(self.angle))


def impacts(d, pipe, length, resting=None):
    """All collisions, and (position, velocity) of every particle. resting: diameter of the spheres that are hit, d without it."""
    found, placed = [], []
    between = (d + (resting or d)) / 2
    gap = 1e-4 * d
    choices = [(speed, angle) for speed in SPEEDS for angle in ANGLES]
    places = 2 * len(choices)
    for k, (speed, angle) in enumerate(choices):
        normal, slip = speed * math.cos(math.radians(angle)), speed * math.sin(math.radians(angle))
        z = [(length - 8 * d) * (2 * k + half) / (places - 1) + 4 * d for half in (0, 1)]
        # Nine squares side by side at the end, 1.2 d wide.
        x, y = (1.2 * d * (k % 3 - 1), 1.2 * d * (k // 3 - 1))
        for kind, place, velocity, axes in (
            ("pair", (0.0, between + gap, z[0]), (0.0, -normal, slip), (1, 2)),
            ("pipe", (0.0, -(pipe - d) / 2 + gap, z[1]), (0.0, -normal, slip), (1, 2)),
            ("end", (x, y, d / 2 + gap), (slip, 0.0, -normal), (2, 0)),
        ):
            if kind == "pair":
                placed.append(((0.0, 0.0, z[0]), (0.0, 0.0, 0.0)))
            found.append(Impact(len(placed), kind, speed, angle, *axes))
            placed.append((place, velocity))
    return found, placed


def resting_numbers(found):
    """Who is hit by another one."""
    return {impact.number - 1 for impact in found if impact.kind == "pair"}


def sizes(text):
    return [value_in(text, *key) for key in (("particles", "diameter"), ("pipe", "diameter"), ("pipe", "length"))]


def with_species(text, count, resting):
    """Two species instead of one size: those at rest, `small`, and all others, `large`."""
    d = value_in(text, "particles", "diameter")
    text = re.sub(r"(?m)^(count|diameter)\s*=.*\n", "", text, count=2)  # the first ones are those of [particles]
    tables = [("large", count - resting, d), ("small", resting, SMALLER * d)]
    lines = [f'[[particles.species]]\nname = "{name}"\ncount = {number}\ndiameter = {diameter!r}\n' for name, number, diameter in tables]
    return text.replace("[material]", "\n".join(lines) + "\n[material]", 1)


def impact_case(text, material, contact, has_sizes=False):
    d, pipe, length = sizes(text)
    found, placed = impacts(d, pipe, length, SMALLER * d if has_sizes else None)
    resting = resting_numbers(found)
    text = re.sub(TABLE.format(name="start"), "", text)
    for table, values in (("material", material), ("contact", contact)):
        for key, value in values.items():
            text = with_value(text, table, key, value)
    if "normal_stiffness" in contact:  # then the material has no say in it
        text = re.sub(r"(?m)^(youngs_modulus|poisson_ratio)\s*=.*\n", "", text)
    text = with_species(text, len(placed), len(resting)) if has_sizes else with_value(text, "particles", "count", len(placed))
    text = with_value(text, "pipe", "ends", '"closed"')
    text = with_value(text, "run", "gravity", "[0.0, 0.0, 0.0]")
    text = with_value(text, "run", "time_step", TIME_STEP)
    text = with_value(text, "run", "duration", DURATION)
    text = with_table(text, "output", [f"log_interval = {DURATION}"])
    lines = []
    for number, (position, velocity) in enumerate(placed):
        lines += ["[[start.particle]]", f"position = {list(position)}", f"velocity = {list(velocity)}"]
        lines += [f'species = "{"small" if number in resting else "large"}"', ""] if has_sizes else [""]
    return text.rstrip() + "\n\n" + "\n".join(lines)


def main():
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    source, folder = Path(sys.argv[1]), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    for name, (material, contact) in LAWS.items():
        file, case = folder / f"{name}.toml", impact_case(source.read_text(), material, contact, name in SIZES)
        if not file.exists() or file.read_text() != case:  # an unchanged case need not be compiled again
            file.write_text(case)


if __name__ == "__main__":
    main()
