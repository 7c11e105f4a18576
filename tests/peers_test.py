#!/usr/bin/env python3
"""What tools/peers writes for other programs and reads from them; none of those programs is needed.

Usage: tests/peers_test.py [COUNT_FILE]. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed.
"""

import math
import struct
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

root = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path[:0] = [str(root / "tests"), str(root / "tools" / "peers"), str(root / "tools" / "report")]

import counted  # noqa: E402
import rates  # noqa: E402
from case_values import law_of, read_case  # noqa: E402
from checking import Check, check_bed, worst  # noqa: E402
from derived_cases import derived, with_value  # noqa: E402
from lammps_law import tsuji_argument, tsuji_polynomial  # noqa: E402
from marked_part import KeptTable, MarkedPart  # noqa: E402
from peer_inputs import Stretch, data_file, script  # noqa: E402
from states import Observed, State, count_contacts, read_dump, read_final  # noqa: E402

HEADER = """
  static constexpr const char* name = "small";
  static constexpr unsigned long long seed = 1ULL;
  static constexpr int particle_count = 2;
  static constexpr double diameter = 0x1.47ae147ae147bp-7;  // 0.01 m
  static constexpr double density = 0x1.f4p+9;
  static constexpr double youngs_modulus = 0x1.65a0bcp+31;
  static constexpr double poisson_ratio = 0x1.51eb851eb851fp-2;
  static constexpr double restitution = 0x1.ccccccccccccdp-1;
  static constexpr double friction = 0x1.3333333333333p-2;
  static constexpr double wall_youngs_modulus = 0x1.65a0bcp+31;
  static constexpr double wall_poisson_ratio = 0x1.51eb851eb851fp-2;
  static constexpr NormalLaw normal = NormalLaw::hertz;
  static constexpr TangentialLaw tangential = TangentialLaw::displacement;
  static constexpr DampingMass damping_mass = DampingMass::reduced;
  static constexpr Damping damping = Damping::restitution;
  static constexpr double pipe_diameter = 0x1.999999999999ap-5;
  static constexpr double pipe_length = 0x1.999999999999ap-1;
  static constexpr Ends ends = Ends::periodic;
  static constexpr bool has_wall = true;
  static constexpr bool has_gas = false;
  static constexpr double gravity[3] = {0x0p+0, -0x1.39eb851eb851fp+3, 0x0p+0};  // 0, -9.81, 0 m/s2
  static constexpr double time_step = 0x1.0c6f7a0b5ed8dp-19;
"""
STATE = State(
    positions=[(0.001, -0.0123456789012345, 0.1), (0.0, 0.0, 0.7)],
    velocities=[(0.1, 0.2, -0.3), (1.0, 0.0, 0.0)],
    spins=[(4.0, 5.0, 1e-17), (0.0, 0.0, 0.0)],
)


class WithFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def file(self, content, name="file"):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def case(self, header=HEADER):
        return read_case(self.file(header, "case.hpp"))


class Cases(WithFolder):
    def test_a_header_reads_back(self):
        case = self.case()
        values = [case[key] for key in ("name", "seed", "diameter", "has_wall", "ends")]
        self.assertEqual(values, ["small", 1, 0.01, True, "periodic"])
        self.assertEqual(case["gravity"], (0.0, -9.81, 0.0))

    def test_what_peers_cannot_be_given_is_refused(self):
        with self.assertRaisesRegex(SystemExit, "normal is linear"):
            self.case(HEADER.replace("NormalLaw::hertz", "NormalLaw::linear"))
        with self.assertRaisesRegex(SystemExit, "no has_gas"):
            self.case(HEADER.replace("has_gas", "gas"))

    def test_the_law_has_the_stiffnesses_of_table_2(self):
        law = law_of(self.case())
        self.assertAlmostEqual(law.normal_pair / 1.122e8, 1, places=3)
        self.assertAlmostEqual(law.normal_wall / 1.587e8, 1, places=3)
        # k_t / k_n with k_n = (3/2) K sqrt(overlap): 0.80 between spheres, 1.60 at the wall
        self.assertAlmostEqual(law.tangential_pair / (1.5 * law.normal_pair), 0.80, places=2)
        self.assertAlmostEqual(law.tangential_wall / (1.5 * law.normal_wall), 1.60, places=2)
        self.assertAlmostEqual(law.alpha, 0.07495, places=5)

    def test_derived_cases_change_what_they_should(self):
        text = (root / "cases" / "pipe_bed.toml").read_text()
        cases = derived(text, "pipe_bed")
        self.assertEqual(set(cases), {"agitated", "bed_settle", "bed", "impacts"})
        for case in cases.values():
            self.assertEqual(case.count("energy_ledger = false"), 1)
            self.assertNotIn("frame_interval", case)
        self.assertIn('arrangement = "random"', cases["agitated"])
        self.assertNotIn("arrangement", cases["bed"] + cases["bed_settle"] + cases["impacts"])
        self.assertIn("count = 9\n", cases["impacts"])
        self.assertEqual(cases["impacts"].count("[[start.particle]]"), 9)
        self.assertEqual(with_value("[a]\nx = 1  # m\n\n[b]\nx = 2\n", "b", "x", 3), "[a]\nx = 1  # m\n\n[b]\nx = 3\n")


