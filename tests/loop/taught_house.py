#!/usr/bin/env python3
"""The demo's house, taught once for all tests that drive through the whole of it: account, robot, tour and map, in the
folder that a server and the demo leave behind.

usage: taught_house.py BIN_FOLDER WEB_FOLDER OUT_FOLDER      makes it, anew
"""
import contextlib
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "deploy"))
import demo  # noqa: E402
from rest_client import Server  # noqa: E402

PORT = 18483


def bring(data):
    """Copies the taught house to a test's own folder. A test that is run by hand, without one, teaches by itself."""
    taught = os.environ.get("HOMEWARD_TAUGHT_HOUSE")
    if taught:
        shutil.copytree(taught, data, dirs_exist_ok=True)


@contextlib.contextmanager
def served(binaries, web, data, port):
    """A server of the taught house in `data`, which is taught first where it is not there, while it runs; no chair."""
    binaries = pathlib.Path(binaries)
    process = subprocess.Popen([binaries / "homeward-server", "--data", data / "server", "--listen",
                                f"127.0.0.1:{port}", "--web", web, "--print-setup-file", data / "setup-link"])
    try:
        server = Server(f"http://127.0.0.1:{port}")
        server.wait_until_up(process)
        demo.set_up_account(server, data)
        _, token_file = demo.robot_with_token(server, data)
        demo.teach(server, binaries, data, token_file)
        yield server
    finally:
        process.terminate()
        process.wait(timeout=30)


def main():
    binaries, web, out = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    with served(binaries, web, out, PORT):
        pass


if __name__ == "__main__":
    main()
