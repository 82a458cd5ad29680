#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fits the confidence of verified motions (src/matching/verify.cpp) and shows how well it is calibrated.

usage: confidence.py BIN_FOLDER WORK_FOLDER [--data FOLDER]

Renders a tour of the generated house and one of the generated offices into WORK_FOLDER (kept there for the next time),
draws pairs of pictures near and far, matches and verifies them, and fits a logistic regression of "the direction is
right within 15 degrees" to what each estimate knows about itself. With --data, the rendered and real pairs below that
folder take part as well. Every set of pairs weighs the same. Prints the coefficients and, fitted without the set that
is judged, stated against true probability.
"""
import argparse
import csv
import math
import pathlib
import random
import subprocess

HOUSE = "hall living_room kitchen dining_room bedroom bathroom study guest_room music_room hall".split()
OFFICES = ["corridor"] + [f"office_{number}" for number in range(1, 9)] + ["corridor"]
ALIKE = "offices taken for each other"
NAMES = ["one", "log lead", "unexplained x log parallax", "tilt, degrees", "evidence per match"]


def number(row, name):
    return float(row[name])


def features(row):
    """What verify.cpp computes from an estimate, in the order of NAMES."""
    matches = max(1.0, number(row, "matches"))
    unexplained = 1.0 - number(row, "inliers") / matches
    parallax = math.log(min(10.0, max(0.5, number(row, "parallax_deg"))) / 10.0)
    return [1.0, math.log(max(1.0, number(row, "lead"))), unexplained * parallax, min(3.0, number(row, "tilt_deg")),
            number(row, "evidence") / matches]


def draw_pairs(tour):
    """Pairs of one tour at all distances; of rooms that look alike and are not the same, 250 in a second file."""
    with open(tour / "poses.csv", newline="") as table:
        rows = list(csv.DictReader(table))
    chance = random.Random(1)
    chosen = []
    for low, high, count in ((0.1, 2.0, 100), (2.0, 4.0, 150), (4.0, 8.0, 200), (8.0, 1e9, 250)):
        wanted = len(chosen) + count
        while len(chosen) < wanted:
            a, b = chance.sample(rows, 2)
            apart = math.hypot(float(a["x_m"]) - float(b["x_m"]), float(a["y_m"]) - float(b["y_m"]))
            if low <= apart < high:
                chosen.append((a, b))
    # Offices are told apart by nothing that two views of them could show: which of them it is, is for the map to know.
    offices = [row for row in rows if row.get("room", "").startswith("office")]
    alike = [pair for pair in chosen if {"office"} == {row.get("room", "")[:6] for row in pair}
             and pair[0]["room"] != pair[1]["room"]]
    chosen = [pair for pair in chosen if pair not in alike]
    while offices and len(alike) < 250:
        a, b = chance.sample(offices, 2)
        if a["room"] != b["room"]:
            alike.append((a, b))
    for name, pairs in (("pairs.csv", chosen), ("alike.csv", alike)):
        with open(tour / name, "w") as out:
            out.write("current,target\n")
            out.writelines(f"{a['filename']},{b['filename']}\n" for a, b in pairs)


def verify(binaries, name, camera, pairs, poses, out):
    command = [binaries / "homeward_bench_pairs", "--name", name, "--camera", camera, "--pairs", pairs]
    with open(out, "w") as file:
        subprocess.run(command + (["--poses", poses] if poses else []), check=True, stdout=file)


def collect(binaries, work, data):
    sets = []
    for name, world, rooms in (("house", "house:1", HOUSE), ("offices", "offices:1", OFFICES)):
        tour = work / name
        if not (tour / "poses.csv").exists():
            subprocess.run([binaries / "homeward", "simulate", "tour", "--world", world, "--rooms", *rooms, "--out", tour],
                           check=True, stdout=subprocess.DEVNULL)
        draw_pairs(tour)
        sets.append((name, tour / "camera.json", tour / "pairs.csv", tour / "poses.csv"))
    sets.append((ALIKE, tour / "camera.json", tour / "alike.csv", tour / "poses.csv"))
    if data:
        train = data / "sim/home/train"
        sets.append(("sim", train / "camera.json", train / "pairs.csv", train / "poses.csv"))
        for name in ("sait", "plm"):
            folder = data / f"real/{name}_corridor_360"
            sets.append((name, folder / "camera.json", folder / "pairs.csv", None))
    samples = {}
    for name, camera, pairs, poses in sets:
        verify(binaries, name, camera, pairs, poses, work / f"{name}.csv")
        with open(work / f"{name}.csv", newline="") as table:
            answered = [row for row in csv.DictReader(table) if row["answered"] == "1"]
        # A pair of different places has no right direction.
        samples[name] = [(features(row), 1.0 if row["same"] == "1" and number(row, "error_deg") < 15 else 0.0)
                         for row in answered]
    return samples


def solve(matrix, right):
    """Gauss with pivots; the matrix is small."""
    n = len(right)
    rows = [list(matrix[i]) + [right[i]] for i in range(n)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(i + 1, n):
            factor = rows[k][i] / rows[i][i]
            rows[k] = [x - factor * y for x, y in zip(rows[k], rows[i])]
    result = [0.0] * n
    for i in reversed(range(n)):
        result[i] = (rows[i][n] - sum(rows[i][k] * result[k] for k in range(i + 1, n))) / rows[i][i]
    return result


def probability(weights, x):
    return 1.0 / (1.0 + math.exp(-max(-30.0, min(30.0, sum(w * v for w, v in zip(weights, x))))))


def fit(samples):
    """Newton's method with a weak pull of all but the constant towards zero. Every set weighs as 200 samples."""
    n = len(NAMES)
    weights = [0.0] * n
    pull = 0.3
    for _ in range(50):
        gradient = [-pull * w if i else 0.0 for i, w in enumerate(weights)]
        curvature = [[(pull if i else 1e-6) if i == k else 0.0 for k in range(n)] for i in range(n)]
        for rows in samples:
            importance = 200.0 / max(1, len(rows))
            for x, y in rows:
                p = probability(weights, x)
                for i in range(n):
                    gradient[i] += importance * (y - p) * x[i]
                    for k in range(n):
                        curvature[i][k] += importance * p * (1.0 - p) * x[i] * x[k]
        step = solve(curvature, gradient)
        weights = [w + s for w, s in zip(weights, step)]
        if max(abs(s) for s in step) < 1e-9:
            break
    return weights


