#!/usr/bin/env python3
"""What of a map to look at in a real browser against a pretended house. usage: evidence_test.py BIN_FOLDER WEB_FOLDER"""
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.exit(subprocess.run(["node", HERE / "evidence_test.mjs"], check=False).returncode)
