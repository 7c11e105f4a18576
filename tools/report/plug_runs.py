"""Runs of the five plugs from several seeds of their fills, shared by make plug-table and make figures.

A run lies in OUT/CASE-seedN and is made once: again only when its program, or the state that it starts from, is newer than its
results. Frames are written for the first seed only, for pictures. SI units, quantities are those of summary.json
(tools/README.md).
"""

import json
import subprocess
from concurrent.futures import ThreadPoolExecutor

PLUGS = {  # plug: the fill it starts from
    "plug_u24": "fill_1000",
    "plug_u17": "fill_1000",
    "plug_u17_d3": "fill_1000",
    "plug_u24_d3": "fill_1000",
    "plug_u24_n500": "fill_500",
}


def is_fresh(folder, older, frames):
    """Whether what lies in a folder was made after all files in `older`."""
    summary = folder / "summary.json"
    wanted = [summary, folder / "final.fixdem"] + ([folder / "frames.pvd"] if frames else [])
    return all(path.exists() for path in wanted) and all(path.stat().st_mtime < summary.stat().st_mtime for path in older)


class PlugRuns:
    def __init__(self, programs, out, seeds, jobs=2):
        self.programs, self.out, self.seeds, self.jobs = programs, out, seeds, jobs

    def folder(self, case, seed):
        return self.out / f"{case}-seed{seed}"

    def run(self, case, seed, older, *options):
        program, folder = self.programs / case, self.folder(case, seed)
        frames = case in PLUGS and seed == self.seeds[0]
        if not is_fresh(folder, [program, *older], frames):
            command = [program, "--out", folder, "--quiet", *([] if frames else ["--no-frames"]), *options]
            done = subprocess.run(command, check=False, capture_output=True, text=True)
            if done.returncode != 0:
                raise SystemExit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stderr}")
            print(f"{folder}: done", flush=True)
        return json.loads((folder / "summary.json").read_text())

    def fill(self, case, seed):
        return self.run(case, seed, [], "--seed", str(seed))

    def plug(self, case, seed):
        state = self.folder(PLUGS[case], seed) / "final.fixdem"
        return self.run(case, seed, [state], "--start-state", state)

    def all(self):
        """(plug, seed) -> its summary; as many programs at a time as there are jobs, fills first."""
        with ThreadPoolExecutor(self.jobs) as pool:
            for job in [pool.submit(self.fill, case, seed) for seed in self.seeds for case in sorted(set(PLUGS.values()))]:
                job.result()
            jobs = {(case, seed): pool.submit(self.plug, case, seed) for case in PLUGS for seed in self.seeds}
            return {key: job.result() for key, job in jobs.items()}
