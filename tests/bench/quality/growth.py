#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Maps that grow, against maps of the same tours built at once.

usage: growth.py --work DIR --eval DIR [--bin DIR] [--home DIR] [--house SEED] [--offices N] [--first N] [--pictures-alone]

--eval: the folder of map.py and localise.py. Cases:
  --home DIR     the tours of the rendered home (train, test_day, test_night): the tour cut in two, a walk by day and
                 one by night added to the whole tour; with them, how well the other walk is localised in each map
  --house SEED   two tours of a generated house, the second in another order of its rooms
  --offices N    N pairs of tours through eight look-alike offices: four of them in one shuffled order, then, as another
                 tour, all eight in another order. From --first on
Each case: the map of the first tour, this map with the second tour added, and one map of both. Maps and tours are kept
in DIR: delete a map to make it again. --pictures-alone: as if no tour had odometry.
Prints one table, and ends with 1 when a grown map has a false merge or a place that mixes two offices.
"""

import argparse
import csv
import json
import pathlib
import random
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]


def run(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(str(part) for part in command)}: {done.stderr or done.stdout}")
    return done.stdout


def cut(source, target, keep, odometry=True):
    """Pictures of a tour under names that no other tour of the case has: those whose number `keep` takes."""
    if not (target / "poses.csv").is_file():
        target.mkdir(parents=True, exist_ok=True)
        for table in ("poses.csv", "times.csv"):
            if not (source / table).is_file():
                continue
            with open(source / table, newline="") as file:
                head, *rows = list(csv.reader(file))
            with open(target / table, "w", newline="") as file:
                writer = csv.writer(file)
                writer.writerow(head)
                for number, row in enumerate(rows):
                    if keep(number):
                        writer.writerow([f"{target.name}-{row[0]}", *row[1:]])
        pictures = sorted(path for path in source.iterdir() if path.suffix == ".jpg")
        for number, picture in enumerate(pictures):
            if keep(number) and not (target / f"{target.name}-{picture.name}").exists():
                (target / f"{target.name}-{picture.name}").symlink_to(picture.resolve())
        for extra in ("camera.json", *(["odometry.csv"] if odometry else [])):
            if (source / extra).is_file():
                (target / extra).write_bytes((source / extra).read_bytes())
    return target


def all_poses(folder, tours):
    """The true poses of several tours as one table."""
    path = folder / ("poses-" + "-".join(tour.name for tour in tours) + ".csv")
    lines = [(tour / "poses.csv").read_text().splitlines() for tour in tours]
    path.write_text("\n".join([lines[0][0], *[line for of_tour in lines for line in of_tour[1:]]]) + "\n")
    return path


class Bench:
    def __init__(self, options):
        self.options = options
        self.program = options.bin / "homeward"
        self.rows = []

    def inspected(self, map_file):
        path = map_file.with_suffix(".json")
        path.write_text(run(self.program, "map", "inspect", map_file, "--json"))
        return path

    def judged(self, map_file, poses):
        return json.loads(run(sys.executable, self.options.eval / "map.py", self.inspected(map_file), poses))

    def mixed_offices(self, map_file, poses):
        """Places that hold pictures of two offices."""
        with open(poses, newline="") as file:
            room = {row["filename"]: row.get("room") or "" for row in csv.DictReader(file)}
        places = json.loads(self.inspected(map_file).read_text())["places"]
        rooms = [{room.get(member.rsplit("/", 1)[-1], "") for member in place["members"]} for place in places]
        return sum(len([name for name in of_place if name.startswith("office")]) > 1 for of_place in rooms)

    def localised(self, map_file, tour, poses):
        beliefs = map_file.with_name(f"{map_file.stem}-{tour.name}.jsonl")
        beliefs.write_text(run(self.program, "localise", "--map", map_file, "--images", tour, "--restart-every", 3))
        return json.loads(run(sys.executable, self.options.eval / "localise.py", beliefs, self.inspected(map_file), poses,
                              tour / "poses.csv"))

    def built(self, folder, tours):
        map_file = folder / ("-".join(tour.name for tour in tours) + ".map")
        if not map_file.is_file():
            each = [part for tour in tours for part in ("--tour", tour)]
            run(self.program, "map", "build", *each, "--camera", tours[0] / "camera.json", "--out", map_file)
        return map_file

    def grown(self, folder, old, tour):
        map_file = folder / f"{old.stem}+{tour.name}.map"
        if not map_file.is_file():
            done = run(self.program, "map", "build", "--add-to", old, "--tour", tour, "--out", map_file, "--json")
            map_file.with_suffix(".added").write_text(done)
        return map_file, json.loads(map_file.with_suffix(".added").read_text())["added"]

    def case(self, name, first, second, queries=()):
        folder = first.parent
        of_first = self.built(folder, [first])
        grown, added = self.grown(folder, of_first, second)
        both = self.built(folder, [first, second])
        for kind, map_file, tours in (("first", of_first, [first]), ("grown", grown, [first, second]),
                                      ("at once", both, [first, second])):
            poses = all_poses(folder, tours)
            row = {"case": name, "map": kind, **self.judged(map_file, poses),
                   "mixed_offices": self.mixed_offices(map_file, poses)}
            if kind == "grown":
                row["added"] = f"{added['images']}, {added['joined_images']}; {added['places']}"
            for query in queries:
                seen = self.localised(map_file, query, poses)
                late = seen.get("near_3", seen.get("near_2"))
                row.setdefault("localised", []).append(
                    f"{query.name} {seen['near_1']:.2f}, {late:.2f}, {seen['strict_1']:.2f}, ece {seen['ece']:.3f}")
            self.rows.append(row)
            print(line(row), flush=True)


HEAD = ["case", "map", "added: pictures, at old places; new places", "places", "false merges", "of two offices", "spread p95",
        "loop recall", "edges right", "connected", "accepted right", "walks: near after 1, after 3, exact after 1, ece"]


def line(row):
    def number(key, digits):
        value = row.get(key)
        return "" if value is None else f"{value:.{digits}f}"

    cells = [row["case"], row["map"], row.get("added", ""), number("places", 0), number("false_merges", 0),
             number("mixed_offices", 0), number("place_spread_p95", 2), number("loop_recall", 2), number("edge_ok", 2),
             number("connected", 2), number("hyp_precision", 2), "; ".join(row.get("localised", []))]
    return "| " + " | ".join(cells) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--eval", type=pathlib.Path, required=True)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--home", type=pathlib.Path)
    parser.add_argument("--house", type=int)
    parser.add_argument("--offices", type=int, default=0)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--pictures-alone", action="store_true")
    options = parser.parse_args()
    bench = Bench(options)
    odometry = not options.pictures_alone
    print("| " + " | ".join(HEAD) + " |\n|" + "---|" * len(HEAD), flush=True)

    def rendered(world, rooms, seed):
        folder = options.work / "rendered" / f"{world.replace(':', '')}-{seed}-{len(rooms)}"
        if not (folder / "poses.csv").is_file():
            run(bench.program, "simulate", "tour", "--world", world, "--rooms", ",".join(rooms), "--step-m", 0.5,
                "--seed", seed, "--out", folder)
        return folder

    if options.home:
        folder = options.work / "home"
        everything = [cut(options.home / tour, folder / short, lambda number: True)
                      for tour, short in (("train", "train"), ("test_day", "day"), ("test_night", "night"))]
        train, day, night = everything
        halves = [cut(options.home / "train", folder / half, lambda number, low=low: low <= number < low + 150)
                  for half, low in (("first", 0), ("second", 150))]
        bench.case("home, the tour's two halves", *halves, [day, night])
        bench.case("home, a walk by day", train, day, [night])
        bench.case("home, a walk by night", train, night, [day])
    if options.house is not None:
        world = f"house:{options.house}"
        rooms = rooms_of(bench, world, options.work)
        orders = []
        for seed in (1, 2):
            order = list(rooms)
            random.Random(seed).shuffle(order)
            orders.append(rendered(world, order, seed))
        folder = options.work / f"house{options.house}{'' if odometry else '-alone'}"
        bench.case(world, cut(orders[0], folder / "one", lambda number: True, odometry),
                   cut(orders[1], folder / "two", lambda number: True, odometry))
    for number in range(options.first, options.first + options.offices):
        shuffles = []
        for seed in (number, 100 + number):
            order = [f"office_{room}" for room in range(1, 9)]
            random.Random(seed).shuffle(order)
            shuffles.append(order)
        one = rendered("offices:1", ["corridor", *shuffles[0][:4], shuffles[0][0], "corridor"], number)
        two = rendered("offices:1", ["corridor", *shuffles[1], shuffles[1][0], "corridor"], 100 + number)
        folder = options.work / f"offices{number}{'' if odometry else '-alone'}"
        bench.case(f"offices {number}", cut(one, folder / "one", lambda n: True, odometry),
                   cut(two, folder / "two", lambda n: True, odometry))
    bad = [row["case"] for row in bench.rows if row["map"] == "grown" and
           row["false_merges"] + row["mixed_offices"] > 0]
    if bad:
        print("does not hold:", ", ".join(bad))
    return 1 if bad else 0


def rooms_of(bench, world, work):
    """The rooms of a world, as the program names them when asked for one that is not there."""
    done = subprocess.run([bench.program, "simulate", "tour", "--world", world, "--rooms", "-,-", "--out",
                           work / "none"], capture_output=True, text=True)
    return [room.strip(" .") for room in done.stderr.split("its rooms are ")[1].split("(")[0].split(",")]


if __name__ == "__main__":
    sys.exit(main())
