#!/usr/bin/env python3
"""The results of a run as NumPy arrays (tools/python/fixdem.py): what was written comes back with names and units. Needs no run of the program.

Usage: tests/python_reader_test.py [COUNT_FILE]. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed. Where there is no
NumPy, or no gnuplot, the tests that need them are skipped, and that is said.
"""

import copy
import math
import pickle
import shutil
import subprocess
import sys
import unittest
from importlib.util import find_spec
from pathlib import Path
from unittest import mock

root = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(root / "tools" / "python"))

import line_folder  # noqa: E402
from counted import run_and_count  # noqa: E402
from fixdem import Run  # noqa: E402
from made_up_run import CONTACTS, FRAME, LINE, WithRun, list_of, needs_numpy  # noqa: E402


@needs_numpy
class Arrays(WithRun):
    def test_log(self):
        log = self.line().log
        self.assertEqual((log.units["time"], log.units["max_speed"], log.units["coordination_number"]), ("s", "m/s", ""))
        self.assertEqual((len(log), log.time.shape, log["time"].dtype.kind, log["time"][-1]), (len(line_folder.LOG), (11,), "f", 1.0))
        self.assertTrue(math.isnan(log.asked_rate[0]) and log["asked_rate"][1] == 0.2)
        for name in ("max_overlap_over_radius", "max overlap / radius", "pressure drop", "pressure drop [Pa]", "kinetic_energy_translation"):
            self.assertEqual(len(log[name]), 11, name)
            self.assertIn(name, log)
        self.assertTrue(all(name.isidentifier() for name in log))
        self.assertIn("pressure_drop", dir(log))
        self.refuses(lambda: log["speed"], "log.csv: no 'speed'; there are: time, ")
        self.assertRaises(AttributeError, lambda: log.speed)
        self.assertRaises(KeyError, lambda: log["speed"])
        self.assertNotIn("speed", log)
        for again in (copy.deepcopy(log), pickle.loads(pickle.dumps(log))):
            self.assertEqual((list(again), again.time[-1]), (list(log), 1.0))

    def test_columns_of_one_name_are_kept_apart(self):
        self.write("log.csv", "time [s],mean velocity of a-b [m/s],mean velocity of a b [m/s]\n0,1,2\n")
        log = Run(self.folder).log
        self.assertEqual((log["mean velocity of a-b"][0], log["mean velocity of a b"][0], len(log)), (1, 2, 3))

    def test_damaged_logs(self):
        path = self.folder / "log.csv"
        run = Run(self.folder)
        self.refuses(lambda: run.log, path, "is missing", "run the case first")
        damaged = {
            "": "is empty", "time [s],b\n0,1\n1": ":3: 1 values", "time [s],b\n0,1\n1,2": ":3: the line has no end",
            "time [s],b\n0,1x\n": ":2: '1x' is no number of 'b'", "b\n1\n": "no column 'time [s]'",
        }  # fmt: skip
        for text, words in damaged.items():
            self.write("log.csv", text)
            self.refuses(lambda: run.log, path, words)
        self.write("log.csv", "time [s],b\n")
        self.assertEqual(run.log.b.shape, (0,))

    def test_dataframe(self):
        log = self.line(frames=False).log
        if find_spec("pandas"):
            frame = log.dataframe()
            self.assertEqual((list(frame), frame.attrs["units"]["time"]), (list(log), "s"))
        with mock.patch.dict(sys.modules, {"pandas": None}):
            self.refuses(log.dataframe, "pandas", "install")

    def test_frames(self):
        run = self.line()
        frames = run.frames
        self.assertEqual((len(frames), frames.times[3], frames[3].time, frames[-1].time), (21, 0.15, 0.15, 1.0))
        frame = frames[3]
        self.assertEqual(frame.position.shape, (len(FRAME), 3))
        self.assertEqual([tuple(place) for place in frame.position.tolist()], [place for _, place, _ in FRAME])
        self.assertEqual([tuple(v) for v in frame["velocity"].tolist()], [v for _, _, v in FRAME])
        self.assertEqual((frame.serial.tolist(), frame.radius[0], frame.contacts.dtype.kind), ([p[0] for p in FRAME], 0.005, "i"))
        self.assertEqual((frame.units["position"], frame.units["pressure_gradient"], frame.units["id"], frame.step), ("m", "Pa/m", "", None))
        frame.position[:, 2] += 1  # an array of the reader's own
        self.assertIs(frames[3], frame)
        self.assertEqual([frames.at(time).time for time in (-5, 0.6, 0.62, 99)], [0.0, 0.6, 0.6, 1.0])
        self.assertEqual([frame.time for frame in frames[::10]], [0.0, 0.5, 1.0])
        self.assertEqual(sum(1 for _ in frames), 21)
        self.assertRaises(IndexError, lambda: frames[21])
        self.assertRaises(AttributeError, lambda: frame.density)
        self.refuses(lambda: frame["density"], "frame_000003.vtp: no 'density'; there are: ")

    def test_frames_are_read_when_they_are_asked_for(self):
        run = self.line()
        path = run.folder / "frames" / "frame_000002.vtp"
        path.write_bytes(path.read_bytes()[:-40])
        (run.folder / "frames" / "frame_000005.vtp").unlink()
        self.assertEqual((len(run.frames), run.frames[2].time, len(run.frames[3].radius)), (21, 0.1, len(FRAME)))
        self.refuses(lambda: run.frames[2].position, path, "damaged (it is cut short)")
        self.refuses(lambda: run.frames[5].position, "frame_000005.vtp is missing")
        self.assertIn("frame_000002", repr(run.frames[2]))

    def test_no_frames(self):
        run = self.line(frames=False)
        self.refuses(lambda: run.frames, "frames.pvd is missing: set frame_interval")
        self.refuses(lambda: run.contacts, "contacts.pvd is missing: set contact_interval")
        (run.folder / "frames.pvd").write_text(list_of("frame", ()))
        self.assertEqual((len(run.frames), run.frames.times.shape), (0, (0,)))
        self.refuses(lambda: run.frames.at(0.5), "frames.pvd", "no frames")

    def test_contacts(self):
        for how in ({}, {"as_text": True}):
            contacts = self.with_contacts(**how).contacts
            last = contacts.at(0.19)
            self.assertEqual((len(contacts), len(contacts[0].owner), last.time, last.step), (3, 0, 0.2, 200))
            self.assertEqual((contacts[0].position.shape, last.position.shape), ((0, 2, 3), (2, 2, 3)))
            self.assertEqual(last.position[1].tolist(), [list(place) for place in CONTACTS[1][2:4]])
            self.assertEqual((last.partner.tolist(), last.force[0].tolist()), ([7, -1], [0.0, 3.0, 4.0]))
            self.assertEqual((last.normal_force.tolist(), last.units["force"]), ([5.0, 1.0], "N"))

    def test_slices(self):
        run = self.line()
        slices = run.slices
        self.assertEqual((list(slices), dict(slices.units)), (list(line_folder.SLICE_QUANTITIES), line_folder.SLICE_QUANTITIES))
        self.assertEqual((slices.pressure.shape, slices.times.shape, slices.z.shape, slices.length), ((51, 200), (51,), (200,), 0.01))
        self.assertAlmostEqual(slices.z[7], 0.075)
        solids = LINE.solids(slices.times[30])
        self.assertLess(abs(slices["solids_fraction"][30] - solids).max(), 1e-6)
        self.assertLess(abs(slices["pressure"][30] / LINE.pressure(solids) - 1).max(), 1e-6)
        self.assertEqual(math.isnan(slices.particle_velocity[30, 0]), solids[0] < 0.4)
        path = run.folder / "slices.bin"
        whole = path.read_bytes()
        path.write_bytes(whole[:-1])
        self.refuses(lambda: Run(run.folder).slices, path, "cut short")
        path.write_bytes(whole.partition(b"\n")[0] + b"\n")
        self.assertEqual(Run(run.folder).slices.pressure.shape, (0, 200))
        path.unlink()
        self.refuses(lambda: Run(run.folder).slices, path, "is missing: set slice_interval")

    def test_plugs_and_probes(self):
        run = self.line()
        plugs = run.plugs
        self.assertEqual((plugs.fate.tolist(), plugs.born[-1], plugs.units["born"]), (["present", "merged"], 1.11, "s"))
        self.assertTrue(math.isnan(plugs.split_off_from[0]) and math.isnan(plugs.length[-1]))
        self.assertEqual((plugs.front_velocity[plugs.counts == 1].tolist(), plugs["born at [m]"][0]), ([line_folder.W], 0.4))
        probes = run.probes
        self.assertEqual(([len(probe.time) for probe in probes], probes[1].units["mass_flow"]), ([101, 21], "kg/s"))
        self.assertTrue(math.isnan(probes[0].mass_flow[0]) and probes[0].solids_fraction[0] == line_folder.LAYER)
        (run.folder / "probe_0.csv").rename(run.folder / "probe_2.csv")
        self.refuses(lambda: Run(run.folder).probes, "probe_0.csv is missing")
        (run.folder / "plugs.csv").unlink()
        self.refuses(lambda: Run(run.folder).plugs, "plugs.csv is missing: only a line has it")
        self.assertEqual(Run(self.folder).probes, [])

    @unittest.skipUnless(shutil.which("gnuplot"), "there is no gnuplot")
    def test_the_example_draws(self):
        run = self.line(frames=False)
        example = root / "tools" / "python" / "pressure_in_time.py"
        subprocess.run([sys.executable, example, run.folder, self.folder / "picture"], check=True)
        self.assertIn("pressure above the outlet, kPa", (self.folder / "picture.svg").read_text())
        self.assertEqual((self.folder / "picture.png").read_bytes()[:4], b"\x89PNG")
        said = subprocess.run([sys.executable, example, self.folder, self.folder / "none"], capture_output=True, text=True, check=False)
        self.assertEqual((said.returncode, len(said.stderr.splitlines())), (1, 1))


if __name__ == "__main__":
    if not find_spec("numpy"):
        print(f"{sys.executable} has no NumPy: the tests of arrays are skipped")
    run_and_count(*sys.argv[1:2])
