#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures what the eyes are worth and holds it against its bounds: one command, a table, and JSON.

usage: run.py [--bin DIR] [--data DIR] [--judges DIR] [--only PART,...] [--json FILE]

Runs the program `homeward` on the developers' data and has its answers judged by the scripts beside that data; what is
not there is skipped and named. The look-alike offices are rendered by the program itself and need no data. The parts
`codes` and `budget` (budget.py), `real_pairs`, `rendered_home`, `look_alike_offices` and `look_alike_wards`
(distinctiveness.py) take minutes and are run only by name. Exit code: 0 when every bound
that could be measured holds, 1 when one does not, 2 when something does not run.
"""

import argparse
import csv
import json
import math
import os
import pathlib
import platform
import subprocess
import sys
import tempfile

import budget
import distinctiveness
import places

ROOT = pathlib.Path(__file__).resolve().parents[3]


class Skipped(Exception):
    """A part that cannot be measured here, and why."""


class Bench:
    def __init__(self, options, scratch):
        self.homeward = options.bin / "homeward"
        self.data = options.data
        self.judges = options.judges
        self.scratch = scratch
        self.rows = []
        self.tables = []

    def program(self, *arguments, out=None):
        """Runs homeward; its standard output, or the file that it was written to."""
        done = subprocess.run([self.homeward, *map(str, arguments)], capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"homeward {' '.join(map(str, arguments))}: {done.stderr.strip()}")
        if out is None:
            return done.stdout
        out.write_text(done.stdout)
        return out

    def judge(self, script, *arguments):
        if not (self.judges / script).is_file():
            raise Skipped(f"{self.judges / script} is not there")
        done = subprocess.run([sys.executable, "-B", self.judges / script, *map(str, arguments)], capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{script}: {(done.stderr or done.stdout).strip()}")
        return json.loads(done.stdout)

    def folder(self, *parts):
        path = self.data.joinpath(*parts)
        if not path.is_dir():
            raise Skipped(f"{path} is not there")
        return path

    def has(self, command):
        listed = subprocess.run([self.homeward, "--help"], capture_output=True, text=True).stdout
        return any(line.split()[:1] == [command] for line in listed.splitlines())

    def row(self, part, figure, value, least=None, most=None):
        holds = None
        if least is not None or most is not None:
            holds = value is not None and (least is None or value >= least) and (most is None or value <= most)
        self.rows.append({"part": part, "figure": figure, "value": value, "least": least, "most": most, "holds": holds})

    def table(self, title, header, rows):
        """Figures without bounds that are better read side by side."""
        self.tables.append({"title": title, "header": header, "rows": rows})

    def skip(self, part, reason):
        self.rows.append({"part": part, "figure": "skipped", "value": None, "least": None, "most": None, "holds": None, "reason": reason})


def home_rendered(bench):
    train = bench.folder("sim", "home", "train")
    lines = bench.program("home", "--camera", train / "camera.json", "--pairs", train / "pairs.csv", out=bench.scratch / "rendered.jsonl")
    figures = bench.judge("home.py", lines, train / "pairs.csv", train / "poses.csv")
    near, middle, far = (figures[band] for band in ("1-2m", "2-4m", "4-8m"))
    part = "home, rendered"
    bench.row(part, "1-2 m: median error, degrees", near["median_deg"], most=1.0)
    bench.row(part, "1-2 m: 95th percentile, degrees", near["p95_deg"], most=4.0)
    bench.row(part, "1-2 m: answered", near["answered"], least=0.99)
    bench.row(part, "2-4 m: below 15 degrees", middle["below_15deg"], least=0.95)
    bench.row(part, "4-8 m: below 15 degrees", far["below_15deg"], least=0.85)
    bench.row(part, "wrong with confidence > 0.8", figures["wrong_confident"])
    bench.row(part, "ms a pair (median)", figures["ms_p50"])


def home_hand_held(bench):
    data = bench.folder("real", "sait_corridor_360")
    lines = bench.program("home", "--camera", data / "camera.json", "--pairs", data / "pairs.csv", out=bench.scratch / "sait.jsonl")
    figures = bench.judge("home.py", lines, data / "pairs.csv")
    part = "home, hand-held corridor"
    bench.row(part, "below 15 degrees", figures["all"]["below_15deg"], least=0.95)
    bench.row(part, "median error, degrees", figures["all"]["median_deg"], most=3.0)
    bench.row(part, "answered", figures["all"]["answered"])
    bench.row(part, "wrong with confidence > 0.8", figures["wrong_confident"])


def home_look_alike(bench):
    data = bench.folder("real", "plm_corridor_360")
    lines = bench.program("home", "--camera", data / "camera.json", "--pairs", data / "pairs.csv", out=bench.scratch / "plm.jsonl")
    figures = bench.judge("home.py", lines, data / "pairs.csv")
    part = "home, look-alike corridors"
    bench.row(part, "same place: answered", figures["all"]["answered"], least=0.5)
    bench.row(part, "of the answered below 30 degrees", figures["all"]["answered_below_30deg"], least=0.7)
    bench.row(part, "wrong with confidence > 0.8 (one of 48)", figures["wrong_confident"], most=1.0 / 48.0 + 1e-9)
    bench.row(part, "other places with confidence > 0.8", figures["different_confident"], most=0.01)


def mirror_offices(bench):
    """Pairs of pictures from the two offices of which one is the other's mirror image."""
    shots = {}
    for room, theta_rad in (("office_7", 0.0), ("office_8", 0.7)):
        folder = bench.scratch / room
        bench.program("simulate", "grid", "--world", "offices:1", "--room", room, "--step-m", 0.4, "--theta-rad", theta_rad, "--out", folder)
        shots[room] = sorted(folder.glob("*.jpg"))
    table = bench.scratch / "offices.csv"
    pairs = [(a, b) for a in shots["office_7"] for b in shots["office_8"]]
    with open(table, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["current", "target"])
        writer.writerows((a.relative_to(bench.scratch), b.relative_to(bench.scratch)) for a, b in pairs)
    lines = bench.program("home", "--camera", bench.scratch / "office_7" / "camera.json", "--pairs", table)
    answers = [json.loads(line) for line in lines.splitlines()]
    sure = sum(answer["bearing_rad"] is not None and answer["confidence"] > 0.8 for answer in answers)
    part = "mirror-image offices"
    bench.row(part, "pairs", len(answers))
    bench.row(part, "with confidence > 0.8", sure / len(answers), most=0.01)


