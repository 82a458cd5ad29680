#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Harmful and harmless drafts of a map's edits, and what `homeward map check` says of each.

usage: replay_check.py --work DIR --worlds WORLD... [--harmful N] [--harmless N] [--draw SEED] [--bin DIR] [--json FILE]
                       [--pictures-alone]

For each world (house:7, wards:7, ...) one tour of rooms drawn by the world's seed, its map with a destination in each of
these rooms, and N drafts of each sort, drawn by seed under the tour's true poses, rooms and sweeps
(drafts.py), which neither the map nor the check reads. A harmful draft is told where exit code 4 comes with at least one
spot of those that the draft harms; a harmless one is blamed where the check is not silent. Tours, maps, drafts and answers
stay in DIR: what is there is not made again, so delete a world's `checks` to ask another program. --pictures-alone: the
check gets the tour without its sweeps.
Prints a line a world and sort, the drafts that were judged wrongly, and how long checks took; ends with 1 when a bound does
not hold: every harmful draft told, at most one harmless draft of twenty blamed, at most 30 s for 300 pictures.
"""

import argparse
import json
import pathlib
import random
import resource
import shutil
import subprocess
import sys
import tempfile
import time

import drafts

ROOT = pathlib.Path(__file__).resolve().parents[3]
BLAMED_AT_MOST = 0.05
SECONDS_PER_PICTURE = 0.1
CONFLICT = 4
ROOMS = {"wards": 3}  # far apart: some 200 pictures, as for
SOME_ROOMS = 6


def run(*command, right=(0,)):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode not in right:
        raise RuntimeError(f"{' '.join(str(part) for part in command)}: {done.stderr.strip() or done.stdout.strip()}")
    return done


def processor_s():
    """Of all programs that were run and have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Case:
    """A world's tour and map in a folder of their own."""

    def __init__(self, options, world):
        self.homeward = options.bin / "homeward"
        self.world = world
        self.folder = options.work / world.replace(":", "_")
        self.tour, self.map = self.folder / "tour", self.folder / "before.map"
        self.alone = self.folder / "alone" / "tour" if options.pictures_alone else None

    def rooms(self):
        """Some rooms at random, the last one the first again."""
        kind, seed = self.world.split(":")
        with tempfile.TemporaryDirectory() as scratch:  # what it refuses names the rooms
            refused = run(self.homeward, "simulate", "tour", "--world", self.world, "--rooms", "nowhere,nowhere", "--out", f"{scratch}/none",
                          right=range(1, 256))
        names = refused.stderr.split("its rooms are ")[1].split(".")[0].split(", ")
        rooms = random.Random(int(seed)).sample(names, ROOMS.get(kind, SOME_ROOMS))
        return ",".join([*rooms, rooms[0]])

    def make(self):
        self.folder.mkdir(parents=True, exist_ok=True)
        if not self.tour.is_dir():
            seed = self.world.split(":")[1]
            part = self.folder / "part"  # so that a tour that was cut short is made again
            shutil.rmtree(part, ignore_errors=True)
            run(self.homeward, "simulate", "tour", "--world", self.world, "--seed", seed, "--rooms", self.rooms(), "--marks", "--out", part)
            part.rename(self.tour)
        if not self.map.is_file():
            run(self.homeward, "map", "build", "--tour", self.tour, "--camera", self.tour / "camera.json", "--out", self.map)
        if self.alone and not self.alone.is_dir():
            self.alone.mkdir(parents=True)
            for file in self.tour.iterdir():
                if file.name != "scans.csv":
                    (self.alone / file.name).symlink_to(file.resolve())

    def truth(self):
        return drafts.Truth(self.tour, json.loads(run(self.homeward, "map", "export", self.map, "--format", "json").stdout))

    def checked(self, draft, name):
        """The check's answer to a draft, and the seconds that it took."""
        answers = self.folder / ("checks_alone" if self.alone else "checks")
        answers.mkdir(exist_ok=True)
        answer = answers / f"{name}.json"
        if answer.is_file() and json.loads(answer.read_text())["draft"] == json.loads(json.dumps(draft)):
            return json.loads(answer.read_text())
        edits, after = answers / f"{name}.edits", answers / f"{name}.map"
        edits.write_text(json.dumps({"edits": draft["edits"]}))
        run(self.homeward, "map", "edit", "--map", self.map, "--edits", edits, "--tour", self.tour, "--out", after)
        begin, used_s = time.monotonic(), processor_s()
        done = run(self.homeward, "map", "check", "--map", after, "--before", self.map, "--tour", self.alone or self.tour, "--json", right=(0, CONFLICT))
        found = json.loads(done.stdout)
        result = {"draft": draft, "seconds": time.monotonic() - begin, "processor_s": processor_s() - used_s, "exit": done.returncode, **found}
        after.unlink()
        answer.write_text(json.dumps(result, indent=1))
        return result


