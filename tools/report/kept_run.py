"""A run that is made once: left alone when its results are whole and of this very program and input, resumed from its
checkpoint when it was stopped, and started otherwise. The folder belongs to whoever keeps the run: results of another program
or input are replaced, and no checkpoint is kept of a run that is done.

Beside the folder of the results lies a record, FOLDER.json. It says what the run is of (`fingerprint`: program, options and
start state, by their contents), who has it (`owner`) and how it stands (`state`):

  running  by the owner, who touches the record every BEAT seconds
  stopped  by a signal, a full disk, a crash: to be gone on with
  done     results are whole
  failed   the program has ended it with one of the exit codes FAILED; the same again would end the same

Several machines may share the folder. A record that says `running` is taken over when its owner is a process of this machine
that is gone, or when nobody has touched it for LEASE seconds, by the clock of the shared file system. An owner that finds
another's name in its record stops its program. A program stops when the process that watches it dies (by setpriv, where that is).
Only the standard library is used, because this part runs on the machines of a sweep.
"""

import contextlib
import functools
import hashlib
import json
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time
import uuid
from dataclasses import dataclass
from pathlib import Path

FAILED = (2, 3, 4, 5)  # exit codes of tools/run that a repetition would not change
BEAT = 2.0  # s
NO_SUCH_INSTRUCTION = "this machine lacks instructions that the program was compiled for: build with ARCH=x86-64-v3 or x86-64"
LEASE = float(os.environ.get("FIXDEM_LEASE", "60"))  # s


def write_whole(path, text):
    """A file that is never half written."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    scratch = path.with_name(f".{path.name}.{uuid.uuid4().hex[:8]}")
    scratch.write_text(text)
    scratch.replace(path)


@functools.lru_cache(maxsize=4096)
def digest_of_contents(path, _size, _modified):
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def digest(path):
    """SHA-256 of a file's contents, read again only when the file has changed; None where there is no file."""
    try:
        status = os.stat(path)
        return digest_of_contents(str(path), status.st_size, status.st_mtime_ns)
    except FileNotFoundError:
        return None


def particle_steps(summary):
    """Steps of the whole run times its particles, from its own figures of speed."""
    speed = summary["performance"]
    return round((speed["particle_steps_per_second"] or 0.0) * speed["kernel_time"])


class Superseded(Exception):
    """Another process has taken the run over."""


@dataclass
class Beginning:
    """Of a program that is started: the step that it goes on from, and the time by the clock of the file system."""

    step: int
    time: float


