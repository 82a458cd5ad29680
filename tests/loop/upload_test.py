#!/usr/bin/env python3
"""Tours from the robot's folder over the server to a map: what cannot be read is named, and sweeps come along.

usage: upload_test.py BIN_FOLDER WEB_FOLDER
"""
import json
import pathlib
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "deploy"))
from rest_client import Server, setup_token  # noqa: E402

BIN = pathlib.Path(sys.argv[1]).resolve()
WEB = pathlib.Path(sys.argv[2]).resolve()
PORT = 18474


class Upload(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="homeward-upload-")
        self.addCleanup(folder.cleanup)
        self.data = pathlib.Path(folder.name)
        self.tour = self.data / "tour"
        self.server = Server(f"http://127.0.0.1:{PORT}")
        with open(self.data / "server.log", "ab") as log:
            process = subprocess.Popen([BIN / "homeward-server", "--data", self.data / "server", "--listen", f"127.0.0.1:{PORT}",
                                        "--web", WEB, "--print-setup-file", self.data / "setup-link"],
                                       stdout=log, stderr=subprocess.STDOUT)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.server.wait_until_up(process)
        token = setup_token(self.data / "setup-link")
        login = {"name": "anna", "password": "correct horse battery"}
        self.server.call("POST", "/api/v1/setup", {"token": token, **login})
        self.server.call("POST", "/api/v1/login", login)
        self.token = self.data / "token"
        self.token.touch(mode=0o600)
        self.token.write_text(self.server.call("POST", "/api/v1/robots", {"name": "Chair"})["token"])

    def teach(self, world, rooms, step_m):
        subprocess.run([BIN / "homeward", "simulate", "tour", "--world", world, "--rooms", rooms, "--step-m", str(step_m), "--marks",
                        "--camera", "equirectangular", "--out", self.tour], check=True, stdout=subprocess.DEVNULL)

    def build(self, name, tour):
        job = self.server.call("POST", "/api/v1/maps", {"name": name, "tours": [tour]})["job"]
        while job["state"] in ("queued", "running"):
            time.sleep(0.2)
            job = self.server.call("GET", f"/api/v1/jobs/{job['id']}")
        return job

    def upload(self, name):
        return subprocess.run([BIN / "homeward-agent", "upload", "--server", self.server.address, "--token-file", self.token,
                               "--tour", self.tour, "--name", name], capture_output=True, text=True, timeout=120)

    def test_the_rest_is_used(self):
        self.teach("offices:1", "corridor,office_1", 1)
        pictures = sorted(self.tour.glob("*.jpg"))
        lost = json.loads((self.tour / "tour.json").read_text())["marks"][0]
        broken = [self.tour / lost["image"], pictures[4], pictures[7]]
        broken[0].write_bytes(b"")
        broken[1].write_text("This is no picture.")
        broken[2].write_bytes(broken[2].read_bytes()[:2000])
        done = self.upload("damaged")
        self.assertEqual(done.returncode, 0, done.stderr)
        for picture in broken:
            self.assertIn(picture.name, done.stderr)
        self.assertIn(f'destination "{lost["label"]}"', done.stderr)
        tour = done.stdout.strip()
        left = len(pictures) - len(set(broken))
        self.assertEqual(self.server.call("GET", f"/api/v1/tours/{tour}")["images"], left)
        with sqlite3.connect(f"file:{self.data / 'server' / 'homeward.db'}?mode=ro", uri=True) as database:
            swept = database.execute("SELECT count(*) FROM tour_sweeps WHERE tour = ?", (tour,)).fetchone()[0]
        self.assertEqual(swept, left, "each picture that is left has its own sweep")
        # A picture that the server's own disk damages afterwards.
        stored = sorted((self.data / "server" / "tours" / tour).iterdir())[1]
        stored.write_bytes(stored.read_bytes()[:1000])
        job = self.build("damaged", tour)
        self.assertEqual((job["state"], job["skipped"]), ("done", 1), job)
        self.assertEqual(job["notes"][0]["code"], "pictures_left_out_of")
        self.assertEqual(job["notes"][0]["parameters"]["left_out"], 1)
        self.assertEqual(job["notes"][0]["parameters"]["all"], left)
        self.assertEqual(self.server.call("GET", f"/api/v1/maps/{job['map']}")["images"], left - 1)

    def test_nothing_that_can_be_read(self):
        self.teach("offices:1", "corridor,office_1", 1)
        for picture in self.tour.glob("*.jpg"):
            picture.write_bytes(b"")
        done = self.upload("nothing")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("00000.jpg", done.stderr)

    def test_sweeps_come_along_and_propose_the_shortcuts_that_the_folder_does(self):
        self.teach("wards:4", "corridor_1,ward_1,bay_1,corridor_1", 0.8)
        done = self.upload("with sweeps")
        self.assertEqual(done.returncode, 0, done.stderr)
        tour = done.stdout.strip()
        job = self.build("with sweeps", tour)
        self.assertEqual(job["state"], "done", job)
        path = f"/api/v1/maps/{job['map']}"
        graph = self.server.call("GET", f"{path}/graph")
        local = self.data / "local.map"
        subprocess.run([BIN / "homeward", "map", "build", "--tour", self.tour, "--camera", self.tour / "camera.json", "--out", local],
                       check=True, stdout=subprocess.DEVNULL)
        listed = subprocess.run([BIN / "homeward", "map", "shortcuts", local, "--json"], check=True, stdout=subprocess.PIPE).stdout
        pictures = lambda shortcut: tuple(shortcut[end].split("/")[1] for end in ("image_a", "image_b"))
        self.assertEqual([pictures(one) for one in graph["shortcuts"]],
                         [pictures(one) for one in json.loads(listed)["shortcuts"]])
        self.assertGreater(len(graph["shortcuts"]), 0)
        # Somebody looks at one of them and accepts it: from then on it is a way.
        one = graph["shortcuts"][0]
        ends = f"from={one['place_a']}&to={one['place_b']}"
        self.assertEqual(self.server.call("GET", f"{path}/route?{ends}")["shortcuts"], [])
        edits = {"edits": [{"kind": "decide_shortcut", "image_a": one["image_a"], "image_b": one["image_b"], "accept": True}]}
        status, answer = self.server.send("POST", f"{path}/edits", json.dumps(edits).encode(), "application/json",
                                          {"If-Match": f'"r{graph["revision"]}"'})
        self.assertEqual(status, 200, answer)
        decided = self.server.call("GET", f"{path}/graph")["shortcuts"][0]
        self.assertEqual((decided["state"], decided["by"]), ("accepted", "anna"))
        route = self.server.call("GET", f"{path}/route?{ends}")
        self.assertEqual(route["places"], [one["place_a"], one["place_b"]])
        self.assertEqual(len(route["shortcuts"]), 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
