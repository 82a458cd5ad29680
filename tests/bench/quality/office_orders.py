#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Maps of tours that enter eight look-alike offices in different orders, and what each source of evidence adds.

usage: office_orders.py --work DIR [--bin DIR] [--orders N] [--first N] [--world SEED] [--ablation] [--tour DIR ...]

Order n is the nth shuffle of the eight rooms, the first of them entered again at the end. Tours are rendered into DIR,
and what was seen and compared is kept there: the first run takes about a minute for each order, later ones a second.
Each tour is built with its odometry, as if it had none, and so with every seventh picture or so missing: steps of
different lengths that nothing tells. --tour adds tours with true poses. --ablation: also without each source of evidence.
Prints tables, and ends with 1 when any place is wider than 4 m or holds two offices with all the evidence, or the loop
recall of an order is below 0.8.
"""

import argparse
import collections
import csv
import pathlib
import random
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
WANTED_RECALL = 0.8


def order(number):
    rooms = [f"office_{room}" for room in range(1, 9)]
    random.Random(number).shuffle(rooms)
    return ["corridor", *rooms, rooms[0], "corridor"]


def render(options, number):
    folder = options.work / f"offices{options.world}-{number}"
    if not (folder / "poses.csv").is_file():
        subprocess.run([options.bin / "homeward", "simulate", "tour", "--world", f"offices:{options.world}", "--rooms",
                        ",".join(order(number)), "--seed", str(number), "--out", folder], check=True,
                       stdout=subprocess.DEVNULL)
    return folder


def judge(options, tours, *more):
    command = [options.bin / "homeward_bench_maps", "--cache", options.work / "seen", *more]
    if options.ablation:
        command.append("--ablation")
    output = subprocess.run([*command, "--tour", *tours], check=True, capture_output=True, text=True).stdout
    return list(csv.DictReader(output.splitlines()))


def table(title, rows):
    """One line for each variant: worst and mean over the tours."""
    variants = collections.OrderedDict()
    for row in rows:
        variants.setdefault(row["evidence"], []).append(row)
    print(f"{title}\n| evidence | tours | places | wider than 4 m | of two rooms | accepted, right | taken back | "
          "loop recall, least | mean |\n|---|---|---|---|---|---|---|---|---|")
    for name, tours in variants.items():
        def total(column):
            return sum(float(row[column]) for row in tours)

        recall = [float(row["loop_recall"]) for row in tours]
        right = sum(float(row["accepted"]) * float(row["accepted_right"]) for row in tours) / max(1.0, total("accepted"))
        print(f"| {name} | {len(tours)} | {total('places') / len(tours):.0f} | {total('false_merges'):.0f} | "
              f"{total('mixed_rooms'):.0f} | {total('accepted'):.0f}, {right:.3f} | {total('taken_back'):.0f} | "
              f"{min(recall):.2f} | {sum(recall) / len(recall):.2f} |")
    print(flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--orders", type=int, default=20)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--world", type=int, default=1)
    parser.add_argument("--ablation", action="store_true")
    parser.add_argument("--tour", type=pathlib.Path, nargs="*", default=[])
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    for tour in options.tour:
        table(f"{tour}", judge(options, [tour]))
    tours = [render(options, options.first + i) for i in range(options.orders)]
    if not tours:
        return 0
    bad = []
    for title, how in (("with odometry", []), ("pictures alone", ["--without-odometry"]),
                       ("pictures alone, 15 % of them missing", ["--without-odometry", "--leave-out", "0.15"])):
        rows = judge(options, tours, *how)
        table(f"offices, {title}", rows)
        bad += [f"{row['tour']} ({title})" for row in rows if row["evidence"] == "all" and
                (int(row["false_merges"]) + int(row["mixed_rooms"]) > 0 or float(row["loop_recall"]) < WANTED_RECALL)]
    if bad:
        print("does not hold:", ", ".join(bad))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
