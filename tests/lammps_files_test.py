#!/usr/bin/env python3
"""What tools/lammps writes for LAMMPS, refuses, and makes of what a run leaves; LAMMPS itself is not needed.

Usage: tests/lammps_files_test.py BUILD_FOLDER [COUNT_FILE]: the folder with cases/ of the shipped cases' headers. Writes
"PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed. `make test-lammps` asks LAMMPS.
"""

import json
import math
import re
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

root = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path[:0] = [str(root / part) for part in ("tests", "tools/peers", "tools/lammps")]

import counted  # noqa: E402
import run_lammps  # noqa: E402
from case_values import law_of, read_case, read_header, with_defaults  # noqa: E402
from lammps_law import law_commands, refusal, tsuji_polynomial  # noqa: E402
from scene_files import NEAR_REACH, SKIN, Refused, files  # noqa: E402
from states import State  # noqa: E402

HEADERS = Path()
EXPORT = root / "tools" / "lammps" / "export_lammps.py"


def case_of(name, **changed):
    """As if the case file had said so: walls have what particles have, unless it says otherwise."""
    case = read_header(HEADERS / f"{name}.hpp")
    for key in ("friction", "restitution", "rolling_friction"):
        if key in changed:
            del case[f"wall_{key}"]
    return with_defaults(case | changed)


def still(count):
    zeros = [(0.0, 0.0, 0.0)] * count
    return State([(0.0, 0.0, 0.01 * k) for k in range(count)], zeros, zeros)


def texts_of(case, repeat=1):
    return files(case, still(case["particle_count"]), "a test", repeat)


def commands(case, start):
    return [line.split() for line in law_commands(case) if line.startswith(start)]


def state_file(count, name=b"settle"):
    head = b"FIXDEM\x1a\n" + struct.pack("<III", 0x01020304, 1, len(name)) + name + struct.pack("<QIIQdddQ", 7, 1, 0, count, 0.01, 0, 1, 3)
    flat = [c for place in still(count).positions for c in place] + [0.0] * (6 * count)
    return head + struct.pack(f"<{9 * count}d", *flat) + struct.pack(f"<{count}iQQ", *[0] * count, 0, 99)


