# SPDX-License-Identifier: Apache-2.0
"""Parts of run.py about maps and the belief in them.

`map_and_places`: the rendered house as a map, and two walks through it, a picture at a time. `kidnapped`: pieces of these
walks cut together, so that the camera is carried off in the middle of each. `foreign`: another generated house, seen
with the same kind of camera. `real_tours`: two corridors photographed by hand; which of their loops are right, only a
person can say from the report.
"""

import csv
import json
import math
import random
import time

KILOBYTE = 1000
PIECE = 6  # pictures of one walk before the camera is carried off
CARRIED_M = 5.0
WALKS = ("test_day", "test_night")


def built_map(bench):
    """The map of the rendered house's tour, its inspection, and the seconds that it took; built once."""
    train = bench.folder("sim", "home", "train")
    file, inspected = bench.scratch / "home.map", bench.scratch / "home.json"
    if not hasattr(bench, "map_seconds"):
        begin = time.monotonic()
        bench.program("map", "build", "--tour", train, "--camera", train / "camera.json", "--out", file)
        bench.map_seconds = time.monotonic() - begin
        bench.program("map", "inspect", file, "--json", out=inspected)
    return file, inspected, bench.map_seconds


def read_poses(file):
    with open(file, newline="") as table:
        return {row["filename"]: (float(row["x_m"]), float(row["y_m"])) for row in csv.DictReader(table)}


def map_and_places(bench):
    train = bench.folder("sim", "home", "train")
    file, inspected, seconds = built_map(bench)
    figures = bench.judge("map.py", inspected, train / "poses.csv")
    part = "map, rendered house"
    bench.row(part, "false merges", figures["false_merges"], most=0)
    bench.row(part, "accepted loops that are right", figures["hyp_precision"], least=1.0)
    bench.row(part, "loop recall", figures["loop_recall"], least=0.9)
    bench.row(part, "places", figures["places"], least=40, most=120)
    bench.row(part, "spread of places, 95th percentile, m", figures["place_spread_p95"], most=2.5)
    bench.row(part, "edges right", figures["edge_ok"], least=0.98)
    bench.row(part, "connected", figures["connected"], least=1.0)
    bench.row(part, "kB a place", figures["bytes_per_place"] / KILOBYTE, most=32.0)
    bench.row(part, "seconds to build", seconds, most=20.0)
    wanted = {"test_day": {"near_1": 0.98, "near_2": 1.0, "near_3": 1.0, "strict_1": 0.8}, "test_night": {"near_1": 0.95, "near_3": 0.99}}
    for walk in WALKS:
        images = bench.folder("sim", "home", walk)
        lines = bench.program("localise", "--map", file, "--images", images, "--restart-every", 3, out=bench.scratch / f"{walk}.jsonl")
        figures = bench.judge("localise.py", lines, inspected, train / "poses.csv", images / "poses.csv")
        part = f"localise, {walk}"
        for updates in ("1", "2", "3"):
            bench.row(part, f"near after {updates}", figures[f"near_{updates}"], least=wanted[walk].get(f"near_{updates}"))
        bench.row(part, "exact after 1", figures["strict_1"], least=wanted[walk].get("strict_1"))
        bench.row(part, "calibration error", figures["ece"], most=0.05)
        bench.row(part, "ms an update (median)", figures["ms_p50"])


def pieces(names, poses, count):
    """Stretches of a walk, in random order, each beginning far from where the one before it ends."""
    chance = random.Random(1)
    starts = list(range(0, len(names) - PIECE + 1))
    chosen = []
    while len(chosen) < count:
        start = chance.choice(starts)
        if chosen and math.dist(poses[names[chosen[-1] + PIECE - 1]], poses[names[start]]) < CARRIED_M:
            continue
        chosen.append(start)
    return [names[start : start + PIECE] for start in chosen]


def write_odometry(file, stretches, poses):
    """What wheels that slip by 5 % would have counted; they do not turn while the robot is carried."""
    chance = random.Random(2)
    x = y = turned = 0.0
    with open(file, "w", newline="") as table:
        rows = csv.writer(table)
        rows.writerow(["t_us", "x_m", "y_m", "theta_rad"])
        for stretch in stretches:
            for before, name in zip([None, *stretch], stretch):
                if before:
                    dx, dy = (poses[name][axis] - poses[before][axis] for axis in (0, 1))
                    way = math.hypot(dx, dy) * (1.0 + chance.gauss(0.0, 0.05))
                    turned += chance.gauss(0.0, 0.02)
                    x += way * math.cos(math.atan2(dy, dx) + turned)
                    y += way * math.sin(math.atan2(dy, dx) + turned)
                rows.writerow([0, f"{x:.4f}", f"{y:.4f}", "0.0"])


