#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fits the confidence of verified motions (src/matching/confidence.cpp) and shows how well it is calibrated.

usage: confidence.py BIN_FOLDER WORK_FOLDER [--data FOLDER]

Renders tours of the generated house and offices and grids of pictures of single offices into WORK_FOLDER (kept there
for the next time), draws pairs of pictures near and far, matches and verifies them, and fits a logistic regression of
"one place, and the direction is right within 15 degrees" to what each estimate knows about itself. With --data, the
rendered and real pairs below that folder take part as well. Every set of pairs weighs the same, but for the office
taken for the one that is its mirror image, which weighs MIRRORED times as much: a chair that is sure of the wrong room
is worse than one that looks twice. Prints the coefficients and, fitted without the set that is judged, stated against
true probability.
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
JUDGED = "mirrored offices of another building"
MIRRORED = 5.0
NAMES = ["one", "log lead", "around", "log (1 + disagreeing)", "log parallax x around"]


def number(row, name):
    return float(row[name])


def features(row):
    """What confidence.cpp computes from the signs, in the order of NAMES."""
    around = number(row, "around")
    parallax = math.log(min(10.0, max(0.5, number(row, "parallax_deg"))) / 10.0)
    disagreeing = max(5.0, number(row, "disagreeing"))
    return [1.0, math.log(max(1.0, number(row, "lead"))), around, math.log1p(disagreeing), parallax * around]


def apart(a, b):
    return math.hypot(float(a["x_m"]) - float(b["x_m"]), float(a["y_m"]) - float(b["y_m"]))


def poses_of(folder):
    """The rows of a folder's poses.csv with the pictures' whole paths."""
    with open(folder / "poses.csv", newline="") as table:
        return [{**row, "filename": str((folder / row["filename"]).resolve())} for row in csv.DictReader(table)]


def write_pairs(file, pairs, same=True):
    with open(file, "w") as out:
        out.write("current,target,same\n")
        out.writelines(f"{a['filename']},{b['filename']},{int(same)}\n" for a, b in pairs)
    return file


def write_poses(file, rows):
    with open(file, "w") as out:
        out.write("filename,x_m,y_m,theta_rad\n")
        out.writelines(f"{row['filename']},{row['x_m']},{row['y_m']},{row['theta_rad']}\n" for row in rows)
    return file


def draw_pairs(tour):
    """Pairs of one tour at all distances, and 250 of rooms that look alike and are not the same."""
    rows = poses_of(tour)
    chance = random.Random(1)
    chosen = []
    for low, high, count in ((0.1, 2.0, 100), (2.0, 4.0, 150), (4.0, 8.0, 200), (8.0, 1e9, 250)):
        wanted = len(chosen) + count
        while len(chosen) < wanted:
            a, b = chance.sample(rows, 2)
            if low <= apart(a, b) < high:
                chosen.append((a, b))
    # Offices of one side are told apart by nothing that two views of them could show: which of them it is, is for the
    # map to know.
    offices = [row for row in rows if row.get("room", "").startswith("office")]
    alike = [pair for pair in chosen if {"office"} == {row.get("room", "")[:6] for row in pair}
             and pair[0]["room"] != pair[1]["room"]]
    chosen = [pair for pair in chosen if pair not in alike]
    while offices and len(alike) < 250:
        a, b = chance.sample(offices, 2)
        if a["room"] != b["room"]:
            alike.append((a, b))
    return chosen, alike


