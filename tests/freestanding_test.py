#!/usr/bin/env python3
"""The kernel where there is no operating system: which headers it includes, what a scene with every feature needs from
outside, how deep its stack can be, and that it makes no system call.

The scene is compiled once, freestanding and without exceptions (tests/freestanding/scene.cpp).

Usage: tests/freestanding_test.py COUNT_FILE FOLDER CXX FLAGS...   FOLDER takes what is compiled.
Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed.
"""

import platform
import re
import signal
import subprocess
import sys
import unittest
from pathlib import Path

root = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path[:0] = [str(root / "tests"), str(root / "tools" / "footprint")]

from counted import write_count  # noqa: E402
from measuring import Calls  # noqa: E402

here = root / "tests" / "freestanding"
folder, compiler = Path("."), ["g++"]  # main() sets them

# C++20 [compliance]; of these a kernel of templates needs few.
FREESTANDING = {"cstddef", "limits", "cfloat", "cstdint", "version", "new", "typeinfo", "source_location", "exception",
                "initializer_list", "compare", "coroutine", "cstdarg", "concepts", "type_traits", "bit", "atomic"}
# arm_neon.h needs <stdint.h> alone. immintrin.h does not qualify: with gcc it brings mm_malloc.h, which wants malloc.
INTRINSICS = {"lanes_neon.hpp": {"arm_neon.h"}}
# What gcc and clang may call in any program (gcc's manual, "Standards"); copying and filling, no mathematics.
OF_THE_COMPILER = {"memcpy", "memmove", "memset", "memcmp"}
MAXIMUM_STACK = 80 * 1024  # bytes, with eight lanes; the sum of all frames, as if each function called all others: packed
# contacts of pairs and of two kinds of wall (sparse_contacts.hpp) have 15 KiB each and never lie on the stack together


def run(*command, **options):
    return subprocess.run([str(part) for part in command], check=True, text=True, capture_output=True, **options).stdout


class Freestanding(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder.mkdir(parents=True, exist_ok=True)
        cls.scene = folder / "scene.o"
        try:
            run(*compiler, "-O2", "-ffreestanding", "-fno-exceptions", "-fno-rtti", "-fno-stack-protector", "-fno-pie",
                "-fstack-usage", "-c", here / "scene.cpp", "-o", cls.scene)
        except subprocess.CalledProcessError as error:
            raise AssertionError(f"the kernel does not compile freestanding:\n{error.stderr}") from None

    def test_only_freestanding_headers(self):
        files = sorted((root / "kernel").glob("*.hpp"))
        self.assertGreater(len(files), 20)
        for file in files:
            included = set(re.findall(r"^\s*#\s*include\s*<(.+?)>", file.read_text(), re.MULTILINE))
            foreign = included - FREESTANDING - INTRINSICS.get(file.name, set())
            self.assertFalse(foreign, f"kernel/{file.name} includes headers that need an operating system")

    def test_needs_no_library(self):
        needed = set(re.findall(r"\bU (\S+)", run("nm", "-u", self.scene)))
        self.assertLessEqual(needed, OF_THE_COMPILER, "the scene calls functions of a library")

    def link_without_library(self):
        source = folder / "memory.c"
        source.write_text("".join(f"void {name}(void) {{}}\n" for name in sorted(OF_THE_COMPILER)))
        cc = [compiler[0], "-x", "c", "-fno-builtin", "-w"]
        run(*cc, "-c", source, "-o", folder / "memory.o")
        run(compiler[0], "-nostdlib", "-static", "-no-pie", "-Wl,--fatal-warnings,-e,scene_start", self.scene,
            folder / "memory.o", "-o", folder / "whole")
        return folder / "whole"

    def test_links_without_library(self):
        """-nostdlib: with the four functions of the compiler the scene is a whole program."""
        self.assertTrue(self.link_without_library().exists())

    def test_no_exceptions_no_types_no_threads(self):
        sections = run("objdump", "-h", self.scene)
        for section in (".gcc_except_table", ".tbss", ".tdata"):
            self.assertNotIn(section, sections)
        names = run("nm", self.scene)
        self.assertNotRegex(names, r" [A-Za-z] (_ZTI|_ZTS|_ZTV|__cxa_|_Unwind|_Zn[wa]|_Zd[la]|_ZGV)")

    def test_stack_is_bounded(self):
        """Every frame has a size that is known, no function calls itself by any way round, none is called by pointer."""
        frames = [line.split("\t") for line in (folder / "scene.su").read_text().splitlines()]
        self.assertGreater(len(frames), 10)
        for name, _, kind in frames:
            self.assertIn(kind, ("static", "dynamic,bounded"), name)
        # `bounded` leaves out what aligning a frame to 64 bytes may skip.
        total = sum(int(size) + 64 + 16 for _, size, _ in frames)
        self.assertLess(total, MAXIMUM_STACK)
        self.assertGreater(total, 1024)  # the compiler did report

        calls = Calls(self.link_without_library())
        self.assertFalse(calls.by_pointer, "where they go is not known before the run")
        self.assertGreaterEqual(len(calls.targets), 3)

        finished = set()

        def visit(name, way):
            self.assertNotIn(name, way, "a function calls itself: " + " > ".join([*way, name]))
            if name not in finished:
                for target in calls.targets[name]:
                    visit(target, [*way, name])
                finished.add(name)

        for name in list(calls.targets):
            visit(name, [])

    def test_library_example(self):
        """tools/example needs a compiler and a generated header; it ends well when the forces on the walls are right."""
        source, program = root / "tools" / "example" / "hanging_drum.cpp", folder / "hanging_drum"
        self.assertLess(len(source.read_text().splitlines()), 60)
        includes = [part for part in compiler if part.startswith("-I")]
        run(compiler[0], "-std=c++20", "-O2", "-ffp-contract=off", "-fno-math-errno", *includes, source, "-o", program)
        self.assertIn("the spring carries", run(program))

    @unittest.skipUnless(platform.system() == "Linux", "strict mode is Linux's")
    def test_no_system_call(self):
        program = folder / "strict"
        run(*compiler, "-no-pie", here / "main.cpp", self.scene, "-o", program)
        control = subprocess.run([program, "control"], check=False)
        if control.returncode == 77:
            self.skipTest("this system has no strict mode")
        self.assertEqual(control.returncode, -signal.SIGKILL, "a forbidden call is not noticed")
        self.assertEqual(subprocess.run([program], check=False).returncode, 0)
        instructions = run("objdump", "-d", self.scene)
        self.assertNotRegex(instructions, r"\t(syscall|sysenter|int +\$0x80|svc)\b")


def main():
    global folder, compiler
    count_file, folder = Path(sys.argv[1]), Path(sys.argv[2])
    compiler = [part for part in sys.argv[3:] if "sanitize" not in part]  # sanitizers are libraries
    suite = unittest.defaultTestLoader.loadTestsFromTestCase(Freestanding)
    result = unittest.TextTestRunner(verbosity=0).run(suite)
    write_count(result, count_file)
    return 0 if result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
