"""The parts of the page that are plain HTML: tables of verdicts, energies, speed, capacities; places for player, charts, maps."""

from html import escape


def number(value, digits=3):
    if value is None:
        return "-"
    return f"{value:.{digits}g}" if isinstance(value, float) else f"{value:,}".replace(",", "\u202f")


def table(name, head, rows):
    """Cells are HTML; the first of each row is its heading. The name is for those who hear the page."""
    cells = "".join(f'<th scope="col">{cell}</th>' for cell in head)
    lines = "".join(
        f'<tr><th scope="row">{first}</th>' + "".join(f"<td>{cell}</td>" for cell in rest) + "</tr>" for first, *rest in rows
    )
    return (
        f'<div class="wide" tabindex="0" role="region" aria-label="{name}"><table><thead><tr>{cells}</tr></thead>'
        f"<tbody>{lines}</tbody></table></div>"
    )


def verdict_table(verdicts):
    rows = [(escape(v["what"]), escape(v["found"]), f'<span class="{v["tone"]}">{escape(v["word"])}</span>', escape(v["why"])) for v in verdicts]
    return table("verdicts", ("what", "measured", "verdict", "by this rule"), rows)


PLAYER = """<h2>The particles</h2>
<figure aria-label="player of the particles in three dimensions">
  <canvas id="stage" tabindex="0" role="application" aria-label="particles; space plays, comma and full stop step, arrows turn, plus and minus zoom"></canvas>
  <p id="trouble" class="bad"></p>
  <div class="controls">
    <button id="play">Play</button>
    <label class="grow">time <input id="time" type="range" min="0" value="0"></label>
    <output id="now" for="time">0 s</output>
    <label>speed <select id="rate">$rates</select></label>
  </div>
$along  <div class="controls">
    <label>colour <select id="colour">$own<option value="axial">axial velocity</option><option value="speed">speed</option>
      <option value="contacts">contacts</option><option value="id">number</option></select></label>
    <span class="scale"><span id="scale-name"></span> <span id="scale-low"></span><span id="scale-bar" class="bar"></span><span id="scale-high"></span></span>
    <label><input id="cut" type="checkbox"> half of the pipe</label>
    <span><button data-view="side">side</button> <button data-view="oblique">oblique</button> <button data-view="end">end</button></span>
  </div>
  <figcaption>$caption</figcaption>
</figure>"""

ALONG = """  <div id="strip" tabindex="0" role="slider" aria-label="part of the pipe that is shown, its middle in m" aria-valuemin="0" aria-valuemax="$length" aria-valuenow="0">
    <canvas aria-hidden="true"></canvas><div class="part"></div></div>
  <div class="controls">
    <output id="where"></output>
    <label>shows <select id="reach">$reaches</select></label>
    <label>moves with <select id="with"><option value="">nothing</option>$plugs</select></label>
  </div>
"""


def along(run):
    """Of a line: the whole pipe as a strip, and which part of it the picture shows."""
    length, window = run["pipe"]["length"], run["line"]["window"]
    reaches = sorted({window, *(reach for reach in (0.25 * window, 0.5 * window, 2 * window, 4 * window, length) if reach <= length)})
    options = "".join(f'<option value="{r:g}"{" selected" if r == window else ""}>{"all" if r == length else f"{r:.2g} m"}</option>' for r in reaches)
    numbers = [one["plug"] for one in run["line"]["tracks"]]
    plugs = "".join(f'<option value="{k}">plug {k}</option>' for k in numbers)
    each = '<option value="each" selected>one plug after another</option>' if numbers else ""
    return ALONG.replace("$length", f"{length:g}").replace("$reaches", options).replace("$plugs", each + plugs)


def player(run, about):
    duration = run["end"]
    rates = [(1, "as it is"), (0.5, "1/2"), (0.2, "1/5"), (0.1, "1/10"), (0.02, "1/50"), (0.005, "1/200")]
    wanted = min(rates, key=lambda rate: abs(duration / rate[0] - 10))  # about ten seconds in all
    options = "".join(f'<option value="{r}"{" selected" if r == wanted[0] else ""}>{name}</option>' for r, name in rates)
    left_out = []
    if about["every"] > 1:
        left_out.append(f"every {about['every']}th of {about['of_frames']} frames")
    if about["share"] > 1:
        left_out.append(f"every {about['share']}th of {number(about['of_particles'])} particles" + (f", drawn {about['drawn']:.2g} times as large" if "drawn" in about else ""))
    count = number(about["particles"]) if "line" not in run else f"Up to {number(about['of_particles'])}"
    moves = "" if "line" not in run else " The strip is the whole pipe, coloured by solids fraction: drag it, or use its arrows, to move along the pipe."
    caption = (
        f"{count} particles, {len(about['times'])} frames"
        + (f" ({', '.join(left_out)}: more does not fit into a page)" if left_out else "")
        + ". Drag to turn, wheel to zoom; with the keyboard in the picture: space plays, comma and full stop step by a frame, arrows "
        "turn, plus and minus zoom. Between frames places are interpolated. Half of the pipe: particles whose centres are "
        "in front of the middle plane (x &lt; 0) are left out. " + run["directions"] + moves
    )
    # What particles differ in comes first, and is what they are coloured by.
    own = "".join(f'<option value="{name}">{name}</option>' for name in ("species", "diameter") if name in about.get("own", {}))
    return PLAYER.replace("$along", along(run) if "line" in run else "").replace("$rates", options).replace("$caption", caption).replace("$own", own)


def charts(list_of_charts):
    boxes = "".join(
        f'<figure><h3>{escape(chart["title"])}</h3><div id="{chart["id"]}" role="img"></div>'
        + (f'<figcaption>{escape(chart["note"])}</figcaption>' if chart["note"] else "")
        + "</figure>"
        for chart in list_of_charts
    )
    return (
        '<h2>In the course of time</h2><p class="faint">The vertical line is the moment that the player shows; a click sets it.</p>'
        f'<div class="columns">{boxes}</div>'
    )


def maps(list_of_maps, overlay=""):
    """overlay: of a line, HTML over each of them."""
    if not list_of_maps:
        return ""
    boxes = "".join(
        f'<figure id="{m["id"]}"><h3>{m["title"]}</h3>'
        f'<p class="scale"><span class="low"></span><span class="bar"></span><span class="high"></span></p>'
        f'<div class="ends"><span>0 s</span><span>time downwards</span></div>'
        f'<div class="map{" tall" if overlay else ""}"><canvas tabindex="0" role="application" aria-label="{m["title"]}: slices along the pipe from left to right, time '
        f'downwards; arrow keys move"></canvas>{overlay}<div class="moment-row"></div></div>'
        f'<div class="ends"><span>0 m</span><span>along the pipe</span><span>{m["length"]:g} m</span></div>'
        f'<output class="faint"></output></figure>'
        for m in list_of_maps
    )
    words = " Lines: fronts of plugs, those of the table below with their numbers, thin ones of others; dashed: stations." if overlay else ""
    return (
        '<h2>Along the pipe, in the course of time</h2><p class="faint">Each row is a frame, the bright line the moment of the player; '
        f'a click sets it.{words}</p><div class="columns">{boxes}</div>'
    )