def kidnapped(bench):
    train = bench.folder("sim", "home", "train")
    file, inspected, _ = built_map(bench)
    map_poses = read_poses(train / "poses.csv")
    prototypes = {place["id"]: map_poses[place["prototype"].split("/")[-1]] for place in json.loads(inspected.read_text())["places"]}
    for walk in WALKS:
        images = bench.folder("sim", "home", walk)
        poses = read_poses(images / "poses.csv")
        cut = bench.scratch / f"cut_{walk}"
        cut.mkdir()
        stretches = pieces(sorted(poses), poses, 30)
        truth = [poses[name] for stretch in stretches for name in stretch]
        for index, name in enumerate(name for stretch in stretches for name in stretch):
            (cut / f"{index:04d}.jpg").symlink_to((images / name).resolve())
        write_odometry(cut / "odometry.csv", stretches, poses)
        part = f"kidnapped, {walk}"
        for how, options in (("", ["--no-odometry"]), (", with odometry", [])):
            lines = [json.loads(line) for line in bench.program("localise", "--map", file, "--images", cut, *options).splitlines()]
            near = []
            for line, pose in zip(lines, truth, strict=True):
                closest = min(math.dist(prototype, pose) for prototype in prototypes.values())
                found = not line["lost"] and math.dist(prototypes[line["place"]], pose)
                near.append(found is not False and (found <= closest + 1.0 or found <= 2.5))
            carried = [near[first : first + 3] for first in range(PIECE, len(near), PIECE)]
            if not how:
                bench.row(part, "times carried off", len(carried))
            bench.row(part, f"right at the third picture{how}", sum(after[2] for after in carried) / len(carried), least=0.95)


def foreign(bench):
    """Pictures of another building, and how often the belief is lost at home although it should not be."""
    train = bench.folder("sim", "home", "train")
    file, inspected, _ = built_map(bench)
    part = "another building"
    elsewhere = bench.scratch / "elsewhere"
    bench.program("simulate", "tour", "--world", "house:7", "--seed", 7, "--camera", train / "camera.json", "--rooms",
                  "hall,living_room,kitchen,bedroom,hall", "--out", elsewhere)
    lines = bench.program("localise", "--map", file, "--images", elsewhere, out=bench.scratch / "elsewhere.jsonl")
    figures = bench.judge("localise.py", lines, "--foreign")
    bench.row(part, "pictures", figures["lines"])
    bench.row(part, "lost at the third picture or later", figures["lost_3"], least=0.98)
    for walk in WALKS:
        images = bench.folder("sim", "home", walk)
        lines = bench.program("localise", "--map", file, "--images", images, out=bench.scratch / f"{walk}_whole.jsonl")
        figures = bench.judge("localise.py", lines, inspected, train / "poses.csv", images / "poses.csv")
        bench.row(part, f"lost at home, {walk}", figures["lost_rate"], most=0.01)


def real_tours(bench):
    for name in ("sait_corridor_360", "plm_corridor_360"):
        data = bench.folder("real", name)
        file = bench.scratch / f"{name}.map"
        bench.program("map", "build", "--tour", data / "images", "--camera", data / "camera.json", "--out", file)
        inspected = json.loads(bench.program("map", "inspect", file, "--json"))
        accepted = sum(hypothesis["decision"] == "accepted" for hypothesis in inspected["hypotheses"])
        part = f"map, {name}"
        bench.row(part, "pictures", sum(len(place["members"]) for place in inspected["places"]))
        bench.row(part, "places", len(inspected["places"]))
        # One picture for each place, many of them alike: whatever is merged is merged wrongly.
        alone = name.startswith("plm")
        bench.row(part, "accepted loops", accepted, most=0 if alone else None)
        if alone:
            merged = sum(len(place["members"]) > 1 for place in inspected["places"])
            bench.row(part, "places of several pictures", merged, most=0)
