#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`homeward retrieve`: a gallery and queries of the rendered tour, and what it says to bad tables."""

import math
import sys
import unittest
from pathlib import Path

from program import CliTest, Program


class Retrieve(CliTest):
    def tables(self):
        """Every second picture of the tour is the gallery, the others ask."""
        tour = self.tour(without=())
        names = sorted(file.name for file in tour.glob("*.jpg"))
        (tour / "gallery.csv").write_text("filename\n" + "\n".join(names[::2]) + "\n")
        (tour / "queries.csv").write_text("filename,note\n" + "".join(name + ",x\n" for name in names[1::2]))
        return names

    def command(self, gallery="tour/gallery.csv", queries="tour/queries.csv"):
        return ("retrieve", "--gallery", gallery, "--queries", queries, "--camera", "tour/camera.json")

    def test_a_query_finds_a_neighbour(self):
        names = self.tables()
        rows = [line.split(",") for line in (self.folder / "tour/poses.csv").read_text().splitlines()[1:]]
        at = {row[0]: (float(row[1]), float(row[2])) for row in rows}
        lines = self.lines_of(*self.command(), "--k", 3)
        self.assertEqual([line["query"] for line in lines], names[1::2])
        near = 0
        for line in lines:
            self.assertEqual(len(line["top"]), 3)
            self.assertGreaterEqual(line["ms"], 0)
            scores = [one["score"] for one in line["top"]]
            self.assertEqual(scores, sorted(scores, reverse=True))
            near += math.dist(at[line["query"]], at[line["top"][0]["image"]]) < 1.6
        self.assertGreaterEqual(near / len(lines), 0.9)

    def test_the_same_command_says_the_same(self):
        self.tables()
        once, again = ([line["top"] for line in self.lines_of(*self.command())] for _ in range(2))
        self.assertEqual(once, again)

    def test_the_index_alone_answers(self):
        names = self.tables()
        lines = self.lines_of(*self.command(queries="tour/gallery.csv"), "--rerank", 0)
        self.assertEqual([line["top"][0]["image"] for line in lines], names[::2])

    def test_bad_tables(self):
        self.tables()
        (self.folder / "tour/none.csv").write_text("filename\n")
        (self.folder / "tour/other.csv").write_text("picture\n00000.jpg\n")
        (self.folder / "tour/gone.csv").write_text("filename\ngone.jpg\n")
        (self.folder / "tour/uneven.csv").write_text("filename\n00000.jpg,3\n")
        self.assert_refused(2, ["none.csv", "no pictures"], *self.command(gallery="tour/none.csv"))
        self.assert_refused(2, ["other.csv", "filename"], *self.command(queries="tour/other.csv"))
        self.assert_refused(3, ["gone.jpg"], *self.command(gallery="tour/gone.csv"))
        self.assert_refused(2, ["uneven.csv:2"], *self.command(gallery="tour/uneven.csv"))
        self.assert_refused(3, ["nowhere.csv"], *self.command(queries="nowhere.csv"))


if __name__ == "__main__":
    executable = sys.argv.pop(1)
    CliTest.program = Program(executable, Path(executable).parent / "cli-cache")
    unittest.main()
