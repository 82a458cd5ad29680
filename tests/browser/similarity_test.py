#!/usr/bin/env python3
"""How alike the pictures of a map are, in a real browser against a pretended house. usage: similarity_test.py BIN_FOLDER
WEB_FOLDER"""
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.exit(subprocess.run(["node", HERE / "similarity_test.mjs"], check=False).returncode)
