#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws what homeward_bench_teach printed as SVG.

path_figures.py arcs OUTPUT FIGURE.svg       features, reprojection error and way of each arc along the path, and where its key
                                             images are by their arcs alone (figure 6 of Segvic et al. 2007)
path_figures.py settings FIGURE.svg NAME=OUTPUT,OUTPUT... ...   arcs and features of runs, a panel for each setting that varies;
                                             NAME is n, sigma or R, as the runs' last lines have it
path_figures.py plans FIGURE.svg OUTPUT...   where the key images of each run are by their arcs alone (figure 7 there)
"""

import math
import sys
from pathlib import Path

INK, GREY, GRID, LINE, DOUBTED = "#222", "#777", "#ddd", "#1f5f99", "#d9822b"
COLUMN = {"n": 0, "sigma": 1, "R": 2}


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def arcs_of(text):
    """Pictures from and to, features, error in pixels, way in metres of each arc, and whether its geometry is in doubt."""
    arcs = []
    for line in text.splitlines():
        if not line.startswith("| ") or line.startswith("| arc "):
            continue
        row = cells(line)
        begin, end = map(int, row[1].split("-"))
        features, spread_deg, lead = int(row[3]), float(row[11]), float(row[12])
        if end > begin:  # the arc that closes a path leads back
            arcs.append((begin, end, features, float(row[5]), float(row[7]), features < 30 or spread_deg > 3 or lead < 10))
    return arcs


def keys_of(text):
    """Where each key image is by its arcs, where it is in truth, and how that goes on: begin, new (unit of length) or kept."""
    rows = [cells(line)[1:] for line in text.splitlines() if line.startswith("key |")]
    return [(float(row[2]), float(row[3]), float(row[4]), float(row[5]), row[6]) for row in rows]


def row_of(text):
    """The settings, arcs and median features of the last line."""
    row = cells(next(line for line in text.splitlines() if line.startswith("row |"))[3:])
    return [float(value) for value in row[:3]], int(row[4]), float(row[7].split(",")[0])


def label(x, y, text, more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" {more}>{text}</text>'


def dot(x, y, is_open, colour=LINE):
    fill = f'fill="white" stroke="{colour}"' if is_open else f'fill="{colour}"'
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.6" {fill}/>'


class Panel:
    """Axes at a place of the drawing."""

    def __init__(self, box, x_range, y_most, title):
        self.left, self.top, self.width, self.height = box
        self.x_from, self.x_to = x_range
        self.y_most = y_most
        self.parts = [label(self.left, self.top - 7, title, 'font-weight="bold"')]
        for share in (0.0, 0.5, 1.0):
            self.parts.append(self.level(share * y_most, f'stroke="{GRID}"'))
            self.parts.append(label(self.left - 5, self.y(share * y_most) + 4, f"{share * y_most:g}", 'text-anchor="end"'))

    def x(self, value):
        return self.left + self.width * (value - self.x_from) / (self.x_to - self.x_from)

    def y(self, value):
        return self.top + self.height * (1 - value / self.y_most)

    def level(self, value, style):
        return f'<line x1="{self.left}" y1="{self.y(value):.1f}" x2="{self.left + self.width}" y2="{self.y(value):.1f}" {style}/>'

    def mark(self, value, text):
        self.parts.append(label(self.x(value), self.top + self.height + 14, text, 'text-anchor="middle"'))

    def bar(self, begin, end, value, colour):
        y = self.y(min(value, self.y_most))
        self.parts.append(f'<rect x="{self.x(begin):.1f}" y="{y:.1f}" width="{max(0.7, self.x(end) - self.x(begin) - 0.6):.1f}" '
                          f'height="{self.top + self.height - y:.1f}" fill="{colour}"/>')

    def line(self, points):
        path = " ".join(f"{self.x(x):.1f},{self.y(y):.1f}" for x, y in points)
        self.parts.append(f'<polyline points="{path}" fill="none" stroke="{LINE}" stroke-width="1.5"/>')
        self.parts.extend(dot(self.x(x), self.y(y), False) for x, y in points)


class Plan:
    """Key images from above, as large as the box lets them be: by their arcs, and, in grey, in truth."""

    def __init__(self, box, keys, title, last_words=""):
        left, top, width, height = box
        xs = [key[i] for key in keys for i in (0, 2)]
        ys = [key[i] for key in keys for i in (1, 3)]
        scale = min(width / max(0.1, max(xs) - min(xs)), height / max(0.1, max(ys) - min(ys)))
        middle = (min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2

        def at(x, y):
            return left + width / 2 + scale * (x - middle[0]), top + height / 2 - scale * (y - middle[1])

        self.parts = [label(left, top - 7, title, 'font-weight="bold"')]
        for first, colour, thick in ((2, "#bbb", 4), (0, LINE, 1.2)):
            points = [(*at(*key[first:first + 2]), "M" if key[4] == "begin" else "L") for key in keys]
            path = " ".join(f"{step}{x:.1f},{y:.1f}" for x, y, step in points)
            self.parts.append(f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="{thick}" stroke-linejoin="round"/>')
        self.parts.extend(dot(*at(*key[:2]), key[4] != "kept") for key in keys)
        metres = next(step for step in (50, 20, 10, 5, 2, 1, 0.5) if scale * step <= width / 3 or step == 0.5)
        y = top + height + 20
        self.parts.append(f'<path d="M{left},{y} h{scale * metres:.1f}" stroke="{INK}" stroke-width="2"/>')
        self.parts.append(label(left + scale * metres + 6, y + 4, f"{metres:g} m{last_words}"))


def svg(width, height, panels, words=()):
    parts = "\n".join([part for panel in panels for part in panel.parts] + list(words))
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="11" '
            f'fill="{INK}">\n<rect width="{width}" height="{height}" fill="white"/>\n{parts}\n</svg>\n')


def round_up(value):
    step = next(step for step in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000) if value <= 4 * step)
    return step * -(-value // step)


def draw_arcs(text):
    arcs, keys = arcs_of(text), keys_of(text)
    last = arcs[-1][1]
    panels = []
    for i, (column, title) in enumerate(((2, "features of an arc"), (3, "reprojection error, pixels"), (4, "way, m"))):
        panel = Panel((40, 26 + 118 * i, 530, 76), (0, last), round_up(max(arc[column] for arc in arcs)), title)
        for arc in arcs:
            panel.bar(arc[0], arc[1], arc[column], DOUBTED if arc[5] else LINE)
        if column == 2:
            least = row_of(text)[0][0]
            panel.parts.append(panel.level(least, f'stroke="{INK}" stroke-dasharray="4 3"'))
            panel.parts.append(label(574, panel.y(least) + 4, f"n = {least:g}"))
        for picture in range(0, last + 1, 50 * max(1, last // 400)):
            panel.mark(picture, picture)
        panels.append(panel)
    panels.append(Plan((640, 26, 220, 296), keys, "key images from above"))
    pale = f'fill="{GREY}"'
    words = [label(40, 376, "Across: pictures of the tour. Orange: the arc says itself that its geometry is in doubt.", pale),
             label(640, 376, "Grey: in truth. Open: new unit of length.", pale)]
    return svg(880, 386, panels, words)


def draw_settings(sweeps):
    panels = []
    for i, (name, texts) in enumerate(sweeps):
        rows = sorted((row_of(text) for text in texts), key=lambda row: row[0][COLUMN[name]])
        for j, (column, title) in enumerate(((1, "arcs"), (2, "features, median"))):
            panel = Panel((40 + 260 * i, 26 + 136 * j, 210, 85), (-0.3, len(rows) - 0.7),
                          round_up(max(row[column] for row in rows)), f"{title}, by {name}")
            panel.line([(k, row[column]) for k, row in enumerate(rows)])
            for k, row in enumerate(rows):
                panel.mark(k, f"{row[0][COLUMN[name]]:g}")
            panels.append(panel)
    return svg(20 + 260 * len(sweeps), 274, panels)


def draw_plans(texts):
    panels = []
    for i, text in enumerate(texts):
        (n, sigma, r), arcs, _ = row_of(text)
        keys = keys_of(text)
        off_m = math.hypot(keys[-1][0] - keys[-1][2], keys[-1][1] - keys[-1][3])
        panels.append(Plan((24 + 290 * (i % 2), 34 + 262 * (i // 2), 252, 196), keys,
                           f"n = {n:g}, \u03c3 = {sigma:g}, R = {r:g}: {arcs} arcs", f"; the last is {off_m:.1f} m off"))
    rows = -(-len(texts) // 2)
    said = "Grey: in truth. Open: the unit of length is taken from the truth anew; after a gap, the place, too."
    words = [label(24, 262 * rows + 18, said, f'fill="{GREY}"')]
    return svg(590, 262 * rows + 28, panels, words)


def main(arguments):
    if len(arguments) == 3 and arguments[0] == "arcs":
        Path(arguments[2]).write_text(draw_arcs(Path(arguments[1]).read_text()))
    elif len(arguments) >= 3 and arguments[0] == "settings":
        sweeps = [argument.split("=", 1) for argument in arguments[2:]]
        read = [(name, [Path(file).read_text() for file in files.split(",")]) for name, files in sweeps]
        Path(arguments[1]).write_text(draw_settings(read))
    elif len(arguments) >= 3 and arguments[0] == "plans":
        Path(arguments[1]).write_text(draw_plans([Path(file).read_text() for file in arguments[2:]]))
    else:
        print(__doc__, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
