#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`homeward simulate tour --people`: who is about is seen by the camera and the range sensor, and by nothing else."""

import csv
import sys
import unittest
from pathlib import Path

from program import CliTest, Program

# Without people this is the tour that all tests share.
TOUR = ("simulate", "tour", "--world", "offices:1", "--rooms", "corridor,office_1", "--step-m", 1, "--marks", "--camera",
        "equirectangular")


class AmongPeople(CliTest):
    def rows(self, file):
        with open(file) as lines:
            return list(csv.reader(lines))

    def tour_among(self, people, name, *options):
        said = self.result_of(*TOUR, "--people", people, "--out", name, *options)
        self.assertIn("2 destinations", said)
        return self.folder / name

    def test_pictures_and_sweeps_show_them_and_the_way_is_the_same(self):
        alone, among = self.shared / "tour", self.tour_among(8, "among")
        self.assertEqual({file.name for file in among.iterdir()}, {file.name for file in alone.iterdir()})
        pictures = sorted(file.name for file in alone.glob("*.jpg"))
        changed = [name for name in pictures if (alone / name).read_bytes() != (among / name).read_bytes()]
        self.assertGreater(len(changed), len(pictures) // 2)
        for name in ("poses.csv", "tour.json", "camera.json", "scans.json"):
            self.assertEqual((among / name).read_bytes(), (alone / name).read_bytes(), name)
        odometry = [[row[1:] for row in self.rows(tour / "odometry.csv")] for tour in (alone, among)]
        self.assertEqual(odometry[0], odometry[1])

        nearer = 0
        for before, now in zip(self.rows(alone / "scans.csv")[1:], self.rows(among / "scans.csv")[1:], strict=True):
            self.assertEqual(len(before), len(now))
            for without, with_people in zip(before[1:], now[1:], strict=True):
                # They hide what is behind them; a ray's noise is the same.
                self.assertLessEqual(float(with_people), float(without))
                nearer += float(with_people) < float(without) - 0.2
        self.assertGreater(nearer, 20)

    def test_it_takes_as_long_or_longer(self):
        alone, among = (self.rows(tour / "times.csv")[1:] for tour in (self.shared / "tour", self.tour_among(8, "among")))
        times = [[int(row[1]) for row in rows] for rows in (alone, among)]
        self.assertEqual(times[0][0], times[1][0])
        for before, now in zip(zip(times[0], times[0][1:]), zip(times[1], times[1][1:]), strict=True):
            self.assertGreaterEqual(now[1] - now[0], before[1] - before[0])

    def test_the_same_seed_gives_the_same_bytes(self):
        one, two = self.tour_among(4, "one"), self.tour_among(4, "two")
        for file in sorted(one.iterdir()):
            self.assertEqual(file.read_bytes(), (two / file.name).read_bytes(), file.name)

    def test_nobody_is_the_tour_without_them(self):
        nobody = self.tour_among(0, "nobody")
        for file in sorted((self.shared / "tour").iterdir()):
            self.assertEqual(file.read_bytes(), (nobody / file.name).read_bytes(), file.name)

    def test_bad_numbers_of_people(self):
        for people in ("-1", "51", "some", "1.5"):
            self.assert_refused(2, ["--people", people], *TOUR, "--people", people, "--out", "new")

    def test_help_names_it(self):
        self.assertIn("People who walk about", self.result_of("simulate", "tour", "--help"))


if __name__ == "__main__":
    executable = sys.argv.pop(1)
    CliTest.program = Program(executable, Path(executable).parent / "cli-cache")
    unittest.main()
