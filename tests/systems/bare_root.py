"""Bare roots of Debian and Ubuntu, for commands that are to find nothing installed but git and make.

debootstrap makes one root for each system, which is kept and never used itself: each use gets a copy. Whatever runs in one has mount
and process namespaces of its own, and so neither mounts nor processes are left behind, however it ends.

Packages come from where this machine's apt takes them, through its proxies; those of a system that this
machine's apt does not know from the mirror that is named.
"""

import os
import re
import shutil
import subprocess
from pathlib import Path

COMPONENTS = {"debian": "main", "ubuntu": "main,universe"}
# For releases that are younger than this debootstrap: a script that has served for all since.
SCRIPTS, FALLBACK = Path("/usr/share/debootstrap/scripts"), {"debian": "sid", "ubuntu": "gutsy"}
PATH = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"
PROXIES = ("http_proxy", "https_proxy", "no_proxy")
TIME_LIMIT = 3 * 3600  # s, for a command that waits for something
# A mount namespace of its own, which ends with this program, even when that is killed.
APART = ("setpriv", "--pdeathsig", "KILL", "unshare", "--mount")
# The shell stays as process 1 and waits for what others leave behind.
ENTER = 'mount -t proc proc "$1/proc" && mount --rbind /dev "$1/dev" && mount --rbind /sys "$1/sys" && shift && "$@"; exit $?'


class NotTried(Exception):
    """Why there is no root of a system."""


def name_refused(system):
    """What is wrong with a name that should be FAMILY:SUITE, for example debian:trixie; None when nothing is."""
    family, _, suite = system.partition(":")
    if family in COMPONENTS and re.fullmatch(r"[a-z][a-z0-9-]*", suite):
        return None
    return f"'{system}' is no system; allowed: {', '.join(f'{name}:SUITE' for name in COMPONENTS)}; for example debian:trixie"


class BareRoot:
    def __init__(self, system, folder, mirror=None, keyring=None):
        """`system`: FAMILY:SUITE. `folder`: where roots are kept."""
        self.family, _, self.suite = system.partition(":")
        self.folder = Path(folder)
        self.kept = self.folder / f"{self.family}-{self.suite}"
        self.mirror = mirror or mirror_of(self.family)
        self.keyring = Path(keyring or f"/usr/share/keyrings/{self.family}-archive-keyring.gpg")

    def make(self, log):
        """The kept root, unless it is there."""
        if self.kept.exists():
            return
        variable = self.family.upper()
        if not self.mirror:
            raise NotTried(f"this machine's apt knows no mirror of {self.family}; name one: {variable}_MIRROR=URL")
        if not self.keyring.exists():
            raise NotTried(f"no {self.keyring}; name the keyring that signs {self.family}: {variable}_KEYRING=FILE")
        unfinished = self.kept.with_suffix(".unfinished")
        remove(unfinished)
        unfinished.mkdir(parents=True)
        command = ["debootstrap", "--variant=minbase", "--include=git,make,ca-certificates", f"--keyring={self.keyring}"]
        command += [f"--components={COMPONENTS[self.family]}", self.suite, str(unfinished), self.mirror]
        if not (SCRIPTS / self.suite).exists():
            command.append(FALLBACK[self.family])
        with open(log, "w") as said:
            code = subprocess.run(
                [*APART, *command], stdin=subprocess.DEVNULL, stdout=said, stderr=subprocess.STDOUT, check=False
            ).returncode
        if code:
            lines = [line for line in Path(log).read_text(errors="replace").splitlines() if line.startswith(("E:", "W:"))]
            raise NotTried(f"debootstrap failed with exit code {code} ({log}): {lines[-1] if lines else 'no message'}")
        unfinished.rename(self.kept)

    def copy(self):
        """The path of a copy that is as bare as the kept root; an earlier one is gone."""
        path = self.folder / "copy"
        remove(path)
        subprocess.run(["cp", "-a", "--one-file-system", "--reflink=auto", str(self.kept), str(path)], check=True)
        shutil.copyfile("/etc/resolv.conf", path / "etc/resolv.conf")
        (path / "etc/apt/apt.conf.d/90from-outside").write_text(apt_settings())
        return path


def mirror_of(family):
    """The URL that this machine's apt takes a family's releases from, or None."""
    command = ["apt-get", "indextargets", "--format", "$(ORIGIN)|$(LABEL)|$(REPO_URI)", "Identifier: Packages"]
    try:
        found = subprocess.run(command, capture_output=True, text=True, check=False).stdout
    except FileNotFoundError:
        return None
    for origin, label, url in (line.split("|") for line in found.splitlines()):
        if origin.lower() == family and label.lower() == family:  # not the one of security updates
            return url
    return None


def apt_settings():
    """How this machine's apt reaches its mirrors (proxies, checks of dates), without what else it is told to do."""
    try:
        told = subprocess.run(["apt-config", "dump"], capture_output=True, text=True, check=True).stdout.splitlines()
    except FileNotFoundError:
        return ""
    wanted = ("Acquire::http::Proxy", "Acquire::https::Proxy", "Acquire::Check-", "Acquire::Retries")
    return "".join(f"{line}\n" for line in told if line.startswith(wanted) and not line.endswith(' "";'))


def run_in(path, folder, command, log):
    """Runs `command` (a list) in `folder` of the root at `path`, what it says going to the file `log`; its exit code."""
    environment = {"PATH": PATH, "HOME": "/root", "TERM": "dumb"}
    environment |= {name: os.environ[name] for name in PROXIES if name in os.environ}
    inside = ["chroot", str(path), "env", "-i", *(f"{name}={value}" for name, value in environment.items())]
    inside += ["sh", "-c", 'cd "$0" && exec "$@"', folder, *command]
    outside = [*APART, "--pid", "--fork", "--kill-child", "sh", "-c", ENTER, "sh", str(path), *inside]
    with open(log, "w") as said:
        try:
            return subprocess.run(
                outside, stdin=subprocess.DEVNULL, stdout=said, stderr=subprocess.STDOUT, timeout=TIME_LIMIT, check=False
            ).returncode
        except subprocess.TimeoutExpired:
            said.write(f"\nstopped after {TIME_LIMIT} s\n")
            return 124


def remove(path):
    subprocess.run(["rm", "-rf", "--one-file-system", str(path)], check=True)
