"""Writes a plan: the derived cases, once casegen has nothing against them, and the list of runs."""

import shutil
import subprocess

import tomli_w
from sweep_file import Refused


def check(casegen, path, name):
    asked = subprocess.run([casegen, path], check=False, capture_output=True, text=True)
    if asked.returncode != 0:
        raise Refused(f"the sweep needs a case that is refused: {name}\n{asked.stderr.strip()}", asked.returncode)


def write_cases(plan, folder, casegen):
    """The derived cases, checked by casegen in a folder beside, which stays when one is refused; those that have not changed are
    left alone, so that they need not be compiled again, and those of an earlier form of the sweep go."""
    trial = folder.with_name(folder.name + ".checked")
    shutil.rmtree(trial, ignore_errors=True)
    trial.mkdir(parents=True)
    texts = {name: tomli_w.dumps(case) for name, case in plan.cases.items()}
    seen = set()
    for name in (job.program for job in plan.jobs.values()):  # those that others start from come first
        if name not in seen:
            (trial / f"{name}.toml").write_text(texts[name])
            check(casegen, trial / f"{name}.toml", name)
            seen.add(name)
    for job in plan.jobs.values():
        values = [*zip(job.options[::2], job.options[1::2])]
        if not seen.issuperset(values):  # a value that one case may have, others may have too
            (trial / f"{job.program}.toml").write_text(tomli_w.dumps(job.checked))
            check(casegen, trial / f"{job.program}.toml", job.name)
            (trial / f"{job.program}.toml").write_text(texts[job.program])
            seen.update(values)
    folder.mkdir(exist_ok=True)
    for path in folder.glob("*.toml"):
        if path.stem not in texts:
            path.unlink()
    for name, text in texts.items():
        path = folder / f"{name}.toml"
        if not path.exists() or path.read_text() != text:
            (trial / path.name).replace(path)
    shutil.rmtree(trial)


def job_list(sweep, plan, programs):
    harmless = ["--checkpoint-interval", repr(float(sweep.checkpoint_interval))] if sweep.checkpoint_interval else []
    last = {name for _, name in plan.points}
    return [
        {"name": job.name, "program": str(programs / job.program), "harmless": harmless, "start": job.start, "stage": job.stage,
         "options": [*job.options, *([] if sweep.frames and job.name in last else ["--no-frames"])]}
        for job in plan.jobs.values()
    ]  # fmt: skip
