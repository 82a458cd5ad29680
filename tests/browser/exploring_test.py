#!/usr/bin/env python3
"""A robot that maps a building by itself, in a real browser, pretended. usage: exploring_test.py BIN_FOLDER WEB_FOLDER"""
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.exit(subprocess.run(["node", HERE / "exploring_test.mjs"], check=False).returncode)
