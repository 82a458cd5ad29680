#!/usr/bin/env python3
"""Two simulated robots, programs of their own, map one building together for a real server, which passes on what they tell
each other: once each names the other, each has all of the other's pictures, and one map is made of both tours. Whether their
floors are joined before they end hangs on the ways that they happen to take: tests/unit/agent/exploring_together_test.cpp.

usage: exploring_together_test.py BIN_FOLDER WEB_FOLDER
"""
import pathlib
import sys
import tempfile
import unittest

import exploring_robot

BIN = pathlib.Path(sys.argv[1]).resolve()
PORT = 18493
WORLD = "laboratory:1"
# Beside each other: x, y, heading.
STARTS = ((0.78, 0.78, -0.307), (2.314, 1.001, -1.023))
LIMIT_M = 4.0


class ExploringTogether(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="homeward-together-")
        self.addCleanup(folder.cleanup)
        self.shared = pathlib.Path(folder.name) / "world"
        self.robots = []
        for number, start in enumerate(STARTS):
            data = pathlib.Path(folder.name) / str(number)
            data.mkdir()
            robot = exploring_robot.ExploringRobot(BIN, None, PORT, data, beside=self.robots[0] if self.robots else None)
            self.addCleanup(robot.close)
            robot.start_simulated_agent(WORLD, "--shared-world", self.shared, "--seed", str(number + 1),
                                        "--start-pose", *(str(value) for value in start))
            self.robots.append(robot)

    def test_two_robots_share_an_exploration_and_one_map_is_made_of_it(self):
        for robot in self.robots:
            robot.explore(limit_m=LIMIT_M)
        first, second = self.robots
        for robot in self.robots:
            robot.until("it has an exploration", robot.report)
        first.share_with(second)
        self.assertIsNone(second.report()["companion"], "one word is not enough")
        second.share_with(first)
        done = [robot.until("its pictures are on the server", robot.uploaded, 150) for robot in self.robots]
        for robot, other in zip(self.robots, reversed(done)):
            robot.until("it has all of the other's pictures",
                        lambda: robot.report()["companion"]["pictures"] == other["pictures"])
            self.assertEqual(robot.report()["companion"]["exploration"], other["id"])
        for robot in self.robots:
            self.assertEqual(robot.collisions(), 0)
        first.build_map(*(report["tour"] for report in done))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
