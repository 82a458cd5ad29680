#!/usr/bin/env python3
"""Paths that were taught to an ordinary camera, followed in simulated time: how far beside the tour the robot drives, and what
it does where it sees nothing any more.

usage: repeated_path_test.py BIN_FOLDER WEB_FOLDER
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

CAMERA = {"format": "homeward-camera", "version": 1, "model": "pinhole", "width_px": 320, "height_px": 240,
          "intrinsics": {"fx_px": 228.5, "fy_px": 228.5, "cx_px": 159.5, "cy_px": 119.5},
          "robot_from_camera": {"translation_m": [0, 0, 1.2], "rotation_wxyz": [0.5, -0.5, 0.5, -0.5]}}


def mission(**more):
    return {"from": "hall", "to": "kitchen", "start_beside_m": 0.3, "start_turned_rad": 0.17, **more}


SCENARIO = {"format": "homeward-scenario", "version": 1, "world": "house:9", "seed": 5, "mode": "repeat", "camera": CAMERA,
            "speed_limit_mps": 0.8, "tour": {"rooms": ["hall", "kitchen"], "step_m": 0.06},
            "missions": [mission(), mission(steering="heading"), mission(steering="features"),
                         mission(faults=[{"kind": "camera_occluded", "at_s": 6}])]}


class RepeatedPath(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "repeat.json"
            file.write_text(json.dumps(SCENARIO))
            ran = subprocess.run([pathlib.Path(sys.argv[1]) / "homeward", "simulate", "run", "--scenario", file, "--json"],
                                 check=True, capture_output=True, text=True)
        cls.way, cls.heading, cls.features, cls.covered = (json.loads(line) for line in ran.stdout.splitlines())
        for one in (cls.way, cls.heading, cls.features, cls.covered):
            print(one["repeat"], one["arrived"], one["final_error_m"], file=sys.stderr)

    def test_by_the_way_that_was_taught_it_comes_back_to_it_and_arrives(self):
        self.assertTrue(self.way["arrived"], self.way)
        self.assertLess(self.way["final_error_m"], 0.1)
        self.assertLess(self.way["repeat"]["lateral_rmse_m"], 0.1)
        self.assertEqual((self.way["collisions"], self.way["repeat"]["lost"]), (0, 0))

    def test_by_headings_or_features_alone_it_arrives_near_by_and_touches_nothing(self):
        for one, steering in ((self.heading, "heading"), (self.features, "features")):
            with self.subTest(steering):
                self.assertEqual(one["repeat"]["steering"], steering)
                self.assertTrue(one["arrived"], one)
                self.assertLess(one["final_error_m"], 0.3)
                self.assertEqual(one["collisions"], 0)

    def test_with_its_lens_covered_it_stops_and_says_that_it_is_lost(self):
        self.assertFalse(self.covered["arrived"])
        self.assertEqual(self.covered["stops"][-1]["reason"]["code"], "path_place_unknown")
        self.assertEqual(self.covered["moved_after_stop"], 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
