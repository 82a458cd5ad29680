#!/usr/bin/env python3
"""A robot behind a rosbridge maps a part of a house by itself, once a disc and once a wheelchair: started over REST, ended
by its limit, its pictures a tour with sweeps and odometry of which a map is built. It touches nothing.

usage: exploring_bridge_test.py BIN_FOLDER WEB_FOLDER [METRES]      how far each may drive
"""
import json
import pathlib
import sqlite3
import sys
import tempfile
import unittest

import exploring_robot

BIN = pathlib.Path(sys.argv[1]).resolve()
WEB = pathlib.Path(sys.argv[2]).resolve()
PORT = 18486
BRIDGE_PORT = 18487
WORLD = "house:1"
LIMIT_M = float(sys.argv[3]) if len(sys.argv) > 3 else 2.5
BEYOND_M = 0.6  # it comes to rest, and the wheels count a little more or less than it drives
STARTS_WITHIN_S = 120
SECONDS_PER_M = 30  # at the very most


class Disc(unittest.TestCase):
    """Of 0.35 m radius."""

    PROFILE = "disc"
    BODY = {"radius_m": 0.35}
    ROOM = "living_room"

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="homeward-exploring-bridge-")
        self.addCleanup(folder.cleanup)
        self.data = pathlib.Path(folder.name)
        self.robot = exploring_robot.ExploringRobot(BIN, WEB, PORT, self.data)
        self.addCleanup(self.robot.close)
        self.robot.start("bridge", BIN.parent / "tests" / "homeward-rosbridge-robot", str(BRIDGE_PORT), WORLD, self.ROOM,
                         self.PROFILE, self.robot.truth_file, self.data / "camera.json")
        self.robot.until("the robot is there", (self.data / "camera.json").exists, STARTS_WITHIN_S)
        described = json.loads((exploring_robot.ROOT / "proto/examples/rosbridge/valid/ros2_round.json").read_text())
        described.update(address=f"ws://127.0.0.1:{BRIDGE_PORT}", body={
            **self.BODY, "max_speed_mps": 0.8, "max_turn_radps": 1.2, "deceleration_mps2": 1.0,
            "turn_deceleration_radps2": 5.0})
        described["image"]["topic"] = "/image"
        described["scan"]["robot_from_scan"]["x_m"] = 0.0
        (self.data / "robot.json").write_text(json.dumps(described))
        self.robot.start_agent("homeward-agent", "--driver", "rosbridge", "--rosbridge", self.data / "robot.json")
        self.robot.until("it hears the range sensor", lambda: self.robot.state()["min_range_m"] is not None)

    def kept_with_pictures(self, tour):
        """Of how many pictures of a tour the server keeps sweeps, of how many odometry, and how far apart that is."""
        with sqlite3.connect(f"file:{self.data / 'server' / 'homeward.db'}?mode=ro", uri=True) as database:
            swept = database.execute("SELECT count(*) FROM tour_sweeps WHERE tour = ?", (tour,)).fetchone()[0]
            at = database.execute("SELECT odometry_x_m, odometry_y_m FROM tour_images WHERE tour = ? AND "
                                  "odometry_theta_rad IS NOT NULL", (tour,)).fetchall()
        return swept, len(at), max(x for x, _ in at) - min(x for x, _ in at) + max(y for _, y in at) - min(y for _, y in at)

    def test_it_explores_up_to_its_limit_and_its_map_is_one_piece(self):
        self.robot.explore(limit_m=LIMIT_M)
        done = self.robot.until("its pictures are on the server", self.robot.uploaded, 60 + SECONDS_PER_M * LIMIT_M)
        self.assertEqual((done["phase"], done["reason"]["code"]), ("uploaded", "exploration_limit"))
        self.assertEqual(self.robot.state()["mission"]["state"], "arrived")
        self.assertGreaterEqual(done["driven_m"], LIMIT_M)
        self.assertLess(done["driven_m"], LIMIT_M + BEYOND_M)
        self.assertEqual(self.robot.collisions(), 0)
        tour = self.robot.server.call("GET", f"/api/v1/tours/{done['tour']}")
        self.assertEqual((tour["images"], tour["state"]), (done["pictures"], "complete"))
        swept, placed, extent_m = self.kept_with_pictures(done["tour"])
        self.assertEqual((swept, placed), (tour["images"], tour["images"]))
        self.assertGreater(extent_m, 0.5)
        self.assertTrue(self.robot.is_one_piece(self.robot.build_map(done["tour"])))


class Wheelchair(Disc):
    """Of 1.10 m x 0.65 m, turning about its rear axle."""

    PROFILE = "chair"
    BODY = {"rectangle": {"front_m": 0.85, "back_m": 0.25, "width_m": 0.65}}
    ROOM = "study"


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
