#!/usr/bin/env python3
"""What tools/lammps writes for particles of several sizes, and refuses; LAMMPS itself is not needed.

Usage: tests/lammps_sizes_test.py BUILD_FOLDER [COUNT_FILE]: the folder with cases/ of the shipped cases' headers. Writes
"PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed. `make test-lammps` asks LAMMPS.
"""

import math
import re
import struct
import sys
import tempfile
import unittest
from pathlib import Path

root = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path[:0] = [str(root / part) for part in ("tests", "tools/peers", "tools/lammps")]

import counted  # noqa: E402
from case_values import kinds_of, law_of, read_case, read_header, spheres_of  # noqa: E402
from lammps_law import law_commands, refusal  # noqa: E402
from scene_files import SKIN, Refused, files  # noqa: E402
from states import State, count_contacts, observe, read_final  # noqa: E402

HEADERS = Path()
LINEAR = {"normal": "linear", "normal_stiffness": 1e5, "tangential_stiffness": 4e4}
SIZES = """  static constexpr double largest_diameter = 0x1.47ae147ae147bp-7;  // 0.01 m
  static constexpr int species_count = 2;
  static constexpr const char* species_names[] = {"large", "small"};
  static constexpr SizeRun sizes[] = {
      {2, 0x1.47ae147ae147bp-7, 0x1.f4p+9, 0},
      {1, 0x1.47ae147ae147bp-8, 0x1.f4p+9, 1},
      {1, 0x1.47ae147ae147bp-7, 0x1.f4p+9, 0},
  };  // count, diameter, density, species
"""


