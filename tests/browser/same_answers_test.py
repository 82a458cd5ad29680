#!/usr/bin/env python3
"""What the pretended server refuses, and its words, beside the real one's. usage: same_answers_test.py BIN_FOLDER WEB_FOLDER"""
import pathlib
import subprocess
import sys

import taught_demo

HERE = pathlib.Path(__file__).resolve().parent
PORT = 18471


def main():
    with taught_demo.running(sys.argv[1], sys.argv[2], PORT) as (address, login, _):
        return subprocess.run(["node", HERE / "same_answers_test.mjs", "--base", address, f"--name={login['name']}",
                               f"--password={login['password']}"], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
