#!/usr/bin/env python3
"""What make does with odd input, and that a build folder never holds what was made of other contents.

All of it happens in a copy of this checkout whose path has a blank, with a copy of the build folder, so that little has to be
compiled. `make -n` shows what make would run; stale products are removed even then.

Usage: tests/make_test.py BUILD_FOLDER CXX SCRATCH [COUNT_FILE]. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

root = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
from counted import run_and_count  # noqa: E402

built, compiler, scratch = Path(sys.argv[1]).resolve(), sys.argv[2], Path(sys.argv[3]).resolve()
checkout = scratch / "a checkout"
variant = Path("build") / built.name
OLD = 1_000_000_000  # s: long before anything was built

# Variables that choose the variant go on; all else of the make that calls this test stays behind.
_, _, overrides = os.environ.get("MAKEFLAGS", "").partition(" -- ")
CHOSEN = [word for word in shlex.split(overrides) if word.split("=")[0] in ("CXX", "ARCH", "LANES", "SAN", "INSTRUMENTED")]
ENVIRONMENT = {name: value for name, value in os.environ.items() if not name.startswith(("MAKE", "MFLAGS", "FIXDEM_"))}


def make(*words, cwd=checkout, **environment):
    """Exit code, standard output and standard error."""
    command = ["make", *CHOSEN, *words]
    done = subprocess.run(command, cwd=cwd, env=ENVIRONMENT | environment, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


def replace(path, text):
    """By a file that is older than everything: what mv, cp -p and rsync -a can do."""
    path.write_text(text)
    os.utime(path, (OLD, OLD))


def placed(velocity):
    """A case that compiles quickly."""
    text = (root / "cases" / "collide_wall.toml").read_text()
    return f"# {velocity}\n{text}"


def copy_build():
    shutil.rmtree(checkout / "build", ignore_errors=True)
    (checkout / variant / "objects").mkdir(parents=True)
    shutil.copy2(built.parent / "sources.sha256", checkout / "build")
    for name in ("made_by", "tests_made_for", "casegen", "objects/tools"):
        subprocess.run(["cp", "-a", built / name, checkout / variant / name], check=True)


def setUpModule():
    shutil.rmtree(scratch, ignore_errors=True)
    checkout.mkdir(parents=True)
    for name in ("Makefile", "kernel", "tools", "cases", "bench", "tests"):
        subprocess.run(["cp", "-a", root / name, checkout], check=True)
    copy_build()


class Made(unittest.TestCase):
    def made(self, *words, **environment):
        code, out, said = make(*words, **environment)
        self.assertEqual(code, 0, out + said)
        return out + said

    def refused(self, *words, saying, cwd=checkout):
        code, out, said = make(*words, cwd=cwd)
        self.assertEqual(code, 2, out + said)
        self.assertEqual(out, "", "nothing is done")
        self.assertEqual(len(said.splitlines()), 1, said)
        self.assertRegex(said, saying)
        self.assertEqual([path for path in checkout.rglob("*pwned*") if "toml" not in path.name], [])


class Contents(Made):
    """Time stamps do not decide."""

    def hash_of_program(self, program):
        said = subprocess.run([checkout / program, "--version"], capture_output=True, text=True, check=True).stdout
        return re.search("xxh64 ([0-9a-f]+)", said)[1]

    def hash_of_case(self, case):
        return subprocess.run([checkout / variant / "casegen", "--hash", case], capture_output=True, text=True, check=True).stdout.strip()

    def test_a_case_replaced_by_an_older_file_and_two_makes_at_once(self):
        case = checkout / "mine.toml"
        replace(case, placed("one"))
        command = ["make", *CHOSEN, "build-program", "CASE=mine.toml"]
        together = [subprocess.Popen(command, cwd=checkout, env=ENVIRONMENT, stderr=subprocess.DEVNULL) for _ in range(2)]
        self.assertEqual([process.wait() for process in together], [0, 0])
        (program,) = (checkout / variant).glob("elsewhere/*/bin/mine")
        self.assertEqual(sorted(path.name for path in program.parent.iterdir()), ["mine"], "no file half written is left")
        self.assertEqual(self.hash_of_program(program), self.hash_of_case(case))
        self.assertNotIn("compile", self.made("build-program", "CASE=mine.toml"), "what is right is left alone")
        replace(case, placed("two"))
        self.made("build-program", "CASE=mine.toml")
        self.assertEqual(self.hash_of_program(program), self.hash_of_case(case))
        self.assertIn("--version", self.made("-n", "run", "CASE=mine.toml"), "program and file are compared before a run")
        program.write_text("#!/bin/sh\necho xxh64 0123\n")  # newer than all it is made of
        code, out, said = make("run", "CASE=mine.toml")
        self.assertNotEqual(code, 0, out)
        self.assertIn("mine.toml has changed since its program was compiled", said)

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
        (checkout / "tools/run/side_view.cpp").unlink()
        self.made("-n", "build-program", "CASE=settle")
        self.assertFalse(program.exists())

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


class Input(Made):
    """Values that a shell or make would read as something else, and names that nobody knows."""

    def variables(self):
        return re.findall(r"^kind\.(\w+) :=", (root / "tools" / "make" / "variables.mk").read_text(), re.MULTILINE)

    def test_no_variable_runs_code(self):
        self.assertGreater(len(self.variables()), 30)
        for name in self.variables():
            with self.subTest(name=name):
                self.refused("run", f"{name}=1`>pwned`;>pwned;$(shell >pwned)' >pwned '\n>pwned", saying=f"fixdem: {name}=")
        for value in ("1`>pwned`", "1;>pwned", "$(shell >pwned)", "1' >pwned '", "1\n>pwned", "$$(>pwned)", "1|>pwned", "1&>pwned"):
            for name in ("SEED", "ARGS"):
                with self.subTest(name=name, value=value):
                    self.refused("run", f"{name}={value}", saying=f"fixdem: {name}=")
        code, _, said = make("help", CASE="x`>pwned`.toml")
        self.assertEqual(code, 2, said)

    def test_a_file_in_cases_whose_name_is_code(self):
        for name in ("x`>pwned`.toml", "x;>pwned;.toml", "$(shell >pwned).toml", "x y.toml", "x%.toml"):
            odd = checkout / "cases" / name
            odd.write_text("")
            with self.subTest(name=name):
                self.refused("cases", saying="the name of a file holds .*rename it: cases/")
            odd.unlink()

    def test_characters_in_the_path_of_a_case(self):
        for character, words in (
            (" ", "a blank"), ("\t", "a blank"), ("%", "%"), (":", ":"), ("=", "="), ("#", "#"), ("'", "'"), (";", ";"), ("&", "&"),
            ("$", r"\$"), ('"', '"'), ("(", r"\("), ("*", r"\*"), ("?", r"\?"), ("~", "~"), ("\\", r"\\"), ("|", r"\|"), ("!", "!"),
        ):  # fmt: skip
            with self.subTest(character=character):
                self.refused("run", f"CASE=my{character}case.toml", saying=f"CASE=.*{words} cannot be in a path .*ln -s")
        self.refused("run", "CASE=-x.toml", saying=r"write \./-x")

    def test_a_checkout_in_a_path_with_a_blank(self):
        code, out, said = make("header", "CASE=settle")
        self.assertEqual(code, 0, said)
        self.assertIn("struct settle", out)
        self.assertEqual([line for line in said.splitlines() if "settle" not in line and "contact" not in line and "Rayleigh" not in line], [])
        quoted = scratch / "it's"
        quoted.mkdir()
        (quoted / "Makefile").symlink_to(checkout / "Makefile")
        (quoted / "tools").symlink_to(checkout / "tools")
        self.refused("cases", cwd=quoted, saying="the character ' is in the path of this folder")

    def test_names_that_no_target_knows(self):
        for given, name in (("case=settle", "CASE"), ("RESUM=1", "RESUME"), ("seed=1", "SEED"), ("EXTENT=1", "EXTEND")):
            self.refused("run", given, saying=f"no target knows a variable {given.split('=')[0]}: did you mean {name}")
        self.refused("run", "CXXFLAGS=-O0", saying=r"no target knows a variable CXXFLAGS \(make help")
        self.made("-n", "header", "CASE=settle", case="settle", RESUM="1")  # of the environment

    def test_values_that_mean_nothing(self):
        for given, words in (
            ("SEED=-1", "whole number"), ("SEED=1.5", "whole number"), ("EXTEND=0.3s", "a number"), ("LANES=3", "one of 1 2 4 8"),
            ("SAN=address", "one of 1 memory"), ("SAN=0", "one of"), ("QUICK=0", "QUICK=1, or leave it out"), ("RESUME=0", "RESUME=1"),
            ("ENGINE=make", "one of parallel slurm"), ("FORMAT=avi", "one of mp4 gif"),
            ("ARCH=avx2", "native scalar x86-64-v4 .*did you mean x86-64-v3"), ("ARCH=avx512", "did you mean x86-64-v4"),
            ("ARCH=sse2", "did you mean x86-64"), ("ARCH=nativ", "did you mean native"), ("ARCH=lanes2", "no such instruction set"),
        ):  # fmt: skip
            with self.subTest(given=given):
                self.refused("run", given, saying=words)
        self.refused("run", "RESUME=1", "FRESH=1", saying="exclude one another")
        self.made("-n", "header", "CASE=settle", "SEED=2", "ARGS=--duration 0.1 --no-frames")

    def test_clean_removes_nothing_of_others(self):
        precious = checkout / "precious"
        (precious / "g++-native").mkdir(parents=True)
        code, _, said = make("clean", "BUILD=precious")
        self.assertEqual(code, 2)
        self.assertIn("nothing is removed", said)
        self.assertTrue(precious.exists())


if __name__ == "__main__":
    run_and_count(*sys.argv[4:5])
