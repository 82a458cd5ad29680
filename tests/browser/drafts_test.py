#!/usr/bin/env python3
"""Drafts of a map in a real browser against a pretended house. usage: drafts_test.py BIN_FOLDER WEB_FOLDER"""
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.exit(subprocess.run(["node", HERE / "drafts_test.mjs"], check=False).returncode)
