#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How well pictures are placed on a drawn plan that is out of date: tours of generated worlds, odometry with 5 % drift.

usage: plan_tracking.py HOMEWARD WORLD... [--runs N] [--light L] [--camera C] [--step-m M] [--people N] [--measure M] [--scans]
       [--anywhere] [--plan OTHER_WORLD] [--after-m M] [--pictures N] [--missing S] [--moved S] [--keep DIR]

For each WORLD (house:SEED, offices:SEED or a folder of pictures with poses.csv and camera.json and, after a comma, its
world.json) and each run: another drift of the odometry, another plan (20 % of the objects missing, 10 % moved), another seed
of the particles, another stretch of the tour. A row of Markdown for each world. Frames are counted from the 20th on, and what is said
of those without a pose again after --after-m metres alone.
"""
import argparse
import csv
import json
import math
import random
import shutil
import subprocess
import tempfile
from pathlib import Path


def wrap(angle):
    return math.atan2(math.sin(angle), math.cos(angle))


def quantile(values, share):
    values = sorted(values)
    return values[min(len(values) - 1, int(share * len(values)))] if values else float("nan")


def run(homeward, *arguments):
    done = subprocess.run([homeward, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{arguments}: {done.stderr}")
    return done.stdout


def drifted(poses, seed):
    """Odometry of these poses: 5 % too long or too short, a steady turn, and noise of each step."""
    chance = random.Random(seed)
    scale, turn_rad_per_m = 1.0 + chance.choice((-0.05, 0.05)), chance.gauss(0.0, 0.01)
    pose, rows = [0.0, 0.0, 0.0], [(0.0, 0.0, 0.0)]
    for (ax, ay, at), (bx, by, bt) in zip(poses, poses[1:]):
        along = math.cos(at) * (bx - ax) + math.sin(at) * (by - ay)
        across = math.cos(at) * (by - ay) - math.sin(at) * (bx - ax)
        length, turn = math.hypot(along, across), wrap(bt - at)
        along *= scale * (1.0 + chance.gauss(0.0, 0.05))
        across *= scale
        turn += turn_rad_per_m * length + chance.gauss(0.0, 0.05) * turn
        pose[0] += math.cos(pose[2]) * along - math.sin(pose[2]) * across
        pose[1] += math.sin(pose[2]) * along + math.cos(pose[2]) * across
        pose[2] = wrap(pose[2] + turn)
        rows.append(tuple(pose))
    return rows


def stretch(folder, out, first, count):
    """Some pictures of a folder as a folder of their own, and where they were taken."""
    with open(folder / "poses.csv") as file:
        rows = list(csv.DictReader(file))[first:first + count]
    out.mkdir()
    for row in rows:
        (out / row["filename"]).symlink_to((folder / row["filename"]).resolve())
    return [row["filename"] for row in rows], [tuple(float(row[k]) for k in ("x_m", "y_m", "theta_rad")) for row in rows]


def one_run(options, folder, world, number, work):
    tour = folder / "poses.csv"
    total = sum(1 for _ in open(tour)) - 1
    chance = random.Random(1000 * options.seed + number)
    first = chance.randrange(max(1, total - options.pictures)) if options.anywhere or total > options.pictures else 0
    images = work / f"run{number}"
    names, poses = stretch(folder, images, first, options.pictures)
    plan = work / f"plan{number}.wrl"
    run(options.homeward, "simulate", "plan", "--world", options.plan or world, "--out", plan, "--missing", options.missing,
        "--moved", options.moved, "--seed", 100 * options.seed + number)
    odometry = work / f"odometry{number}.csv"
    odometry.write_text("filename,x_m,y_m,theta_rad\n" + "".join(
        f"{name},{x:.5f},{y:.5f},{t:.6f}\n" for name, (x, y, t) in zip(names, drifted(poses, 7 * options.seed + number))))
    arguments = ["track", "--model", plan, "--camera", folder / "camera.json", "--images", images, "--odometry", odometry,
                 "--seed", number + 1, "--measure", options.measure, "--json"]
    if options.scans:
        arguments += ["--scans", folder / "scans.csv"]
    if not options.anywhere:
        arguments += ["--start", ",".join(f"{value:.4f}" for value in poses[0])]
    lines = [json.loads(line) for line in run(options.homeward, *arguments).splitlines()]
    return judged(lines, poses, options.after_m)


def judged(lines, poses, after_m):
    said = {"m": [], "deg": [], "ms": [], "lost": 0, "pictures": 0, "wrong": 0, "found_m": None, "reasons": {}, "late": 0, "late_reasons": {}}
    driven = 0.0
    for number, (line, pose) in enumerate(zip(lines, poses)):
        if number:
            driven += math.dist(pose[:2], poses[number - 1][:2])
        said["pictures"] += 1
        said["ms"].append(line["ms"])
        late = driven > after_m
        said["late"] += late
        if line["lost"]:
            said["lost"] += 1
            for reasons in [said["reasons"]] + [said["late_reasons"]] * late:
                reasons[line["why_lost"]] = reasons.get(line["why_lost"], 0) + 1
            continue
        off = math.dist((line["x_m"], line["y_m"]), pose[:2])
        if off > 0.5:
            said["wrong"] += 1
        elif said["found_m"] is None:
            said["found_m"] = driven
        if number >= 20:
            said["m"].append(off)
            said["deg"].append(abs(math.degrees(wrap(line["theta_rad"] - pose[2]))))
    return said


def row(name, runs):
    every = lambda key: [value for one in runs for value in one[key]]
    found = [one["found_m"] for one in runs if one["found_m"] is not None]
    pictures = sum(one["pictures"] for one in runs)
    added = lambda key: {why: sum(one[key].get(why, 0) for one in runs) for why in sorted({why for one in runs for why in one[key]})}
    return (f"| {name} | {len(runs)} | {quantile(every('m'), 0.5):.3f} | {quantile(every('m'), 0.95):.3f} | "
            f"{quantile(every('deg'), 0.5):.2f} | {quantile(every('deg'), 0.95):.2f} | "
            f"{sum(one['lost'] for one in runs) / pictures:.3f} | {sum(one['wrong'] for one in runs)} of {pictures} | "
            f"{sum(value <= 20.0 for value in found)} of {len(runs)} ({', '.join(f'{value:.0f}' for value in sorted(found))} m) | "
            f"{added('reasons')} | {added('late_reasons')} of {sum(one['late'] for one in runs)} | {quantile(every('ms'), 0.5):.0f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("homeward")
    parser.add_argument("worlds", nargs="+")
    parser.add_argument("--runs", type=int, default=10)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--light", default="day")
    parser.add_argument("--camera", default="hyperbolic_mirror")
    parser.add_argument("--step-m", type=float, default=0.3)
    parser.add_argument("--people", type=int, default=0)
    parser.add_argument("--pictures", type=int, default=120)
    parser.add_argument("--measure", default="count")
    parser.add_argument("--scans", action="store_true")
    parser.add_argument("--anywhere", action="store_true")
    parser.add_argument("--plan")
    parser.add_argument("--after-m", type=float, default=12.0)
    parser.add_argument("--missing", type=float, default=0.2)
    parser.add_argument("--moved", type=float, default=0.1)
    parser.add_argument("--keep", type=Path)
    options = parser.parse_args()
    print("| world | runs | m | m, 95 % | degrees | degrees, 95 % | lost | wrong by 0.5 m | found within 20 m | lost because | after --after-m | ms |",
          flush=True)
    for world in options.worlds:
        work = Path(tempfile.mkdtemp(prefix="homeward-plan-"))
        if "," in world:
            folder, source = map(Path, world.split(","))
        else:
            among = f".people_{options.people}" * (options.people > 0)
            source, folder = world, (options.keep or work) / f"{world.replace(':', '_')}.{options.camera}.{options.light}{among}"
            if not folder.exists():
                run(options.homeward, "simulate", "tour", "--world", world, "--rooms", "all", "--step-m", options.step_m, "--light",
                    options.light, "--camera", options.camera, "--people", options.people, "--seed", 17, "--out", folder)
        print(row(world, [one_run(options, folder, source, number, work) for number in range(options.runs)]), flush=True)
        shutil.rmtree(work)


if __name__ == "__main__":
    main()
