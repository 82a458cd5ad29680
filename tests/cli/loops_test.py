#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`homeward loops`: a tour that is gone through a second time, and what it says to bad folders."""

import shutil
import sys
import unittest
from pathlib import Path

from program import CliTest, Program, write_png


class Loops(CliTest):
    def command(self, images="tour", camera="tour/camera.json"):
        return ("loops", "--images", images, "--camera", camera)

    def twice(self):
        """The tour's pictures, and once more under later names."""
        tour = self.tour()
        names = sorted(file.name for file in tour.glob("*.jpg"))
        for name in names:
            shutil.copy(tour / name, tour / f"again_{name}")
        return names

    def test_the_second_time_every_picture_is_known(self):
        names = self.twice()
        lines = self.lines_of(*self.command(), "--gap", len(names))
        self.assertEqual([line["image"] for line in lines], names + [f"again_{name}" for name in names])
        for line in lines:
            self.assertEqual(set(line), {"image", "match", "score", "ms"})
            self.assertGreater(line["ms"], 0)
        for line in lines[:len(names)]:
            self.assertIsNone(line["match"])
            self.assertIsNone(line["score"])
        self.assertEqual([line["match"] for line in lines[len(names):]], names)
        for line in lines[len(names):]:
            self.assertGreater(line["score"], 0)
            self.assertLessEqual(line["score"], 1)

    def test_a_match_is_old_enough(self):
        names = self.twice()
        order = {name: i for i, name in enumerate(names + [f"again_{name}" for name in names])}
        lines = self.lines_of(*self.command(), "--gap", len(names) + 2)
        matched = [line for line in lines if line["match"]]
        self.assertGreater(len(matched), 0)
        for line in matched:
            self.assertGreaterEqual(order[line["image"]] - order[line["match"]], len(names) + 2)

    def test_the_same_command_says_the_same(self):
        self.twice()
        once, again = ([(line["match"], line["score"]) for line in self.lines_of(*self.command(), "--gap", 3)] for _ in range(2))
        self.assertEqual(once, again)

    def test_fewer_pictures_than_the_gap(self):
        self.tour()
        for line in self.lines_of(*self.command(), "--gap", 1000):
            self.assertIsNone(line["match"])

    def test_bad_folders(self):
        self.tour()
        (self.folder / "empty").mkdir()
        (self.folder / "other").mkdir()
        write_png(self.folder / "other" / "a.png", 320, 240, 90)
        (self.folder / "broken").mkdir()
        whole = next((self.folder / "tour").glob("*.jpg")).read_bytes()
        (self.folder / "broken" / "half.jpg").write_bytes(whole[:len(whole) // 2])
        self.assert_refused(2, ["empty"], *self.command(images="empty"))
        self.assert_refused(3, ["nowhere"], *self.command(images="nowhere"))
        self.assert_refused(2, ["a.png"], *self.command(images="other"))
        self.assert_refused(2, ["half.jpg"], *self.command(images="broken"))
        self.assert_refused(3, ["none.json"], *self.command(camera="none.json"))
        self.assert_refused(2, ["--gap"], *self.command(), "--gap", 0)


if __name__ == "__main__":
    executable = sys.argv.pop(1)
    CliTest.program = Program(executable, Path(executable).parent / "cli-cache")
    unittest.main()