class Sets:
    """Pairs of pictures by name, verified."""

    def __init__(self, binaries, work):
        self.binaries = binaries
        self.work = work
        self.samples = {}

    def simulate(self, kind, name, *arguments):
        folder = self.work / name
        if not (folder / "poses.csv").exists():
            subprocess.run([self.binaries / "homeward", "simulate", kind, *map(str, arguments), "--out", folder], check=True,
                           stdout=subprocess.DEVNULL)
        return folder

    def verify(self, name, camera, pairs, poses=None):
        table = self.work / f"{name}.csv"
        command = [self.binaries / "homeward_bench_pairs", "--name", name, "--camera", camera, "--pairs", pairs]
        with open(table, "w") as out:
            subprocess.run(command + (["--poses", poses] if poses else []), check=True, stdout=out)
        with open(table, newline="") as rows:
            answered = [row for row in csv.DictReader(rows) if row["answered"] == "1"]
        # A pair of different places has no right direction.
        self.samples[name] = [
            (features(row), 1.0 if row["same"] == "1" and number(row, "error_deg") < 15 else 0.0)
            for row in answered]

    def tours(self):
        for name, world, rooms in (("house", "house:1", HOUSE), ("offices", "offices:1", OFFICES)):
            tour = self.simulate("tour", name, "--world", world, "--rooms", *rooms)
            poses = write_poses(self.work / f"{name}_poses.csv", poses_of(tour))
            chosen, alike = draw_pairs(tour)
            self.verify(name, tour / "camera.json", write_pairs(self.work / f"{name}_pairs.csv", chosen), poses)
        self.verify(ALIKE, tour / "camera.json", write_pairs(self.work / "alike_pairs.csv", alike, same=False))

    def grids(self):
        """Pictures within one office, right whichever they are, and of an office and the one that is its mirror image."""
        chance = random.Random(2)
        for seed, fitted in ((2, True), (1, False)):
            seen = {}
            for room in ("office_7", "office_8"):
                for theta_rad in (0.0, 0.7):
                    grid = self.simulate("grid", f"{room}_{seed}_{theta_rad}", "--world", f"offices:{seed}", "--room", room,
                                         "--step-m", 0.4, "--theta-rad", theta_rad)
                    seen[room, theta_rad] = poses_of(grid)
            camera = grid / "camera.json"
            def draw(one, other, count):
                pairs = [(a, b) for a in seen[one, 0.0] for b in seen[other, 0.7] if apart(a, b) > 0.2]
                return chance.sample(pairs, min(count, len(pairs)))
            table = write_pairs(self.work / f"mirrored_pairs_{seed}.csv", draw("office_7", "office_8", 800), same=False)
            self.verify("mirrored offices" if fitted else JUDGED, camera, table)
            if fitted:
                poses = write_poses(self.work / "office_poses.csv", [row for rows in seen.values() for row in rows])
                table = write_pairs(self.work / "office_pairs.csv",
                                    draw("office_7", "office_7", 150) + draw("office_8", "office_8", 150))
                self.verify("within an office", camera, table, poses)

    def data(self, data):
        train = data / "sim/home/train"
        self.verify("sim", train / "camera.json", train / "pairs.csv", train / "poses.csv")
        chance = random.Random(3)
        taught = poses_of(train)
        for name in ("test_day", "test_night"):
            again = poses_of(train.parent / name)
            near = [(a, b) for a in again for b in taught if 0.1 < apart(a, b) < 2.5]
            self.verify(name, train / "camera.json", write_pairs(self.work / f"{name}_pairs.csv", chance.sample(near, 300)),
                        write_poses(self.work / f"{name}_poses.csv", again + taught))
        for name in ("sait", "plm"):
            folder = data / f"real/{name}_corridor_360"
            self.verify(name, folder / "camera.json", folder / "pairs.csv")


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
    """Newton's method with a weak pull of all but the constant towards zero. A set weighs as 200 samples."""
    n = len(NAMES)
    weights = [0.0] * n
    pull = 0.3
    for _ in range(50):
        gradient = [-pull * w if i else 0.0 for i, w in enumerate(weights)]
        curvature = [[(pull if i else 1e-6) if i == k else 0.0 for k in range(n)] for i in range(n)]
        for name, rows in samples.items():
            importance = (MIRRORED if name == "mirrored offices" else 1.0) * 200.0 / max(1, len(rows))
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
    sure = sum(p > 0.8 and y for p, y in stated)
    right = sum(y for _, y in stated)
    print(f"  expected calibration error {off:.3f}; more than 0.8: {sure:.0f} of {right:.0f} right, {wrong} of "
          f"{len(stated) - right:.0f} wrong")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binaries", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--data", type=pathlib.Path)
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    sets = Sets(options.binaries, options.work)
    sets.tours()
    sets.grids()
    if options.data:
        sets.data(options.data)
    samples = sets.samples
    judged = {name: samples.pop(name) for name in (ALIKE, JUDGED)}
    weights = fit(samples)
    for name, weight in zip(NAMES, weights):
        print(f"{weight:9.3f}  {name}")
    everything = []
    for name, rows in samples.items():
        others = fit({other: kept for other, kept in samples.items() if other != name})
        stated = [(probability(others, x), y) for x, y in rows]
        everything += stated
        reliability(f"{name}, fitted without it", stated)
        reliability(f"{name}, fitted with it", [(probability(weights, x), y) for x, y in rows])
    reliability("all, each fitted without its set", everything)
    reliability("all", [(probability(weights, x), y) for rows in samples.values() for x, y in rows])
    for name, rows in judged.items():
        reliability(f"{name}, not fitted", [(probability(weights, x), y) for x, y in rows])


if __name__ == "__main__":
    main()