def judged(case, sort, draft, name):
    found = case.checked(draft, name)
    told = found["exit"] == CONFLICT and bool(found["worse"])
    at_the_spot = [drafts.is_spot(draft, worse) for worse in found["worse"]]
    return {
        "world": case.world, "sort": sort, "name": name, "kind": draft["kind"], "why": draft["why"],
        "told": told, "right_spot": any(at_the_spot), "elsewhere": at_the_spot.count(False),
        "said": [f"{worse['kind']}: {worse['words']}" for worse in found["worse"]],
        "seconds": found["seconds"], "processor_s": found["processor_s"], "pictures": found["pictures"],
        "right": told and any(at_the_spot) if sort == "harmful" else not told,
    }


def tabulate(rows):
    print(f"{'world':18} {'sort':9} {'drafts':>6} {'right':>6}  by kind")
    for world in [*dict.fromkeys(row["world"] for row in rows), "all"]:
        for sort in ("harmful", "harmless"):
            some = [row for row in rows if row["sort"] == sort and world in (row["world"], "all")]
            kinds = {kind: [row["right"] for row in some if row["kind"] == kind] for kind in sorted({row["kind"] for row in some})}
            by_kind = ", ".join(f"{kind} {sum(right)}/{len(right)}" for kind, right in kinds.items())
            print(f"{world:18} {sort:9} {len(some):6} {sum(row['right'] for row in some):6}  {by_kind}")
    for row in rows:
        if not row["right"]:
            print(f"\n{row['world']} {row['name']}, {row['sort']} {row['kind']}: {row['why']}\n  " + ("\n  ".join(row["said"]) or "nothing told"))


def holds(rows):
    harmful = [row for row in rows if row["sort"] == "harmful"]
    harmless = [row for row in rows if row["sort"] == "harmless"]
    blamed = sum(not row["right"] for row in harmless)
    slowest = max(rows, key=lambda row: row["seconds"] / row["pictures"])
    print(f"\nharmful told at their spot: {sum(row['right'] for row in harmful)} of {len(harmful)}")
    print(f"harmless blamed: {blamed} of {len(harmless)}")
    print(f"slowest check: {slowest['seconds']:.1f} s for {slowest['pictures']} pictures, {slowest['processor_s']:.1f} s of the processor")
    return (all(row["right"] for row in harmful) and blamed <= BLAMED_AT_MOST * len(harmless)
            and slowest["seconds"] <= SECONDS_PER_PICTURE * slowest["pictures"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--worlds", nargs="+", required=True)
    parser.add_argument("--harmful", type=int, default=5, help="drafts of a world")
    parser.add_argument("--harmless", type=int, default=5)
    parser.add_argument("--draw", type=int, default=1, help="seed of the drafts")
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build" / "release" / "bin")
    parser.add_argument("--pictures-alone", action="store_true", help="without the tour's sweeps")
    parser.add_argument("--json", type=pathlib.Path, help="every draft and what was said of it")
    options = parser.parse_args()
    rows = []
    for world in options.worlds:
        case = Case(options, world)
        case.make()
        truth = case.truth()
        for sort, count in (("harmful", options.harmful), ("harmless", options.harmless)):
            drawn = drafts.draw(truth, sort, count, f"{world} {sort} {options.draw}")
            for number, draft in enumerate(drawn):
                rows.append(judged(case, sort, draft, f"{sort}-{options.draw}-{number}"))
                print(f"\r{world} {sort} {number + 1} of {count}   ", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    tabulate(rows)
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1) + "\n")
    sys.exit(0 if holds(rows) else 1)


if __name__ == "__main__":
    main()