class WithHeader(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        text = (HEADERS / "settle.hpp").read_text()
        text = re.sub(r"(?m)^.*constexpr double (diameter|density) = .*\n", "", text)
        text = re.sub(r"particle_count = \d+;\n", "particle_count = 4;\n" + SIZES, text)
        self.header = self.folder / "sizes.hpp"
        self.header.write_text(text)
        self.case = read_header(self.header)

    def state(self, diameters=(0.01, 0.01, 0.005, 0.01), densities=(1000.0,) * 4):
        zeros = [(0.0, 0.0, 0.0)] * 4
        places = [(0.0, 0.0, 0.01), (0.0, 0.0, 0.0199), (0.0, 0.0074, 0.01), (0.0, 0.0, 0.05)]
        return State(places, zeros, zeros, list(diameters), list(densities))


class Values(WithHeader):
    def test_every_particle_has_its_size(self):
        self.assertEqual([(s.diameter, s.species) for s in spheres_of(self.case)], [(0.01, 0), (0.01, 0), (0.005, 1), (0.01, 0)])
        self.assertEqual([kind.diameter for kind in kinds_of(self.case)], [0.01, 0.005])
        repeated = spheres_of(self.case | {"particle_count": 8})
        self.assertEqual(repeated[:4], repeated[4:])

    def test_the_law_is_that_of_each_kind(self):
        large, small = (law_of(self.case, kind) for kind in kinds_of(self.case))
        self.assertAlmostEqual(small.mass / large.mass, 1 / 8, places=12)
        self.assertAlmostEqual(small.normal_pair / large.normal_pair, math.sqrt(0.5), places=12)
        self.assertAlmostEqual(large.normal_pair / 1.122208506e8, 1, places=9)

    def test_contacts_and_energy_are_of_the_own_radii(self):
        state = self.state()
        self.assertEqual(count_contacts(self.case, state.positions), 2)  # 9.9 mm below 10, 7.4 below 7.5
        moving = State(state.positions, [(0.0, 0.0, 1.0)] * 4, [(1.0, 0.0, 0.0)] * 4)
        large, small = (law_of(self.case, kind) for kind in kinds_of(self.case))
        energy = sum(0.5 * n * law.mass * (1 + 0.4 * law.radius**2) for n, law in ((3, large), (1, small)))
        self.assertAlmostEqual(observe(self.case, moving).kinetic_energy / energy, 1, places=12)

    def test_other_programs_are_given_one_size_only(self):
        with self.assertRaisesRegex(SystemExit, "several sizes; the peers can be given one size only"):
            read_case(self.header)


class Law(WithHeader):
    def lines(self, start, **changed):
        return [line.split() for line in law_commands(self.case | changed) if line.startswith(start)]

    def test_hertz_has_one_line_for_all_pairs(self):
        (pair,) = self.lines("pair_coeff")
        self.assertEqual(pair[1:4], ["*", "*", "hertz"])
        # 4/3 of the effective modulus, whatever the radii: stiffness 9.162794085e7 for 10 mm with 5 mm.
        self.assertAlmostEqual(float(pair[4]) * math.sqrt(0.005 * 0.0025 / 0.0075) / 9.162794085e7, 1, places=9)

    def test_each_kind_has_its_walls(self):
        groups, pipes, ends = self.lines("group"), self.lines("fix wall"), self.lines("fix ends")
        self.assertEqual([group[1:] for group in groups], [["kind_1", "type", "1"], ["kind_2", "type", "2"]])
        self.assertEqual([(fix[1], fix[2]) for fix in pipes + ends],
                         [("wall_1", "kind_1"), ("wall_2", "kind_2"), ("ends_1", "kind_1"), ("ends_2", "kind_2")])  # fmt: skip
        for kind, pipe, end in zip(kinds_of(self.case), pipes, ends):
            law, r = law_of(self.case, kind), kind.radius
            self.assertAlmostEqual(float(end[6]) * math.sqrt(r) / law.normal_wall, 1, places=12)
            self.assertAlmostEqual(float(pipe[6]) * math.sqrt(r * 0.075 / (0.075 - r)) / law.normal_wall, 1, places=12)

    def test_the_linear_dashpot_is_that_of_each_pair_of_types(self):
        pairs = self.lines("pair_coeff", **LINEAR)
        self.assertEqual([pair[1:3] for pair in pairs], [["1", "1"], ["1", "2"], ["2", "2"]])
        beta = -math.log(0.9) / math.hypot(math.pi, math.log(0.9))
        large, small = (kind.mass for kind in kinds_of(self.case))
        for pair, mass in zip(pairs, (large / 2, large * small / (large + small), small / 2)):
            self.assertAlmostEqual(float(pair[5]) / (2 * beta * math.sqrt(mass * 1e5)), 1, places=12)
        critical = self.lines("pair_coeff", damping="critical", **LINEAR)
        self.assertAlmostEqual(float(critical[1][5]) / (2 * math.sqrt(2 * large * small / (large + small) * 1e5)), 1, places=12)
        walls = self.lines("fix ends", **LINEAR)
        self.assertAlmostEqual(float(walls[1][7]) / (2 * beta * math.sqrt(small * 1e5)), 1, places=12)

    def test_what_cannot_be_given_is_refused_with_a_way_out(self):
        for changed, said, way_out in (
            ({"species_count": 0}, "[particles.sizes]", "[[particles.species]]"),
            ({"has_gas": True}, "gas with particles of several sizes", "leave [gas] out"),
        ):
            self.assertIn(said, refusal(self.case | changed))
            self.assertIn(way_out, refusal(self.case | changed))
        self.assertIsNone(refusal(self.case))


class Scenes(WithHeader):
    def test_data_have_types_diameters_and_densities(self):
        texts = files(self.case, self.state(), "a test")
        self.assertIn("\n2 atom types\n", texts["data"])
        self.assertIn("\n2 1 0.01 1000.0 0.0 0.0 0.0199\n3 2 0.005 1000.0 0.0 0.0074 0.01\n", texts["data"])
        self.assertIn(f"\nneighbor {SKIN * 0.005!r} bin\n", texts["scene.in"])
        self.assertEqual(texts["steps.in"].count("omegaz type radius"), 2)

    def test_a_state_of_other_particles_is_refused(self):
        for state, said in (
            (self.state(diameters=(0.01, 0.01, 0.006, 0.01)), "particle 2 has diameter 0.006 in the state and 0.005 in the case"),
            (self.state(densities=(1000.0, 2000.0, 1000.0, 1000.0)), "particle 1 has density 2000 in the state and 1000 in the case"),
        ):
            with self.assertRaisesRegex(Refused, said):
                files(self.case, state, "a test")

    def test_a_state_file_says_diameters_and_densities(self):
        state, count = self.state(), 4
        head = b"FIXDEM\x1a\n" + struct.pack("<III", 0x01020304, 3, 1) + b"x" + struct.pack("<QIIQdddQ", 7, 1, 0, count, 0.01, 0, 1, 3)
        flat = [c for place in state.positions for c in place] + [0.0] * (6 * count)
        body = struct.pack(f"<{9 * count}d", *flat) + struct.pack(f"<{count}i", *[0] * count)
        body += struct.pack(f"<{2 * count}d", *state.diameters, *state.densities)
        path = self.folder / "final.fixdem"
        path.write_bytes(head + body + struct.pack("<QQ", 0, 99))
        found = read_final(path)
        self.assertEqual((found.positions, found.diameters, found.densities), (state.positions, state.diameters, state.densities))
        path.write_bytes(head + body[:-40])
        with self.assertRaisesRegex(SystemExit, "cut short"):
            read_final(path)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    HEADERS = Path(sys.argv[1]).resolve() / "cases"
    counted.run_and_count(*sys.argv[2:3])
