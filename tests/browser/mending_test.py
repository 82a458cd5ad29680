#!/usr/bin/env python3
"""A map of the real server is mended and inspected in a real browser. usage: mending_test.py BIN_FOLDER WEB_FOLDER [FOLDER FOR PICTURES]"""
import pathlib
import subprocess
import sys

import taught_demo

HERE = pathlib.Path(__file__).resolve().parent
PORT = 18473


def main():
    with taught_demo.running(sys.argv[1], sys.argv[2], PORT) as (address, login, _):
        asked = ["--base", address, f"--name={login['name']}", f"--password={login['password']}",
                 *(f"--out={folder}" for folder in sys.argv[3:4])]
        ended = [subprocess.run(["node", HERE / test, *asked], check=False).returncode
                 for test in ("mending_test.mjs", "inspecting_test.mjs")]
        return max(ended)


if __name__ == "__main__":
    sys.exit(main())
