#!/usr/bin/env python3
"""Eight offices that look nearly the same never share a place, whatever the order of the tour.

usage: look_alike_test.py BIN_FOLDER WEB_FOLDER
"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

BIN = pathlib.Path(sys.argv[1]).resolve()
ORDERS = ["12345678", "81726354", "37152648"]


def build(folder, order, seed):
    """The places of one tour as lists of rooms, and the map's number of components."""
    rooms = ["corridor"] + [f"office_{number}" for number in order] + ["corridor"]
    tour = folder / f"tour{seed}"
    file = folder / f"{seed}.map"
    subprocess.run([BIN / "homeward", "simulate", "tour", "--world", "offices:1", "--rooms", ",".join(rooms), "--step-m", "0.6",
                    "--seed", str(seed), "--out", tour], check=True, stdout=subprocess.DEVNULL)
    truth = tour / "poses.csv"
    with open(truth, newline="") as table:
        room_of = {row["filename"]: row["room"] for row in csv.DictReader(table)}
    truth.unlink()  # no method may read it
    subprocess.run([BIN / "homeward", "map", "build", "--tour", tour, "--camera", tour / "camera.json", "--out", file],
                   check=True, stdout=subprocess.DEVNULL)
    inspected = json.loads(subprocess.run([BIN / "homeward", "map", "inspect", file, "--json"], check=True,
                                          capture_output=True, text=True).stdout)
    places = {place["id"]: {room_of[member.split("/")[-1]] for member in place["members"]} for place in inspected["places"]}
    return places, inspected


class LookAlikes(unittest.TestCase):
    def test_no_two_offices_share_a_place(self):
        with tempfile.TemporaryDirectory(prefix="homeward-offices-") as name:
            for seed, order in enumerate(ORDERS, start=1):
                with self.subTest(order=order):
                    places, inspected = build(pathlib.Path(name), order, seed)
                    mixed = {place: rooms for place, rooms in places.items()
                             if len({room for room in rooms if room.startswith("office")}) > 1}
                    self.assertEqual(mixed, {})
                    offices = set().union(*places.values()) - {"corridor", ""}
                    self.assertEqual(len(offices), 8, "every office is in the map")
                    self.assertGreater(sum(h["decision"] == "accepted" for h in inspected["hypotheses"]), 0,
                                       "the corridor is driven again and again: some loops must close")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
