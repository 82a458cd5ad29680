#!/usr/bin/env python3
"""How soon a rider can press a destination on a slow device with a slow connection: headless Chromium, slowed down, on the
real server with the demo's house and its chair connected. Prints a JSON object: milliseconds from opening the address.

usage: go_usable.py BIN_FOLDER WEB_FOLDER [--slow-down 4] [--mbit 1.6] [--round-trip-ms 150]
"""
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "browser"))
import taught_demo  # noqa: E402

PORT = 18492


def main():
    with taught_demo.running(sys.argv[1], sys.argv[2], PORT) as (address, login, _):
        return subprocess.run(["node", HERE / "go_usable.mjs", "--base", address, f"--name={login['name']}",
                               f"--password={login['password']}", *sys.argv[3:]], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
