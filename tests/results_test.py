#!/usr/bin/env python3
"""What lies in a folder of results is never lost or taken for something else: programs run as a user runs them.

Usage: tests/results_test.py BUILD_FOLDER [COUNT_FILE]. Needs the programs settle, settle_mixed and collide_pair in BUILD_FOLDER/bin
and BUILD_FOLDER/casegen. Writes "PASSED FAILED" to COUNT_FILE. Exit code: 0 when all passed.
"""

import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.dont_write_bytecode = True
from counted import run_and_count  # noqa: E402
from with_folder import WithFolder  # noqa: E402

BUILD = Path(sys.argv[1] if len(sys.argv) > 1 else "build/g++-native").resolve()
SHORT = ("--duration", "0.004", "--checkpoint-interval", "0.001")


def program(case):
    return str(BUILD / "bin" / case)


class Results(WithFolder):
    def run_case(self, *options, out="run", case="settle", **settings):
        done = subprocess.run([program(case), "--quiet", "--out", self.folder / out, *options], capture_output=True, text=True, check=False, **settings)
        return done.returncode, done.stderr

    def bytes_of(self, out="run"):
        """Of every file, but for the figures of the clock."""
        folder = self.folder / out
        found = {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file() and not p.name.startswith("checkpoint-")}
        summary = json.loads(found["summary.json"])
        del summary["performance"]
        return {**found, "summary.json": json.dumps(summary)}

    def start(self, *options, out="run", case="settle"):
        """A run that is under way: the first row of its log is there. It hears all signals, also where nohup started the tests."""
        def hear_all_signals():
            for number in (signal.SIGHUP, signal.SIGINT, signal.SIGTERM):
                signal.signal(number, signal.SIG_DFL)

        running = subprocess.Popen([program(case), "--quiet", "--out", self.folder / out, *options], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True, preexec_fn=hear_all_signals)
        self.addCleanup(running.stderr.close)
        self.addCleanup(running.kill)
        log, end = self.folder / out / "log.csv", time.monotonic() + 60
        while time.monotonic() < end and not (log.exists() and log.read_text().count("\n") > 1):
            time.sleep(0.005)
        return running

    def refuse(self, code, words, *options, **settings):
        found, said = self.run_case(*options, **settings)
        self.assertEqual(found, code, said)
        for word in words if isinstance(words, tuple) else (words,):
            self.assertIn(word, said)

    def crashed(self, out="run", fault="crash@40"):
        code, _ = self.run_case("--duration", "0.006", "--checkpoint-interval", "0.001", out=out, env={**os.environ, "FIXDEM_DISK_FAULT": fault})
        self.assertEqual(code, -signal.SIGKILL)


class NothingIsLost(Results):
    def test_a_second_start_says_what_lies_there_and_changes_nothing(self):
        self.assertEqual(self.run_case(*SHORT)[0], 0)
        before = self.bytes_of()
        self.refuse(0, "is done already", *SHORT)
        self.refuse(6, ("the finished run of settle, 0.004 s", "duration: 0.004 s there, 0.002 s here", "--fresh", "--extend"), "--duration", "0.002")
        self.refuse(6, "seed: 1 there, 2 here", *SHORT, "--seed", "2")
        self.refuse(6, "frames: written there, not written here", *SHORT, "--no-frames")
        self.refuse(6, ("case: settle there, collide_pair here", "[particles] count: 150 there, 2 here"), case="collide_pair")
        self.assertEqual(self.bytes_of(), before)
        self.crashed("stopped")
        (self.folder / "stopped" / "lock").unlink()  # of the dead: it is taken over, and goes
        names = sorted(p.name for p in (self.folder / "stopped").iterdir())
        self.refuse(6, ("an unfinished run of settle", "RESUME=1"), "--duration", "0.006", out="stopped")
        self.assertEqual(sorted(p.name for p in (self.folder / "stopped").iterdir()), names)

    def test_fresh_moves_what_lies_there_aside(self):
        real = self.folder / "elsewhere" / "real"
        real.mkdir(parents=True)
        (self.folder / "run").symlink_to(real)
        (real / "notes.txt").write_text("mine")
        for number in range(3):
            self.assertEqual(self.run_case("--duration", f"0.00{number + 1}", "--fresh")[0], 0)
        for number in (1, 2):
            self.assertEqual(json.loads((real.with_name(f"real.{number}") / "summary.json").read_text())["duration"], number / 1000)
            self.assertTrue((real.with_name(f"real.{number}") / "frames" / "frame_000000.vtp").exists())
        self.assertEqual(json.loads((real / "summary.json").read_text())["duration"], 0.003)
        self.assertEqual((real / "notes.txt").read_text(), "mine")
        self.assertTrue((self.folder / "run").is_symlink())
        here = self.folder / "here"
        here.mkdir()
        for duration in ("0.001", "0.002"):
            done = subprocess.run([program("settle"), "--quiet", "--fresh", "--out", ".", "--duration", duration], cwd=here, check=False, stderr=subprocess.DEVNULL)
            self.assertEqual(done.returncode, 0)
        self.assertEqual(json.loads((self.folder / "here.1" / "summary.json").read_text())["duration"], 0.001)

    def test_replace_throws_away_and_only_on_demand(self):
        self.run_case(*SHORT)
        self.assertEqual(self.run_case("--duration", "0.002", "--replace", "--drop-checkpoint")[0], 0)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["run"])
        self.assertEqual([p.name for p in (self.folder / "run").glob("checkpoint-*")], [])
        self.refuse(0, "is done already", "--duration", "0.002")
        self.refuse(3, "it cannot be extended", "--extend", "0.001")
        self.refuse(2, "begins anew", "--replace", "--resume")
        self.refuse(2, "", "--replace", "--fresh")

    def test_a_case_is_told_by_its_keys_not_by_its_comments(self):
        text = (Path(__file__).parent.parent / "cases" / "settle.toml").read_text()
        lines = []
        for name, contents in (("own", text), ("comment", text + "# a comment\n"), ("changed", text.replace("friction = 0.3", "friction = 0.25"))):
            header = self.folder / f"{name}.hpp"
            subprocess.run([BUILD / "casegen", self.write(f"{name}.toml", contents), "--output", header], check=True, capture_output=True)
            lines.append([line for line in header.read_text().splitlines() if " keys = " in line])
        self.assertEqual(lines[0], lines[1])
        self.assertEqual(lines[0][0].replace("[material] friction = 0.3", "[material] friction = 0.25"), lines[2][0])
        self.crashed()
        self.refuse(3, ("case: settle there, settle_mixed here", '[run] precision: "double" there, "mixed" here'), "--resume", case="settle_mixed")


