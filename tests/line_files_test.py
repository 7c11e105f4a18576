#!/usr/bin/env python3
"""What tools read of an open line (tools/python/slices.py, columns.py), and the table of tools/line_table: whole files, damaged
ones and empty ones, without a run of the program.

Usage: tests/line_files_test.py [COUNT_FILE]. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed.
"""

import json
import math
import subprocess
import sys
import tomllib
from pathlib import Path

root = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
for folder in ("tools/report", "tools/python", "tools/line_table"):
    sys.path.insert(0, str(root / folder))

import line_folder  # noqa: E402
import line_table  # noqa: E402
from columns import FixdemError, read_columns, read_plugs, read_probes  # noqa: E402
from counted import run_and_count  # noqa: E402
from slices import Slices, fronts_of, track  # noqa: E402
from with_folder import WithFolder  # noqa: E402
from with_seed import with_seed  # noqa: E402

LINE = line_folder.Line(duration=2.0)


class Refusing(WithFolder):
    def refuses(self, action, *words):
        with self.assertRaises((FixdemError, SystemExit)) as said:
            action()
        for word in words:
            self.assertIn(str(word), str(said.exception))


class SlicesFile(Refusing):
    def file(self, data):
        path = self.folder / "slices.bin"
        path.write_bytes(data)
        return path

    def test_all_comes_back(self):
        slices = Slices(self.file(line_folder.slices_bytes(LINE)))
        self.assertEqual((len(slices.times), slices.count, slices.length), (101, 200, 0.01))
        self.assertEqual(slices.units, line_folder.SLICE_QUANTITIES)
        solids = [round(value, 6) for value in slices.values["solids_fraction"][50]]
        self.assertEqual(solids, LINE.solids(slices.times[50]))
        self.assertTrue(math.isnan(slices.values["particle_velocity"][0][-1]))
        self.assertAlmostEqual(slices.centres()[7], 0.075)

    def test_either_order_of_bytes(self):
        one, other = (Slices(self.file(line_folder.slices_bytes(LINE, order=order))) for order in "<>")
        self.assertEqual((one.times, one.values["pressure"]), (other.times, other.values["pressure"]))

    def test_a_run_that_has_only_begun_has_no_moments(self):
        head = line_folder.slices_bytes(LINE).partition(b"\n")[0]
        self.assertEqual(Slices(self.file(head + b"\n")).times, [])

    def test_damaged_files_are_refused_with_their_name(self):
        path = self.folder / "slices.bin"
        self.refuses(lambda: Slices(path), path, "slice_interval")
        whole = line_folder.slices_bytes(LINE)
        head, _, records = whole.partition(b"\n")
        about = json.loads(head)
        for size in (0, 1, 20, len(head) // 2, len(head), len(head) + 2, len(whole) - 1, len(whole) - 804):
            self.refuses(lambda data=whole[:size]: Slices(self.file(data)), path)
        self.refuses(lambda: Slices(self.file(b"PK\x03\x04\n")), path, "fixdem slices")
        self.refuses(lambda: Slices(self.file(b"[1, 2]\n")), path, "fixdem slices")
        for changed in ({"version": 2}, {"slices": 0}, {"slices": -3}, {"slices": 1.5}, {"slices": 10**12}, {"slices": "200"}, {"slice_length": 0}, {"slice_length": "x"},
                        {"byte_order": "middle"}, {"quantities": None}, {"quantities": [1]}, {"quantities": about["quantities"] * 2}):  # fmt: skip
            self.refuses(lambda changed=changed: Slices(self.file(json.dumps(about | changed).encode() + b"\n" + records)), path)
        record = len(records) // 101
        self.refuses(lambda: Slices(self.file(head + b"\n" + records[record : 2 * record] + records)), path, "do not ascend")
        self.refuses(lambda: Slices(self.file(head + b"\n" + b"\xff" * record)), path, "do not ascend")

    def test_as_a_table(self):
        path = self.file(line_folder.slices_bytes(LINE))
        command = [sys.executable, root / "tools" / "python" / "slices.py", path]
        rows = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
        self.assertEqual(rows[0], "time [s],z [m],solids_fraction,pressure [Pa above the outlet],particle_velocity [m/s]")
        self.assertEqual(len(rows), 1 + 101 * 200)
        self.assertEqual(rows[200], "0,1.995,0.22,5,")
        said = subprocess.run([*command, "heat"], capture_output=True, text=True, check=False)
        self.assertEqual(said.returncode, 1)
        self.assertIn("no quantity 'heat'; there are: solids_fraction, pressure", said.stderr)


class Columns(Refusing):
    def test_numbers_words_and_empty_cells(self):
        self.assertEqual(read_columns(self.write("a.csv", "t,what\n1,\n2e3,left\n")), {"t": [1.0, 2000.0], "what": [None, "left"]})
        self.assertEqual(read_columns(self.write("a.csv", "t\n")), {"t": []})

    def test_damage_is_named(self):
        path = self.folder / "a.csv"
        self.refuses(lambda: read_columns(path), path, "is missing")
        damaged = {
            "": "is empty", "\n": "is empty", "t,z\n1,2\n3": ":3: 1 values in 2 columns", "t,z\n1,2,3\n": ":2:", "t,z\n1,2\n3,4": ":3: the line has no end",
            't\n"' + 200_000 * "1" + "\n": "damaged",
        }  # fmt: skip
        for text, words in damaged.items():
            self.refuses(lambda text=text: read_columns(self.write("a.csv", text)), path, words)
        self.refuses(lambda: read_columns(self.write("a.csv", "t,z\n"), ["u"]), path, "no column 'u'; there are: t, z")
        self.refuses(lambda: read_columns(self.folder), self.folder, "cannot be read")
        path.write_bytes(b"t,z\n\x00\xff,2\n")
        self.assertEqual(len(read_columns(path)["t"]), 1)


class Plugs(Refusing):
    def test_plugs(self):
        self.write("plugs.csv", line_folder.plug_rows(LINE))
        *ran, young = read_plugs(self.folder)
        self.assertEqual([plug.fate for plug in ran], ["left", "present"])
        self.assertEqual((ran[0].front_velocity, ran[0].counts, ran[0].parent), (line_folder.W, True, None))
        self.assertEqual((young.fate, young.into, young.parent, young.length, young.counts), ("merged", 1, 0, None, False))
        self.write("plugs.csv", line_folder.PLUG_HEAD)
        self.assertEqual(read_plugs(self.folder), [])

    def test_damage(self):
        path = self.folder / "plugs.csv"
        text = line_folder.plug_rows(LINE)
        for damaged in (text.replace("\n0,", "\nx,"), text.replace("\n0,0,", "\n0,,"), text.replace("\n0,0,", "\n0,9,")):
            self.refuses(lambda damaged=damaged: (self.write("plugs.csv", damaged), read_plugs(self.folder)), path)

    def test_tracks_follow_the_fronts(self):
        path = self.folder / "slices.bin"
        path.write_bytes(line_folder.slices_bytes(LINE))
        self.write("plugs.csv", line_folder.plug_rows(LINE))
        slices, plugs = Slices(path), read_plugs(self.folder)
        fronts = fronts_of(slices.values["solids_fraction"], slices.length)
        for plug in plugs[:-1]:
            points = track(plug, slices.times, fronts)
            self.assertGreater(len(points), 40)
            self.assertLess(max(abs(z - line_folder.BORN_AT - line_folder.W * (t - plug.born)) for t, z in points), 0.011)
        self.assertEqual(track(plugs[0], [], []), [(0.0, 0.4), (plugs[0].last, plugs[0].last_at)])
        self.assertEqual(len(track(plugs[0], slices.times, [[] for _ in fronts])), len(track(plugs[0], slices.times, fronts)), "what is not found is expected")

    def test_a_curved_track_is_followed(self):
        class Slowing(line_folder.Line):
            def fronts(self, time):
                return [0.4 + 0.8 * time - 0.1 * time * time]

        line = Slowing(duration=2.0)
        (self.folder / "slices.bin").write_bytes(line_folder.slices_bytes(line))
        self.write("plugs.csv", line_folder.PLUG_HEAD + "0,0,0.4,,present,,2,1.6,99,1.2,0.6,0.5,0.24,1000,0.4,1\n")
        slices, (plug,) = Slices(self.folder / "slices.bin"), read_plugs(self.folder)
        points = track(plug, slices.times, fronts_of(slices.values["solids_fraction"], slices.length))
        self.assertLess(max(abs(z - line.fronts(t)[0]) for t, z in points), 0.011)

    def test_probes(self):
        case = LINE.case()
        line_folder.write_line(self.folder, LINE)
        one, other = read_probes(self.folder, case)
        self.assertEqual((one.position, other.position, len(one.time), len(other.time)), (1.0, 1.6, 201, 41))
        self.assertEqual((one.flow[0], one.passages[-1]), (None, 2.0))
        self.assertEqual(read_probes(self.folder, {}), [])
        (self.folder / "probe_1.csv").unlink()
        self.refuses(lambda: read_probes(self.folder, case), "probe_1.csv is missing")


class Table(Refusing):
    def case(self, seed):
        return with_seed((root / "cases" / "line_10mm.toml").read_text(), seed)

    def test_seeds_of_start_and_feed(self):
        for seed in (1, 7):
            case = tomllib.loads(self.case(seed))
            self.assertEqual((case["start"]["seed"], case["feed"]["seed"]), (seed, seed))
        plain = tomllib.loads((root / "cases" / "line_10mm.toml").read_text())
        self.assertEqual([probe["position"] for probe in plain["probe"]], [1.0, 1.6])
        for table in ("start", "feed"):
            case[table].pop("seed"), plain[table].pop("seed", None)
        self.assertEqual(case, plain)

    def run_of(self, line=LINE, **changed):
        folder = line_folder.write_line(self.folder / "run", line)
        summary = line_folder.summary(line)
        summary["line"] |= changed
        return line_table.LineRun(folder, line.case(), summary)

    def rows(self, runs):
        return {row[0]: row[1:] for row in line_table.table_rows(runs)}

    def test_figures_bands_and_words(self):
        line = line_folder.Line(duration=8.0)
        rows = self.rows({"seed 1": self.run_of(line), "seed 2": self.run_of(line, plug_velocity=0.99, layer_ratio_eq41=0.3)})
        self.assertEqual(rows["plug velocity W, m/s"], ["0.75 to 0.95", "0.87 ± 0.09", "0.99 ± 0.09", "**outside**: seed 2"])
        self.assertEqual(rows["particles in plugs V_p, m/s"][-1], "yes")
        self.assertEqual(rows["W - 0.967 V_p, m/s"], ["0.3 to 0.4", "0.348 ± 0.000", "0.468 ± 0.000", "**outside**: seed 2"])
        self.assertEqual(rows["layer ratio less that"], ["within 0.05 of 0", "-0.010", "+0.110", "**outside**: seed 2"])
        self.assertEqual(rows["layer ratio by eq. (41)"], ["-", "0.420", "0.300", "-"])
        self.assertEqual(rows["pressure at the inlet, kPa"][:2], ["1.7 to 2.5", "2.05 ± 0.21"])
        passed = float(rows["plugs per second at 1.0 m"][1])
        self.assertAlmostEqual(passed, 1 / line.every, delta=0.16)
        self.assertEqual(rows["plugs followed"][0], "-")
        self.assertEqual(list(rows)[:7].index("layer ratio less that"), list(rows).index("layer ratio by eq. (41)") + 1)

    def test_a_line_without_plugs_has_dashes_and_lies_outside(self):
        nothing = dict.fromkeys(("plug_velocity", "plug_particle_velocity", "plug_length", "layer_ratio", "layer_ratio_eq41", "plug_frequency"))
        rows = self.rows({"seed 1": self.run_of(**nothing, plugs=0)})
        for name in ("plug velocity W, m/s", "W - 0.967 V_p, m/s", "layer ratio less that"):
            self.assertEqual(rows[name][1:], ["-", "**outside**: seed 1"])

    def test_a_station_that_is_missing_is_asked_for(self):
        run = self.run_of()
        run.probes = run.probes[:1]
        self.refuses(lambda: line_table.table_rows({"seed 1": run}), "[[probe]]", "1.6 m")

    def test_the_command_runs_what_is_missing_and_writes_between_the_marks(self):
        line_folder.write_line(self.folder / "made", line_folder.Line(duration=8.0))
        (self.folder / "made" / "final.fixdem").touch()
        for seed in (1, 2):
            self.write(f"line_10mm_seed{seed}.toml", self.case(seed))
            (self.folder / "bin").mkdir(exist_ok=True)
            program = self.write(f"bin/line_10mm_seed{seed}", f'#!/bin/sh\necho "$@" >>{self.folder}/calls\nmkdir -p "$2"\ncp -r {self.folder}/made/. "$2"\n')
            program.chmod(0o755)
        readme = self.write("README.md", "before\n<!-- line table -->\nold\n<!-- end -->\nafter\n")
        command = [sys.executable, root / "tools" / "line_table" / "line_table.py", readme, "line_10mm_seed1", "line_10mm_seed2", "--cases", self.folder,
                   "--programs", self.folder / "bin", "--out", self.folder / "out"]  # fmt: skip
        for _ in range(2):
            subprocess.run(command, check=True, capture_output=True)
        text = readme.read_text()
        self.assertEqual(len((self.folder / "calls").read_text().splitlines()), 2)
        self.assertTrue(text.startswith("before\n<!-- line table -->\nRegenerated") and text.endswith("|\n<!-- end -->\nafter\n"))
        self.assertIn("| quantity | band | seed 1 | seed 2 | inside |", text)
        self.assertNotIn("\nold", text)


if __name__ == "__main__":
    run_and_count(*sys.argv[1:2])
