"""Reads a case as casegen completed it, and derives the contact law that a peer program has to be given.

The header that casegen writes holds every value of the case, defaults resolved, in a form that reads back exactly; no
second reader of case files is needed. The law is that of kernel/case.hpp, eqs. (16)-(22) and (26), in SI units.
"""

import math
import re
from dataclasses import dataclass
from pathlib import Path

SIZE_RUN = re.compile(r"\{\s*(\d+),\s*([^,{}]+),\s*([^,{}]+),\s*(\d+)\s*\}")  # kernel/sizes.hpp
MEMBER = re.compile(r"static constexpr [\w:* ]+? (\w+)(\[\d*\])? = (.*?);", re.DOTALL)

# What the peers are given here; a case that asks for something else is refused.
REQUIRED = {
    "normal": "hertz",
    "tangential": "displacement",
    "damping": "restitution",
    "damping_mass": "reduced",
    "ends": "periodic",
    "has_wall": True,
    "has_gas": False,
    "friction_limit": "total",
    "rolling_friction": 0,
    "wall_rolling_friction": 0,
}


def value_of(text):
    """A C++ initialiser as a Python value: number, truth value, name of an enumerator, text or tuple of numbers."""
    text = text.strip()
    if text.startswith('"'):
        return text.strip('"')
    if text.startswith("{"):
        return tuple(value_of(item) for item in text.strip("{}").split(",")) if "{" not in text[1:] else text
    if text in ("true", "false"):
        return text == "true"
    if "::" in text:
        return text.split("::")[1]
    if text == "__builtin_inf()":
        return math.inf
    number = text.removesuffix("ULL")
    if re.fullmatch(r"-?\d+", number):
        return int(number)
    if re.fullmatch(r"-?0x[0-9a-f.]+p[+-]?\d+", number):
        return float.fromhex(number)
    return text


def read_header(header):
    """The members of the struct in a header of casegen: name -> value; what it leaves out has its default."""
    text = Path(header).read_text()
    case = {name: value_of(value) for name, _, value in MEMBER.findall(text)}
    if "sizes" in case:
        case["sizes"] = tuple(tuple(map(value_of, run)) for run in SIZE_RUN.findall(case["sizes"]))
    needed = {*REQUIRED, "friction", "restitution", "particle_count", "pipe_diameter", "gravity", "time_step"}
    needed |= {"species_count"} if "sizes" in case else {"diameter", "density"}
    missing = sorted(needed - {"friction_limit", "rolling_friction", "wall_rolling_friction"} - set(case))
    if missing:
        raise SystemExit(f"{header}: no {', '.join(missing)} in it: not a header of casegen, or one of another version")
    return with_defaults(case)


def with_defaults(case):
    """With what a header says only where it differs: walls, the limit of friction and rolling resistance."""
    case = {"wall_friction": case["friction"], "wall_restitution": case["restitution"], "friction_limit": "total", "rolling_friction": 0.0} | case
    return {"wall_rolling_friction": case["rolling_friction"] if case["wall_friction"] > 0 else 0.0} | case


def read_case(header):
    """The same of a case that peers can be given."""
    case = read_header(header)
    if "sizes" in case:
        raise SystemExit(f"{header}: its particles are of several sizes; the peers can be given one size only")
    for key, wanted in REQUIRED.items():
        if case[key] != wanted:
            raise SystemExit(f"{header}: {key} is {case[key]}; the peers can be given {wanted} only")
    return case


@dataclass(frozen=True)
class Sphere:
    """What a particle is; species from 0."""

    diameter: float
    density: float
    species: int = 0

    @property
    def radius(self):
        return self.diameter / 2

    @property
    def mass(self):
        return math.pi / 6 * self.diameter**3 * self.density


def spheres_of(case):
    """Every particle, by number. Of a case that is repeated, all copies one after the other."""
    if "sizes" not in case:
        return [Sphere(case["diameter"], case["density"])] * case["particle_count"]
    once = [Sphere(*kind) for count, *kind in case["sizes"] for _ in range(count)]
    return once * (case["particle_count"] // len(once))


def kinds_of(case):
    """One sphere of each species, in their order."""
    return [sphere for _, sphere in sorted({sphere.species: sphere for sphere in spheres_of(case)}.items())]


@dataclass(frozen=True)
class Law:
    """Of two spheres of one kind, and of such a sphere at a wall: K and k of F_n = K overlap^(3/2), k_t = k overlap^(1/2); alpha of eta = alpha (M K)^(1/2) overlap^(1/4), M being the
    reduced mass. With the linear law K and k are in N/m and alpha is not used."""

    radius: float
    mass: float
    normal_pair: float
    normal_wall: float
    tangential_pair: float
    tangential_wall: float
    alpha: float
    friction: float
    wall_friction: float


def damping_ratio(restitution):
    """Of a linear oscillator whose rebound is `restitution` times the impact."""
    return -math.log(restitution) / math.hypot(math.pi, math.log(restitution))


def stiffnesses_of(case, radius):
    """Normal and tangential, of pairs and walls: the fields of Law."""
    if case["normal"] == "linear":
        normal, tangential = case["normal_stiffness"], case["tangential_stiffness"]
        return {"normal_pair": normal, "normal_wall": normal, "tangential_pair": tangential, "tangential_wall": tangential}
    modulus, poisson = case["youngs_modulus"], case["poisson_ratio"]
    shear = modulus / (2 * (1 + poisson))
    compliance = (1 - poisson**2) / modulus
    wall_compliance = (1 - case["wall_poisson_ratio"] ** 2) / case["wall_youngs_modulus"]
    return {
        "normal_pair": math.sqrt(2 * radius) / (3 * compliance),
        "normal_wall": 4 / 3 * math.sqrt(radius) / (compliance + wall_compliance),
        "tangential_pair": 2 * math.sqrt(2 * radius) * shear / (2 - poisson),
        "tangential_wall": 8 * math.sqrt(radius) * shear / (2 - poisson),
    }


def law_of(case, sphere=None):
    """Of this sphere, or of the first kind."""
    sphere = sphere or kinds_of(case)[0]
    return Law(
        radius=sphere.radius,
        mass=sphere.mass,
        **stiffnesses_of(case, sphere.radius),
        alpha=math.sqrt(5) * damping_ratio(case["restitution"]),
        friction=case["friction"],
        wall_friction=case["wall_friction"],
    )
