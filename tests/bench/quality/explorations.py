#!/usr/bin/env python3
"""How well does a robot explore? One line of a table for each run of `homeward explore`, and what holds of all of them.

usage: explorations.py --homeward BIN --work DIR --world NAME:FIRST [--seeds N] [--shut-doors SHARE] [--robot disc|chair]
  --world   a generated world's kind and the first seed ("house:2201": house:2201, house:2202, ...), or a world.json, as
            PATH:FIRST, explored with the seeds from FIRST on; may be given more than once
Folders of runs in DIR that are complete already are not driven again.
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys

SUMMED = ("wrong_edges", "mixed_places", "collisions")


def runs_of(world, seeds):
    name, first = world.rsplit(":", 1)
    for seed in range(int(first), int(first) + seeds):
        yield (name if name.endswith(".json") else f"{name}:{seed}"), seed


def drive(options, world, seed):
    folder = options.work / f"{pathlib.Path(world).stem.replace(':', '_')}-{seed}-{options.robot}-{options.shut_doors}"
    said = folder / "result.json"
    if not said.exists():
        shutil.rmtree(folder, ignore_errors=True)
        shut = ["--shut-doors", str(options.shut_doors)] if options.shut_doors else []
        done = subprocess.run([options.homeward, "explore", "--world", world, "--seed", str(seed), "--robot", options.robot, "--out",
                               folder, "--json", *shut], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{world} seed {seed}: {done.stderr}")
        said.write_text(done.stdout)
    return json.loads(said.read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--homeward", required=True)
    parser.add_argument("--work", required=True, type=pathlib.Path)
    parser.add_argument("--world", required=True, action="append")
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--shut-doors", type=float, default=0.0)
    parser.add_argument("--robot", default="disc", choices=("disc", "chair"))
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    print("| world, seed | ended | covered | driven, known plan, m | ratio | s | places, edges | wrong edges, mixed places, collisions | step ms |")
    print("|---|---|---|---|---|---|---|---|---|")
    rows = []
    for world in options.world:
        for name, seed in runs_of(world, options.seeds):
            row = drive(options, name, seed)
            rows.append(row)
            print(f"| {pathlib.Path(name).name} {seed} | {row['ended']} | {row['covered']:.3f} | {row['driven_m']:.0f}, {row['known_plan_m']:.0f} | "
                  f"{row['driven_m'] / row['known_plan_m']:.2f} | {row['duration_s']:.0f} | {row['nodes']}, {row['edges']} | "
                  f"{', '.join(str(row[key]) for key in SUMMED)} | {row['step_ms_p50']:.0f}, {row['step_ms_max']:.0f} |", flush=True)
    ratios = [row["driven_m"] / row["known_plan_m"] for row in rows]
    print(json.dumps({"runs": len(rows), "complete": sum(row["ended"] == "complete" for row in rows),
                      "covered_least": min(row["covered"] for row in rows), "ratio_most": max(ratios),
                      "ratio_mean": sum(ratios) / len(ratios), **{key: sum(row[key] for row in rows) for key in SUMMED},
                      "step_ms_max": max(row["step_ms_max"] for row in rows)}))


if __name__ == "__main__":
    main()
