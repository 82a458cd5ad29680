#!/usr/bin/env python3
"""A real browser on a real server: click a room, watch the simulated chair arrive there.

usage: arrival_test.py BIN_FOLDER WEB_FOLDER [SCREENSHOT_FOLDER]
"""
import pathlib
import subprocess
import sys

import taught_demo

HERE = pathlib.Path(__file__).resolve().parent
PORT = 18472


def main():
    with taught_demo.running(sys.argv[1], sys.argv[2], PORT) as (address, login, data):
        shots = sys.argv[3] if len(sys.argv) > 3 else str(data / "screenshots")
        return subprocess.run(["node", HERE / "arrival_test.mjs", "--base", address, f"--name={login['name']}",
                               f"--password={login['password']}", "--destination", "kitchen", "--out", shots],
                              check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