class Inputs(WithFolder):
    def test_the_damping_argument_is_inverted(self):
        argument = tsuji_argument(0.07495)
        self.assertAlmostEqual(tsuji_polynomial(argument), 0.07495, places=12)
        # the trap that it avoids: 0.9 itself damps so little that 0.928 comes back
        scaled = tsuji_polynomial(0.9) / math.sqrt(5)
        self.assertAlmostEqual(math.exp(-math.pi * scaled / math.sqrt(1 - scaled**2)), 0.928, places=3)
        with self.assertRaisesRegex(SystemExit, "restitution"):
            tsuji_argument(1.5)

    def test_particles_read_back_exactly(self):
        lines = data_file(self.case(), STATE).splitlines()
        self.assertIn("2 atoms", lines)
        row = lines[lines.index("Atoms") + 2].split()
        self.assertEqual(tuple(map(float, row[2:])), (0.01, 1000.0, *STATE.positions[0]))
        row = lines[lines.index("Velocities") + 2].split()
        self.assertEqual(tuple(map(float, row[1:])), (*STATE.velocities[0], *STATE.spins[0]))

    def test_only_the_steps_stand_between_the_meters(self):
        case = self.case()
        for program in ("lammps", "liggghts"):
            lines = script(program, case, law_of(case), Stretch(100, 200, 2e-6), 1e-4).splitlines()
            before = next(i for i, line in enumerate(lines) if line.endswith("> before'"))
            self.assertEqual(lines[before - 1], "run 100")
            self.assertEqual(lines[before + 1], "run 200 pre no")
            self.assertTrue(lines[before + 2].endswith("> after'"))
            self.assertGreater(next(i for i, line in enumerate(lines) if line.startswith("dump ")), before + 2)
            self.assertIn("fix weight all gravity 9.81 vector 0.0 -9.81 0.0", lines)

    def test_stiffnesses_reach_lammps_without_the_radius(self):
        case = self.case()
        law = law_of(case)
        lines = script("lammps", case, law, Stretch(0, 1, 2e-6), 1e-4).splitlines()
        pair = next(line for line in lines if line.startswith("pair_coeff")).split()
        wall = next(line for line in lines if line.startswith("fix wall")).split()
        self.assertAlmostEqual(float(pair[4]) * math.sqrt(0.0025) / law.normal_pair, 1, places=12)
        self.assertAlmostEqual(float(wall[6]) * math.sqrt(0.005 * 0.05 / 0.045) / law.normal_wall, 1, places=12)
        self.assertAlmostEqual(float(wall[10]) * math.sqrt(0.005 * 0.05 / 0.045) / law.tangential_wall, 1, places=12)


