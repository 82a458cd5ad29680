#!/usr/bin/env python3
"""Kills the server over and over (SIGKILL, at a random moment) while pictures are uploaded, a map is edited and another
one is built, and counts what was acknowledged and is lost, and how long each start takes until it is ready.

usage: kills.py BIN_FOLDER [--kills 300] [--seed 1]
Prints one JSON object; exits with 1 where something is lost.
"""
import argparse
import hashlib
import http.client
import json
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "deploy"))
import demo  # noqa: E402
from rest_client import Failed, Server  # noqa: E402

PORT = 18479
GONE = (OSError, http.client.HTTPException, Failed)  # the server was killed meanwhile


class Kills:
    def __init__(self, binaries, data, seed):
        self.binaries, self.data = binaries, data
        self.random = random.Random(seed)
        self.server = Server(f"http://127.0.0.1:{PORT}")
        self.process = None
        self.ending = False
        self.pictures = {}  # (tour, number): SHA-256 of what was acknowledged
        self.edits = 0
        self.label = None
        self.revision = 0
        self.builds = 0
        self.ready_s = []
        self.start()
        while not (data / "setup-link").exists():
            time.sleep(0.01)
        demo.set_up_account(self.server, data)

    def start(self):
        began = time.monotonic()
        with open(self.data / "server.log", "ab") as log:
            self.process = subprocess.Popen([self.binaries / "homeward-server", "--data", self.data / "server", "--listen",
                                             f"127.0.0.1:{PORT}", "--print-setup-file", self.data / "setup-link"],
                                            stdout=log, stderr=subprocess.STDOUT)
        while True:
            if self.process.poll() is not None:
                sys.exit(f"the server did not start again: see {self.data / 'server.log'}")
            try:
                if self.server.send("GET", "/readyz")[0] == 200:
                    break
            except OSError:
                pass
            time.sleep(0.005)
        self.ready_s.append(time.monotonic() - began)

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()

    def caller(self):
        server = Server(self.server.address)
        server.cookie = self.server.cookie
        return server

    def upload(self, files, camera):
        server = self.caller()
        while not self.ending:
            try:
                tour = server.call("POST", "/api/v1/tours", {"name": "t", "camera": camera})["id"]
                for number, file in enumerate(files):
                    bytes_ = file.read_bytes()
                    status, _ = server.send("PUT", f"/api/v1/tours/{tour}/images/{number}", bytes_, "image/jpeg")
                    if status in (200, 201):
                        self.pictures[tour, number] = hashlib.sha256(bytes_).hexdigest()
            except GONE:
                time.sleep(0.01)

    def edit(self, map_id):
        server = self.caller()
        place = None
        while not self.ending:
            try:
                graph = server.call("GET", f"/api/v1/maps/{map_id}/graph")
                place = graph["places"][0]["id"]
                revision = graph["revision"]
                while not self.ending:
                    label = f"label {self.edits + 1}"
                    status, answer = server.send(
                        "POST", f"/api/v1/maps/{map_id}/edits",
                        json.dumps({"edits": [{"kind": "rename", "place": place, "label": label}]}).encode(),
                        "application/json", {"If-Match": f'"r{revision}"'})
                    if status != 200:
                        break
                    revision = answer["revision"]
                    self.edits, self.label, self.revision = self.edits + 1, label, revision
            except GONE:
                time.sleep(0.01)

    def build(self, map_id):
        server = self.caller()
        while not self.ending:
            try:
                job = server.call("POST", f"/api/v1/maps/{map_id}/builds", {"kind": "build"}, expect=(202, 409))
                while not self.ending and "job" in job:
                    state = server.call("GET", f"/api/v1/jobs/{job['job']['id']}")["state"]
                    if state not in ("queued", "running"):
                        self.builds += state == "done"
                        break
                    time.sleep(0.1)
            except GONE:
                pass
            time.sleep(0.05)

    def lost(self, map_id):
        """What was acknowledged and is not there, once nobody works any more."""
        missing = []
        for (tour, number), digest in self.pictures.items():
            file = self.data / "server" / "tours" / tour / f"{number}.jpg"
            known = file.exists() and hashlib.sha256(file.read_bytes()).hexdigest() == digest
            if not known:
                missing.append(f"{tour}/{number}")
        for tour in {tour for tour, _ in self.pictures}:
            count = sum(1 for one, _ in self.pictures if one == tour)
            if self.server.call("GET", f"/api/v1/tours/{tour}")["images"] < count:
                missing.append(f"{tour}: rows")
        graph = self.server.call("GET", f"/api/v1/maps/{map_id}/graph")
        if graph["revision"] < self.revision or not graph["places"][0]["label"].startswith("label"):
            missing.append(f"revision {self.revision}")
        if graph["revision"] == self.revision and graph["places"][0]["label"] != self.label:
            missing.append(self.label)
        return missing


def prepare(kills):
    """A built map to edit, and another to build. Gives the tour's pictures, its camera and the two maps' ids."""
    tour = kills.data / "tour"
    subprocess.run([kills.binaries / "homeward", "simulate", "tour", "--world", "house:1", "--rooms", "hall,kitchen",
                    "--seed", "3", "--out", tour], check=True, stdout=subprocess.DEVNULL)
    files = sorted(tour.glob("*.jpg"))
    camera = json.loads((tour / "camera.json").read_text())
    id_ = kills.server.call("POST", "/api/v1/tours", {"name": "house", "camera": camera})["id"]
    for number, file in enumerate(files):
        kills.server.send("PUT", f"/api/v1/tours/{id_}/images/{number}", file.read_bytes(), "image/jpeg")
    kills.server.call("POST", f"/api/v1/tours/{id_}/complete", {})
    maps = []
    for name in ("edited", "built"):
        made = kills.server.call("POST", "/api/v1/maps", {"name": name, "tours": [id_]})
        while kills.server.call("GET", f"/api/v1/jobs/{made['job']['id']}")["state"] in ("queued", "running"):
            time.sleep(0.2)
        maps.append(made["map"]["id"])
    return files, camera, maps


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binaries", type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="homeward-kills-") as folder:
        kills = Kills(arguments.binaries.resolve(), pathlib.Path(folder), arguments.seed)
        files, camera, (edited, built) = prepare(kills)
        kills.ready_s.clear()
        workers = [threading.Thread(target=kills.upload, args=(files, camera)),
                   threading.Thread(target=kills.edit, args=(edited,)), threading.Thread(target=kills.build, args=(built,))]
        for worker in workers:
            worker.start()
        for _ in range(arguments.kills):
            time.sleep(kills.random.uniform(0.05, 1.5))
            kills.kill()
            kills.start()
        kills.ending = True
        for worker in workers:
            worker.join()
        missing = kills.lost(edited)
        quarantine = kills.data / "server" / "quarantine"
        kills.kill()
        print(json.dumps({"kills": arguments.kills, "pictures": len(kills.pictures), "edits": kills.edits,
                          "builds": kills.builds, "lost": missing,
                          "ready_s": {"median": round(sorted(kills.ready_s)[len(kills.ready_s) // 2], 3),
                                      "largest": round(max(kills.ready_s), 3)},
                          "quarantined": sum(1 for file in quarantine.rglob("*") if file.is_file())}))
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
