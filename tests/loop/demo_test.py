#!/usr/bin/env python3
"""The demo, headless: server, tour over REST, map, simulated chair on the link, two missions that arrive.

usage: demo_test.py BIN_FOLDER WEB_FOLDER
"""
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]

with tempfile.TemporaryDirectory(prefix="homeward-demo-") as folder:
    sys.exit(subprocess.run([sys.executable, ROOT / "deploy" / "demo.py", "--headless", "--to", "kitchen,study",
                             "--port", "18471", "--data", folder,
                             "--bin", sys.argv[1], "--web", sys.argv[2]], check=False).returncode)
