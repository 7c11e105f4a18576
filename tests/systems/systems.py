#!/usr/bin/env python3
"""`make run` and `make test` from bare roots of other systems, with each compiler, each from a root of its own; a table of what came
out, which replaces the rows of the same systems in a document.

Usage: tests/systems/systems.py --folder FOLDER --document FILE SYSTEM... [--compilers NAME...]; as root. A SYSTEM is debian:SUITE or
ubuntu:SUITE. Environment: DEBIAN_MIRROR, UBUNTU_MIRROR (URLs), DEBIAN_KEYRING, UBUNTU_KEYRING (files).
Only what is committed is tried. Exit code: 0 all passed without a warning, 1 something did not or could not be tried, 2 wrong usage.
"""

import argparse
import fcntl
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

root = Path(__file__).resolve().parent.parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(root / "tools" / "report"))

from bare_root import BareRoot, NotTried, name_refused, remove, run_in  # noqa: E402
from marked_part import KeptTable  # noqa: E402
from outcome import (  # noqa: E402
    HEAD,
    KEY,
    outcome_of_run,
    outcome_of_test,
    new_rows,
    row,
    row_not_tried,
    states_that_differ,
    version_in,
)

CHECKOUT = "/root/fixdem"
SHOWN = 10  # warnings of one command


def say(text):
    print(f"fixdem: {text}", file=sys.stderr, flush=True)


def git(*arguments, folder=root):
    done = subprocess.run(["git", "-C", str(folder), *arguments], stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"fixdem: git {arguments[0]} failed (see above): test-systems tries what is committed in this checkout")
    return done.stdout.strip()


def commit_in(folder):
    return git("rev-parse", "--short=7", "HEAD", folder=folder)


def timed(copy, folder, command, log):
    """Exit code, output and seconds of a command in a root."""
    start = time.monotonic()
    code = run_in(copy, folder, command, log)
    return code, log.read_text(errors="replace"), time.monotonic() - start


def release_of(copy):
    """12.11 of Debian, 24.04 of Ubuntu."""
    version = copy / "etc/debian_version"
    settings = dict(line.split("=", 1) for line in (copy / "etc/os-release").read_text().splitlines() if "=" in line)
    if settings["ID"] == "debian":
        return version.read_text().strip()
    return settings["VERSION_ID"].strip('"')


def report(command, outcome, log):
    say(f"{command}: {outcome.result}, {len(outcome.warnings)} warnings, {outcome.minutes:.1f} min ({log})")
    for line in outcome.warnings[:SHOWN]:
        say(f"  {line}")
    if len(outcome.warnings) > SHOWN:
        say(f"  ... and {len(outcome.warnings) - SHOWN} more")


def try_compiler(bare, compiler, logs):
    """The row of one system and compiler, and whether all was as it should be."""
    copy = bare.copy()
    clone, outcomes = f"{copy}{CHECKOUT}", []
    try:
        git("clone", "--quiet", "--no-hardlinks", ".", clone)
        for command in ("run", "test"):
            log = logs / f"{bare.family}-{bare.suite}-{Path(compiler).name}-{command}.txt"
            code, said, seconds = timed(copy, CHECKOUT, ["make", command, f"CXX={compiler}"], log)
            if command == "run":
                summaries = list(Path(clone, "out").glob("plug_u24*/summary.json"))
                outcomes.append(outcome_of_run(code, said, summaries[0].read_text() if summaries else None, seconds))
            else:
                outcomes.append(outcome_of_test(code, said, seconds))
            report(f"{bare.family}:{bare.suite}, make {command} CXX={compiler}", outcomes[-1], log)
        log = logs / "version.txt"
        run_in(copy, "/", [compiler, "--version"], log)
        names = (f"{bare.family}:{bare.suite}", compiler, release_of(copy), version_in(log.read_text()))
        return row(names, *outcomes, commit_in(clone)), all(outcome.passed and not outcome.warnings for outcome in outcomes)
    finally:
        remove(copy)


def try_system(system, compilers, folder):
    """(row, passed) for each compiler."""
    family = system.partition(":")[0].upper()
    try:
        bare = BareRoot(system, folder / "roots", os.environ.get(f"{family}_MIRROR"), os.environ.get(f"{family}_KEYRING"))
        bare.make(folder / "logs" / f"{system.replace(':', '-')}-debootstrap.txt")
    except NotTried as why:
        say(f"{system} not tried: {why}")
        for compiler in compilers:
            yield row_not_tried(system, compiler, str(why), commit_in(root)), False
        return
    for compiler in compilers:
        yield try_compiler(bare, compiler, folder / "logs")


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("systems", nargs="+", metavar="SYSTEM")
    arguments.add_argument("--compilers", nargs="+", default=["g++", "clang++"])
    arguments.add_argument("--folder", type=Path, required=True)
    arguments.add_argument("--document", type=Path, required=True, help="file with the marks of the table")
    chosen = arguments.parse_args()
    for wrong in filter(None, map(name_refused, chosen.systems)):
        arguments.error(wrong)
    if os.geteuid() != 0:
        say("debootstrap and chroot are for root only: sudo make test-systems")
        return 2
    signal.signal(signal.SIGTERM, lambda number, _: sys.exit(128 + number))  # so that copies are removed
    (chosen.folder / "logs").mkdir(parents=True, exist_ok=True)
    document = KeptTable(chosen.document, "systems table", HEAD, KEY)
    with open(chosen.folder / "lock", "w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            say(f"another make test-systems is at work in {chosen.folder}; wait for it")
            return 2
        if git("status", "--porcelain", "--untracked-files=no"):
            say("changes that are not committed are left out")
        all_passed = True
        for system in chosen.systems:
            for new, passed in try_system(system, chosen.compilers, chosen.folder.resolve()):
                table = document.put(new_rows(document.rows(), new))
                all_passed &= passed
    print(table)
    for complaint in states_that_differ(document.rows()):
        say(f"runs ended in different states: {complaint}")
        all_passed = False
    return 0 if all_passed else 1


if __name__ == "__main__":
    sys.exit(main())
