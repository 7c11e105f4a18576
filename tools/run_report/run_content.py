"""What the page of a run shows of its frames and log, for every case but an open line (line_content.py): charts, maps, player."""

import numpy as np
import page_content
import player_data
import run_folder


def map_data(ident, name, title, unit, times, values, length, high=None):
    rounded = [[float(f"{v:.3g}") for v in row] for row in values]
    low, top = min(0.0, float(values.min())), float(values.max()) if high is None else high
    unit_above = " and more" if top < values.max() else ""
    return {"above": unit_above, "id": ident, "name": name, "title": title, "unit": unit, "times": times, "values": rounded, "low": low, "high": top, "length": length}


def own_values(frames, summary):
    """What particles differ in, for the player: nothing where all are equal."""
    if frames["radius"].min() == frames["radius"].max() and frames["species"] is None:
        return {}
    own = {"diameter": 2 * frames["radius"]}
    if frames["species"] is not None:
        own |= {"species": frames["species"], "names": [species["name"] for species in summary["species"]]}
    return own


def maps(pipe, frames):
    slices = run_folder.slices_of(pipe, frames)
    times = [round(float(time), 9) for time in frames["times"]]
    solids = run_folder.solids_fraction(pipe, frames["position"][:, :, 2], [frames["radius"]] * len(times), slices)
    found = [map_data("map-solids", "solids fraction", "Solids fraction", "", times, solids, pipe["length"])]
    if frames["pressure_gradient"] is not None:
        gradient = run_folder.by_slices(frames["pressure_gradient"], slices)
        found.append(map_data("map-gradient", "pressure gradient", "Pressure gradient of the gas", "Pa/m", times, gradient, pipe["length"], float(np.percentile(gradient, 99))))
    return found


class RunContent:
    """verdicts; data: what the page's script is given; packed: the frames; overlay: what is drawn over maps; plugs: a table of them."""

    overlay = plugs = packed = ""

    def __init__(self, run, case, pipe, summary, log, budget):
        self.verdicts = page_content.verdicts(summary, log, case)
        self.data = {"radius": None, "charts": page_content.charts(log), "maps": [], "frames": None}
        frames = run_folder.read_frames(run)
        if frames:
            own = own_values(frames, summary)
            self.data["frames"], self.packed = player_data.pack(frames["times"], frames["position"], frames["velocity"], frames["contacts"], budget, own)
            self.data |= {"radius": float(frames["radius"].max()), "maps": maps(pipe, frames)}