class LongerRuns(Results):
    def test_a_finished_run_is_extended_to_the_bytes_of_a_longer_one(self):
        for case, first, whole, more in (("settle", "0.0043", "0.0071", "0.0028"), ("collide_pair", "0.0101", "0.0203", "0.0102")):
            self.assertEqual(self.run_case("--duration", whole, out=f"{case}-whole", case=case)[0], 0)
            for name, options in (("extend", ("--extend", more)), ("duration", ("--resume", "--duration", whole))):
                out = f"{case}-{name}"
                self.assertEqual(self.run_case("--duration", first, out=out, case=case)[0], 0)
                self.assertEqual(self.run_case(*options, out=out, case=case)[0], 0)
                self.assertEqual(self.bytes_of(out), self.bytes_of(f"{case}-whole"), out)
                self.refuse(0, "is done already", "--resume", out=out, case=case)
                self.assertEqual(len(list((self.folder / out).glob("checkpoint-*"))), 1)

    def test_an_interrupted_run_may_become_longer_but_not_shorter(self):
        self.run_case("--duration", "0.009", out="whole")
        self.crashed()
        self.refuse(2, "it can be made longer, not shorter", "--resume", "--duration", "0.005")
        self.refuse(2, "--extend is for finished runs", "--extend", "0.001")
        self.assertEqual(self.run_case("--resume", "--duration", "0.009")[0], 0)
        self.assertEqual(self.bytes_of(), self.bytes_of("whole"))

    def test_an_extension_that_dies_is_gone_on_with(self):
        self.run_case("--duration", "0.006", out="whole")
        self.run_case("--duration", "0.003")
        code, _ = self.run_case("--extend", "0.003", env={**os.environ, "FIXDEM_DISK_FAULT": "crash@9"})
        self.assertEqual(code, -signal.SIGKILL)
        self.refuse(2, "--extend is for finished runs", "--extend", "0.003")
        self.assertEqual(self.run_case("--resume")[0], 0)
        self.assertEqual(self.bytes_of(), self.bytes_of("whole"))

    def test_what_contradicts_a_finished_run_is_refused(self):
        self.run_case(*SHORT)
        before = self.bytes_of()
        self.refuse(2, "--seed", "--resume", "--seed", "2")
        self.refuse(2, "--no-frames", "--resume", "--no-frames")
        self.refuse(3, "case: settle there, settle_mixed here", "--resume", case="settle_mixed")
        self.refuse(6, "no folder", "--resume-from", str(self.folder / "run" / "checkpoint-2000.fixdem"), out="nowhere")
        self.assertFalse((self.folder / "nowhere").exists())
        self.refuse(6, "no folder", "--extend", "0.1", out="nowhere")
        self.refuse(2, "--extend", "--extend", "0")
        self.refuse(2, "--extend", "--extend", "1e300")
        self.refuse(6, ("checkpoint", "Is a directory"), "--resume-from", str(self.folder))
        self.assertEqual(self.bytes_of(), before)

    def test_intervals_without_end_never_come_due(self):
        code, said = self.run_case("--duration", "0.002", "--checkpoint-interval", "1e20")
        self.assertEqual((code, said), (0, ""))
        self.assertEqual(len(list((self.folder / "run").glob("checkpoint-*"))), 1)
        for duration in ("1e14", "1e300", "inf"):
            self.refuse(2, "--duration", "--duration", duration, out="long")