class Law(unittest.TestCase):
    def test_flat_ends_and_pipe_have_their_own_effective_radius(self):
        case = case_of("settle")
        law = law_of(case)
        (pipe,), (ends,) = commands(case, "fix wall"), commands(case, "fix ends")
        self.assertEqual((pipe[-2:], ends[-3:]), (["zcylinder", "0.0375"], ["zplane", "0.0", "0.065"]))
        self.assertAlmostEqual(float(ends[6]) * math.sqrt(0.005) / law.normal_wall, 1, places=12)
        self.assertAlmostEqual(float(ends[10]) * math.sqrt(0.005) / law.tangential_wall, 1, places=12)
        self.assertAlmostEqual(float(pipe[6]) * math.sqrt(0.005 * 0.075 / 0.07) / law.normal_wall, 1, places=12)

    def test_walls_are_those_of_the_case(self):
        self.assertEqual((len(commands(case_of("pipe_bed"), "fix wall")), len(commands(case_of("pipe_bed"), "fix ends"))), (1, 0))
        self.assertEqual((len(commands(case_of("collide_wall"), "fix wall")), len(commands(case_of("collide_wall"), "fix ends"))), (0, 1))
        self.assertEqual(len(commands(case_of("collide_pair"), "fix")), 0)

    def test_tangential_forms(self):
        for form, word in (("displacement", "mindlin"), ("force", "mindlin/force"), ("rescale", "mindlin_rescale/force")):
            ((*_, spring, _, damped, friction, _, tsuji),) = commands(case_of("pipe_bed", tangential=form), "pair_coeff")
            self.assertEqual((spring, damped, friction, tsuji), (word, "1.0", "0.3", "tsuji"))

    def test_damping_is_that_of_the_mass_and_restitution(self):
        alpha = law_of(case_of("settle")).alpha
        for mass, factor in (("reduced", 1), ("particle", math.sqrt(2))):
            case = case_of("settle", damping_mass=mass)
            (pair,), (wall,) = commands(case, "pair_coeff"), commands(case, "fix wall")
            self.assertAlmostEqual(tsuji_polynomial(float(pair[5])) / alpha, factor, places=10)
            self.assertAlmostEqual(tsuji_polynomial(float(wall[7])) / alpha, 1, places=10)
        (pair,) = commands(case_of("settle", restitution=1.0), "pair_coeff")
        self.assertEqual((pair[5], pair[-1]), ("0.0", "velocity"))

    def test_without_friction_nothing_acts_along_the_tangent(self):
        self.assertIn("tangential linear_nohistory 0.0 0.0", " ".join(commands(case_of("settle", friction=0.0), "pair_coeff")[0]))

    def test_walls_of_their_own(self):
        case = case_of("settle", wall_friction=0.1, wall_restitution=0.5)
        beta = -math.log(0.5) / math.hypot(math.pi, math.log(0.5))
        (pair,), (wall,) = commands(case, "pair_coeff"), commands(case, "fix wall")
        self.assertEqual((pair[10], wall[12]), ("0.3", "0.1"))
        self.assertAlmostEqual(tsuji_polynomial(float(wall[7])) / (math.sqrt(5) * beta), 1, places=10)
        linear = case | {"normal": "linear", "normal_stiffness": 1e5, "tangential_stiffness": 4e4}
        (pair,), (wall,) = commands(linear, "pair_coeff"), commands(linear, "fix wall")
        self.assertAlmostEqual(float(wall[7]) / (2 * beta * math.sqrt(law_of(case).mass * 1e5)), 1, places=12)
        self.assertEqual((pair[10], wall[12]), ("0.3", "0.1"))

    def test_linear_law(self):
        case = case_of("settle", normal="linear", normal_stiffness=1e5, tangential_stiffness=4e4)
        mass, beta = law_of(case).mass, -math.log(0.9) / math.hypot(math.pi, math.log(0.9))
        (pair,), (wall,) = commands(case, "pair_coeff"), commands(case, "fix wall")
        self.assertEqual(pair[3:5] + pair[6:9], ["hooke", "100000.0", "tangential", "linear_history", "40000.0"])
        self.assertAlmostEqual(float(pair[5]) / (2 * beta * math.sqrt(mass / 2 * 1e5)), 1, places=12)
        self.assertAlmostEqual(float(wall[7]) / (2 * beta * math.sqrt(mass * 1e5)), 1, places=12)
        (pair,) = commands(case | {"damping": "critical"}, "pair_coeff")
        self.assertAlmostEqual(float(pair[5]) / (2 * math.sqrt(mass * 1e5)), 1, places=12)
        self.assertAlmostEqual(float(pair[5]) * float(pair[9]) / (2 * math.sqrt(mass * 4e4)), 1, places=12)

    def test_rolling_resistance(self):
        linear = {"normal": "linear", "normal_stiffness": 1e5, "tangential_stiffness": 4e4, "rolling_friction": 0.05}
        case = case_of("settle", **linear)
        (pair,), (pipe,), (ends,) = commands(case, "pair_coeff"), commands(case, "fix wall"), commands(case, "fix ends")
        self.assertEqual(pair[11:], ["rolling", "sds", "40000.0", pair[5], "0.05", "damping", "velocity"])  # dashpot: that of sliding
        self.assertEqual(ends[13:-3], ["rolling", "sds", "40000.0", ends[7], "0.05", "damping", "velocity"])
        # Inside the pipe LAMMPS takes another effective radius for displacement and torque: the torque must be that of a flat wall.
        effective = 0.005 * 0.075 / 0.07
        stiffness, damping, friction = map(float, pipe[15:18])
        self.assertAlmostEqual(stiffness * effective**2 / (4e4 * 0.005**2), 1, places=12)
        self.assertAlmostEqual(damping * effective**2 / (float(ends[7]) * 0.005**2), 1, places=12)
        self.assertAlmostEqual(friction * effective / (0.05 * 0.005), 1, places=12)
        (pair,) = commands(case | {"damping": "critical"}, "pair_coeff")
        self.assertAlmostEqual(float(pair[14]) / (2 * math.sqrt(law_of(case).mass * 4e4)), 1, places=12)
        for walls, of_pair, of_wall in (
            ({"wall_rolling_friction": 0.0}, True, False),
            ({"wall_friction": 0.0}, True, False),  # a wall that turns nothing
            ({"rolling_friction": 0.0, "wall_rolling_friction": 0.02}, False, True),
        ):
            case = case_of("settle", **linear | walls)
            (pair,), (pipe,), (ends,) = commands(case, "pair_coeff"), commands(case, "fix wall"), commands(case, "fix ends")
            self.assertEqual(("rolling" in pair, "rolling" in pipe, "rolling" in ends), (of_pair, of_wall, of_wall))
        self.assertNotIn("rolling", " ".join(commands(case_of("settle"), "pair_coeff")[0]))

    def test_peers_are_not_given_rolling_resistance(self):
        header = (HEADERS / "pipe_bed.hpp").read_text()
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "rolling.hpp"
            path.write_text(header)
            self.assertEqual(read_case(path)["wall_rolling_friction"], 0)
            path.write_text(header.replace("  // contact law", "  static constexpr double rolling_friction = 0x1p-4;\n  // contact law"))
            with self.assertRaisesRegex(SystemExit, "rolling_friction is 0.0625; the peers can be given 0 only"):
                read_case(path)
            self.assertEqual(read_header(path)["wall_rolling_friction"], 0.0625)

    def test_what_cannot_be_given_is_refused_with_a_way_out(self):
        for changed, said, way_out in (
            ({"slider": "paper"}, 'slider = "paper"', '"clip"'),
            ({"friction_limit": "elastic"}, 'friction_limit = "elastic"', '"total"'),
            ({"rolling_friction": 0.05}, 'rolling_friction = 0.05 with normal = "hertz"', 'normal = "linear"'),
            ({"wall_rolling_friction": 0.05}, "wall_rolling_friction = 0.05", 'normal = "linear"'),
            ({"wall_restitution": 0.05}, "wall_restitution = 0.05", "wall_restitution between 0.12"),
            ({"ends": "open"}, 'ends = "open"', '"periodic"'),
            ({"restitution": 0.05}, "restitution = 0.05", "0.12"),
            ({"restitution": 0.99999}, "restitution = 0.99999", "choose 1"),
            ({"normal": "linear", "tangential": "force"}, 'tangential = "force"', '"displacement"'),
        ):
            self.assertIn(said, refusal(case_of("settle", **changed)))
            self.assertIn(way_out, refusal(case_of("settle", **changed)))
        self.assertIsNone(refusal(case_of("settle", slider="paper", friction=0.0)))

    def test_gas_that_is_not_constant_or_not_level_is_refused_with_a_way_out(self):
        for changed, said, way_out in (
            ({"gas_velocity_in_time": "{{0x0p+0, 0x1p+0}, {0x1p+0, 0x1p+1}}"}, "bulk_velocity in time", "a number"),
            ({"gas_compressible": True}, "compressible = true", "leave [gas] compressible out"),
            ({"gravity": (0.0, -8.5, -4.9)}, "an inclined pipe", "[0, -g, 0]"),
        ):
            self.assertIn(said, refusal(case_of("plug_u24", **changed)))
            self.assertIn(way_out, refusal(case_of("plug_u24", **changed)))
        self.assertIsNone(refusal(case_of("plug_u24")))
        self.assertIsNone(refusal(case_of("plug_u24", particle_count=1, gravity=(0.0, 0.0, -9.81))))