@dataclass
class KeptRun:
    """`options` are those that results depend on, `harmless` others; `start_state` is the file given as --start-state."""

    folder: Path
    program: Path
    options: tuple = ()
    start_state: Path | None = None
    harmless: tuple = ()

    @property
    def record_path(self):
        return self.folder.with_name(self.folder.name + ".json")

    def fingerprint(self):
        parts = [digest(self.program), *self.options, digest(self.start_state) if self.start_state else "no start state"]
        return hashlib.sha256(json.dumps(parts).encode()).hexdigest()

    def read(self):
        """The record; an empty one where there is none of this program and input."""
        try:
            record = json.loads(self.record_path.read_text())
        except (OSError, ValueError):
            return {}
        return record if record.get("fingerprint") == self.fingerprint() else {}

    def is_over(self, record):
        results = all((self.folder / name).exists() for name in ("summary.json", "final.fixdem"))
        return record.get("state") == "failed" or (record.get("state") == "done" and results)

    def summary(self):
        return json.loads((self.folder / "summary.json").read_text())

    def write(self, **entries):
        """The moment of it, by the clock of the file system."""
        write_whole(self.record_path, json.dumps({"fingerprint": self.fingerprint(), **entries}, indent=1) + "\n")
        return self.record_path.stat().st_mtime

    def fail(self, message):
        """For a run that cannot even be started."""
        self.write(state="failed", owner=owner_here(), exit_code=None, message=message, seconds=0.0, particle_steps=0)

    def complete(self):
        """Brings the run to its end unless it is there; returns its record, whose state is not `running`."""
        while True:
            record = self.read()
            if self.is_over(record):
                return record
            if record.get("state") != "running" or self.is_abandoned(record["owner"]):
                break
            time.sleep(BEAT / 2)
        clear_folder(self.folder)
        # Results of another program or input give way if a kept run has made them, and are moved aside otherwise.
        anew = "--replace" if self.record_path.exists() else "--fresh"
        code, message = self.attempt("--resume" if record else anew)
        if code == 3 and record:  # a checkpoint that cannot be used must not stand in the way
            first = message
            code, message = self.attempt("--replace")
            message = f"begun anew, because: {first}\n{message}".rstrip()
        return self.read()

    def made(self):
        """The summary of the run, brought to its end; ends the caller with its last words where it fails."""
        if not self.is_over(self.read()):
            record = self.complete()
            if record["state"] != "done":
                raise SystemExit(f"{self.program}, results in {self.folder}: exit code {record['exit_code']}\n{record['message']}")
            print(f"{self.folder}: done", flush=True)
        return self.summary()

    def is_abandoned(self, owner):
        machine, process, _ = owner.split(" ")
        if machine == socket.gethostname() and not is_alive(int(process)):
            return True
        probe = self.record_path.with_name(f".{self.record_path.name}.{uuid.uuid4().hex[:8]}")
        probe.touch()
        try:
            return probe.stat().st_mtime - self.record_path.stat().st_mtime > LEASE
        finally:
            probe.unlink()

    def attempt(self, beginning):
        """One start of the program; its exit code and its last words, which the record has, too."""
        owner, begin = owner_here(), time.monotonic()
        began = Beginning(self.last_checkpoint() if beginning == "--resume" else 0, self.write(state="running", owner=owner))
        command = [*stopped_with_us(), self.program, "--out", self.folder, "--quiet", "--drop-checkpoint", beginning]
        command += [*self.options, *self.harmless]
        command += ["--start-state", self.start_state] if self.start_state else []
        with tempfile.TemporaryFile("w+", errors="replace") as said:
            try:
                program = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=said)
                code = self.watch(program, owner, began)
            except OSError as error:  # no such file, or not for this machine
                said.write(f"{error}\n")
                code = 126
            said.seek(0)
            message = "\n".join(said.read().strip().splitlines()[-6:])
        state = "done" if code == 0 else "failed" if code in FAILED else "stopped"
        if code == -signal.SIGILL:
            message = f"{message}\n{NO_SUCH_INSTRUCTION}".strip()
        self.write(
            state=state,
            owner=owner,
            exit_code=code,
            message=message,
            seconds=time.monotonic() - begin,
            particle_steps=self.steps_since(began),
        )
        return code, message

    def watch(self, program, owner, began):
        """Waits for the program and keeps the record alive; whatever ends the waiting ends the program, with a checkpoint."""
        try:
            while True:
                try:
                    return program.wait(BEAT)
                except subprocess.TimeoutExpired:
                    if self.read().get("owner") != owner:
                        raise Superseded(f"{self.folder}: taken over by another process") from None
                    os.utime(self.record_path)
        except BaseException as reason:
            program.terminate()
            code = program.wait()
            if not isinstance(reason, Superseded):
                self.write(
                    state="stopped",
                    owner=owner,
                    exit_code=code,
                    message="stopped",
                    seconds=0.0,
                    particle_steps=self.steps_since(began),
                )
            raise

    def last_checkpoint(self):
        """Its step; 0 where there is none and a run begins at its beginning."""
        return max((int(path.stem.split("-")[1]) for path in self.folder.glob("checkpoint-*.fixdem")), default=0)

    def steps_since(self, began):
        """Particle-steps of the program that was started then; zero when it died without a summary."""
        with contextlib.suppress(OSError, ValueError, KeyError, ZeroDivisionError):
            if (self.folder / "summary.json").stat().st_mtime >= began.time:
                summary = self.summary()
                return round(particle_steps(summary) * (1 - began.step / summary["steps"]))
        return 0


def owner_here():
    return f"{socket.gethostname()} {os.getpid()} {uuid.uuid4().hex[:8]}"


def is_alive(process):
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        pass
    return True


def stopped_with_us():
    return ["setpriv", "--pdeathsig", "TERM"] if shutil.which("setpriv") else []


def clear_folder(folder):
    """Waits for a program of this machine that is about to stop there; forgets the lock of one that died with its machine.
    Locks of dead programs of this machine are taken over by the next program itself."""
    begin = time.monotonic()
    with contextlib.suppress(OSError, ValueError):
        while time.monotonic() - begin < LEASE:
            _, process, _, _, machine = (folder / "lock").read_text().split()
            if machine != socket.gethostname():
                (folder / "lock").unlink()
            elif is_alive(int(process)):
                time.sleep(0.1)
            else:
                return
