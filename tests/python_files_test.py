#!/usr/bin/env python3
"""The files of a run as the standard library reads them (tools/python/frames.py, slices.py, columns.py): what was written comes back, what is
damaged is refused with its file's name. Needs no run of the program.

Usage: tests/python_files_test.py [COUNT_FILE]. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed.
"""

import json
import random
import subprocess
import sys
from pathlib import Path
from unittest import mock

root = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(root / "tools" / "python"))

import fixdem  # noqa: E402
import line_folder  # noqa: E402
from counted import run_and_count  # noqa: E402
from fixdem import FixdemError, Run  # noqa: E402
from frames import frame_list, frames_at, read_frame  # noqa: E402
from made_up_run import CONTACTS, FRAME, LINE, WithRun, list_of  # noqa: E402
from slices import Slices  # noqa: E402


class StandardLibrary(WithRun):
    """What tools on hosts without NumPy read."""

    def test_a_frame_reads_back_raw_and_as_text_in_either_order_of_bytes(self):
        ways = ({}, {"as_text": True}, {"order": ">"})
        one, *others = (read_frame(self.file("a.vtp", line_folder.frame_bytes(FRAME, 0.01, [5000.0, 500.0], **how))) for how in ways)
        self.assertEqual([tuple(place) for place in one["position"]], [place for _, place, _ in FRAME])
        self.assertEqual(list(one["serial"]), [serial for serial, _, _ in FRAME])
        self.assertEqual(list(one["pressure_gradient"]), [5000.0, 500.0])
        self.assertEqual(others, [one, one])

    def test_contacts_have_the_data_of_their_lines(self):
        found = read_frame(self.file("a.vtp", line_folder.contact_bytes(CONTACTS, 12)))
        self.assertEqual((found["owner"], found["partner"], found["step"]), ((0, 7), (7, -1), (12,)))
        self.assertEqual((found["force"], found["position"][1]), ([c[4] for c in CONTACTS], CONTACTS[0][3]))

    def test_a_frame_is_refused_wherever_it_is_cut(self):
        path = self.folder / "a.vtp"
        self.refuses(lambda: read_frame(path), path, "is missing", "run the case again")
        self.refuses(lambda: read_frame(self.folder), self.folder, "cannot be read")
        for how in ({}, {"as_text": True}):
            whole = line_folder.frame_bytes(FRAME[:20], 0.01, [1.0], **how).rstrip()
            for size in range(len(whole)):
                self.refuses(lambda data=whole[:size]: read_frame(self.file("a.vtp", data)), path, "damaged")

    def test_a_frame_whose_parts_do_not_fit_is_refused(self):
        whole = line_folder.frame_bytes(FRAME, 0.01, [1.0])
        changes = (
            (b'NumberOfPoints="', b'NumberOfPoints="1'), (b'"raw"', b'"base64"'), (b"Float64", b"Float99"), (b'type="Float64" ', b""),
            (b'Components="3"', b'Components="0"'), (b"<Points>", b"<Pointz>"), (b"</Points>", b"</Pointz>"), (b'offset="0"', b'offset="-9"'),
            (b'offset="0"', b'offset="x"'), (b'offset="0"', b""),
        )  # fmt: skip
        for old, new in changes:
            self.assertIn(old, whole)
            self.refuses(lambda data=whole.replace(old, new, 1): read_frame(self.file("a.vtp", data)), "a.vtp: damaged")

    def test_no_damage_ends_otherwise_than_with_a_sentence(self):
        chance = random.Random(1)
        files = {
            "a.vtp": (line_folder.frame_bytes(FRAME[:3], 0.01, [1.0]), read_frame),
            "b.vtp": (line_folder.contact_bytes(CONTACTS, 1, as_text=True), read_frame),
            "frames.pvd": (list_of("frame", (0, 0.1)).encode(), frame_list),
            "slices.bin": (line_folder.slices_bytes(line_folder.Line(duration=0.02)), Slices),
            "summary.json": (json.dumps(line_folder.summary(LINE)).encode(), lambda path: fixdem.read_summary(path.parent)),
            "log.csv": (line_folder.log_rows(LINE).encode(), fixdem.read_columns),
        }
        for name, (whole, read) in files.items():
            refused = 0
            for _ in range(400):
                data = bytearray(whole)
                for _ in range(chance.randint(1, 3)):
                    data[chance.randrange(min(len(data), 2000))] = chance.randrange(256)
                try:
                    read(self.file(name, bytes(data)))
                except FixdemError as error:
                    self.assertIn(name, str(error))
                    refused += 1
            self.assertGreater(refused, 5, name)

    def test_lists_of_frames(self):
        path = self.folder / "frames.pvd"
        self.refuses(lambda: frame_list(path), path, "is missing: set frame_interval")
        self.refuses(lambda: frame_list(self.folder / "contacts.pvd"), "is missing: set contact_interval")
        whole = list_of("frame", (0, 0.1))
        self.assertEqual(frame_list(self.write("frames.pvd", whole)), [(0.1 * k, self.folder / "frames" / f"frame_{k:06}.vtp") for k in range(2)])
        for text in ("", whole[:-20], whole.replace("0.1", "x"), whole.replace("0.1", "nan"), whole.replace("file=", "folder=")):
            self.refuses(lambda text=text: frame_list(self.write("frames.pvd", text)), path, "damaged")
        line_folder.write_frames(self.folder / "run", LINE, line_folder.particles(LINE))
        ((time, frame),) = frames_at(self.folder / "run", [0.152])
        self.assertEqual((time, list(frame["serial"])), (0.15, [serial for serial, _, _ in FRAME]))
        self.refuses(lambda: frames_at(self.folder / "run", [0.17]), "no frame near 0.17 s")
        self.write("frames.pvd", list_of("frame", ()))
        self.refuses(lambda: frames_at(self.folder, [0.0]), path, "lists no frames")

    def test_summary(self):
        run = self.line()
        self.assertEqual((run.summary["line"]["fed"], run.case["precision"], run.case["time_step"]), (1600, "double", 5e-5))
        self.assertNotIn("performance", run.case)
        path = run.folder / "summary.json"
        whole = path.read_text()
        for text in ("", "[1]", whole[:-1], whole[: len(whole) // 2], "[" * 100_000):
            path.write_text(text)
            self.refuses(lambda: Run(run.folder).summary, path)
        path.unlink()
        self.refuses(lambda: Run(run.folder).summary, path, "is missing", "run the case first")
        self.refuses(lambda: Run(path), path, "is no folder", "make run CASE=")
        self.refuses(lambda: Run(run.folder / "log.csv"), "is no folder")

    def test_without_numpy_that_is_said(self):
        run = self.line()
        with mock.patch.dict(sys.modules, {"numpy": None}):
            self.assertEqual(run.summary["status"], "done")
            self.assertEqual((len(run.frames), run.frames[3].time), (21, 0.15))
            for read in (lambda: run.log, lambda: run.frames[3].radius, lambda: run.slices, lambda: run.plugs, lambda: run.probes):
                self.refuses(read, "NumPy", "install")

    def test_a_command_ends_with_the_message(self):
        said = subprocess.run([sys.executable, root / "tools" / "python" / "slices.py", self.folder / "none"], capture_output=True, text=True, check=False)
        self.assertEqual(said.returncode, 1)
        self.assertTrue(said.stderr.startswith(f"fixdem: {self.folder / 'none'} is missing: set slice_interval"), said.stderr)
        self.assertEqual(len(said.stderr.splitlines()), 1)


if __name__ == "__main__":
    run_and_count(*sys.argv[1:2])
