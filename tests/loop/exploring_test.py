#!/usr/bin/env python3
"""A simulated robot maps a house by itself for a real server: watched, fenced, paused, sent on, through kills of agent and
server, until its pictures are a tour of which a map is built.

usage: exploring_test.py BIN_FOLDER WEB_FOLDER
"""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import threading
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "deploy"))
from rest_client import Failed, Server, setup_token  # noqa: E402

BIN = pathlib.Path(sys.argv[1]).resolve()
WEB = pathlib.Path(sys.argv[2]).resolve()
PORT = 18479
LOGIN = {"name": "anna", "password": "correct horse battery"}
BY_NOW_S = 60
RESTS_WITHIN_S = 1.0


class Exploring(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="homeward-exploring-")
        self.addCleanup(folder.cleanup)
        self.data = pathlib.Path(folder.name)
        self.truth_file = self.data / "truth"
        self.address = f"http://127.0.0.1:{PORT}"
        self.processes = {}
        self.addCleanup(lambda: [self.kill(name) for name in list(self.processes)])
        self.start_server()
        self.server.call("POST", "/api/v1/setup", {"token": setup_token(self.data / "setup-link"), **LOGIN})
        self.server.call("POST", "/api/v1/login", LOGIN)
        made = self.server.call("POST", "/api/v1/robots", {"name": "Chair"})
        self.robot = f"/api/v1/robots/{made['id']}"
        self.token = self.data / "token"
        self.token.touch(mode=0o600)
        self.token.write_text(made["token"])
        self.lease = None
        self.watches = threading.Event()
        watcher = threading.Thread(target=self.keep_lease, daemon=True)
        watcher.start()
        self.addCleanup(watcher.join)
        self.addCleanup(self.watches.set)

    def start(self, name, command):
        with open(self.data / f"{name}.log", "ab") as log:
            self.processes[name] = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT)

    def kill(self, name):
        process = self.processes.pop(name)
        process.kill()
        process.wait()

    def start_server(self):
        self.start("server", [BIN / "homeward-server", "--data", self.data / "server", "--listen", f"127.0.0.1:{PORT}", "--web", WEB,
                              "--print-setup-file", self.data / "setup-link"])
        self.server = Server(self.address)
        self.server.wait_until_up(self.processes["server"])

    def start_agent(self):
        pose = self.stands()
        where = ["--start-pose", *(f"{value:.4f}" for value in pose)] if pose else []
        self.start("agent", [BIN / "homeward-simulated-agent", "run", "--server", self.address, "--token-file", self.token, "--robot",
                             self.robot.split("/")[-1], "--driver", "simulator", "--world", "house:1", "--explorations",
                             self.data / "explorations", "--record", self.data / "recordings", "--truth-file", self.truth_file, *where])
        self.until("the robot is there", lambda: self.server.call("GET", self.robot)["online"])

    def stands(self):
        """Where the robot truly is: x, y, heading."""
        if not self.truth_file.exists():
            return None
        lines = self.truth_file.read_text().splitlines()
        last = json.loads(lines[-1] if lines[-1].endswith("}") else lines[-2])
        return last["x_m"], last["y_m"], last["theta_rad"]

    def until(self, what, is_so, for_s=BY_NOW_S):
        ends = time.monotonic() + for_s
        while time.monotonic() < ends:
            found = is_so()
            if found:
                return found
            time.sleep(0.1)
        logs = {name: (self.data / f"{name}.log").read_text()[-1500:] for name in ("agent", "server")}
        self.fail(f"not in {for_s} s: {what}; robot {self.server.call('GET', self.robot)} {logs}")

    def report(self):
        try:
            return self.server.call("GET", f"{self.robot}/exploration")
        except Failed:
            return None

    def pictures(self, least, phase="exploring"):
        def so():
            report = self.report()
            return report if report and report["phase"] == phase and report["pictures"] >= least else None
        return self.until(f"{least} pictures, {phase}", so)

    def keep_lease(self):
        while not self.watches.wait(2.0):
            if self.lease is None:
                continue
            try:
                self.watching.call("PUT", f"{self.robot}/lease", {"lease_id": self.lease})
            except (Failed, OSError):
                pass  # the server is down just now

    def explore(self, **more):
        self.watching = Server(self.address)
        self.watching.call("POST", "/api/v1/login", LOGIN)
        self.lease = self.server.call("POST", f"{self.robot}/lease", {"take_over": True})["lease"]["id"]
        return self.server.call("POST", f"{self.robot}/explorations", {"lease_id": self.lease, **more})

    def expect_stands(self):
        time.sleep(RESTS_WITHIN_S)
        before = self.stands()
        time.sleep(1.5)
        after = self.stands()
        self.assertLess(math.hypot(after[0] - before[0], after[1] - before[1]), 0.001, "it moves without an order")
        self.assertAlmostEqual(after[2], before[2], places=3)

    def expect_recorded(self):
        """The latest drive, with what was found and decided on it."""
        latest = max((self.data / "recordings").glob("*.hwrec"))
        done = subprocess.run([BIN / "homeward", "replay", latest, "--json"], capture_output=True, text=True)
        replayed = json.loads(done.stdout)
        self.assertEqual((replayed["complete"], replayed["differences"]), (True, 0), replayed)
        subprocess.run([BIN / "homeward", "replay", latest, "--states", self.data / "states.csv"], check=True)
        with open(self.data / "states.csv", newline="") as table:
            states = list(csv.DictReader(table))
        self.assertEqual([row["end"] for row in states if row["state"] == "ended"], ["limit"])
        self.assertTrue([row for row in states if row["state"] in ("new", "known_again")])

    def test_a_robot_maps_a_house_through_pauses_and_kills(self):
        self.start_agent()
        mission = self.explore(limit_m=4.5)
        self.assertEqual((mission["kind"], mission["map"]), ("explore", None))
        exploration = mission["exploration"]
        seen = self.pictures(2)
        self.assertEqual(len(seen["nodes"]), seen["pictures"])
        self.assertGreater(len(seen["floor"]["runs"]), 100)

        fence = [[-9.0, 4.0], [-8.0, 4.0], [-8.0, 5.0]]
        self.server.call("PUT", f"{self.robot}/exploration/fences", {"lease_id": self.lease, "fences": [fence]})
        self.until("it knows its fence", lambda: self.report()["fences"] == [fence])

        self.server.call("POST", f"{self.robot}/stop", {})
        paused = self.pictures(2, "paused")
        self.assertEqual(paused["reason"]["code"], "stopped_by")
        self.expect_stands()

        # Its program is killed while it drives, and starts anew: all is there, and nothing moves before somebody says so.
        self.explore(exploration=exploration, limit_m=4.5)
        before = self.pictures(4)
        self.kill("agent")
        self.start_agent()
        again = self.pictures(before["pictures"], "paused")
        self.assertEqual(again["id"], exploration)
        self.assertEqual(again["fences"], [fence])
        self.expect_stands()

        # And so is the server.
        self.explore(exploration=exploration, limit_m=4.5)
        self.pictures(again["pictures"] + 2)
        self.kill("server")
        self.expect_stands()
        self.start_server()
        self.server.call("POST", "/api/v1/login", LOGIN)
        self.until("the robot is back", lambda: self.server.call("GET", self.robot)["online"])
        self.pictures(again["pictures"] + 2, "paused")
        self.expect_stands()

        self.explore(exploration=exploration, limit_m=4.5)
        done = self.until("its pictures are on the server", lambda: (self.report() or {}).get("tour") and self.report())
        self.assertEqual(done["phase"], "uploaded")
        self.assertEqual(done["reason"]["code"], "exploration_limit")
        self.assertEqual(self.server.call("GET", self.robot)["mission"]["state"], "arrived")
        tour = self.server.call("GET", f"/api/v1/tours/{done['tour']}")
        self.assertEqual((tour["images"], tour["state"]), (done["pictures"], "complete"))
        job = self.server.call("POST", "/api/v1/maps", {"name": "House", "tours": [done["tour"]]})["job"]
        built = self.until("the map is built",
                           lambda: (self.server.call("GET", f"/api/v1/jobs/{job['id']}")["state"] in ("done", "failed")
                                    and self.server.call("GET", f"/api/v1/jobs/{job['id']}")))
        self.assertEqual(built["state"], "done", built)
        self.expect_recorded()
        for line in self.truth_file.read_text().splitlines():
            self.assertEqual(json.loads(line)["collisions"], 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