class Signals(Results):
    def test_a_repeated_signal_does_not_cost_the_checkpoint(self):
        for number in range(10):
            out = f"run{number}"
            running = self.start("--duration", "50", out=out)
            for _ in range(3):
                running.send_signal(signal.SIGTERM)
                time.sleep(0.001)
            self.assertEqual(running.wait(), 128 + signal.SIGTERM)
            self.assertEqual(len(list((self.folder / out).glob("checkpoint-*"))), 1)
            self.assertEqual(json.loads((self.folder / out / "summary.json").read_text())["status"], "interrupted")
            shutil.rmtree(self.folder / out)

    def test_a_terminal_that_closes_leaves_a_checkpoint(self):
        running = self.start("--duration", "50")
        running.send_signal(signal.SIGHUP)
        self.assertEqual(running.wait(), 128 + signal.SIGHUP)
        self.assertEqual(len(list((self.folder / "run").glob("checkpoint-*"))), 1)


class Page(WithFolder):
    def test_a_step_that_is_too_long_for_contacts_is_never_called_stable(self):
        root = Path(__file__).resolve().parent.parent
        for folder in ("tools/run_report", "tools/report", "tools/python"):
            sys.path.insert(0, str(root / folder))
        from page_content import time_step_verdicts

        stability = {"maximum_step_ratio": 0.602, "steps_per_contact": 3.5, "steps_per_contact_needed": 20.0}
        words = [row["word"] for row in time_step_verdicts(stability)]
        self.assertEqual(words, ["too long for its contacts", "fewer than 20: results may be wrong"])
        self.assertEqual([row["word"] for row in time_step_verdicts({**stability, "steps_per_contact": 36.2})], ["stable", "enough"])
        self.assertEqual([row["word"] for row in time_step_verdicts({**stability, "steps_per_contact": None})], ["stable"])


class Files(Results):
    def test_a_log_that_is_changed_during_the_run_is_noticed(self):
        running = self.start("--duration", "50")
        (self.folder / "run" / "log.csv").write_bytes(b"")
        self.assertEqual(running.wait(), 6)
        said = running.stderr.read()
        self.assertIn("log.csv has been changed by somebody else", said)
        running = self.start("--duration", "50", out="same-size")
        log = self.folder / "same-size" / "log.csv"
        changed = bytearray(log.read_bytes())
        changed[5] ^= 1
        with open(log, "r+b") as file:
            file.write(changed[:6])
        running.send_signal(signal.SIGTERM)
        self.assertEqual(running.wait(), 6)
        self.assertIn("log.csv has been changed in its first", running.stderr.read())

    def test_a_limit_on_the_size_of_files_ends_with_6(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))

        self.refuse(6, "File too large", "--duration", "0.002", preexec_fn=limit)

    def test_closed_streams_leave_the_files_alone(self):
        self.run_case("--duration", "0.002", out="whole")
        for number in range(3):
            out = self.folder / f"closed{number}"
            closing = " ".join(f"{k}<&-" for k in range(number + 1))
            code = subprocess.run(["sh", "-c", f'exec "$0" --duration 0.002 --out "$1" {closing}', program("settle"), out], check=False,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode  # fmt: skip
            self.assertEqual(code, 0)
            self.assertEqual(self.bytes_of(out), self.bytes_of("whole"))

    def test_links_and_other_peoples_files_are_not_written_through(self):
        victim = self.write("victim", "precious")
        run = self.folder / "run"
        run.mkdir()
        (run / "lock").symlink_to(victim)
        self.refuse(6, ("lock", "symbolic link"), "--duration", "0.001")
        (run / "lock").unlink()
        (run / "lock").write_text("my own words\n")
        self.refuse(6, "is no lock of fixdem", "--duration", "0.001")
        self.assertEqual((run / "lock").read_text(), "my own words\n")
        (run / "lock").unlink()
        for name in ("log.csv", "final.fixdem.part", "summary.json.part"):
            (run / name).symlink_to(victim)
        self.assertEqual(self.run_case("--duration", "0.001", "--replace")[0], 0)
        self.assertEqual(victim.read_text(), "precious")
        (run / "checkpoint-999.fixdem").mkdir()
        self.refuse(6, ("checkpoint-999.fixdem", "directory"), "--duration", "0.002", "--resume")


if __name__ == "__main__":
    del sys.argv[1:2]
    run_and_count(*sys.argv[1:2])
