#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws what homeward_bench_teach printed as SVG.

path_figures.py arcs OUTPUT FIGURE.svg       features, reprojection error and way of each arc along the path
path_figures.py settings FIGURE.svg NAME=OUTPUT,OUTPUT... ...   arcs and features of runs, a panel for each setting that varies;
                                             NAME is n, sigma or R, as the runs' last lines have it
"""

import sys
from pathlib import Path

INK, GRID, LINE = "#222", "#ddd", "#1f5f99"
COLUMN = {"n": 0, "sigma": 1, "R": 2}


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def arcs_of(text):
    """Pictures from and to, features, error in pixels, way in metres of each arc."""
    arcs = []
    for line in text.splitlines():
        if not line.startswith("| ") or line.startswith("| arc "):
            continue
        row = cells(line)
        begin, end = row[1].split("-")
        arcs.append((int(begin), int(end), int(row[3]), float(row[5]), float(row[7])))
    return arcs


def row_of(text):
    """The settings, arcs and median features of the last line."""
    row = cells(next(line for line in text.splitlines() if line.startswith("row |"))[3:])
    return [float(value) for value in row[:3]], int(row[4]), float(row[7].split(",")[0])


class Panel:
    """Axes at a place of the drawing."""

    def __init__(self, box, x_range, y_most, title):
        self.left, self.top, self.width, self.height = box
        self.x_from, self.x_to = x_range
        self.y_most = y_most
        self.parts = [f'<text x="{self.left}" y="{self.top - 6}">{title}</text>']
        for share in (0.0, 0.5, 1.0):
            y = self.y(share * y_most)
            self.parts.append(f'<line x1="{self.left}" y1="{y:.1f}" x2="{self.left + self.width}" y2="{y:.1f}" stroke="{GRID}"/>')
            self.parts.append(f'<text x="{self.left - 4}" y="{y + 4:.1f}" text-anchor="end">{share * y_most:g}</text>')

    def x(self, value):
        return self.left + self.width * (value - self.x_from) / (self.x_to - self.x_from)

    def y(self, value):
        return self.top + self.height * (1 - value / self.y_most)

    def mark(self, value, text):
        self.parts.append(f'<text x="{self.x(value):.1f}" y="{self.top + self.height + 14}" text-anchor="middle">{text}</text>')

    def bar(self, begin, end, value):
        y = self.y(min(value, self.y_most))
        self.parts.append(f'<rect x="{self.x(begin):.1f}" y="{y:.1f}" width="{max(0.5, self.x(end) - self.x(begin) - 0.3):.1f}" '
                          f'height="{self.top + self.height - y:.1f}" fill="{LINE}"/>')

    def line(self, points, colour):
        path = " ".join(f"{self.x(x):.1f},{self.y(y):.1f}" for x, y in points)
        self.parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="1.5"/>')
        for x, y in points:
            self.parts.append(f'<circle cx="{self.x(x):.1f}" cy="{self.y(y):.1f}" r="2.5" fill="{colour}"/>')


def svg(width, height, panels):
    parts = "\n".join(part for panel in panels for part in panel.parts)
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="11" '
            f'fill="{INK}">\n<rect width="{width}" height="{height}" fill="white"/>\n{parts}\n</svg>\n')


def round_up(value):
    step = next(step for step in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000) if value <= 4 * step)
    return step * -(-value // step)


def draw_arcs(text):
    arcs = arcs_of(text)
    last = arcs[-1][1]
    panels = []
    for i, (column, title) in enumerate(((2, "features of an arc"), (3, "reprojection error, pixels"), (4, "way, m"))):
        panel = Panel((48, 24 + 120 * i, 740, 80), (0, last), round_up(max(arc[column] for arc in arcs)), title)
        for arc in arcs:
            panel.bar(arc[0], arc[1], arc[column])
        for picture in range(0, last + 1, max(1, last // 600) * 100):
            panel.mark(picture, picture)
        panels.append(panel)
    return svg(800, 380, panels)


def draw_settings(sweeps):
    panels = []
    for i, (name, texts) in enumerate(sweeps):
        rows = sorted((row_of(text) for text in texts), key=lambda row: row[0][COLUMN[name]])
        for j, (column, title) in enumerate(((1, "arcs"), (2, "features, median"))):
            panel = Panel((48 + 260 * i, 24 + 130 * j, 200, 85), (-0.3, len(rows) - 0.7),
                          round_up(max(row[column] for row in rows)), f"{title}, by {name}")
            panel.line([(k, row[column]) for k, row in enumerate(rows)], LINE)
            for k, row in enumerate(rows):
                panel.mark(k, f"{row[0][COLUMN[name]]:g}")
            panels.append(panel)
    return svg(48 + 260 * len(sweeps), 270, panels)


def main(arguments):
    if len(arguments) == 3 and arguments[0] == "arcs":
        Path(arguments[2]).write_text(draw_arcs(Path(arguments[1]).read_text()))
    elif len(arguments) >= 3 and arguments[0] == "settings":
        sweeps = [argument.split("=", 1) for argument in arguments[2:]]
        read = [(name, [Path(file).read_text() for file in files.split(",")]) for name, files in sweeps]
        Path(arguments[1]).write_text(draw_settings(read))
    else:
        print(__doc__, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
