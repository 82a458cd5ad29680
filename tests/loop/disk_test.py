#!/usr/bin/env python3
"""A server whose disk is full, and one whose disk fails at any one call.

Full: what cannot be kept is refused with 507 and leaves nothing behind, readyz says so, leases and stops still work, and
all is well again as soon as there is room. Failing: a map is imported over and over, and each time the next call that
writes, flushes, renames or opens fails; the server goes on, and the map is there whole or not at all.
usage: disk_test.py BIN_FOLDER WEB_FOLDER
"""
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "deploy"))
import demo  # noqa: E402
from rest_client import Server  # noqa: E402

BIN = pathlib.Path(sys.argv[1]).resolve()
WEB = pathlib.Path(sys.argv[2]).resolve()
PORT = 18502
FULL, FAILS_AT, CALLS = 0, 8, 16  # offsets of failing_disk.cpp's orders


class Disk(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="homeward-disk-")
        cls.data = pathlib.Path(cls.folder.name)
        cls.orders = cls.data / "orders"
        cls.orders.write_bytes(bytes(24))
        tour = cls.data / "tour"
        subprocess.run([BIN / "homeward", "simulate", "tour", "--world", "house:1", "--rooms", "hall,kitchen", "--marks",
                        "--seed", "3", "--out", tour], check=True, stdout=subprocess.DEVNULL)
        cls.pictures = sorted(tour.glob("*.jpg"))
        cls.camera = json.loads((tour / "camera.json").read_text())
        subprocess.run([BIN / "homeward", "map", "build", "--tour", tour, "--camera", tour / "camera.json", "--out",
                        cls.data / "map.hwmap"], check=True, stdout=subprocess.DEVNULL)
        cls.server = Server(f"http://127.0.0.1:{PORT}")
        cls.process = None
        cls.start()
        demo.set_up_account(cls.server, cls.data)

    @classmethod
    def tearDownClass(cls):
        cls.end()
        cls.folder.cleanup()

    @classmethod
    def start(cls):
        environment = {**os.environ, "HOMEWARD_FAILING_DISK": str(cls.orders),
                       "HOMEWARD_FAILING_FOLDER": str(cls.data / "server"),
                       "LD_PRELOAD": str(BIN.parent / "tests" / "libhomeward_failing_disk.so")}
        with open(cls.data / "server.log", "ab") as log:
            cls.process = subprocess.Popen([BIN / "homeward-server", "--data", cls.data / "server", "--listen",
                                            f"127.0.0.1:{PORT}", "--web", WEB, "--print-setup-file",
                                            cls.data / "setup-link"], stdout=log, stderr=subprocess.STDOUT,
                                           env=environment)
        cls.server.wait_until_up(cls.process)

    @classmethod
    def end(cls):
        if cls.process and cls.process.poll() is None:
            cls.process.kill()
            cls.process.wait()

    def order(self, offset, value):
        with open(self.orders, "r+b") as file:
            file.seek(offset)
            file.write(struct.pack("=q", value))

    def calls(self):
        return struct.unpack_from("=q", self.orders.read_bytes(), CALLS)[0]

    def put(self, tour, number):
        return self.server.send("PUT", f"/api/v1/tours/{tour}/images/{number}", self.pictures[number].read_bytes(),
                                "image/jpeg")

    def ready(self):
        return self.server.send("GET", "/readyz")

    def unfinished(self):
        return [file.name for file in (self.data / "server").rglob("*") if file.suffix in (".part", ".arrived")]

    def test_1_a_full_disk_keeps_nobody_from_stopping(self):
        tour = self.server.call("POST", "/api/v1/tours", {"name": "house", "camera": self.camera})["id"]
        self.assertEqual(self.put(tour, 0)[0], 201)
        robot = self.server.call("POST", "/api/v1/robots", {"name": "chair"})["id"]
        self.server.call("POST", f"/api/v1/robots/{robot}/lease", {"take_over": True})
        self.assertEqual(self.ready()[0], 200)
        self.order(FULL, 1)
        status, problem = self.put(tour, 1)
        self.assertEqual((status, problem.get("code")), (507, "disk_full"), problem)
        status, text = self.ready()
        self.assertEqual(status, 503)
        self.assertIn("disk is full", text["detail"])
        status, problem = self.server.send("POST", "/api/v1/maps/import?name=x", (self.data / "map.hwmap").read_bytes())
        self.assertEqual((status, problem.get("code")), (507, "disk_full"), problem)
        self.assertEqual(self.unfinished(), [])
        for _ in range(50):
            lease = self.server.call("POST", f"/api/v1/robots/{robot}/lease", {"take_over": True})["lease"]
            self.server.call("DELETE", f"/api/v1/robots/{robot}/lease", {"lease_id": lease["id"]})
            self.server.call("POST", f"/api/v1/robots/{robot}/stop", {})
        self.assertEqual(self.server.call("GET", f"/api/v1/tours/{tour}")["images"], 1)
        self.order(FULL, 0)
        self.assertEqual(self.put(tour, 1)[0], 201)
        self.assertEqual(self.ready()[0], 200)
        later = self.server.call("POST", f"/api/v1/robots/{robot}/lease", {"take_over": True})["lease"]
        self.end()
        self.start()
        after = self.server.call("POST", f"/api/v1/robots/{robot}/lease", {"take_over": True})["lease"]
        self.assertGreater(after["epoch"], later["epoch"])
        self.assertEqual(self.server.call("GET", f"/api/v1/tours/{tour}")["images"], 2)
        self.assertEqual(self.ready()[0], 200)

    def test_1b_what_is_kept_is_for_its_owner_alone(self):
        kept = [self.data / "server", *(self.data / "server").rglob("*")]
        self.assertGreater(len(kept), 8)
        self.assertEqual([str(one) for one in kept if one.stat().st_mode & 0o077], [])

    def test_2_an_import_is_whole_or_not_there_whichever_call_fails(self):
        file = (self.data / "map.hwmap").read_bytes()
        before = len(self.server.call("GET", "/api/v1/maps")["maps"])
        failures = 0
        for number in range(1, 1000):
            self.order(CALLS, 0)
            self.order(FAILS_AT, number)
            status, problem = self.server.send("POST", "/api/v1/maps/import?name=house", file)
            counted = self.calls()
            self.order(FAILS_AT, 0)
            self.assertIsNone(self.process.poll(), f"call {number} ended the server")
            maps = self.server.call("GET", "/api/v1/maps")["maps"]
            self.assertEqual(self.unfinished(), [], number)
            if status == 201 and counted < number:
                break
            failures += 1
            self.assertIn(status, (201, 500), problem)
            self.assertEqual(len(maps), before + (status == 201), f"call {number}: {problem}")
            before = len(maps)
            for one in maps:
                self.server.call("GET", f"/api/v1/maps/{one['id']}/graph")
            self.end()
            self.start()
            # One whose last flush failed may be on the disk after all; then it is there whole.
            after = self.server.call("GET", "/api/v1/maps")["maps"]
            self.assertIn(len(after) - before, (0, 1 if status == 500 else 0), f"call {number}")
            before = len(after)
            for one in after:
                self.server.call("GET", f"/api/v1/maps/{one['id']}/graph")
            self.assertEqual(self.ready(), (200, {"detail": "ready\n"}), f"call {number}")
        print(f"{failures} calls failed, each once", file=sys.stderr)
        self.assertGreater(failures, 8, "the calls were not met")
        self.assertEqual(len(maps), before + 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
