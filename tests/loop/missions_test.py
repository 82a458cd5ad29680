#!/usr/bin/env python3
"""Closed loops in the generated house, in simulated time: teach, build, drive. When something fails: faults_test.py.

usage: missions_test.py BIN_FOLDER WEB_FOLDER
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import small_mirror

BIN = pathlib.Path(sys.argv[1]).resolve()
ARRIVED_WITHIN_M = 0.3
DOCKED_WITHIN_RAD = math.radians(3)


def scenario(missions, robot):
    return {"world": "house:1", "camera": {"model": "hyperbolic_mirror"}, **robot, "format": "homeward-scenario", "version": 1,
            "seed": 1,
            "tour": {"rooms": ["hall", "kitchen", "living_room", "bathroom", "hall"], "light": "day"},
            "missions": missions}


def drive(missions, **robot):
    with tempfile.TemporaryDirectory(prefix="homeward-missions-") as folder:
        file = pathlib.Path(folder) / "scenario.json"
        file.write_text(json.dumps(scenario(missions, robot)))
        done = subprocess.run([BIN / "homeward", "simulate", "run", "--scenario", file, "--json"], check=True,
                              capture_output=True, text=True)
        return [json.loads(line) for line in done.stdout.splitlines()]


class Missions(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.results = drive([
            {"from": "hall", "to": "kitchen"},
            {"from": "kitchen", "to": "bathroom"},
            {"from": "bathroom", "to": "living_room", "people": 2},
        ])

    def test_missions_arrive_where_the_destination_was_taught(self):
        for result in self.results:
            with self.subTest(to=result["to"]):
                self.assertTrue(result["arrived"], result)
                self.assertLessEqual(result["final_error_m"], ARRIVED_WITHIN_M, result)

    def test_the_chair_takes_up_the_taught_heading(self):
        for result in self.results:
            self.assertLessEqual(result["final_error_rad"], DOCKED_WITHIN_RAD, result)

    def test_nothing_is_touched(self):
        for result in self.results:
            self.assertEqual(result["collisions"], 0, result)


class OtherRobots(unittest.TestCase):
    def arrives(self, **robot):
        results = drive([{"from": "kitchen", "to": "living_room"}], **robot)
        for result in results:
            self.assertTrue(result["arrived"], result)
            self.assertLessEqual(result["final_error_m"], ARRIVED_WITHIN_M, result)
            self.assertLessEqual(result["final_error_rad"], DOCKED_WITHIN_RAD, result)
            self.assertEqual(result["collisions"], 0, result)
        return results

    def test_a_wheelchair_gets_its_whole_length_through_doors_0_2_m_wider_than_itself(self):
        for result in self.arrives(robot="chair", world="narrow_house:1"):
            self.assertGreaterEqual(result["min_clearance_m"], 0.02, result)

    def test_a_ring_of_ultrasound_sensors_does_in_place_of_a_laser(self):
        self.arrives(ranges="ultrasound", camera=small_mirror.CAMERA)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
