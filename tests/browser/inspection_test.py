#!/usr/bin/env python3
"""How a map was driven, came about and was built, in a real browser against a pretended house. usage: inspection_test.py
BIN_FOLDER WEB_FOLDER"""
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.exit(subprocess.run(["node", HERE / "inspection_test.mjs"], check=False).returncode)
