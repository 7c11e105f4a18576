#!/usr/bin/env python3
"""Runs what make export-lammps wrote over MPI, and writes summary.json beside it: make run-lammps.

summary.json has the entries `final`, `performance` and `plug` of the program's (tools/README.md) as far as they can be told
from the final dump, with the same units; energies and contacts are computed by tools/peers/states.py. Speed is that of
LAMMPS' own loop by the clock, gas included; `processor_share` is how much of a core each rank had (1 on a quiet machine).
Exit code: 0 done, 2 wrong usage, 3 a result that cannot be read, 6 files; otherwise that of mpirun.
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "peers"))
from case_values import read_header
from ending import Failed, finish
from export_lammps import clear_results, positive
from scene_files import SUFFIX
from states import observe, read_dump

BUSY = re.compile(r"([\d.]+)% CPU use with")
LOOP = re.compile(r"Loop time of (\S+) on (\d+) procs for (\d+) steps with (\d+) atoms")


def found(command):
    path = shutil.which(command)
    if not path:
        raise Failed(2, f"no program {command}: install it, or give its path (LMP=/path/to/lmp, MPIRUN=/path/to/mpirun)")
    return str(Path(path).resolve())


def environment(ranks):
    """Open MPI refuses to be root and to run more processes than cores unless told so; other kinds of MPI do not look."""
    changed = {"OMP_NUM_THREADS": "1"}
    if os.geteuid() == 0:
        changed |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    if ranks > cores:
        changed |= {"OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none"}
        changed |= {"OMPI_MCA_mpi_yield_when_idle": "1"}
    return {**os.environ, **changed}


def command(program, ranks, mpirun, variables, quiet):
    """A program of ours finds its scripts itself; LAMMPS is told."""
    line = [found(mpirun), "-np", str(ranks), found(program), "-log", "log.lammps"]
    if Path(program).name.startswith("lmp"):
        line += ["-in", "run.in"]
    for name, value in variables.items():
        line += ["-var", name, str(value)]
    return line + (["-screen", "none"] if quiet else [])


def run(folder, program, ranks, mpirun="mpirun", steps=None, frames=None, quiet=False):
    variables = {name: value for name, value in (("steps", steps), ("frames", frames)) if value is not None}
    line = command(program, ranks, mpirun, variables, quiet)
    clear_results(folder)
    done = subprocess.run(line, cwd=folder, env=environment(ranks), check=False)
    if done.returncode != 0:
        said = folder / "log.lammps"
        last = said.read_text(errors="replace").splitlines()[-3:] if said.exists() else []
        raise Failed(done.returncode, "\n  ".join([f"{' '.join(line)} in {folder}: exit code {done.returncode}", *last]))


def summary(folder, case, ranks, repeat=1):
    """What came out, from the files of a run that is done."""
    text = (folder / "log.lammps").read_text()
    loop, busy, version = LOOP.search(text), BUSY.search(text), re.search(r"LAMMPS \((.*?)\)", text)
    if not (loop and busy and version):
        raise Failed(3, f"{folder}/log.lammps: no 'Loop time' in it: the run did not end")
    seconds, steps, particles = float(loop[1]), int(loop[3]), int(loop[4])
    if int(loop[2]) != ranks:
        raise Failed(3, f"{folder}/log.lammps: {loop[2]} ranks instead of {ranks}: mpirun is of another MPI than LAMMPS")
    whole = {**case, "pipe_length": case["pipe_length"] * repeat, "particle_count": case["particle_count"] * repeat}
    state = read_dump(folder / "final.lammpstrj")
    if len(state.positions) != particles:
        raise Failed(3, f"{folder}/final.lammpstrj: {len(state.positions)} particles, log.lammps says {particles}")
    seen = observe(whole, state)
    plug = folder / "plug.json"
    return {
        "case": case["name"],
        "repeat": repeat,
        "program": f"LAMMPS {version[1]}",
        "ranks": ranks,
        "particles": particles,
        "time_step": case["time_step"],
        "steps": steps,
        "final": {
            "time": steps * case["time_step"],
            "kinetic_energy": seen.kinetic_energy,
            "contacts": seen.contacts,
            "mean_axial_velocity": sum(v[2] for v in state.velocities) / particles,
            "mean_height": seen.mean_height,
        },
        "performance": {
            "wall_time": seconds,
            "processor_share": float(busy[1]) / 100,
            "particle_steps_per_second": particles * steps / seconds if seconds > 0 else None,
        },
        "plug": json.loads(plug.read_text()) if plug.exists() else None,
    }


def write_summary(folder, outcome):
    path = folder / "summary.json"
    temporary = path.with_name(path.name + SUFFIX)
    temporary.write_text(json.dumps(outcome, indent=2) + "\n")
    os.replace(temporary, path)


def describe_plug(plug):
    if plug is None:
        return ""
    if plug["front_velocity"] is None:
        return f"\nplug: none ({plug['samples_with_plug']} of {plug['samples']} samples in the second half of the run show one)"
    return (
        f"\nplug: front {plug['front_velocity']:.3f} m/s, layer area ratio {plug['layer_area_ratio']:.3f}, "
        f"{plug['pressure_gradient']:.0f} Pa/m"
    )


def describe(outcome):
    final, speed = outcome["final"], outcome["performance"]["particle_steps_per_second"]
    share = outcome["performance"]["processor_share"]
    fast = "" if speed is None else f", {speed * 1e-6:.4g} million particle-steps/s with {share:.0%} of a core for each rank"
    return (
        f"{outcome['case']}: {outcome['particles']} particles, {outcome['steps']} steps on {outcome['ranks']} ranks of "
        f"{outcome['program']} in {outcome['performance']['wall_time']:.2f} s{fast}\n"
        f"kinetic energy {final['kinetic_energy']:.6g} J, contacts {final['contacts']}, "
        f"mean height {final['mean_height']:.6g} m, mean axial velocity {final['mean_axial_velocity']:.6g} m/s"
        + describe_plug(outcome["plug"])
    )


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("folder", type=Path, help="written by export_lammps.py")
    arguments.add_argument("--header", type=Path, required=True, help="the case's header, written by casegen")
    arguments.add_argument("--repeat", type=positive, default=1, help="what the export was given")
    arguments.add_argument("--ranks", type=positive, default=1, help="MPI processes")
    arguments.add_argument("--program", default="lmp", help="LAMMPS, or the program that has the gas beside it")
    arguments.add_argument("--mpirun", default="mpirun")
    arguments.add_argument("--steps", type=positive, help="instead of the case's duration")
    arguments.add_argument("--quiet", action="store_true", help="LAMMPS' own output into log.lammps only")
    chosen = arguments.parse_args()
    case = read_header(chosen.header)
    run(chosen.folder, chosen.program, chosen.ranks, chosen.mpirun, chosen.steps, quiet=chosen.quiet)
    outcome = summary(chosen.folder, case, chosen.ranks, chosen.repeat)
    write_summary(chosen.folder, outcome)
    print(describe(outcome))
    print(f"results in {chosen.folder}: summary.json, final.lammpstrj, log.lammps")


if __name__ == "__main__":
    finish("run-lammps", main)