class Scenes(unittest.TestCase):
    def test_every_shipped_case_is_exported_or_refused_as_the_readme_says(self):
        table = (root / "tools" / "lammps" / "README.md").read_text()
        names = sorted(path.stem for path in (root / "cases").glob("*.toml"))
        for name in names:
            (verdict,) = re.findall(rf"(?m)^\| `{name}` \| (exported|refused)", table)
            self.assertEqual("refused" if refusal(case_of(name)) else "exported", verdict, name)
            if verdict == "exported":
                self.assertIn("scene.in", texts_of(case_of(name)))
        self.assertEqual(len(re.findall(r"(?m)^\| `\w+` \| (?:exported|refused)", table)), len(names))

    def test_the_script_says_what_it_is_not(self):
        scene = texts_of(case_of("settle"))["scene.in"]
        self.assertIn("Contact histories start empty", scene)
        self.assertIn("From case settle of fixdem and a test.", scene)

    def test_box_ends_weight_and_step(self):
        closed, periodic, bare = (texts_of(case_of(name))["scene.in"] for name in ("settle", "pipe_bed", "collide_pair"))
        self.assertIn("\nboundary f f f\n", closed)
        self.assertIn("\nboundary f f p\n", periodic)
        self.assertIn("\nboundary m m p\n", bare)
        self.assertIn("\nfix weight all gravity 9.81 vector 0.0 -9.81 0.0\n", closed)
        self.assertNotIn("gravity", bare)
        self.assertIn("\ntimestep 2e-06\n", closed)

    def test_there_is_one_run_and_its_length_can_be_changed(self):
        steps = texts_of(case_of("settle"))["steps.in"]
        self.assertEqual(len(re.findall(r"(?m)^run ", steps)), 1)
        self.assertIn("variable steps index 100000\n", steps)
        self.assertIn("variable frames index 2500 ", steps)

    def test_the_gas_is_called_when_slices_or_floaters_are_due(self):
        case = case_of("plug_u24", gas_update_interval=6, gas_floater_interval=21)
        texts = texts_of(case)
        self.assertIn("\ngroup floating empty\nfix gas all external pf/callback 3 1\n", texts["scene.in"])
        self.assertNotIn("run.in", texts)  # LAMMPS alone could not run it
        cutoff = float(re.search(r"comm_modify cutoff (\S+)", texts["scene.in"])[1])
        self.assertGreaterEqual(cutoff, (NEAR_REACH + SKIN) * case["diameter"])

    def test_copies_only_along_a_periodic_pipe(self):
        self.assertIn("\nreplicate 1 1 100\n", texts_of(case_of("pipe_bed"), 100)["scene.in"])
        with self.assertRaisesRegex(Refused, "periodic"):
            texts_of(case_of("settle"), 2)

    def test_a_state_of_another_number_of_particles_is_refused(self):
        case = case_of("settle")
        with self.assertRaisesRegex(Refused, "149 particles and the case 150"):
            files(case, still(149), "a test")


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def export(self, *options, case="settle", state=None):
        path = self.folder / "state"
        path.write_bytes(state_file(150) if state is None else state)
        command = [EXPORT, "--header", HEADERS / f"{case}.hpp", "--state", path, "--out", self.folder / "out", *options]
        return subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)

    def test_writes_all_files_and_takes_old_results_away(self):
        (self.folder / "out").mkdir()
        (self.folder / "out" / "final.lammpstrj").write_text("of an earlier run")
        self.assertEqual(self.export().returncode, 0)
        self.assertEqual({path.name for path in (self.folder / "out").iterdir()}, {"data", "scene.in", "steps.in", "run.in"})

    def test_bad_input_is_named_and_nothing_written(self):
        for wrong, said in (
            (self.export(state=b"nothing"), "first bytes"),
            (self.export(state=state_file(150)[:500]), "cut short"),
            (self.export(state=state_file(3)), "3 particles and the case 150"),
            (self.export("--repeat", "2"), "periodic"),
        ):
            self.assertEqual(wrong.returncode, 3)
            self.assertIn(said, wrong.stderr)
            self.assertFalse((self.folder / "out").exists())
        self.assertEqual(self.export("--repeat", "0").returncode, 2)
        missing = self.export("--state", str(self.folder / "none"))
        self.assertEqual(missing.returncode, 6)
        self.assertIn("none", missing.stderr)

    def test_a_run_is_summed_up(self):
        case = case_of("collide_pair")
        (self.folder / "log.lammps").write_text("LAMMPS (1 Apr 2020)\nLoop time of 0.5 on 2 procs for 1000 steps with 2 atoms\n\n98.5% CPU use with 2\n")
        columns = "ITEM: ATOMS id x y z vx vy vz omegax omegay omegaz\n"
        (self.folder / "final.lammpstrj").write_text(columns + "2 0 0 0.0599 0 0 -1 0 0 0\n1 0 0 0.05 0 0 3 0 0 0\n")
        (self.folder / "plug.json").write_text('{"front_velocity": null}')
        found = json.loads(json.dumps(run_lammps.summary(self.folder, case, 2)))
        self.assertEqual(found["performance"], {"wall_time": 0.5, "processor_share": 0.985, "particle_steps_per_second": 4000.0})
        self.assertEqual((found["final"]["contacts"], found["final"]["mean_axial_velocity"], found["ranks"]), (1, 1.0, 2))
        self.assertAlmostEqual(found["final"]["kinetic_energy"], 0.5 * law_of(case).mass * 10, places=15)
        with self.assertRaisesRegex(run_lammps.Failed, "2 ranks instead of 4"):
            run_lammps.summary(self.folder, case, 4)
        (self.folder / "log.lammps").write_text("LAMMPS (1 Apr 2020)\nERROR\n")
        with self.assertRaisesRegex(run_lammps.Failed, "did not end"):
            run_lammps.summary(self.folder, case, 2)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    HEADERS = Path(sys.argv[1]).resolve() / "cases"
    counted.run_and_count(*sys.argv[2:3])
