#!/usr/bin/env python3
"""The live picture of a run (--watch): on a terminal it draws over itself, elsewhere and on a dumb one it stays away.

Usage: watch_test.py PROGRAM SCRATCH [COUNT_FILE]: the program of settle; a folder for its results. Writes "passed failed" to COUNT_FILE.
"""

import fcntl
import os
import pty
import re
import struct
import subprocess
import sys
import termios
from pathlib import Path

program, scratch = sys.argv[1:3]
passed = failed = 0


def check(what, right, found=""):
    global passed, failed
    passed, failed = passed + bool(right), failed + (not right)
    if not right:
        print(f"FAILED: {what}: {found!r}; again: tests/watch_test.py {program} {scratch}")


def command(*options):
    return [program, "--out", scratch, "--replace", "--no-frames", "--duration", "0.004", *options]


def on_terminal(columns, **settings):
    """What the program writes to a terminal of that width."""
    leader, follower = pty.openpty()
    fcntl.ioctl(follower, termios.TIOCSWINSZ, struct.pack("HHHH", 40, columns, 0, 0))
    environment = {k: v for k, v in os.environ.items() if k != "NO_COLOR"} | {"TERM": "xterm"} | settings
    with subprocess.Popen(command("--watch"), stdin=follower, stdout=follower, stderr=subprocess.PIPE, env=environment) as running:
        os.close(follower)
        seen = b""
        while True:
            try:
                part = os.read(leader, 65536)
            except OSError:  # the other side is closed
                break
            if not part:
                break
            seen += part
        check("ends well", running.wait() == 0, running.stderr.read())
    os.close(leader)
    return seen.decode()


def plain(text):
    return re.sub(r"\033\[[0-9]*[A-Za-z]", "", text).replace("\r", "")


def has_terminals():
    """Not where /dev/pts is missing, as in a bare chroot."""
    try:
        for end in pty.openpty():
            os.close(end)
        return True
    except OSError as error:
        print(f"the picture is not looked at: this system gives no pseudo-terminal ({error})")
        return False


def look_at_the_picture():
    seen = on_terminal(62)
    last = plain(seen.rpartition("settle   ")[2]).splitlines()
    check("a picture is drawn over the one before", re.search(r"\033\[\d+A", seen), seen[:300])
    check("cells that move are coloured", "\033[36m" in seen)
    check("it ends with the last moment", last[0].startswith("0.0040 s of 0.004 s"), last[0])
    check("the rule fills the terminal", last[1] == "+" + "-" * 60 + "+", last[1])
    pipe = [line for line in last if line.startswith("|")]
    check("rows of the pipe", len(pipe) == 20 and all(len(line) == 62 for line in pipe), pipe)
    check("particles show as letters, also at the bottom", all(any(c in "=+*#%@:-" for c in line) for line in (pipe[10], pipe[18])), pipe)
    check("key figures", any("kinetic energy" in line for line in last))
    check("no table", "E transl" not in seen)
    check("NO_COLOR", "\033[36m" not in on_terminal(62, NO_COLOR="1"))
    dumb = on_terminal(62, TERM="dumb")
    check("a dumb terminal gets the table", "E transl" in dumb and "\033[" not in dumb, dumb[:300])


def table(*options):
    text = subprocess.run(command(*options), capture_output=True, text=True, check=True).stdout
    return text[: text.index("settle: done")]  # after that: speeds, which differ


if has_terminals():
    look_at_the_picture()
check("without a terminal it is as if not asked for", table("--watch") == table())
check("--quiet is quieter", subprocess.run(command("--watch", "--quiet"), capture_output=True, text=True, check=True).stdout == "")

if len(sys.argv) > 3:
    Path(sys.argv[3]).write_text(f"{passed} {failed}\n")
print(f"{passed} passed, {failed} failed")
sys.exit(failed > 0)
