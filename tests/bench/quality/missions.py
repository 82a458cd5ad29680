#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Missions at random after one taught tour, by what was in their way.

usage: missions.py --work DIR [--home WORLD.json] [--only CASE ...] [--count N] [--seed N] [--record] [--bin DIR]

Cases, each so many missions between rooms drawn at random after a tour of all rooms by day:
  house, house-night, house-people, house-moved
              the generated house house:1: by day; at night; with three people who walk about; with one piece of furniture
              moved in every room
  house-chair, house-chair-night, house-chair-people, house-chair-moved
              the same with a wheelchair of 1.10 m x 0.65 m
  narrow, narrow-chair
              by day in narrow_house:1, whose doors are 0.85 m wide
  home, home-night, home-people
              the same in the world --home (a world.json)
  offices, offices-night
              by day and at night between the eight offices of offices:1, which look alike
  house-explored, offices-explored, home-explored
              by day over a map that the robot has made by itself, in house:SEED, offices:SEED and --home; only with --only
Two at once, each through `homeward simulate run`; results stay in DIR as one file of JSON lines a case, and a case that is
there already is only counted: delete its file to drive it again. --record keeps a recording of each mission beside it.
A mission counts as right when it arrived within 0.3 m of its destination's true pose. Prints one table, names the missions
that are not right and ends with 1 when a bound does not hold: of 100 by day at least 98, of 30 at night 27, with people 28,
with moved furniture, narrow doors or offices 27, after an exploration 96 %, and no collision in any.
"""

import argparse
import concurrent.futures
import json
import pathlib
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
HOUSE = ["hall", "living_room", "kitchen", "dining_room", "bedroom", "bathroom", "study", "guest_room", "music_room", "hall"]
CASES = {  # missions, share that must be right, what their entry in the scenario says
    "house": (100, 0.98, {}),
    "house-night": (30, 0.9, {"light": "night"}),
    "house-people": (30, 28 / 30, {"people": 3}),
    "house-moved": (30, 0.9, {"moved_furniture": 1}),
    "house-chair": (100, 0.98, {}),
    "house-chair-night": (30, 0.9, {"light": "night"}),
    "house-chair-people": (30, 28 / 30, {"people": 3}),
    "house-chair-moved": (30, 0.9, {"moved_furniture": 1}),
    "narrow": (30, 0.9, {}),
    "narrow-chair": (30, 0.9, {}),
    "home": (100, 0.98, {}),
    "home-night": (30, 0.9, {"light": "night"}),
    "home-people": (30, 28 / 30, {"people": 3}),
    "offices": (30, 0.9, {}),
    "offices-night": (30, 0.9, {"light": "night"}),
    "house-explored": (50, 0.96, {}),
    "offices-explored": (50, 0.96, {}),
    "home-explored": (50, 0.96, {}),
}
GENERATED = {"house": "house:1", "narrow": "narrow_house:1", "offices": "offices:1"}
EXPLORED = "-explored"


def rooms_of(world):
    """All rooms, each after the one nearest to it, and back to the first."""
    rooms = json.loads(world.read_text())["rooms"]
    if isinstance(rooms, str):
        rooms = json.loads((world.parent / rooms).read_text())
    points = {room["name"]: (room["x_m"], room["y_m"]) for room in rooms}
    tour = [next(iter(points))]
    while len(tour) < len(points):
        x, y = points[tour[-1]]
        left = [name for name in points if name not in tour]
        tour.append(min(left, key=lambda name: (points[name][0] - x) ** 2 + (points[name][1] - y) ** 2))
    return [*tour, tour[0]]


def drive(options, case):
    out = options.work / f"{case}.jsonl"
    if out.is_file():
        return
    count, _, entry = CASES[case]
    kind = case.split("-")[0]
    world = GENERATED.get(kind)
    rooms = "all" if world == "offices:1" else HOUSE if world else rooms_of(options.home)
    if case.endswith(EXPLORED):
        world, rooms = f"{kind}:{options.seed}" if world else None, "explored"
    scenario = {
        "format": "homeward-scenario",
        "version": 1,
        "world": world or str(options.home.resolve()),
        "seed": options.seed,
        "camera": {"model": "hyperbolic_mirror"},
        "robot": "chair" if "-chair" in case else "disc",
        "tour": {"rooms": rooms, "light": "day"},
        "missions": [{"random": options.count or count, **entry}],
    }
    file = options.work / f"{case}.json"
    file.write_text(json.dumps(scenario))
    command = [options.bin / "homeward", "simulate", "run", "--scenario", file, "--json"]
    if options.record:
        command += ["--record", options.work / f"{case}-recordings"]
    part = out.with_suffix(".part")
    with open(part, "w") as lines, open(options.work / f"{case}.log", "w") as log:
        done = subprocess.run([str(piece) for piece in command], stdout=lines, stderr=log)
    if done.returncode != 0:
        sys.exit(f"{case}: homeward simulate run ended with {done.returncode}, see {case}.log")
    part.rename(out)


def figures_of(case, results):
    count, share, _ = CASES[case]
    right = [one for one in results if one["arrived"] and one["final_error_m"] <= 0.3]
    errors = sorted(one["final_error_m"] for one in results if one["arrived"])
    turns = sorted(one["final_error_rad"] * 57.29578 for one in results if one["arrived"])
    collisions = sum(one["collisions"] for one in results)
    longer = [one["path_m"] / one["shortest_m"] for one in right if one["shortest_m"] > 1.0]
    figures = {
        "right": f"{len(right)} of {len(results)}",
        "median error": f"{statistics.median(errors):.3f} m" if errors else "",
        "largest": f"{errors[-1]:.3f} m" if errors else "",
        "heading": f"{statistics.median(turns):.1f}, at most {turns[-1]:.1f} deg" if turns else "",
        "collisions": str(collisions),
        "nearest to anything": f"{min(one['min_clearance_m'] for one in results):.3f} m",
        "way / shortest": f"{statistics.median(longer):.2f}" if longer else "",
        "found again": str(sum(one.get("detours", 0) for one in results)),
        "vectors a second": f"{statistics.median(one['vectors_per_s'] for one in results):.1f}",
    }
    wrong = [one for one in results if one not in right]
    return figures, wrong, len(right) >= share * len(results) - 1e-9 and collisions == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--home", type=pathlib.Path)
    parser.add_argument("--only", nargs="+", choices=sorted(CASES))
    parser.add_argument("--count", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--record", action="store_true")
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    cases = options.only or [case for case in CASES
                             if not case.endswith(EXPLORED) and (options.home or not case.startswith("home"))]
    if any(case.startswith("home") for case in cases) and not options.home:
        parser.error("--home: a world.json is needed for these cases")
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        list(pool.map(lambda case: drive(options, case), cases))
    holds = True
    notes = []
    for number, case in enumerate(cases):
        results = [json.loads(line) for line in (options.work / f"{case}.jsonl").read_text().splitlines()]
        figures, wrong, held = figures_of(case, results)
        holds = holds and held
        if number == 0:
            print("| missions | " + " | ".join(figures) + " |\n|" + "---|" * (len(figures) + 1))
        print(f"| {case} | " + " | ".join(figures.values()) + " |", flush=True)
        for one in wrong:
            stop = one["stops"][-1]["reason"]["code"] if one["stops"] else "says that it arrived"
            notes.append(f"{case}: {one['from']} to {one['to']}, {one['final_error_m']:.2f} m off: {stop}")
        for one in results:
            if one["collisions"]:
                notes.append(f"{case}: {one['from']} to {one['to']}: {one['collisions']} collisions")
    print("\n".join(["", *notes] if notes else []))
    return 0 if holds else 1


if __name__ == "__main__":
    sys.exit(main())
