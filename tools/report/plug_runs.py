"""Runs of the five plugs from several seeds of their fills, shared by make plug-table and make figures.

A run lies in OUT/CASE-seedN and is made once (kept_run.py): again only when its program, or the state that it starts from, is
another; one that was stopped goes on. Frames are written for the first seed only, for pictures. SI units, quantities are those of
summary.json (tools/README.md).
"""

from concurrent.futures import ThreadPoolExecutor

from kept_run import KeptRun

PLUGS = {  # plug: the fill it starts from
    "plug_u24": "fill_1000",
    "plug_u17": "fill_1000",
    "plug_u17_d3": "fill_1000",
    "plug_u24_d3": "fill_1000",
    "plug_u24_n500": "fill_500",
}


class PlugRuns:
    def __init__(self, programs, out, seeds, jobs=2):
        self.programs, self.out, self.seeds, self.jobs = programs, out, seeds, jobs

    def folder(self, case, seed):
        return self.out / f"{case}-seed{seed}"

    def run(self, case, seed, start_state=None, options=()):
        frames = case in PLUGS and seed == self.seeds[0]
        return KeptRun(self.folder(case, seed), self.programs / case, (*options, *([] if frames else ["--no-frames"])), start_state).made()

    def fill(self, case, seed):
        return self.run(case, seed, options=("--seed", str(seed)))

    def plug(self, case, seed):
        return self.run(case, seed, self.folder(PLUGS[case], seed) / "final.fixdem")

    def all(self):
        """(plug, seed) -> its summary; as many programs at a time as there are jobs, fills first."""
        with ThreadPoolExecutor(self.jobs) as pool:
            for job in [pool.submit(self.fill, case, seed) for seed in self.seeds for case in sorted(set(PLUGS.values()))]:
                job.result()
            jobs = {(case, seed): pool.submit(self.plug, case, seed) for case in PLUGS for seed in self.seeds}
            return {key: job.result() for key, job in jobs.items()}
