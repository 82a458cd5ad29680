#!/usr/bin/env python3
"""Homing between all pairs of a grid of pictures, method by method (the experiment of Vardy and Möller 2005).

Renders a grid of one room, asks `homeward home` (and `compass`) for every pair, and prints for each method: the share
answered, the mean and median angular error of the direction, the mean error of the turn, and the return ratio: the share
of starts from which following the vectors from grid point to grid point leads to the goal.

usage: homing_grid.py [--homeward PROGRAM] [--world W] [--room R] [--step-m S] [--most N] [--light L] [--work DIR]
"""
import argparse
import csv
import json
import math
import pathlib
import random
import statistics
import subprocess
import tempfile


def wrap(angle):
    return math.remainder(angle, 2 * math.pi)


def grid(program, folder, world, room, step_m, light):
    if not (folder / "poses.csv").exists():
        subprocess.run([program, "simulate", "grid", "--world", world, "--room", room, "--step-m", str(step_m),
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
    """The share of starts that reach the goal, each step to the grid point that lies best in the vector's direction."""
    home = 0
    for start in poses:
        here = start
        seen = set()
        while here != goal and here not in seen:
            seen.add(here)
            bearing = vectors.get((here, goal))
            if bearing is None:
                break
            x, y, theta = poses[here]
            best, least = None, math.pi / 3
            for there, (tx, ty, _) in poses.items():
                apart = math.hypot(tx - x, ty - y)
                if there == here or apart > 1.5 * step_m:
                    continue
                off = abs(wrap(math.atan2(ty - y, tx - x) - theta - bearing))
                if off < least:
                    best, least = there, off
            if best is None:
                break
            here = best
        home += here == goal
    return home / len(poses)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--homeward", default="build/release/bin/homeward")
    options.add_argument("--world", default="house:1")
    options.add_argument("--room", default="living_room")
    options.add_argument("--step-m", type=float, default=0.5)
    options.add_argument("--light", default="day")
    options.add_argument("--goals", type=int, default=8, help="goals whose return ratio is taken")
    options.add_argument("--most", type=int, default=4000, help="pairs; more are sampled")
    options.add_argument("--work", default=None)
    asked = options.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        work = pathlib.Path(asked.work or scratch)
        folder = work / f"grid-{asked.world.replace(':', '_').replace('/', '_')}-{asked.room}-{asked.light}"
        folder.parent.mkdir(parents=True, exist_ok=True)
        poses = grid(asked.homeward, folder, asked.world, asked.room, asked.step_m, asked.light)
        chance = random.Random(1)
        names = sorted(poses)
        goals = chance.sample(names, min(asked.goals, len(names)))
        pairs = [(a, b) for a in names for b in names if a != b]
        if len(pairs) > asked.most:
            pairs = chance.sample(pairs, asked.most)
        pairs = sorted(set(pairs) | {(a, b) for a in names for b in goals if a != b})
        result = {"world": asked.world, "room": asked.room, "light": asked.light, "points": len(names),
                  "pairs": len(pairs)}
        for method in ("epipolar", "scale-space", "compass"):
            command, more = ("compass", ()) if method == "compass" else ("home", ("--method", method))
            errors, turns, vectors, ms = [], [], {}, []
            for answer in ask(asked.homeward, command, folder, pairs, more):
                ax, ay, atheta = poses[answer["current"]]
                bx, by, btheta = poses[answer["target"]]
                ms.append(answer["ms"])
                if answer["turn_rad"] is not None:
                    turns.append(abs(wrap(answer["turn_rad"] - wrap(btheta - atheta))))
                if answer.get("bearing_rad") is None:
                    continue
                vectors[answer["current"], answer["target"]] = answer["bearing_rad"]
                errors.append(abs(wrap(answer["bearing_rad"] - wrap(math.atan2(by - ay, bx - ax) - atheta))))
            told = {"answered": round(max(len(turns), len(errors)) / len(pairs), 3),
                    "turn_error_mean_deg": round(math.degrees(statistics.mean(turns)), 2) if turns else None,
                    "ms_median": round(statistics.median(ms), 2)}
            if errors:
                told["error_mean_deg"] = round(math.degrees(statistics.mean(errors)), 2)
                told["error_median_deg"] = round(math.degrees(statistics.median(errors)), 2)
                told["return_ratio"] = round(
                    statistics.mean(returns(poses, vectors, goal, asked.step_m) for goal in goals), 3)
            result[method] = told
        print(json.dumps(result))


if __name__ == "__main__":
    main()
