"""What the tests of make share: a copy of this checkout whose path has a blank, with a copy of the build folder, so that little
has to be compiled; and make called there. `make -n` shows what make would run; stale products are removed even then.

Arguments of such a test: BUILD_FOLDER CXX SCRATCH [COUNT_FILE].
"""

import os
import shlex
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

root = Path(__file__).resolve().parent.parent
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


def copy_build():
    shutil.rmtree(checkout / "build", ignore_errors=True)
    (checkout / variant / "objects").mkdir(parents=True)
    shutil.copy2(built.parent / "sources.sha256", checkout / "build")
    for name in ("made_by", "tests_made_for", "casegen", "objects/tools"):
        subprocess.run(["cp", "-a", built / name, checkout / variant / name], check=True)


def copy_checkout():
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
