#!/usr/bin/env python3
"""A map of the real server is mended and inspected in a real browser. usage: mending_test.py BIN_FOLDER WEB_FOLDER [FOLDER FOR PICTURES]"""
import json
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "loop"))
import taught_house  # noqa: E402

PORT = 18501


def main():
    with tempfile.TemporaryDirectory(prefix="homeward-mending-") as folder:
        data = pathlib.Path(folder)
        taught_house.bring(data)
        with taught_house.served(sys.argv[1], sys.argv[2], data, PORT) as server:
            login = json.loads((data / "login.json").read_text())
            asked = ["--base", server.address, f"--name={login['name']}", f"--password={login['password']}",
                     *(f"--out={pictures}" for pictures in sys.argv[3:4])]
            ended = [subprocess.run(["node", HERE / test, *asked], check=False).returncode
                     for test in ("mending_test.mjs", "inspecting_test.mjs")]
        return max(ended)


if __name__ == "__main__":
    sys.exit(main())
