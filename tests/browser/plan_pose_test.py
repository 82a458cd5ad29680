#!/usr/bin/env python3
"""A real browser on a real server: the house's plan is uploaded and the map laid on it, the simulated chair drives, and
the page shows it on the plan where it is.

usage: plan_pose_test.py BIN_FOLDER WEB_FOLDER [SCREENSHOT_FOLDER]
"""
import json
import pathlib
import subprocess
import sys

import taught_demo

HERE = pathlib.Path(__file__).resolve().parent
PORT = 18521
WORLD = "house:1"  # of the demo


def pins(data):
    """Where the pictures of the demo's tour were taken, by its truth; an installer presses the plan there."""
    rows = (line.split(",") for line in (data / "tour" / "poses.csv").read_text().splitlines()[1:])
    return {row[0]: [float(field) for field in row[1:4]] for row in rows}


def main():
    with taught_demo.running(sys.argv[1], sys.argv[2], PORT) as (address, login, data):
        plan = data / "house.wrl"
        subprocess.run([pathlib.Path(sys.argv[1]) / "homeward", "simulate", "plan", "--world", WORLD, "--out", plan],
                       check=True, stdout=subprocess.DEVNULL)
        truth = data / "poses.json"
        truth.write_text(json.dumps(pins(data)))
        shots = sys.argv[3] if len(sys.argv) > 3 else str(data / "screenshots")
        return subprocess.run(["node", HERE / "plan_pose_test.mjs", "--base", address, f"--name={login['name']}",
                               f"--password={login['password']}", "--plan", plan, "--poses", truth, "--truth",
                               data / "truth.jsonl", "--destination", "kitchen", "--out", shots],
                              check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
