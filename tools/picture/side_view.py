"""Side views of a pipe as SVG: seen from the side (-x), z to the right, y up, one frame of a run in each panel.

Every particle is a circle true to scale, of its own size, nearer ones cover farther ones, and a particle of which nothing shows is left out,
which keeps the file small. What a circle looks like is its kind, a name that the caller gives for each particle. Lengths in
m, drawn at `scale` pixels per metre. rsvg-convert and pngquant make the PNG of it, so that both show the same.
"""

import subprocess

MARGIN_LEFT, MARGIN_RIGHT, MARGIN_TOP, GAP = 66, 14, 10, 12


def one_radius(frame):
    """Of all particles; None where they differ."""
    radius = frame["radius"][0]
    return radius if all(other == radius for other in frame["radius"]) else None


def visible(particles, width, height):
    """Those of which at least three pixels show, nearest last. particles: (x, column, row, radius, kind) in pixels."""
    taken = set()
    seen = []
    for particle in sorted(particles, key=lambda p: p[0]):  # smallest x, that is nearest, first
        _, column, row, radius, _ = particle
        shown = 0
        for j in range(max(0, int(row - radius)), min(int(height), int(row + radius) + 1)):
            for i in range(max(0, int(column - radius)), min(int(width), int(column + radius) + 1)):
                inside = (i + 0.5 - column) ** 2 + (j + 0.5 - row) ** 2 < radius * radius
                if inside and (i, j) not in taken:
                    taken.add((i, j))
                    shown += 1
        if shown >= 3:
            seen.append(particle)
    return reversed(seen)


def panel(frame, kinds, pipe, scale, are_equal):
    """One frame, in a frame of reference that starts at the pipe's upper left corner. kinds: one name per particle; are_equal: whether all
    particles of all frames are, so that one circle serves each kind."""
    length, diameter = pipe["length"], pipe["diameter"]
    width, height = length * scale, diameter * scale
    ring = (-length, 0, length) if pipe["ends"] == "periodic" else (0,)
    particles = []
    for (x, y, z), radius, kind in zip(frame["position"], frame["radius"], kinds):
        for image in (z + shift for shift in ring):  # a particle across the periodic end shows at both
            if -radius < image < length + radius:
                particles.append((x, image * scale, (diameter / 2 - y) * scale, radius * scale, kind))
    shown = visible(particles, width, height)
    if not are_equal:
        circles = (f'<circle class="{kind}" cx="{c:.1f}" cy="{r:.1f}" r="{size - 0.3:.2f}"/>' for _, c, r, size, kind in shown)
    else:
        circles = (f'<use href="#{kind}" x="{c:.1f}" y="{r:.1f}"/>' for _, c, r, _, kind in shown)
    return f'<rect width="{width:.1f}" height="{height:.1f}" class="pipe"/><g clip-path="url(#pipe)">' + "".join(circles) + "</g>"


def axis(length, scale, left, top):
    """Below the last panel: tenths of a metre along the pipe."""
    parts = []
    for k in range(int(length / 0.1 + 1e-9) + 1):
        x = left + 0.1 * k * scale
        parts.append(f'<path d="M{x:.1f} {top}v5" stroke="#444"/><text x="{x:.1f}" y="{top + 18}" text-anchor="middle">{0.1 * k:.1f}</text>')
    return "".join(parts)


def document(panels, pipe, styles, scale, foot, columns=1):
    """panels: (label, frame, kinds), one below the other, or row by row in several columns with the label above.

    styles: kind -> fill of its circle; foot: height and a function of x, y that draws what belongs below."""
    width, height = pipe["length"] * scale, pipe["diameter"] * scale
    above = 20 if columns > 1 else 0
    left = GAP if columns > 1 else max(MARGIN_LEFT, 16 + 7 * max(len(label) for label, _, _ in panels))
    pitch = height + GAP + above
    rows = -(-len(panels) // columns)
    total = left + columns * (width + GAP) - GAP + MARGIN_RIGHT, MARGIN_TOP + rows * pitch - GAP + foot[0]
    radii = {one_radius(frame) for _, frame, _ in panels}
    radius = radii.pop() if len(radii) == 1 else None
    circles = colours = ""
    if radius is None:
        colours = "".join(f".{kind}{{fill:{fill}}}" for kind, fill in styles.items())
    else:
        circles = "".join(f'<circle id="{kind}" r="{radius * scale - 0.3:.2f}" fill="{fill}"/>' for kind, fill in styles.items())
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {total[0]:.0f} {total[1]:.0f}" width="{total[0]:.0f}" height="{total[1]:.0f}">',
        "<style>text{font:13px sans-serif;fill:#222}.pipe{fill:#f4f4f2;stroke:#444}circle{stroke:#000;stroke-width:.6}" + colours + "</style>",
        f'<defs>{circles}<clipPath id="pipe"><rect width="{width:.1f}" height="{height:.1f}"/></clipPath></defs>'
        '<rect width="100%" height="100%" fill="#fff"/>',
    ]
    for k, (label, frame, kinds) in enumerate(panels):
        x, y = left + k % columns * (width + GAP), MARGIN_TOP + k // columns * pitch + above
        place = (x, y - 6, "start") if columns > 1 else (x - 8, y + pitch / 2, "end")
        parts.append(f'<text x="{place[0]:.0f}" y="{place[1]:.0f}" text-anchor="{place[2]}">{label}</text>')
        parts.append(f'<g transform="translate({x:.1f} {y:.1f})">{panel(frame, kinds, pipe, scale, radius is not None)}</g>')
    parts.append(foot[1](left, MARGIN_TOP + rows * pitch - GAP + 1))
    return "\n".join(parts) + "</svg>\n"


def save(svg_text, path, colours=128):
    """path.svg and, of it, path.png with so many colours."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.with_suffix(".svg").write_text(svg_text)
    save_png(path, colours)


def save_png(path, colours=128):
    """path.png, of path.svg."""
    svg, png = path.with_suffix(".svg"), path.with_suffix(".png")
    subprocess.run(["rsvg-convert", "--zoom", "1.2", str(svg), "--output", str(png)], check=True)
    subprocess.run(["pngquant", "--force", "--strip", "--output", str(png), str(colours), str(png)], check=True)
    print(f"{svg} ({svg.stat().st_size // 1000} kB), {png} ({png.stat().st_size // 1000} kB)")
