#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Maps broken on purpose, and how soon a person is asked about what is wrong with them.

usage: doubts.py --work DIR --eval DIR [--bin DIR] [--worlds house,wards] [--first N] [--seeds N] [--alike] [--ask N]
                 [--without-odometry] [--no-answers] [--api]

--eval: the folder of map.py. For each world and seed N, N+1, ...: a tour of all rooms (of wards: three) is rendered and its
map built (both kept in DIR); 5 places of it are wrongly merged, 5 loops missed, 3 ways made that do not exist
(homeward_bench_faults; --alike: places that look most alike are merged; --without-odometry: of tours that had none).
`homeward map doubts` then names what to look at, and the faults among the first 20 (--ask) are counted. What it asks is then
answered as the true poses say, by `homeward map edit`, one question after the other, until map.py finds nothing wrong, or
nothing more is asked. --api: a server does all that instead: the tour is uploaded and built there, the map exported, broken
and imported again, and asked about and answered by the calls that the dashboard makes (doubts_api.py).
Prints a line for each map and their sum; ends with 1 when fewer than 0.9 of all faults are among the first 20, or a map is
not whole after the answers.
"""

import argparse
import csv
import json
import math
import pathlib
import random
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
SAME_M = 1.0  # pictures that show one place, as map.py counts revisits
MIXED_M = 2.0  # pictures of one place that are not worth splitting
WAY_M = 6.0  # ends of a way, as map.py counts edges
WANTED = 0.9
MOST_ANSWERS = 60


def run(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(str(part) for part in command)}: {done.stderr or done.stdout}")
    return done.stdout


def read_poses(tour):
    with open(tour / "poses.csv", newline="") as file:
        return {row["filename"]: (float(row["x_m"]), float(row["y_m"])) for row in csv.DictReader(file)}


def rooms(world, seed):
    """All rooms of a house; of wards, which are large, three by chance, from the first hall and back to it."""
    if world != "wards":
        return "all"
    return ",".join(["hall_1", *(f"ward_{number}" for number in random.Random(seed).sample(range(1, 7), 3)), "hall_1"])


def without_odometry(tour):
    """The same pictures as a tour of its own."""
    bare = tour.with_name(f"{tour.name}-bare")
    bare.mkdir(exist_ok=True)
    for file in tour.iterdir():
        if file.name not in ("odometry.csv", "scans.csv", "scans.json") and not (bare / file.name).exists():
            (bare / file.name).symlink_to(file.resolve())
    return bare


class Case:
    """A broken map and what is wrong with it."""

    def __init__(self, options, world, seed):
        self.options = options
        self.program = options.bin / "homeward"
        self.name = f"{world}:{seed}"
        self.tour = options.work / f"{world}-{seed}"
        if not (self.tour / "poses.csv").is_file():
            run(self.program, "simulate", "tour", "--world", self.name, "--rooms", rooms(world, seed), "--seed", seed, "--out",
                self.tour)
        if options.without_odometry:
            self.tour = without_odometry(self.tour)
        self.sound = options.work / f"{self.tour.name}.map"
        self.poses = read_poses(self.tour)
        kind = "alike" if options.alike else "any"
        self.broken = options.work / f"{self.tour.name}-{kind}.map"
        self.build()
        told = self.broken.with_suffix(".faults.json")
        run(options.bin / "homeward_bench_faults", "--map", self.sound, "--tour", self.tour, "--out", self.broken, "--faults",
            told, "--seed", seed, *(["--alike"] if options.alike else []))
        self.faults = json.loads(told.read_text())["faults"]

    def build(self):
        if not self.sound.is_file():
            run(self.program, "map", "build", "--tour", self.tour, "--camera", self.tour / "camera.json", "--out", self.sound)

    def distance(self, image_a, image_b):
        return math.dist(*(self.poses[image.rsplit("/", 1)[-1]] for image in (image_a, image_b)))

    def doubts(self, map_file, limit):
        return json.loads(run(self.program, "map", "doubts", map_file, "--json", "--limit", limit))["doubts"]

    def judged(self, map_file):
        inspected = map_file.with_suffix(".json")
        inspected.write_text(run(self.program, "map", "inspect", map_file, "--json"))
        return json.loads(run(sys.executable, "-B", self.options.eval / "map.py", inspected, self.tour / "poses.csv"))

    def found(self, asked):
        """For each fault the number of the first question about it, from 1; 0 where there is none."""
        numbers = []
        for fault in self.faults:
            a, b = set(fault["images_a"]), set(fault["images_b"])
            hits = [number for number, doubt in enumerate(asked, 1) if doubt["kind"] == fault["kind"] and
                    ({doubt["image_a"], doubt["image_b"]} & a and {doubt["image_a"], doubt["image_b"]} & b)]
            numbers.append(hits[0] if hits else 0)
        return numbers

    def by_masses(self):
        """How many faults are among as many hypotheses, those first that are least certain: what a report says of a map."""
        found = json.loads(run(self.program, "map", "inspect", self.broken, "--json"))["hypotheses"]
        found.sort(key=lambda one: max(one["support"], 1.0 - one["plausibility"]))
        asked = [{"image_a": one["prototype_a"], "image_b": one["prototype_b"],
                  "kind": "mixed_place" if one["decision"] == "accepted" else "same_place"} for one in found]
        return sum(0 < number <= self.options.ask for number in self.found(asked))

    def answer(self, doubt):
        """The edits that the true poses ask for."""
        near = {"same_place": SAME_M, "mixed_place": MIXED_M, "way": WAY_M}[doubt["kind"]]
        return doubt["if_yes"] if self.distance(doubt["image_a"], doubt["image_b"]) <= near else doubt["if_no"]

    def answered(self):
        """Answers one question after the other, the first that was not answered yet; how many, and how the map is then."""
        map_file = self.options.work / f"{self.broken.stem}-answered.map"
        map_file.write_bytes(self.broken.read_bytes())
        batch = self.options.work / f"{self.broken.stem}-answer.json"
        known, figures = set(), self.judged(map_file)
        while len(known) < MOST_ANSWERS and not whole(figures):
            doubt = next((one for one in self.doubts(map_file, 1000) if self.identity(one) not in known), None)
            if doubt is None:
                break
            known.add(self.identity(doubt))
            edits = self.answer(doubt)
            if not edits:
                continue
            batch.write_text(json.dumps({"edits": edits}))
            run(self.program, "map", "edit", "--map", map_file, "--edits", batch, "--out", map_file, "--tour", self.tour)
            figures = self.judged(map_file)
        return len(known), figures

    @staticmethod
    def identity(doubt):
        return doubt["kind"], doubt["image_a"], doubt["image_b"]


def whole(figures):
    return figures["false_merges"] == 0 and figures["edge_ok"] == 1.0 and figures["connected"] == 1.0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--eval", type=pathlib.Path, required=True)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--worlds", default="house,wards")
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--alike", action="store_true")
    parser.add_argument("--without-odometry", action="store_true")
    parser.add_argument("--ask", type=int, default=20)
    parser.add_argument("--no-answers", action="store_true")
    parser.add_argument("--api", action="store_true")
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    if not options.api:
        return measure(options, Case)
    import doubts_api  # which needs this file
    with doubts_api.server(options) as case:
        return measure(options, case)


def measure(options, make_case):
    rows, bad = [], []
    print("| map | merged | loops | ways | of all | by masses alone | asked at | answers | false merges | edges ok | connected |\n"
          "|---|---|---|---|---|---|---|---|---|---|---|", flush=True)
    for seed in range(options.first, options.first + options.seeds):
        for world in options.worlds.split(","):
            case = make_case(options, world, seed)
            at = case.found(case.doubts(case.broken, 1000))
            first = {kind: [0 < number <= options.ask for number, fault in zip(at, case.faults) if fault["kind"] == kind]
                     for kind in ("mixed_place", "same_place", "way")}
            answers, figures = (0, None) if options.no_answers else case.answered()
            rows.append(first)
            kinds = " | ".join(f"{sum(hits)}/{len(hits)}" for hits in first.values())
            every = [hit for hits in first.values() for hit in hits]
            after = "| |" if figures is None else f"{figures['false_merges']} | {figures['edge_ok']} | {figures['connected']}"
            print(f"| {case.name} | {kinds} | {sum(every)}/{len(every)} | {case.by_masses()}/{len(every)} | {' '.join(str(number) for number in at)} | {answers} | "
                  f"{after} |", flush=True)
            if figures is not None and not whole(figures):
                bad.append(case.name)
    sums = {kind: [hit for row in rows for hit in row[kind]] for kind in ("mixed_place", "same_place", "way")}
    every = [hit for hits in sums.values() for hit in hits]
    share = sum(every) / max(1, len(every))
    print("| all | " + " | ".join(f"{sum(hits)}/{len(hits)}" for hits in sums.values()) + f" | {share:.3f} | | | | | | |")
    if bad:
        print("not whole after the answers:", ", ".join(bad))
    return 1 if bad or share < WANTED else 0


if __name__ == "__main__":
    sys.exit(main())
