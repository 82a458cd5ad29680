#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a person should look at in a map, asked and answered on the command line."""

import json
import sys
import unittest
from pathlib import Path

from program import CliTest, Program


class Doubts(CliTest):
    def doubts(self, file, *more):
        return json.loads(self.result_of("map", "doubts", file, "--json", *more))

    def edit(self, *edits, file, out):
        (self.folder / "edits.json").write_text(json.dumps({"edits": list(edits)}))
        self.result_of("map", "edit", "--map", file, "--edits", "edits.json", "--out", out, "--tour", self.shared / "tour")

    def test_a_page_of_the_list(self):
        self.good_map()
        first = self.doubts("good.map", "--limit", "1")
        self.assertEqual([first["format"], first["offset"], first["map"]], ["homeward-doubts", 0, "good.map"])
        self.assertLessEqual(len(first["doubts"]), 1)
        every = self.doubts("good.map", "--limit", "1000", "--threads", "1")
        self.assertEqual(every["total"], len(every["doubts"]))
        weights = [doubt["weight"] for doubt in every["doubts"]]
        self.assertEqual(weights, sorted(weights, reverse=True))
        self.assertEqual(every["doubts"][:1], first["doubts"])
        self.assertIn("doubts", self.result_of("map", "doubts", "good.map"))

    def test_a_way_that_a_person_drew_is_not_asked_about(self):
        self.good_map()
        places = json.loads(self.result_of("map", "export", "good.map", "--format", "json"))["places"]
        ends = [places[0]["id"], places[len(places) // 2]["id"]]
        self.edit({"kind": "add_edge", "from": ends[0], "to": ends[1]}, file="good.map", out="drawn.map")
        def ways(*more):
            return [doubt for doubt in self.doubts("drawn.map", "--kind", "way", "--limit", "1000", *more)["doubts"]
                    if {doubt["place_a"], doubt["place_b"]} == set(ends)]
        self.assertEqual(ways(), [])
        said = ways("--about", "decided", "--place", ends[0])
        self.assertEqual([doubt["by"] for doubt in said], ["person"])
        self.edit(*said[0]["if_no"], file="drawn.map", out="gone.map")
        difference = json.loads(self.result_of("map", "diff", "good.map", "gone.map", "--json"))
        self.assertEqual(difference["edges"], [])

    def test_what_is_not_there_is_refused(self):
        self.good_map()
        self.assert_refused(3, ["p999"], "map", "doubts", "good.map", "--place", "p999")
        self.assert_refused(3, ["none.map"], "map", "doubts", "none.map")


if __name__ == "__main__":
    executable = sys.argv.pop(1)
    CliTest.program = Program(executable, Path(executable).parent / "cli-cache")
    unittest.main()
