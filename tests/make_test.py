#!/usr/bin/env python3
"""A build folder never holds what was made of other contents, two cases never share a folder, and runs are not replaced unasked.

Usage: tests/make_test.py BUILD_FOLDER CXX SCRATCH [COUNT_FILE]. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed.
"""

import json
import re
import shlex
import shutil
import subprocess
import sys
import time
from pathlib import Path

sys.dont_write_bytecode = True
from counted import run_and_count  # noqa: E402
from make_checkout import CHOSEN, ENVIRONMENT, Made, checkout, compiler, copy_build, copy_checkout, make, replace, root, scratch, variant  # noqa: E402

SMALL = (root / "cases" / "collide_wall.toml").read_text()
LARGE = """[particles]
count = 3000000
diameter = 0.010
density = 1000.0
[material]
youngs_modulus = 3.0e9
poisson_ratio = 0.33
restitution = 0.9
friction = 0
[pipe]
diameter = 0.5
length = 80.0
ends = "periodic"
[start]
arrangement = "random"
[run]
time_step = 2.0e-6
duration = 1.0
reference_speed = 1.0
"""


def setUpModule():
    copy_checkout()


class Contents(Made):
    """Time stamps do not decide."""

    def hash_of_program(self, program):
        said = subprocess.run([checkout / program, "--version"], capture_output=True, text=True, check=True).stdout
        return re.search("xxh64 ([0-9a-f]+)", said)[1]

    def hash_of_case(self, case):
        return subprocess.run([checkout / variant / "casegen", "--hash", case], capture_output=True, text=True, check=True).stdout.strip()

    def test_two_makes_at_once_then_runs_then_a_case_replaced_by_an_older_and_larger_one(self):
        case = checkout / "mine.toml"
        replace(case, SMALL)
        command = ["make", *CHOSEN, "build-program", "CASE=mine.toml"]
        together = [subprocess.Popen(command, cwd=checkout, env=ENVIRONMENT, stderr=subprocess.DEVNULL) for _ in range(2)]
        seen = set()  # of the program, as a run beside the other make would find it
        while any(process.poll() is None for process in together):
            seen |= {(at.st_size, at.st_mode & 0o777) for at in map(Path.stat, (checkout / variant).glob("elsewhere/*/bin/mine"))}
            time.sleep(0.001)
        self.assertEqual([process.wait() for process in together], [0, 0])
        (program,) = (checkout / variant).glob("elsewhere/*/bin/mine")
        whole = (program.stat().st_size, program.stat().st_mode & 0o777)
        self.assertTrue(seen <= {whole}, f"{seen}: the program is there when it is whole, {whole}")
        self.assertEqual([path.name for path in program.parent.iterdir()], ["mine"], "no file half written is left")
        self.assertEqual(self.hash_of_program(program), self.hash_of_case(case))
        self.assertNotIn("compile", self.made("build-program", "CASE=mine.toml"), "what is right is left alone")

        self.made("run", "CASE=mine.toml", "ARGS=--duration 0.01")
        (results,) = (checkout / "out").glob("mine-*")
        short = json.loads((results / "summary.json").read_text())
        code, _, said = make("run", "CASE=mine.toml")
        self.assertNotEqual(code, 0, "a shorter run lies there")
        self.assertIn("FRESH=1", said)
        self.assertEqual(json.loads((results / "summary.json").read_text()), short)
        self.made("run", "CASE=mine.toml", "EXTEND=0.01")
        extended = (results / "log.csv").read_bytes()
        self.made("run", "CASE=mine.toml", "FRESH=1")
        self.assertEqual((results / "log.csv").read_bytes(), extended, "of the same bytes as a run of that length")
        self.assertEqual((results.with_name(results.name + ".1") / "log.csv").read_bytes(), extended, "moved aside")

        replace(case, LARGE)
        self.made("build-program", "CASE=mine.toml")
        self.assertEqual(self.hash_of_program(program), self.hash_of_case(case))
        program.write_text("#!/bin/sh\necho xxh64 0123\n")  # newer than all it is made of
        code, out, said = make("run", "CASE=mine.toml")
        self.assertNotEqual(code, 0, out)
        self.assertIn("mine.toml has changed since its program was compiled", said)

    def test_a_step_too_long_for_contacts_is_warned_of_at_each_run(self):
        (checkout / "long.toml").write_text(SMALL.replace("time_step = 2.0e-6", "time_step = 2.0e-5"))
        for options in ((), ("FRESH=1",)):
            code, _, said = make("run", "CASE=long.toml", *options)
            self.assertEqual(code, 0, said)
            self.assertRegex(said, r"time_step = 2e-05 gives only \d+\.\d steps per contact")
        for summary in (checkout / "out").glob("long-*/summary.json"):
            self.assertLess(json.loads(summary.read_text())["stability"]["steps_per_contact"], 20)

    def test_a_pipe_too_wide_for_so_many_particles(self):
        wide = scratch / "wide.toml"
        wide.write_text(LARGE.replace("diameter = 0.5\n", "diameter = 20.0\n"))
        done = subprocess.run([checkout / variant / "casegen", wide], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 3)
        self.assertRegex(done.stderr, r"wide.toml:\d+:\d+: error: .*diameter = 20.* a slice of it .* at most \d+\.\d+ m")

    def test_a_case_that_others_start_from(self):
        fill = checkout / "cases" / "fill_500.toml"
        before = fill.read_text()
        self.made("header", "CASE=plug_u24_n500")
        replace(fill, before.replace("count = 500", "count = 499"))
        code, _, said = make("header", "CASE=plug_u24_n500")
        self.assertNotEqual(code, 0)
        self.assertIn("has 499 particles", said)
        replace(fill, before)
        self.made("header", "CASE=plug_u24_n500")

    def restored(self, *sources):
        """The checkout and its build folder as they were, once the test is over."""
        texts = {checkout / source: (checkout / source).read_text() for source in sources}

        def restore():
            for path, text in texts.items():
                path.write_text(text)
            copy_build()

        self.addCleanup(restore)

    def test_a_source_replaced_by_an_older_file(self):
        self.restored("tools/run/log.cpp", "tools/run/dump.hpp", "kernel/status.hpp")
        self.made("-n", "build-program", "CASE=settle")
        objects = checkout / variant / "objects" / "tools" / "run"
        for source, gone, kept in (
            ("tools/run/log.cpp", ("log",), ("dump", "side_view")),
            ("tools/run/dump.hpp", ("dump", "outputs"), ("side_view",)),
            ("kernel/status.hpp", ("fault_report",), ()),
        ):
            self.assertEqual([name for name in (*gone, *kept) if not (objects / f"{name}.o").exists()], [])
            replace(checkout / source, (checkout / source).read_text() + "// another\n")
            shown = self.made("-n", "build-program", "CASE=settle")
            for name in gone:
                self.assertIn(f"tools/run/{name}.cpp", shown)
                self.assertFalse((objects / f"{name}.o").exists(), f"{name}.o was made of another {source}")
            self.assertEqual([name for name in kept if not (objects / f"{name}.o").exists()], [], "what does not depend on it stays")

    def test_a_source_that_is_gone_and_what_was_linked_with_it(self):
        self.restored("tools/run/side_view.cpp")
        program = checkout / variant / "bin" / "linked_before"
        program.parent.mkdir(exist_ok=True)
        program.write_text("")
        of_a_root = checkout / "build" / "systems" / "roots" / "tidy"
        of_a_root.mkdir(parents=True, exist_ok=True)
        (checkout / "tools/run/side_view.cpp").unlink()
        self.made("-n", "build-program", "CASE=settle")
        self.assertFalse(program.exists())
        self.assertTrue(of_a_root.exists(), "roots of other systems are not made of sources")

    def test_another_compiler_of_the_same_name(self):
        self.restored()
        *launcher, command = shlex.split(compiler)
        wrapper = scratch.with_name("bin") / Path(command).name
        wrapper.parent.mkdir(exist_ok=True)
        wrapper.write_text(f'#!/bin/sh\nexec {shutil.which(command)} -DUPGRADED "$@"\n')
        wrapper.chmod(0o755)
        said = self.made("-n", "header", "CASE=settle", f"CXX={shlex.join([*launcher, str(wrapper)])}")
        self.assertIn("was made by another compiler", said)
        self.assertFalse((checkout / variant / "casegen").exists())

    def test_a_build_of_unknown_sources(self):
        self.restored()
        (checkout / "build" / "sources.sha256").unlink()
        self.made("-n", "header", "CASE=settle")
        self.assertFalse((checkout / variant / "casegen").exists())

    def test_the_mark_of_a_final_state(self):
        folder = scratch / "mark"
        folder.mkdir(exist_ok=True)
        program, start, state, mark = (folder / name for name in ("program", "start", "state", "mark"))
        whole_run = checkout / "tools" / "make" / "whole_run.sh"
        for path in (program, start, state):
            path.write_text(path.name)

        def holds():
            return subprocess.run([whole_run, "holds", mark, state, program, start], check=False).returncode == 0

        self.assertFalse(holds())
        inputs = subprocess.run([whole_run, "inputs", program, start], capture_output=True, text=True, check=True).stdout.strip()
        subprocess.run([whole_run, "leave", mark, inputs, state], check=True)
        self.assertTrue(holds())
        for path in (program, start, state):
            replace(path, "other")
            self.assertFalse(holds(), f"{path.name} is another one, though older")
            replace(path, path.name)
            self.assertTrue(holds())


