"""Figs. 10, 12 and 14: plugs every 0.1 s, seen through the wall of the pipe, marked particles in black.

Marked are particles that start in a slice of the pile, a tenth of its length in the middle; they keep their mark. Fig. 10: 1000 particles
at 2.4 m/s; Fig. 12: 500; Fig. 14: 1000 at 1.7 m/s, with the bed's resistance of 10 mm particles and with that of 3 mm.
"""

from drawing import side_views
from frames import frames_at
from plug_verdict import verdict

WORDS = {"moves": "moves", "dies": "shrinks and comes to rest", "collapses": "is gone: a stationary layer is left"}


def marks(frame):
    places = sorted(z for _, _, z in frame["position"])
    end = places[int(0.98 * len(places))]
    return [0.45 * end < z < 0.55 * end for _, _, z in frame["position"]]


def panels_of(run, times, label=""):
    shown = frames_at(run, times)
    marked = marks(shown[0][1])
    return [(f"{label}{time:.1f} s", frame, marked) for time, frame in shown]


def tenths(duration, every=0.1):
    return [round(k * every, 3) for k in range(round(duration / every) + 1)]


def fig_10(run, summary, pipe, out):
    side_views(panels_of(run, tenths(1.2)), pipe, out / "fig_10")
    plug = summary["plug"]
    moves = verdict(plug) == "moves"
    found = f"its front at {plug['front_velocity']:.2f} m/s, the particles in it at {plug['particle_velocity']:.2f} m/s, over 0.6 to 1.2 s" if moves else "no front to follow"
    return (
        "A plug of 1000 particles in air at 2.4 m/s, every 0.1 s",
        f"Seen through the wall; black: particles that start in one slice. The plug {WORDS[verdict(plug)]}: {found}. "
        + ("As in the paper, the front moves like a wave, faster than the particles: it takes up those that lie in front and leaves others behind as a layer, "
           "so the black slice is drawn out and falls back through the plug." if moves and plug["front_velocity"] > plug["particle_velocity"]
           else "The paper's plug moves, with a front faster than its particles: this one does not."),
    )  # fmt: skip


def fig_12(run, summary, pipe, out):
    side_views(panels_of(run, tenths(1.2)), pipe, out / "fig_12")
    word = verdict(summary["plug"])
    return (
        "The same with 500 particles",
        f"At the end the plug {WORDS[word]}; the mean axial velocity is {round(summary['final']['mean_axial_velocity'], 3) + 0.0:.3f} m/s. "
        + ("As in the paper, so few particles form no plug that lasts." if word == "collapses" else "In the paper no plug is left."),
    )


def fig_14(plain, modified, pipe, out):
    """plain, modified: (folder, summary)"""
    times = tenths(1.2, 0.3)
    panels = panels_of(plain[0], times, "10 mm, ") + panels_of(modified[0], times, "3 mm, ")
    side_views(panels, pipe, out / "fig_14")
    words = verdict(plain[1]["plug"]), verdict(modified[1]["plug"])
    return (
        "1000 particles in air at 1.7 m/s, with the bed's resistance of 10 mm particles and with that of 3 mm",
        f"With 10 mm in the Ergun equation the plug {WORDS[words[0]]} (mean axial velocity at the end {plain[1]['final']['mean_axial_velocity']:.3f} m/s); with 3 mm, the paper's modification, "
        f"it {WORDS[words[1]]} ({modified[1]['plug']['front_velocity'] or 0:.2f} m/s). "
        + ("Both as the paper says: without the modification a short, diminishing plug that hardly moves." if words == ("dies", "moves") else "In the paper the first dies and the second moves."),
    )  # fmt: skip
