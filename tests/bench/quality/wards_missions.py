#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Missions at random in generated hospitals whose halves look alike, and chairs carried off to the wrong one.

usage: wards_missions.py --work DIR --seeds SEED... [--day N] [--night N] [--kidnapped N] [--robot disc|chair] [--bin DIR]

Teaches each wards:SEED by one tour of all its rooms by day, and drives in each N missions by day (20), N at night (5) and N
by day in which the robot is lifted, 10 s after the start, to the spot that looks most alike (0). One `homeward simulate run`
a seed, two seeds at once; results stay in DIR as one file of JSON lines a seed, and a seed that is there already is only
counted. Prints a line a seed and one of all, then every mission that did not arrive within 0.3 m, and ends with 1 when a
bound does not hold: no false arrival (claimed, more than 0.5 m away), no collision, 95 % within 0.3 m, belief and estimate
never more than 2 m apart for longer than 3 s, and of those carried off each says so within 5 s.
"""

import argparse
import concurrent.futures
import json
import pathlib
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
RIGHT_M = 0.3
FALSE_M = 0.5
APART_S = 3.0
TOLD_S = 5.0


def drive(options, seed):
    out = options.work / f"wards-{seed}.jsonl"
    if out.is_file():
        return
    kidnapped = [{"kind": "kidnapped", "at_s": 10}]
    wanted = [(options.night, {"light": "night"}), (options.kidnapped, {"faults": kidnapped}), (options.day, {})]
    scenario = {
        "format": "homeward-scenario",
        "version": 1,
        "world": f"wards:{seed}",
        "seed": seed,
        "camera": {"model": "hyperbolic_mirror"},
        "robot": options.robot,
        "tour": {"rooms": "all", "light": "day"},
        "missions": [{"random": count, **entry} for count, entry in wanted if count > 0],
    }
    file = options.work / f"wards-{seed}.json"
    file.write_text(json.dumps(scenario))
    part = out.with_suffix(".part")
    command = [options.bin / "homeward", "simulate", "run", "--scenario", file, "--json"]
    with open(part, "w") as lines, open(options.work / f"wards-{seed}.log", "w") as log:
        done = subprocess.run([str(piece) for piece in command], stdout=lines, stderr=log)
    if done.returncode != 0:
        sys.exit(f"wards:{seed}: homeward simulate run ended with {done.returncode}, see wards-{seed}.log")
    part.rename(out)


def is_right(one):
    return one["arrived"] and one["final_error_m"] <= RIGHT_M


def is_false(one):
    return one["arrived"] and one["final_error_m"] > FALSE_M


def line(name, results):
    driven = [one for one in results if "kidnapped_at_s" not in one]
    carried = [one for one in results if "kidnapped_at_s" in one]
    right = [one for one in driven if is_right(one)]
    longer = [one["path_m"] / one["shortest_m"] for one in right if one["shortest_m"] > 1.0]
    told = [one["told_after_s"] for one in carried if one["told_after_s"] is not None]
    row = {
        "missions": len(driven),
        "within 0.3 m": len(right),
        "false": sum(map(is_false, driven)),
        "collisions": sum(one["collisions"] for one in results),
        "largest error": f"{max((one['final_error_m'] for one in driven if one['arrived']), default=0):.2f} m",
        "belief apart": f"{max((one['belief_apart_s'] for one in results), default=0):.1f} s",
        "way / shortest": f"{statistics.median(longer):.2f}" if longer else "",
        "carried off": len(carried),
        "told within 5 s": sum(after <= TOLD_S for after in told),
        "told never": len(carried) - len(told),
        "falsely arrived": sum(map(is_false, carried)),
    }
    holds = (
        len(right) >= 0.95 * len(driven)
        and not any(map(is_false, results))
        and row["collisions"] == 0
        and all(one["belief_apart_s"] <= APART_S for one in results)
        and row["told within 5 s"] == len(carried)
    )
    return {"world": name, **row}, holds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--seeds", type=int, nargs="+", required=True)
    parser.add_argument("--day", type=int, default=20)
    parser.add_argument("--night", type=int, default=5)
    parser.add_argument("--kidnapped", type=int, default=0)
    parser.add_argument("--robot", choices=["disc", "chair"], default="disc")
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        list(pool.map(lambda seed: drive(options, seed), options.seeds))
    every = []
    rows = []
    notes = []
    for seed in options.seeds:
        results = [json.loads(text) for text in (options.work / f"wards-{seed}.jsonl").read_text().splitlines()]
        every += results
        rows.append(line(f"wards:{seed}", results)[0])
        for number, one in enumerate(results, 1):
            if is_right(one):
                continue
            end = one["stops"][-1]["reason"]["code"] if one["stops"] and not one["arrived"] else "says that it arrived"
            notes.append(f"wards:{seed} {number}: {one['from']} to {one['to']}, {one['final_error_m']:.2f} m off: {end}")
    total, holds = line("all", every)
    print("| " + " | ".join(total) + " |\n|" + "---|" * len(total))
    for row in [*rows, total]:
        print("| " + " | ".join(map(str, row.values())) + " |")
    print("\n".join(["", *notes] if notes else []))
    return 0 if holds else 1


if __name__ == "__main__":
    sys.exit(main())