class Names(Made):
    """Two cases never share a folder."""

    def test_cases_of_one_name(self):
        names = ("a/b/x.toml", "a+b/x.toml", "a/b+x.toml", "cases/b/x.toml")
        for name in names:
            (checkout / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(root / "cases" / "collide_wall.toml", checkout / name)
        shown = {name: self.made("-n", "run", f"CASE={name}") for name in (*names, "collide_wall")}
        programs = [re.search(r"(\S+) --out (\S+)", text) for text in shown.values()]
        self.assertEqual(len({found[1] for found in programs}), len(programs), programs)
        self.assertEqual(len({found[2] for found in programs}), len(programs), programs)
        self.assertTrue(programs[-1][2].endswith("out/collide_wall"), programs[-1])
        for name, spelling in (("a/b/x.toml", "./a/../a//b/x.toml"), ("a/b/x.toml", f"{scratch.name}/../a/b/x.toml")):
            self.assertEqual(self.name(name), self.name(spelling))
        self.assertEqual(self.name("cases/settle.toml"), "settle")
        shutil.rmtree(checkout / "cases" / "b")

    def name(self, path):
        command = ["tools/make/name_apart.sh", path, "cases"]
        return subprocess.run(command, cwd=checkout, capture_output=True, text=True, check=True).stdout.strip()

    def test_sweeps_of_one_name(self):
        for name in ("s/p/x.toml", "s+p/x.toml"):
            (checkout / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(root / "cases" / "sweeps" / "small.toml", checkout / name)
        shown = [self.made("-pn", "build-sweep", f"SWEEP={name}") for name in ("s/p/x.toml", "s+p/x.toml", "cases/sweeps/small.toml")]
        for name in ("sweep_out", "sweep_build"):
            self.assertEqual(len({re.search(rf"^{name} := (\S+)", text, re.MULTILINE)[1] for text in shown}), 3)
        self.assertIn("sweep_out := out/sweeps/small\n", shown[2])


if __name__ == "__main__":
    run_and_count(*sys.argv[4:5])
