#!/usr/bin/env python3
"""A mission during which the wall clocks of server and robot jump an hour forth, two back and to rights again: it
arrives as if nothing had happened, because what drives counts on steady clocks alone.

usage: clock_test.py BIN_FOLDER WEB_FOLDER
"""
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "deploy"))
import demo  # noqa: E402
from rest_client import Server  # noqa: E402

BIN = pathlib.Path(sys.argv[1]).resolve()
WEB = pathlib.Path(sys.argv[2]).resolve()
PORT = 18475
HOUR_S = 3600
JUMPS_S = (HOUR_S, -HOUR_S, 0)
BETWEEN_JUMPS_S = 2.5
UNDER_WAY_MPS = 0.2


class Clock(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="homeward-clock-")
        self.addCleanup(folder.cleanup)
        self.data = pathlib.Path(folder.name)
        self.clock = self.data / "clock"
        self.set_clock(0)
        self.environment = {**os.environ, "HOMEWARD_MOVING_CLOCK": str(self.clock),
                            "LD_PRELOAD": str(BIN.parent / "tests" / "libhomeward_moving_clock.so")}

    def set_clock(self, seconds):
        mode = "r+b" if self.clock.exists() else "w+b"
        with open(self.clock, mode) as file:
            file.write(struct.pack("=q", seconds))

    def start(self, name, *arguments):
        log = open(self.data / f"{name}.log", "ab")
        process = subprocess.Popen(arguments, stdout=log, stderr=subprocess.STDOUT, env=self.environment)
        log.close()

        def end():
            process.kill()
            process.wait()
        self.addCleanup(end)
        return process

    def jump_under_way(self):
        """Moves the clocks once the chair is well under way."""
        end = time.monotonic() + 120
        while time.monotonic() < end:
            truth = demo.last_truth(self.data / "truth.jsonl")
            if truth and truth["speed_mps"] > UNDER_WAY_MPS:
                break
            time.sleep(0.05)
        for seconds in JUMPS_S:
            self.set_clock(seconds)
            self.jumped.append(seconds)
            time.sleep(BETWEEN_JUMPS_S)

    def test_a_mission_arrives_although_the_wall_clocks_jump(self):
        self.jumped = []
        subprocess.run([BIN / "homeward", "simulate", "tour", "--world", demo.WORLD, "--rooms", "kitchen,hall,kitchen",
                        "--marks", "--seed", "3", "--out", self.data / "tour"], check=True, stdout=subprocess.DEVNULL)
        process = self.start("server", BIN / "homeward-server", "--data", self.data / "server", "--listen",
                             f"127.0.0.1:{PORT}", "--web", WEB, "--print-setup-file", self.data / "setup-link")
        server = Server(f"http://127.0.0.1:{PORT}")
        server.wait_until_up(process)
        demo.set_up_account(server, self.data)
        robot, token_file = demo.robot_with_token(server, self.data)
        map_id = demo.teach(server, BIN, self.data, token_file)
        server.call("PUT", f"/api/v1/robots/{robot}/map", {"map": map_id})
        self.start("agent", BIN / "homeward-simulated-agent", "run", "--server", server.address, "--robot", robot, "--token-file",
                   token_file, "--world", demo.WORLD, "--start-room", "hall", "--truth-file",
                   self.data / "truth.jsonl")
        jumps = threading.Thread(target=self.jump_under_way)
        jumps.start()
        arrived = demo.drive(server, robot, map_id, "kitchen", self.data)
        jumps.join()
        self.assertTrue(arrived, (self.data / "agent.log").read_text()[-2000:])
        self.assertEqual(self.jumped, list(JUMPS_S))
        self.expect_that_clocks_jumped()

    def expect_that_clocks_jumped(self):
        """The simulator stamps what it tells with the wall clock: there the jumps must be, and motion right after each."""
        truths = [json.loads(line) for line in (self.data / "truth.jsonl").read_text().splitlines() if line.endswith("}")]
        jumps = [i for i in range(1, len(truths)) if abs(truths[i]["t_us"] - truths[i - 1]["t_us"]) > HOUR_S * 0.9e6]
        steps = [round((truths[i]["t_us"] - truths[i - 1]["t_us"]) / 1e6 / HOUR_S) for i in jumps]
        self.assertEqual(steps, [1, -2, 1])
        for i in jumps[:2]:
            self.assertGreater(max(abs(t["speed_mps"]) for t in truths[i:i + 20]), 0.05, "it stood after a jump")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