def retrieved(bench, name, gallery, queries, camera):
    if not bench.has("retrieve"):
        raise Skipped("`homeward retrieve` is not built")
    return bench.program("retrieve", "--gallery", gallery, "--queries", queries, "--camera", camera, out=bench.scratch / f"{name}.jsonl")


def recall(bench, name, least):
    data = bench.folder("real", name)
    lines = retrieved(bench, name, data / "gallery.csv", data / "queries.csv", data / "camera.json")
    figures = bench.judge("recall.py", lines, data / "queries.csv", data / "gallery.csv")
    part = f"recall, {name}"
    bench.row(part, "at rank 1", figures["recall_1"], least=least)
    bench.row(part, "among the best 10", figures["recall_10"])
    bench.row(part, "ms a query (median)", figures["ms_p50"])


def recall_corridor(bench):
    recall(bench, "corridor_vpr", 0.95)


def recall_tower(bench):
    recall(bench, "ie_tower", 0.85)


def night_against_day(bench):
    data = bench.folder("sim", "home")
    both = bench.scratch / "night"
    both.mkdir()
    poses = {}
    for folder, table in (("train", "gallery.csv"), ("test_night", "queries.csv")):
        (both / folder).symlink_to((data / folder).resolve())
        poses[folder] = places.read_poses(data / folder / "poses.csv")
        (both / table).write_text("filename\n" + "".join(f"{folder}/{name}\n" for name in poses[folder]))
    lines = retrieved(bench, "night", both / "gallery.csv", both / "queries.csv", data / "train" / "camera.json")
    near = 0
    for line in map(json.loads, lines.read_text().splitlines()):
        if not line["top"]:
            continue
        x, y = poses["test_night"][pathlib.Path(line["query"]).name]
        found = poses["train"][pathlib.Path(line["top"][0]["image"]).name]
        near += math.hypot(found[0] - x, found[1] - y) <= 1.0
    bench.row("night against day", "first picture within 1 m", near / len(poses["test_night"]), least=0.97)


