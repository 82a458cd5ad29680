#!/usr/bin/env python3
"""In a hospital whose halves look alike the chair never says that it has arrived where it is not, and says so when it was
carried off. Many missions in many hospitals: tests/bench/quality/wards_missions.py.

usage: wards_test.py BIN_FOLDER WEB_FOLDER
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

BIN = pathlib.Path(sys.argv[1]).resolve()
THERE_M = 0.5
MISSIONS = [
    {"from": "ward_1", "to": "ward_7"},  # two wards of which each has its like in the other half
    {"from": "ward_7", "to": "ward_1", "faults": [{"kind": "kidnapped", "at_s": 10}]},
]
SCENARIO = {
    "format": "homeward-scenario", "version": 1, "world": "wards:4", "seed": 4, "camera": {"model": "hyperbolic_mirror"},
    "tour": {"rooms": ["corridor_1", "ward_1", "ward_2", "corridor_2", "ward_6", "ward_7", "corridor_1"], "light": "day"},
    "missions": MISSIONS,
}


class Wards(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory(prefix="homeward-wards-") as folder:
            file = pathlib.Path(folder) / "scenario.json"
            file.write_text(json.dumps(SCENARIO))
            done = subprocess.run([BIN / "homeward", "simulate", "run", "--scenario", file, "--json"], check=True,
                                  capture_output=True, text=True)
        cls.results = [json.loads(line) for line in done.stdout.splitlines()]

    def test_every_mission_is_driven_and_touches_nothing(self):
        self.assertEqual(len(self.results), len(MISSIONS))
        for result in self.results:
            self.assertEqual(result["collisions"], 0, result)

    def test_it_says_that_it_has_arrived_only_where_it_has(self):
        for result in self.results:
            with self.subTest(start=result["from"], to=result["to"]):
                if result["arrived"]:
                    self.assertLess(result["final_error_m"], THERE_M, result)
                    self.assertGreaterEqual(result["arrival_probability"], 0.9, result)
                else:
                    self.assertTrue(result["stops"] and result["stops"][-1]["reason"], result)

    def test_undisturbed_it_arrives(self):
        self.assertTrue(self.results[0]["arrived"], self.results[0])

    def test_carried_off_to_a_place_that_looks_alike_it_says_so(self):
        result = self.results[1]
        self.assertIn("kidnapped_at_s", result)
        self.assertIsNotNone(result["told_after_s"], result)
        self.assertLessEqual(result["told_after_s"], 5.0, result)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
