#!/usr/bin/env python3
"""A robot explores a building that looks alike all over, with some of its doors shut, by itself; the map of it covers what
it can reach.

usage: explore_test.py BIN_FOLDER WEB_FOLDER
"""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

BIN = pathlib.Path(sys.argv[1]).resolve()
PICTURES_APART_M = 0.7  # at most, on the whole tour
KNOWS_WITHIN_M = 0.25   # where its pictures were taken, from the first one


def homeward(*arguments):
    return subprocess.run([BIN / "homeward", *map(str, arguments)], check=True, capture_output=True, text=True).stdout


def rows(file):
    with open(file, newline="") as table:
        return list(csv.DictReader(table))


def poses(file):
    return [tuple(float(row[key]) for key in ("x_m", "y_m", "theta_rad")) for row in rows(file)]


def seen_from(origin, pose):
    """A pose in the frame of another."""
    dx, dy = pose[0] - origin[0], pose[1] - origin[1]
    c, s = math.cos(origin[2]), math.sin(origin[2])
    return c * dx + s * dy, -s * dx + c * dy


class Exploration(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="homeward-explore-")
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.out = cls.folder / "offices"
        cls.told = json.loads(homeward("explore", "--world", "offices:2301", "--seed", 2301, "--shut-doors", 0.3, "--out", cls.out,
                                       "--json"))

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_it_covers_what_it_can_reach_and_touches_nothing(self):
        self.assertEqual((self.told["ended"], self.told["reason"]), ("complete", None), self.told)
        self.assertGreaterEqual(self.told["covered"], 0.95, self.told)
        self.assertEqual(self.told["collisions"], 0, self.told)

    def test_its_map_has_no_wrong_ways_and_is_one_piece(self):
        self.assertEqual(self.told["wrong_edges"], 0, self.told)
        self.assertEqual(self.told["mixed_places"], 0, self.told)
        inspected = json.loads(homeward("map", "inspect", self.out / "map.hwmap", "--json"))
        self.assertEqual(len(inspected["places"]), self.told["nodes"])
        beside = {}
        for edge in inspected["edges"]:
            beside.setdefault(edge["from"], set()).add(edge["to"])
            beside.setdefault(edge["to"], set()).add(edge["from"])
        reached, left = set(), [inspected["places"][0]["id"]]
        while left:
            place = left.pop()
            if place not in reached:
                reached.add(place)
                left += beside.get(place, ())
        self.assertEqual(len(reached), len(inspected["places"]))

    def test_what_it_drove_is_a_tour_like_any_other(self):
        tour = self.out / "tour"
        truth, said = poses(tour / "poses.csv"), poses(tour / "odometry.csv")
        self.assertEqual(len(truth), self.told["pictures"])
        self.assertEqual(len(said), len(truth))
        self.assertEqual(len(list(tour.glob("*.jpg"))), len(truth))
        self.assertEqual(len(rows(tour / "scans.csv")), len(truth))
        self.assertLess(max(math.dist(a[:2], b[:2]) for a, b in zip(truth, truth[1:])), PICTURES_APART_M)
        off = [math.dist(seen_from(truth[0], there), seen_from(said[0], here)) for there, here in zip(truth, said)]
        self.assertLess(max(off), KNOWS_WITHIN_M)

    def test_its_picture_of_the_plan_is_written(self):
        self.assertEqual((self.out / "plan.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def states_of(self, out):
        table = self.folder / f"{out.name}-states.csv"
        homeward("replay", out / "exploration.hwrec", "--states", table)
        return rows(table)

    def test_its_recording_tells_what_it_found_and_decided(self):
        states = self.states_of(self.out)
        self.assertEqual(list(states[0]), ["step", "after_s", "state", "picture", "x_m", "y_m", "theta_rad", "known", "agreement",
                                           "place_x_m", "place_y_m", "gain_m2", "cost_m", "end"])
        of = {name: [row for row in states if row["state"] == name]
              for name in ("new", "known_again", "next_place", "reached", "ended")}
        pictures = sorted(int(row["picture"]) for row in of["new"] + of["known_again"])
        self.assertEqual(pictures, list(range(self.told["pictures"])))
        self.assertGreater(len(of["known_again"]), 0)
        for row in of["known_again"]:
            self.assertLess(int(row["known"]), int(row["picture"]))
            self.assertGreater(float(row["agreement"]), 0.5)
        self.assertGreater(len(of["next_place"]), 10)
        self.assertGreater(min(float(row["gain_m2"]) for row in of["next_place"]), 0.0)
        self.assertGreater(len(of["reached"]), 10)
        self.assertEqual([row["end"] for row in of["ended"]], ["all_seen"])
        self.assertEqual(states[-1]["state"], "ended")
        self.assertLessEqual(float(states[-1]["after_s"]), self.told["duration_s"])

    def test_the_thesis_s_method_is_recorded_too(self):
        out = self.folder / "thesis"
        told = json.loads(homeward("explore", "--method", "thesis", "--world", "laboratory:1", "--seed", 1, "--limit-m", 5,
                                   "--out", out, "--json"))
        self.assertEqual(told["ended"], "limit")
        self.assert_replays(out / "exploration.hwrec", "exploration_limit")
        states = self.states_of(out)
        self.assertEqual(list(states[0]), ["step", "after_s", "state", "nodes", "dissimilarity", "direction_rad", "left_rad"])
        self.assertEqual([(row["state"], row["nodes"]) for row in states],
                         [({"Exploration": "exploration", "Exploration(Homing)": "exploration_homing",
                            "Path planning": "path_planning", "EXPLORATION DONE": "done"}[row["state"]], row["nodes"])
                          for row in told["rows"]])
        self.assertEqual(states[0]["state"], "exploration")
        self.assertNotEqual(states[0]["direction_rad"], "")

    def assert_replays(self, recording, reason):
        """To the end, and bit for bit."""
        replayed = json.loads(homeward("replay", recording, "--json"))
        self.assertEqual((replayed["complete"], replayed["differences"]), (True, 0), replayed)
        self.assertEqual(replayed["compared"], replayed["steps"])
        self.assertEqual(replayed["why_stopped"]["state"], "arrived")
        self.assertEqual(replayed["why_stopped"]["reason"]["code"], reason)

    def test_it_ends_at_a_limit_and_maps_what_it_has_seen(self):
        told = json.loads(homeward("explore", "--world", "offices:42", "--seed", 2, "--limit-m", 6, "--pictures-every", 5,
                                   "--out", self.folder / "little", "--json"))
        self.assertEqual(told["ended"], "limit")
        self.assertLess(told["driven_m"], 6.5)
        self.assertGreaterEqual(told["driven_m"], 6.0)
        self.assertGreater(told["nodes"], 0)
        self.assertEqual(sorted(file.name for file in (self.folder / "little").glob("plan-*.png")),
                         [f"plan-{number:04}.png" for number in range(5, told["pictures"] + 1, 5)])
        self.assertGreater(told["pictures"], 5)
        self.assert_replays(self.folder / "little" / "exploration.hwrec", "exploration_limit")
        self.assertEqual(self.states_of(self.folder / "little")[-1]["end"], "limit")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
