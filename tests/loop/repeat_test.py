#!/usr/bin/env python3
"""A robot with one ordinary camera follows a path that it was taught: real programs, a tour that goes to the server, and
its path from there to the robot.

usage: repeat_test.py BIN_FOLDER WEB_FOLDER
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "deploy"))
import demo  # noqa: E402
from rest_client import Failed, Server  # noqa: E402

PORT = 18503
WORLD = "house:9"
CAMERA = {"format": "homeward-camera", "version": 1, "model": "pinhole", "width_px": 320, "height_px": 240,
          "intrinsics": {"fx_px": 228.5, "fy_px": 228.5, "cx_px": 159.5, "cy_px": 119.5},
          "robot_from_camera": {"translation_m": [0, 0, 1.2], "rotation_wxyz": [0.5, -0.5, 0.5, -0.5]}}


class Repeat(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.binaries = pathlib.Path(sys.argv[1]).resolve()
        cls.folder = tempfile.TemporaryDirectory()
        cls.data = pathlib.Path(cls.folder.name)
        (cls.data / "lens.json").write_text(json.dumps(CAMERA))
        subprocess.run([cls.binaries / "homeward", "simulate", "tour", "--world", WORLD, "--camera",
                        cls.data / "lens.json", "--step-m", "0.06", "--rooms", "hall", "kitchen", "--marks",
                        "--out", cls.data / "tour"], check=True, stdout=subprocess.DEVNULL)
        cls.log = open(cls.data / "programs.log", "ab")
        cls.processes = [subprocess.Popen(
            [cls.binaries / "homeward-server", "--data", cls.data / "server", "--listen", f"127.0.0.1:{PORT}", "--web",
             sys.argv[2], "--print-setup-file", cls.data / "setup-link"], stdout=cls.log, stderr=subprocess.STDOUT)]
        cls.server = Server(f"http://127.0.0.1:{PORT}")
        cls.server.wait_until_up(cls.processes[0])
        demo.set_up_account(cls.server, cls.data)
        cls.robot, token_file = demo.robot_with_token(cls.server, cls.data)
        cls.map = cls.taught(token_file)
        cls.server.call("PUT", f"/api/v1/robots/{cls.robot}/map", {"map": cls.map})
        cls.processes.append(subprocess.Popen(
            [cls.binaries / "homeward-simulated-agent", "run", "--server", cls.server.address, "--robot", cls.robot,
             "--token-file", token_file, "--world", WORLD, "--camera", cls.data / "lens.json", "--start-pose",
             *(str(number) for number in cls.beside_the_first_picture()), "--record", cls.data / "recordings",
             "--truth-file", cls.data / "truth.jsonl"], stdout=cls.log, stderr=subprocess.STDOUT))

    @classmethod
    def tearDownClass(cls):
        for process in reversed(cls.processes):
            process.terminate()
        for process in cls.processes:
            process.wait(timeout=30)
        cls.log.close()
        print("--- end of programs.log ---", *(cls.data / "programs.log").read_text().splitlines()[-15:], sep="\n")
        cls.folder.cleanup()

    @classmethod
    def taught(cls, token_file):
        """The map of the path that the server makes of the tour."""
        subprocess.run([cls.binaries / "homeward-agent", "upload", "--server", cls.server.address, "--token-file",
                        token_file, "--tour", cls.data / "tour", "--name", "way to the kitchen"], check=True,
                       stdout=subprocess.DEVNULL)
        tour = next(t for t in cls.server.call("GET", "/api/v1/tours")["tours"] if t["state"] == "complete")
        answer = cls.server.call("POST", "/api/v1/maps", {"name": "path", "tours": [tour["id"]], "path": True})
        end = time.monotonic() + 120
        while True:
            job = cls.server.call("GET", f"/api/v1/jobs/{answer['job']['id']}")
            if job["state"] == "done":
                return answer["map"]["id"]
            if job["state"] in ("failed", "cancelled") or time.monotonic() > end:
                raise Failed(f"the path was not taught: {job}")
            time.sleep(0.2)

    @classmethod
    def beside_the_first_picture(cls):
        fields = (cls.data / "tour" / "poses.csv").read_text().splitlines()[1].split(",")
        x_m, y_m, theta_rad = (float(field) for field in fields[1:4])
        beside_m = 0.15
        return x_m - beside_m * math.sin(theta_rad), y_m + beside_m * math.cos(theta_rad), theta_rad + 0.1

    def ended(self, destination, lease):
        mission = self.server.call("POST", f"/api/v1/robots/{self.robot}/missions",
                                   {"lease_id": lease, "destination": destination})
        end = time.monotonic() + 240
        while time.monotonic() < end:
            mission = self.server.call("GET", f"/api/v1/robots/{self.robot}/missions/{mission['id']}")
            if mission["state"] in ("arrived", "refused", "stopped", "failed"):
                return mission
            self.server.call("PUT", f"/api/v1/robots/{self.robot}/lease", {"lease_id": lease})
            time.sleep(0.5)
        self.fail(f"it has not ended: {mission}")

    def test_it_follows_the_path_and_knows_that_none_leads_back(self):
        end = time.monotonic() + 120
        while not (self.server.call("GET", f"/api/v1/robots/{self.robot}").get("belief") or {}).get("place"):
            self.assertLess(time.monotonic(), end, "it is not known where the robot is")
            time.sleep(0.5)
        lease = self.server.call("POST", f"/api/v1/robots/{self.robot}/lease", {"take_over": True})["lease"]["id"]
        graph = self.server.call("GET", f"/api/v1/maps/{self.map}/graph")
        of = {destination["label"]: destination for destination in graph["destinations"]}
        mission = self.ended(of["kitchen"]["id"], lease)
        self.assertEqual(mission["state"], "arrived", mission.get("reason"))
        truth = demo.last_truth(self.data / "truth.jsonl")
        target = demo.mark_pose(self.data / "tour", of["kitchen"]["image"].split("/")[-1])
        self.assertLess(math.hypot(truth["x_m"] - target[0], truth["y_m"] - target[1]), 0.2)
        self.assertEqual(truth["collisions"], 0)
        with self.subTest("its recording replays bit for bit"):
            recording = next((self.data / "recordings").glob("*.hwrec"))
            replayed = json.loads(subprocess.run([self.binaries / "homeward", "replay", recording, "--json"], check=True,
                                                 capture_output=True, text=True).stdout)
            self.assertEqual((replayed["differences"], replayed["complete"]), (0, True), replayed)
            self.assertGreater(replayed["steps"], 100)
        with self.subTest("the path leads only forwards"):
            mission = self.ended(of["hall"]["id"], lease)
            self.assertEqual((mission["state"], mission["reason"]["code"]), ("failed", "path_leads_elsewhere"))
            stood = demo.last_truth(self.data / "truth.jsonl")
            self.assertLess(math.hypot(truth["x_m"] - stood["x_m"], truth["y_m"] - stood["y_m"]), 0.05)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
