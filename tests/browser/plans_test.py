#!/usr/bin/env python3
"""Floor plans under a map, in a real browser against a pretended house. usage: plans_test.py BIN_FOLDER WEB_FOLDER"""
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.exit(subprocess.run(["node", HERE / "plans_test.mjs"], check=False).returncode)
