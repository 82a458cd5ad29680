#!/usr/bin/env python3
"""A simulated robot maps a house by itself for a real server: watched, fenced, paused, sent on, through kills of agent and
server, until its pictures are a tour of which a map is built.

usage: exploring_test.py BIN_FOLDER WEB_FOLDER
"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

import exploring_robot

BIN = pathlib.Path(sys.argv[1]).resolve()
WEB = pathlib.Path(sys.argv[2]).resolve()
PORT = 18479
RESTS_WITHIN_S = 1.0


class Exploring(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="homeward-exploring-")
        self.addCleanup(folder.cleanup)
        self.chair = exploring_robot.ExploringRobot(BIN, WEB, PORT, folder.name)
        self.addCleanup(self.chair.close)

    def start_agent(self):
        self.chair.start_simulated_agent("house:1", "--record", self.chair.data / "recordings")

    def expect_stands(self):
        time.sleep(RESTS_WITHIN_S)
        moved_m, turned_rad = self.chair.moved(1.5)
        self.assertLess(moved_m, exploring_robot.AT_REST_M, "it moves without an order")
        self.assertLess(turned_rad, exploring_robot.AT_REST_RAD)

    def expect_recorded(self):
        """The latest drive, with what was found and decided on it."""
        latest = max((self.chair.data / "recordings").glob("*.hwrec"))
        done = subprocess.run([BIN / "homeward", "replay", latest, "--json"], capture_output=True, text=True)
        replayed = json.loads(done.stdout)
        self.assertEqual((replayed["complete"], replayed["differences"]), (True, 0), replayed)
        subprocess.run([BIN / "homeward", "replay", latest, "--states", self.chair.data / "states.csv"], check=True)
        with open(self.chair.data / "states.csv", newline="") as table:
            states = list(csv.DictReader(table))
        self.assertEqual([row["end"] for row in states if row["state"] == "ended"], ["limit"])
        self.assertTrue([row for row in states if row["state"] in ("new", "known_again")])

    def test_a_robot_maps_a_house_through_pauses_and_kills(self):
        chair = self.chair
        self.start_agent()
        mission = chair.explore(limit_m=4.5)
        self.assertEqual((mission["kind"], mission["map"]), ("explore", None))
        exploration = mission["exploration"]
        seen = chair.pictures(2)
        self.assertEqual(len(seen["nodes"]), seen["pictures"])
        self.assertGreater(len(seen["floor"]["runs"]), 100)

        fence = [[-9.0, 4.0], [-8.0, 4.0], [-8.0, 5.0]]
        chair.server.call("PUT", f"{chair.robot}/exploration/fences", {"lease_id": chair.lease, "fences": [fence]})
        chair.until("it knows its fence", lambda: chair.report()["fences"] == [fence])

        chair.server.call("POST", f"{chair.robot}/stop", {})
        paused = chair.pictures(2, "paused")
        self.assertEqual(paused["reason"]["code"], "stopped_by")
        self.expect_stands()

        # Its program is killed while it drives, and starts anew: all is there, and nothing moves before somebody says so.
        chair.explore(exploration=exploration, limit_m=4.5)
        before = chair.pictures(4)
        chair.kill("agent")
        self.start_agent()
        again = chair.pictures(before["pictures"], "paused")
        self.assertEqual(again["id"], exploration)
        self.assertEqual(again["fences"], [fence])
        self.expect_stands()

        # And so is the server.
        chair.explore(exploration=exploration, limit_m=4.5)
        chair.pictures(again["pictures"] + 2)
        chair.kill("server")
        self.expect_stands()
        chair.start_server()
        chair.sign_in()
        chair.until("the robot is back", chair.online)
        chair.pictures(again["pictures"] + 2, "paused")
        self.expect_stands()

        chair.explore(exploration=exploration, limit_m=4.5)
        done = chair.until("its pictures are on the server", chair.uploaded)
        self.assertEqual(done["phase"], "uploaded")
        self.assertEqual(done["reason"]["code"], "exploration_limit")
        self.assertEqual(chair.state()["mission"]["state"], "arrived")
        tour = chair.server.call("GET", f"/api/v1/tours/{done['tour']}")
        self.assertEqual((tour["images"], tour["state"]), (done["pictures"], "complete"))
        chair.build_map(done["tour"])
        self.assertEqual(chair.collisions(), 0)
        self.expect_recorded()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