class States(WithFolder):
    def final(self):
        flat = [c for rows in (STATE.positions, STATE.velocities, STATE.spins) for row in rows for c in row]
        head = b"FIXDEM\x1a\n" + struct.pack("<III", 0x01020304, 1, 5) + b"small" + struct.pack("<QIIQdddQ", 7, 1, 0, 2, 0.01, 0, 1, 3)
        return head + struct.pack("<18d", *flat) + struct.pack("<iiQQ", 0, 0, 0, 99)

    def test_a_final_state_reads_back(self):
        self.assertEqual(read_final(self.file(self.final())), STATE)
        rolling = self.final().replace(b"\1\0\0\0\5", b"\2\0\0\0\5")
        self.assertEqual(read_final(self.file(rolling)), STATE)

    def test_other_files_are_no_final_states(self):
        later = self.final().replace(b"\1\0\0\0\5", b"\5\0\0\0\5")
        for content, message in ((b"nothing", "first bytes"), (self.final()[:100], "cut short"), (later, "version 5")):
            with self.assertRaisesRegex(SystemExit, message):
                read_final(self.file(content))

    def test_a_dump_is_put_in_order_and_its_last_frame_taken(self):
        columns = "ITEM: ATOMS id x y z vx vy vz omegax omegay omegaz\n"
        frame = "".join(f"{n} {' '.join(f'{value + n}' for value in range(9))}\n" for n in (2, 1))
        old = columns + frame.replace(".", "9.") + "ITEM: TIMESTEP\n5\n"
        state = read_dump(self.file(old + columns + frame))
        self.assertEqual(state.positions, [(1.0, 2.0, 3.0), (2.0, 3.0, 4.0)])
        self.assertEqual(state.spins[1], (8.0, 9.0, 10.0))
        with self.assertRaisesRegex(SystemExit, "missing"):
            read_dump(self.file(columns + frame.splitlines()[0]))

    def test_contacts_are_counted_across_the_ends_and_at_the_wall(self):
        case = self.case()
        self.assertEqual(count_contacts(case, [(0, 0, 0.001), (0, 0, 0.795), (0, 0, 0.4), (0, 0.0099, 0.4)]), 2)
        self.assertEqual(count_contacts(case, [(0, 0, 0.001), (0, 0, 0.790)]), 0)
        self.assertEqual(count_contacts(case, [(0.0, -0.02001, 0.1), (0.0, -0.01999, 0.5)]), 1)


class Verdicts(WithFolder):
    def test_what_is_no_number_disagrees(self):
        self.assertFalse(Check("", 1.0, math.nan, 1.0, "").holds)
        self.assertFalse(worst("", 0.1, "", [1.0, 2.0, 3.0], [1.0, math.nan, 3.0]).holds)

    def test_the_maximum_difference_counts(self):
        check = worst("", 0.1, "", [1.0, 2.0, 3.0], [1.0, 2.5, 3.2])
        self.assertEqual((check.ours, check.theirs, check.holds), (2.0, 2.5, False))

    def test_two_beds_in_the_same_motion_are_not_at_rest(self):
        case = self.case()
        checks = check_bed(case, law_of(case), Observed(1e-3, 100, 0.017), Observed(1e-3, 100, 0.017))
        self.assertEqual([check.holds for check in checks], [False, True, True])

    def test_ratios_are_of_best_runs(self):
        rows = rates.rows_of("bed", {"fixdem": [0.2, 0.1], "lammps": [2.0, 1.0, 3.0]}, 1000, {"fixdem": "", "lammps": "skin"})
        self.assertEqual([(row.best, row.ratio) for row in rows], [(10000.0, 1.0), (1000.0, 10.0)])
        rows = rates.rows_of("bed", {"fixdem": [0.5, 0.25], "lammps": [4.0, 5.0]}, 4e6, {"fixdem": "", "lammps": "skin"})
        self.assertEqual(rates.table(rows).splitlines()[-1], "| `bed` | lammps | 2 | 1.00 | 0.80 (-20%) | 16.00 | skin |")

    def test_a_processor_has_a_row_of_ratios_to_lammps_beside_those_of_others(self):
        rows, remarks = [], {"fixdem": "", "lammps": "", "liggghts": ""}
        for scene, lammps in (("bed", 3.8), ("agitated", 1.5)):
            rows += rates.rows_of(scene, {"fixdem": [0.25], "lammps": [lammps], "liggghts": [9]}, 1000, remarks)
        with mock.patch("rates.machine", return_value="Chip (family 1, model 2), AVX2"):
            row = rates.expected_row(rows)
        self.assertEqual(row, ["Chip (family 1, model 2)", "AVX2", "15.2", "6.0"])
        kept = KeptTable(self.file((root / "README.md").read_text()), "processors", rates.EXPECTED, 2)
        before = kept.rows()
        kept.put([row])
        self.assertEqual(kept.rows(), sorted([*before, row]))
        self.assertTrue(all(float(ratio) > 1 for others in before for ratio in others[2:]))

    def test_a_readme_without_marks_is_refused_and_one_with_keeps_the_rest(self):
        with self.assertRaisesRegex(SystemExit, "no line"):
            MarkedPart(self.file("<!-- end -->\n<!-- peers -->\n"), "peers")
        path = self.file("a\n<!-- peers -->\nold\n<!-- end -->\nb\n<!-- end -->\n")
        MarkedPart(path, "peers").write("new\n")
        self.assertEqual(path.read_text(), "a\n<!-- peers -->\nnew\n<!-- end -->\nb\n<!-- end -->\n")


if __name__ == "__main__":
    counted.run_and_count(*sys.argv[1:2])
