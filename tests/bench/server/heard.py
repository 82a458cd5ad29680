#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How soon one person hears of another's edits: from when an edit of a map, or of a draft of it, is acknowledged until the
event of it has come in on the other's WebSocket (less than nothing where it comes first), and from when it was sent.

usage: heard.py BIN_FOLDER --map FILE [--edits 50]
FILE: a map, such as `homeward map build` makes. Prints one JSON object, in milliseconds.
"""
import argparse
import base64
import json
import os
import pathlib
import queue
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "deploy"))
import demo  # noqa: E402
from rest_client import Server  # noqa: E402

PORT = 18477
PASSWORD = "only for this measure"
LIMIT_S = 10.0


class Events:
    """The other's event socket; each message with the time at which it was there whole."""

    def __init__(self, cookie):
        self.heard = queue.Queue()
        self.socket = socket.create_connection(("127.0.0.1", PORT))
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET /api/v1/events HTTP/1.1\r\nHost: 127.0.0.1:{PORT}\r\nUpgrade: websocket\r\n"
                             f"Connection: Upgrade\r\nSec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n"
                             f"Origin: http://127.0.0.1:{PORT}\r\nCookie: {cookie}\r\n\r\n").encode())
        self.stream = self.socket.makefile("rb")
        status = self.stream.readline()
        if b" 101 " not in status:
            sys.exit(f"the socket is refused: {status}")
        while self.stream.readline() not in (b"\r\n", b""):
            pass
        threading.Thread(target=self.listen, daemon=True).start()

    def listen(self):
        text = b""
        while True:
            begin = self.stream.read(2)
            if len(begin) < 2:
                return
            size = begin[1] & 127
            if size > 125:
                size = struct.unpack(">H" if size == 126 else ">Q", self.stream.read(2 if size == 126 else 8))[0]
            part, kind = self.stream.read(size), begin[0] & 15
            if kind == 9:  # a ping is answered; what a client sends is masked
                self.socket.sendall(bytes([0x8A, 0x80 | size]) + bytes(4) + part)
            if kind in (0, 1):
                text += part
            if kind in (0, 1) and begin[0] & 128:
                now = time.monotonic()
                self.heard.put((now, json.loads(text)))
                text = b""

    def wait_for(self, fits):
        end = time.monotonic() + LIMIT_S
        while True:
            at, message = self.heard.get(timeout=max(0.001, end - time.monotonic()))
            if fits(message):
                return at


def caller(address, name, password):
    server = Server(address)
    server.call("POST", "/api/v1/login", {"name": name, "password": password})
    return server


def change(server, path, edit, tag):
    """When it was sent, when it was acknowledged, and the answer."""
    body = json.dumps({"edits": [edit]}).encode()
    sent = time.monotonic()
    status, answer = server.send("POST", path, body, "application/json", {"If-Match": f'"{tag}"'})
    if status != 200:
        sys.exit(f"{edit} is refused with {status}: {answer}")
    return sent, time.monotonic(), answer


def of_map(server, events, path, map_id, number):
    graph = server.call("GET", f"{path}/graph")
    place = graph["places"][number % len(graph["places"])]["id"]
    edit = {"kind": "rename", "place": place, "label": f"name {number}"}
    sent, told, answer = change(server, f"{path}/edits", edit, f"r{graph['revision']}")
    heard = events.wait_for(lambda one: one["type"] == "map" and one["map"]["id"] == map_id and
                            one["map"]["revision"] == answer["revision"])
    return sent, told, heard


def of_draft(server, events, path, draft, number):
    graph = server.call("GET", f"{path}/drafts/{draft['id']}/graph")
    edge = graph["edges"][number % len(graph["edges"])]
    edit = {"kind": "block_edge", "from": edge["from"], "to": edge["to"], "blocked": not edge["blocked"]}
    sent, told, answer = change(server, f"{path}/drafts/{draft['id']}/edits", edit, f"d{draft['version']}")
    draft["version"] = answer["version"]
    heard = events.wait_for(lambda one: one["type"] == "draft" and one["draft"]["id"] == draft["id"] and
                            one["draft"]["version"] == answer["version"])
    return sent, told, heard


def summary(times):
    """Median and worst, of what was acknowledged and of what was sent."""
    both = {"after_acknowledged_ms": [heard - told for _, told, heard in times],
            "after_sent_ms": [heard - sent for sent, _, heard in times]}
    return {name: {"median": round(1000 * sorted(one)[len(one) // 2], 1), "worst": round(1000 * max(one), 1)}
            for name, one in both.items()}


def measure(server, data, arguments):
    demo.set_up_account(server, data)
    server.call("POST", "/api/v1/users", {"name": "other", "password": PASSWORD, "role": "installer"})
    one, other = server, caller(server.address, "other", PASSWORD)
    status, made = one.send("POST", "/api/v1/maps/import?name=map", arguments.map.read_bytes(), "application/vnd.sqlite3")
    if status != 201:
        sys.exit(f"the map is not imported: {status} {made}")
    map_id, events = made["map"]["id"], Events(other.cookie)
    path = f"/api/v1/maps/{map_id}"
    edits = [of_map(one, events, path, map_id, number) for number in range(arguments.edits)]
    draft = one.call("POST", f"{path}/drafts", {"name": "draft"})
    drafted = [of_draft(one, events, path, draft, number) for number in range(arguments.edits)]
    return {"places": made["map"]["places"], "edits": arguments.edits, "map": summary(edits), "draft": summary(drafted)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binaries", type=pathlib.Path)
    parser.add_argument("--map", type=pathlib.Path, required=True)
    parser.add_argument("--edits", type=int, default=50)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="homeward-heard-") as folder:
        data = pathlib.Path(folder)
        process = subprocess.Popen([arguments.binaries / "homeward-server", "--data", data / "server", "--listen",
                                    f"127.0.0.1:{PORT}", "--print-setup-file", data / "setup-link"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            server = Server(f"http://127.0.0.1:{PORT}")
            server.wait_until_up(process)
            print(json.dumps(measure(server, data, arguments)))
        finally:
            process.kill()
            process.wait()


if __name__ == "__main__":
    main()
