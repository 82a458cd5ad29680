# SPDX-License-Identifier: Apache-2.0
"""Parts of run.py: pairs of pictures of one place and of different ones, with and without a map that knows what is common."""

import csv
import json
import math
import random

RIGHT_DEG = 15.0
SURE = 0.8


def judged(lines, truth):
    """Right and wrong answers with more than SURE, and all that are right; truth: (current, target) -> bearing or None."""
    counts = {"right": 0, "sure and right": 0, "same": 0, "wrong, sure": 0, "different": 0, "different, sure": 0}
    for line in map(json.loads, lines.splitlines()):
        bearing = truth[line["current"], line["target"]]
        counts["same" if bearing is not None else "different"] += 1
        if line["bearing_rad"] is None:
            continue
        sure = line["confidence"] > SURE
        if bearing is None:
            counts["different, sure"] += sure
            continue
        off = line["bearing_rad"] - bearing
        right = abs(math.degrees(math.atan2(math.sin(off), math.cos(off)))) < RIGHT_DEG
        counts["right"] += right
        counts["sure and right"] += sure and right
        counts["wrong, sure"] += sure and not right
    return counts


def with_and_without(bench, name, camera, tour, pairs, truth):
    """Rows of one set of pairs; their pictures need not be in the tour."""
    file = bench.scratch / f"{name}.map"
    bench.program("map", "build", "--tour", tour, "--camera", camera, "--out", file)
    cells = []
    for extra in ((), ("--map", file)):
        counts = judged(bench.program("home", "--camera", camera, "--pairs", pairs, *extra), truth)
        part = f"{name}, {'with' if extra else 'without'} the map"
        for figure, value in counts.items():
            bench.row(part, figure, value)
        cells.append(counts)
    wrong = [(counts["different, sure"] + counts["wrong, sure"]) / max(1, counts["different"] + counts["same"]) for counts in cells]
    bench.row(name, "wrong and sure, of all pairs, without", wrong[0])
    bench.row(name, "wrong and sure, of all pairs, with the map", wrong[1], most=0.005)
    bench.row(name, "right and sure, points lost", 100.0 * (cells[0]["sure and right"] - cells[1]["sure and right"]) / max(1, cells[0]["same"]))


def real_pairs(bench):
    folders = sorted(bench.folder("real").glob("tour_*")) + [bench.folder("real", name) for name in ("plm_corridor_360", "sait_corridor_360")]
    for data in folders:
        with open(data / "pairs.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        truth = {(row["current"], row["target"]): float(row["bearing_rad"]) if row.get("same") != "0" else None for row in rows}
        with_and_without(bench, data.name, data / "camera.json", data / "images", data / "pairs.csv", truth)


def write_pairs(file, right, wrong):
    with open(file, "w", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(["current", "target"])
        writer.writerows(right + wrong)


def simulated_pairs(bench, name, world, rooms, step_m, grid_m):
    """A tour as the map, pictures of a grid as queries; pictures within 3 m of one another, and more than 12 m apart."""
    work = bench.scratch / name
    work.mkdir()
    bench.program("simulate", "tour", "--world", world, "--rooms", *rooms, "--step-m", step_m, "--out", work / "tour")
    bench.program("simulate", "grid", "--world", world, "--step-m", grid_m, "--turned", "--seed", 202, "--out", work / "grid")
    here = {f"grid/{file}": pose for file, pose in read_full_poses(work / "grid").items()}
    there = {f"tour/{file}": pose for file, pose in read_full_poses(work / "tour").items()}
    chance = random.Random(9)
    targets = chance.sample(sorted(there), min(60, len(there)))
    apart = lambda a, b: math.hypot(here[a][0] - there[b][0], here[a][1] - there[b][1])
    right = [(a, b) for a in here for b in targets if 0.1 < apart(a, b) < 3.0]
    wrong = [(a, b) for a in here for b in targets if apart(a, b) > 12.0]
    right, wrong = chance.sample(right, min(400, len(right))), chance.sample(wrong, min(2000, len(wrong)))
    write_pairs(work / "pairs.csv", right, wrong)
    truth = {pair: None for pair in wrong}
    for a, b in right:
        (x, y, theta), (to_x, to_y, _) = here[a], there[b]
        truth[a, b] = math.atan2(to_y - y, to_x - x) - theta
    with_and_without(bench, name, work / "tour" / "camera.json", work / "tour", work / "pairs.csv", truth)


def read_full_poses(folder):
    with open(folder / "poses.csv", newline="") as file:
        return {row["filename"]: tuple(float(row[key]) for key in ("x_m", "y_m", "theta_rad")) for row in csv.DictReader(file)}


def look_alike_offices(bench):
    rooms = ["corridor"] + [f"office_{number}" for number in range(1, 9)] + ["corridor"]
    for seed in (1, 2):
        simulated_pairs(bench, f"offices {seed}", f"offices:{seed}", rooms, 0.5, 0.9)


def rendered_home(bench):
    train = bench.folder("sim", "home", "train")
    poses = read_full_poses(train)
    with open(train / "pairs.csv", newline="") as file:
        rows = [(row["current"], row["target"]) for row in csv.DictReader(file)]
    truth = {(a, b): math.atan2(poses[b][1] - poses[a][1], poses[b][0] - poses[a][0]) - poses[a][2] for a, b in rows}
    with_and_without(bench, "rendered home", train / "camera.json", train, train / "pairs.csv", truth)


def look_alike_wards(bench):
    rooms = ["corridor_1", *(f"ward_{number}" for number in range(1, 6)), "corridor_2", *(f"ward_{number}" for number in range(6, 11)), "corridor_1"]
    for seed in (1, 100):
        simulated_pairs(bench, f"wards {seed}", f"wards:{seed}", rooms, 0.5, 2.9)