def loops(bench):
    train = bench.folder("sim", "home", "train")
    if not bench.has("loops"):
        raise Skipped("`homeward loops` is not built")
    lines = bench.program("loops", "--images", train, "--camera", train / "camera.json", out=bench.scratch / "loops.jsonl")
    figures = bench.judge("loops.py", lines, train / "poses.csv")
    part = "loops, rendered house"
    bench.row(part, "recall without a wrong match", figures["recall_at_100"], least=0.97)
    bench.row(part, "recall of all matches", figures["recall"])
    bench.row(part, "precision of all matches", figures["precision"])
    bench.row(part, "ms a picture (median)", figures["ms_p50"], most=40.0)
    bench.row(part, "ms a picture (99th percentile)", figures["ms_p99"])


PARTS = {
    "home_rendered": home_rendered,
    "home_hand_held": home_hand_held,
    "home_look_alike": home_look_alike,
    "mirror_offices": mirror_offices,
    "recall_corridor": recall_corridor,
    "recall_tower": recall_tower,
    "night_against_day": night_against_day,
    "loops": loops,
    "map_and_places": places.map_and_places,
    "kidnapped": places.kidnapped,
    "foreign": places.foreign,
    "real_tours": places.real_tours,
}
# Run only by name: minutes each.
BY_NAME = {
    "codes": budget.codes,
    "budget": budget.budget,
    "real_pairs": distinctiveness.real_pairs,
    "rendered_home": distinctiveness.rendered_home,
    "look_alike_offices": distinctiveness.look_alike_offices,
    "look_alike_wards": distinctiveness.look_alike_wards,
}


def shown(value):
    if value is None:
        return "-"
    return str(value) if isinstance(value, int) else f"{value:.3f}"


def table_of(rows):
    cells = [("part", "figure", "measured", "bound", "holds")]
    for row in rows:
        bound = " ".join(f"{sign} {shown(row[key])}" for key, sign in (("least", ">="), ("most", "<=")) if row[key] is not None)
        holds = {None: "", True: "yes", False: "NO"}[row["holds"]]
        cells.append((row["part"], row["figure"] + (f": {row['reason']}" if "reason" in row else ""), shown(row["value"]), bound, holds))
    widths = [max(len(line[column]) for line in cells) for column in range(5)]
    widths[1] = min(widths[1], 44)
    return "\n".join(f"{line[0]:{widths[0]}}  {line[1]:{widths[1]}}  {line[2]:>{widths[2]}}  {line[3]:{widths[3]}}  {line[4]}".rstrip() for line in cells)


def markdown(table):
    lines = [f"\n{table['title']}\n", table["header"], ["---"] * len(table["header"]), *table["rows"]]
    return "\n".join(line if isinstance(line, str) else "| " + " | ".join("" if cell is None else str(cell) for cell in line) + " |" for line in lines)


def machine():
    model = next((line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), platform.machine())
    return f"{os.cpu_count()} cores of {model}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build" / "release" / "bin")
    parser.add_argument("--data", type=pathlib.Path, default=ROOT.parent / "shared" / "data")
    parser.add_argument("--judges", type=pathlib.Path, default=ROOT.parent / "shared" / "tools" / "eval")
    parser.add_argument("--only", default=",".join(PARTS), help="parts, with commas between: " + ", ".join(PARTS) + "; only by name: " + ", ".join(BY_NAME))
    parser.add_argument("--json", type=pathlib.Path)
    options = parser.parse_args()
    if not (options.bin / "homeward").is_file():
        parser.error(f"{options.bin / 'homeward'} is not there; build it, or name its folder with --bin")
    parts = PARTS | BY_NAME
    unknown = [part for part in options.only.split(",") if part not in parts]
    if unknown:
        parser.error(f"there is no part '{unknown[0]}'; there are {', '.join(parts)}")
    broken = False
    with tempfile.TemporaryDirectory(prefix="homeward-quality-") as scratch:
        bench = Bench(options, pathlib.Path(scratch))
        for part in options.only.split(","):
            print(f"{part} ...", file=sys.stderr, flush=True)
            try:
                parts[part](bench)
            except Skipped as reason:
                bench.skip(part, str(reason))
            except (RuntimeError, KeyError, ValueError) as error:
                broken = True
                bench.skip(part, f"did not run: {str(error).splitlines()[0]}")
    if bench.rows:
        print(table_of(bench.rows))
    for table in bench.tables:
        print(markdown(table))
    if options.json:
        options.json.write_text(json.dumps({"machine": machine(), "rows": bench.rows, "tables": bench.tables}, indent=2, default=float) + "\n")
    if broken:
        sys.exit(2)
    sys.exit(1 if any(row["holds"] is False for row in bench.rows) else 0)


if __name__ == "__main__":
    main()
