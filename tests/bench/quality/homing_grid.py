#!/usr/bin/env python3
"""Homing between all pairs of a grid of pictures, method by method (the experiment of Vardy and Möller 2005).

Renders a grid of one room, asks `homeward home` (and `compass`) for every pair, and prints for each method: the share
answered, the mean and median angular error of the direction, the mean error of the turn, and the return ratio: the share
of starts from which following the vectors from grid point to grid point leads to the goal, with those of true vectors.

No answer counts as 90 degrees. Headings are random. Means are over goals of the mean over starts.

usage: homing_grid.py [--homeward PROGRAM] [--world W] [--room R | --within X0 Y0 X1 Y1] [--step-m S] [--light L]
                      [--work DIR]
"""
import argparse
import csv
import json
import math
import pathlib
import statistics
import subprocess
import tempfile


def wrap(angle):
    return math.remainder(angle, 2 * math.pi)


def grid(program, folder, world, part, step_m, light):
    if not (folder / "poses.csv").exists():
        subprocess.run([program, "simulate", "grid", "--world", world, *part, "--turned", "--step-m", str(step_m),
                        "--light", light, "--out", folder], check=True)
    with open(folder / "poses.csv", newline="") as table:
        return {row["filename"]: (float(row["x_m"]), float(row["y_m"]), float(row["theta_rad"]))
                for row in csv.DictReader(table)}


def ask(program, command, folder, pairs, more=()):
    with tempfile.NamedTemporaryFile("w", suffix=".csv", dir=folder) as table:
        table.write("current,target\n" + "".join(f"{a},{b}\n" for a, b in pairs))
        table.flush()
        done = subprocess.run([program, command, "--camera", folder / "camera.json", "--pairs", table.name, *more],
                              check=True, capture_output=True, text=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def returns(poses, vectors, goal, step_m):
    """The share of starts that reach the goal, each step to the neighbour that lies best in the vector's direction among
    those where it has not been: where furniture stands in that direction, round it."""
    home = 0
    for start in poses:
        if start == goal:
            continue
        here = start
        seen = set()
        while here != goal:
            seen.add(here)
            bearing = vectors.get((here, goal))
            if bearing is None:
                break
            x, y, theta = poses[here]
            near = [(abs(wrap(math.atan2(ty - y, tx - x) - theta - bearing)), there)
                    for there, (tx, ty, _) in poses.items()
                    if there not in seen and math.hypot(tx - x, ty - y) <= 1.5 * step_m]
            if not near:
                break
            here = min(near)[1]
        home += here == goal
    return home / (len(poses) - 1)


def by_distance(poses, errors):
    """Pairs, mean and median error for each metre apart."""
    bands = {}
    for (a, b), error in errors.items():
        apart_m = math.hypot(poses[a][0] - poses[b][0], poses[a][1] - poses[b][1])
        bands.setdefault(int(apart_m), []).append(error)
    return {f"{m}-{m + 1}m": {"n": len(e), "mean_deg": round(statistics.mean(e), 2),
                              "median_deg": round(statistics.median(e), 2)} for m, e in sorted(bands.items())}


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--homeward", default="build/release/bin/homeward")
    options.add_argument("--world", default="house:1")
    options.add_argument("--room", default="living_room")
    options.add_argument("--within", type=float, nargs=4, default=None, help="a part of the floor instead of a room")
    options.add_argument("--step-m", type=float, default=0.5)
    options.add_argument("--light", default="day")
    options.add_argument("--work", default=None)
    asked = options.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        work = pathlib.Path(asked.work or scratch)
        part = ["--within", *map(str, asked.within)] if asked.within else ["--room", asked.room]
        name = "_".join([asked.world, *part[1:], asked.light]).replace(":", "_").replace("/", "_")
        folder = work / f"grid-{name}"
        folder.parent.mkdir(parents=True, exist_ok=True)
        poses = grid(asked.homeward, folder, asked.world, part, asked.step_m, asked.light)
        names = sorted(poses)
        pairs = [(a, b) for a in names for b in names if a != b]
        result = {"world": asked.world, "part": part[1:], "light": asked.light, "points": len(names),
                  "pairs": len(pairs)}
        exact = {(a, b): math.atan2(poses[b][1] - poses[a][1], poses[b][0] - poses[a][0]) - poses[a][2] for a, b in pairs}
        # What furniture in the way leaves to any method that only follows its vectors.
        result["return_ratio_of_exact_vectors"] = round(
            statistics.mean(returns(poses, exact, goal, asked.step_m) for goal in names), 4)
        methods = {"epipolar": ("home",), "epipolar --uncertain": ("home", "--uncertain"),
                   "scale-space": ("home", "--method", "scale-space"), "hiss": ("home", "--method", "hiss"),
                   "compass": ("compass",)}
        for method, (command, *more) in methods.items():
            turns, vectors, ms, errors = [], {}, [], {}
            for answer in ask(asked.homeward, command, folder, pairs, more):
                pair = answer["current"], answer["target"]
                ax, ay, atheta = poses[pair[0]]
                bx, by, btheta = poses[pair[1]]
                ms.append(answer["ms"])
                if answer["turn_rad"] is not None:
                    turns.append(abs(wrap(answer["turn_rad"] - wrap(btheta - atheta))))
                if method == "compass":
                    continue
                errors[pair] = 90.0
                if answer["bearing_rad"] is None:
                    continue
                vectors[pair] = answer["bearing_rad"]
                truth = math.atan2(by - ay, bx - ax) - atheta
                errors[pair] = math.degrees(abs(wrap(answer["bearing_rad"] - truth)))
            told = {"answered": round(max(len(turns), len(vectors)) / len(pairs), 4),
                    "turn_error_mean_deg": round(math.degrees(statistics.mean(turns)), 2) if turns else None,
                    "turn_error_median_deg": round(math.degrees(statistics.median(turns)), 2) if turns else None,
                    "ms_median": round(statistics.median(ms), 2)}
            if errors:
                # Every goal has as many starts, so the mean over goals of their means is the mean.
                told["error_mean_deg"] = round(statistics.mean(errors.values()), 2)
                told["error_median_deg"] = round(statistics.median(errors.values()), 2)
                told["below_15_deg"] = round(sum(e < 15 for e in errors.values()) / len(errors), 4)
                told["return_ratio"] = round(
                    statistics.mean(returns(poses, vectors, goal, asked.step_m) for goal in names), 4)
                told["by_distance"] = by_distance(poses, errors)
            result[method] = told
        print(json.dumps(result))


if __name__ == "__main__":
    main()
