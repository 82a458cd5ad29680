#!/usr/bin/env python3
"""A real browser on a real server that freezes: how soon the dashboard says so, and a STOP that nobody hears.

usage: silence_test.py BIN_FOLDER WEB_FOLDER [SCREENSHOT_FOLDER]
"""
import pathlib
import signal
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "deploy"))
import demo  # noqa: E402
from rest_client import Server  # noqa: E402

PORT = 18484


def main():
    with tempfile.TemporaryDirectory(prefix="homeward-silence-") as folder:
        data = pathlib.Path(folder)
        shots = sys.argv[3] if len(sys.argv) > 3 else str(data / "screenshots")
        process = subprocess.Popen([pathlib.Path(sys.argv[1]) / "homeward-server", "--data", data / "server", "--listen",
                                    f"127.0.0.1:{PORT}", "--web", sys.argv[2], "--print-setup-file", data / "setup-link"])
        try:
            server = Server(f"http://127.0.0.1:{PORT}")
            server.wait_until_up(process)
            login = demo.set_up_account(server, data)
            server.call("POST", "/api/v1/robots", {"name": "Chair"})
            return subprocess.run(["node", HERE / "silence_test.mjs", "--base", server.address, f"--name={login['name']}",
                                   f"--password={login['password']}", "--pid", str(process.pid), "--out", shots],
                                  check=False).returncode
        finally:
            process.send_signal(signal.SIGCONT)
            process.terminate()
            process.wait(timeout=30)


if __name__ == "__main__":
    sys.exit(main())
