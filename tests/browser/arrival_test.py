#!/usr/bin/env python3
"""A real browser on a real server: click a room, watch the simulated chair arrive there.

usage: arrival_test.py BIN_FOLDER WEB_FOLDER [SCREENSHOT_FOLDER]
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "loop"))
import taught_house  # noqa: E402

PORT = 18472


def main():
    with tempfile.TemporaryDirectory(prefix="homeward-arrival-") as folder:
        data = pathlib.Path(folder)
        taught_house.bring(data)
        shots = sys.argv[3] if len(sys.argv) > 3 else str(data / "screenshots")
        demo = subprocess.Popen([sys.executable, HERE.parents[1] / "deploy" / "demo.py", "--port", str(PORT), "--data", data,
                                 "--bin", sys.argv[1], "--web", sys.argv[2]], stdout=subprocess.PIPE, text=True)
        try:
            for line in demo.stdout:
                print(line, end="", flush=True)
                if line.strip().startswith("password"):
                    break
            else:
                print("the demo ended before it was ready", file=sys.stderr)
                return 1
            login = json.loads((data / "login.json").read_text())
            time.sleep(2)
            return subprocess.run(["node", HERE / "arrival_test.mjs", "--base", f"http://127.0.0.1:{PORT}",
                                   f"--name={login['name']}", f"--password={login['password']}", "--destination", "kitchen",
                                   "--out", shots], check=False).returncode
        finally:
            demo.terminate()
            demo.wait(timeout=30)


if __name__ == "__main__":
    sys.exit(main())
