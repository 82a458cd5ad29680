#!/usr/bin/env python3
"""The dashboard in a real browser against a pretended house. usage: mock_test.py BIN_FOLDER WEB_FOLDER"""
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.exit(subprocess.run(["node", HERE / "mock_test.mjs"], check=False).returncode)
