#!/usr/bin/env python3
"""Changing a map in a real browser against a pretended house. usage: map_edits_test.py BIN_FOLDER WEB_FOLDER"""
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.exit(subprocess.run(["node", HERE / "map_edits_test.mjs"], check=False).returncode)
