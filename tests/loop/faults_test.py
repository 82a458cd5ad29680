#!/usr/bin/env python3
"""What goes wrong on the way, each with its expected outcome, in simulated time: cameras, laser, link, the agent itself,
wheels, a box in the way, furniture moved. Nothing is ever touched, and nothing moves after a stop.

usage: faults_test.py BIN_FOLDER WEB_FOLDER [CAMERA_MODEL]      a usual camera in place of a small one
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import small_mirror

BIN = pathlib.Path(sys.argv[1]).resolve()
CAMERA = {"model": sys.argv[3]} if len(sys.argv) > 3 else small_mirror.CAMERA
ARRIVED_WITHIN_M = 0.3
STANDS_WITHIN_S = 0.5
AT_S = 5


def fault(kind, **more):
    return {"from": "hall", "to": "kitchen", "faults": [{"kind": kind, "at_s": AT_S, **more}]}


MISSIONS = {
    "a third covered": fault("camera_occluded", for_s=5, share=0.34),
    "tracking lost": fault("camera_occluded", for_s=2, share=1.0),
    "lost for long": fault("camera_occluded", for_s=12, share=1.0),
    "covered for good": fault("camera_occluded", for_s=60, share=1.0),
    "picture frozen": fault("camera_frozen", for_s=60),
    "laser silent": fault("scan_lost", for_s=3),
    "link cut": fault("link_lost", for_s=3),
    "agent frozen": fault("agent_frozen", for_s=2),
    "agent frozen for a moment": fault("agent_frozen", for_s=0.7),
    "wheels slip": fault("wheel_slip", for_s=4, share=0.5),
    "box in the way": fault("obstacle"),
    "box for a while": fault("obstacle", for_s=8),
    "stopped by hand": fault("stop", for_s=0.2),
    "kidnapped": fault("kidnapped"),
    "moved furniture": {"from": "kitchen", "to": "hall", "moved_furniture": 1},
}
UNSEEING = {"covered for good": "way_not_recognised", "picture frozen": "camera_silent"}
REASONS = {
    "laser silent": "range_sensor_silent",
    "link cut": "link_lost",
    "agent frozen": "computer_held_up",
    "agent frozen for a moment": "computer_held_up",
    "stopped by hand": "stopped_by_hand",
}


def cause(reason):
    """The code of what was wrong first."""
    while "because" in reason["parameters"]:
        reason = reason["parameters"]["because"]
    return reason["code"]


def run(folder, name, content):
    file = folder / name
    file.write_text(json.dumps(content))
    return subprocess.run([BIN / "homeward", "simulate", "run", "--scenario", file, "--json"], capture_output=True,
                          text=True)


class Faults(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scenario = {"format": "homeward-scenario", "version": 1, "world": "house:1", "seed": 1,
                    "camera": CAMERA,
                    "tour": {"rooms": ["kitchen", "hall", "living_room", "hall"], "light": "day"},
                    "missions": list(MISSIONS.values())}
        with tempfile.TemporaryDirectory(prefix="homeward-faults-") as folder:
            done = run(pathlib.Path(folder), "scenario.json", scenario)
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        lines = [json.loads(line) for line in done.stdout.splitlines()]
        cls.results = dict(zip(MISSIONS, lines, strict=True))
        for name, result in cls.results.items():
            print(f"{name}: {json.dumps(result)}", file=sys.stderr)

    def expect_arrival(self, name):
        result = self.results[name]
        self.assertTrue(result["arrived"], result)
        self.assertLessEqual(result["final_error_m"], ARRIVED_WITHIN_M, result)

    def test_nothing_is_touched(self):
        for name, result in self.results.items():
            with self.subTest(name):
                self.assertEqual(result["collisions"], 0, result)

    def test_nothing_moves_after_a_stop(self):
        for name, result in self.results.items():
            with self.subTest(name):
                self.assertEqual(result["moved_after_stop"], 0, result)

    def test_a_covered_part_of_the_picture_does_not_keep_it_from_arriving(self):
        self.expect_arrival("a third covered")

    def test_it_arrives_although_it_sees_nothing_for_two_seconds(self):
        self.expect_arrival("tracking lost")
        self.assertEqual(self.results["tracking lost"]["stops"], [])

    def test_it_looks_again_where_it_is_and_goes_on_after_it_was_lost(self):
        self.expect_arrival("lost for long")
        result = self.results["lost for long"]
        self.assertGreaterEqual(result["detours"], 1, result)
        self.assertEqual(cause(result["stops"][0]["reason"]), "way_not_recognised")

    def test_without_pictures_it_stops_for_good_and_says_why(self):
        for name, code in UNSEEING.items():
            with self.subTest(name):
                result = self.results[name]
                self.assertFalse(result["arrived"], result)
                self.assertEqual(len(result["stops"]), 1, result)
                self.assertEqual(cause(result["stops"][0]["reason"]), code)

    def test_what_must_stop_it_does_and_says_why(self):
        for name, code in REASONS.items():
            with self.subTest(name):
                result = self.results[name]
                self.assertFalse(result["arrived"], result)
                self.assertEqual(len(result["stops"]), 1, result)
                self.assertEqual(cause(result["stops"][0]["reason"]), code)
                self.assertEqual(result["detours"], 0, "only a person sets it going again")

    def test_it_stands_in_time(self):
        for name in REASONS:
            with self.subTest(name):
                stand_after_s = self.results[name]["stops"][0]["stand_after_s"]
                self.assertGreater(stand_after_s, 0.0, "it stood before anything happened")
                self.assertLessEqual(stand_after_s, STANDS_WITHIN_S)

    def test_it_arrives_although_its_wheels_slip(self):
        self.expect_arrival("wheels slip")

    def test_a_box_in_the_way_is_passed_or_named(self):
        for name in ("box in the way", "box for a while"):
            with self.subTest(name):
                result = self.results[name]
                if result["arrived"]:
                    self.expect_arrival(name)
                else:
                    self.assertIn(cause(result["stops"][-1]["reason"]), ("way_blocked", "way_blocked_or_elsewhere"), result)

    def test_a_kidnapped_robot_is_put_down_elsewhere_and_the_result_says_whether_it_told(self):
        result = self.results["kidnapped"]
        self.assertAlmostEqual(result["kidnapped_at_s"], AT_S, delta=0.11)
        if result["told_after_s"] is None:
            self.assertTrue(result["arrived"], result)
        else:
            self.assertGreater(result["told_after_s"], 0.0)
            if not result["stops"]:  # it said so, looked around and found its way
                self.expect_arrival("kidnapped")

    def test_moved_furniture_is_seen_and_driven_round(self):
        result = self.results["moved furniture"]
        self.assertGreaterEqual(result["moved_furniture"], 8, result)
        self.expect_arrival("moved furniture")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