def reliability(title, stated):
    """A line for each bin of stated probability, then the expected calibration error."""
    print(f"{title}: stated, true, n")
    off = 0.0
    for low, high in ((0.0, 0.2), (0.2, 0.4), (0.4, 0.6), (0.6, 0.8), (0.8, 0.9), (0.9, 0.97), (0.97, 1.01)):
        chosen = [(p, y) for p, y in stated if low <= p < high]
        if chosen:
            said, true = (sum(values) / len(chosen) for values in zip(*chosen))
            off += abs(said - true) * len(chosen) / len(stated)
            print(f"  {said:.2f} {true:.2f} {len(chosen)}")
    wrong = sum(p > 0.8 and not y for p, y in stated)
    print(f"  expected calibration error {off:.3f}; {wrong} of {len(stated)} wrong with more than 0.8")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binaries", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--data", type=pathlib.Path)
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    samples = collect(options.binaries, options.work, options.data)
    alike = samples.pop(ALIKE)
    weights = fit(samples.values())
    for name, weight in zip(NAMES, weights):
        print(f"{weight:9.3f}  {name}")
    everything = []
    for name, rows in samples.items():
        others = fit([kept for other, kept in samples.items() if other != name])
        stated = [(probability(others, x), y) for x, y in rows]
        everything += stated
        reliability(f"{name}, fitted without it", stated)
        reliability(f"{name}, fitted with it", [(probability(weights, x), y) for x, y in rows])
    reliability("all, each fitted without its set", everything)
    reliability("all", [(probability(weights, x), y) for rows in samples.values() for x, y in rows])
    reliability(f"{ALIKE}, not fitted", [(probability(weights, x), y) for x, y in alike])


if __name__ == "__main__":
    main()
