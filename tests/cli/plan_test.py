#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`homeward simulate plan`: the file that it writes, what changes in it, and what bad input gets."""

import json
import sys
import unittest
from pathlib import Path

from program import CliTest, Program

KEYS = {"lines", "triangles", "objects", "missing", "moved"}


class DrawnPlans(CliTest):
    @classmethod
    def setUpClass(cls):
        """No tour is needed here."""

    def plan(self, name, *options):
        answer = json.loads(self.result_of("simulate", "plan", "--world", "offices:1", "--out", name, "--json", *options))
        self.assertEqual(set(answer), KEYS)
        return answer

    def test_a_plan_is_a_file_of_lines_and_faces(self):
        answer = self.plan("plan.wrl")
        self.assertGreater(answer["lines"], 300)
        self.assertGreater(answer["objects"], 10)
        self.assertEqual((answer["missing"], answer["moved"]), (0, 0))
        text = (self.folder / "plan.wrl").read_text()
        self.assertTrue(text.startswith("#VRML V2.0 utf8\n"))
        self.assertEqual(text.count("-1\n"), answer["lines"] + answer["triangles"])

    def test_shares_of_the_objects_are_left_out_and_moved(self):
        whole = self.plan("whole.wrl")
        old = self.plan("old.wrl", "--missing", 0.25, "--moved", 0.25)
        self.assertEqual(old["objects"], whole["objects"])
        self.assertEqual(old["missing"], int(0.25 * whole["objects"] + 0.5))
        self.assertGreater(old["moved"], 0)
        self.assertLessEqual(old["moved"], int(0.25 * whole["objects"] + 0.5))
        self.assertLess(old["triangles"], whole["triangles"])
        again = self.plan("again.wrl", "--missing", 0.25, "--moved", 0.25)
        other = self.plan("other.wrl", "--missing", 0.25, "--moved", 0.25, "--seed", 2)
        self.assertEqual(again, old)
        read = {name: (self.folder / f"{name}.wrl").read_bytes() for name in ("old", "again", "other")}
        self.assertEqual(read["again"], read["old"])
        self.assertNotEqual(read["other"], read["old"])
        self.assertEqual(other["missing"], old["missing"])

    def test_it_says_what_it_wrote(self):
        said = self.result_of("simulate", "plan", "--world", "offices:1", "--out", "plan.wrl", "--missing", 0.5)
        for word in ("lines", "triangles", "objects", "left out", "moved", "plan.wrl"):
            self.assertIn(word, said)

    def test_bad_input_is_refused(self):
        plan = ("simulate", "plan", "--out", "plan.wrl", "--world")
        self.assert_refused(3, ["nowhere.json"], *plan, "nowhere.json")
        self.assert_refused(2, ["--missing"], *plan, "offices:1", "--missing", 1.5)
        self.assert_refused(2, ["--moved"], *plan, "offices:1", "--moved", -0.1)
        self.assert_refused(2, ["no more than 1 together"], *plan, "offices:1", "--missing", 0.6, "--moved", 0.6)
        self.assert_refused(2, ["--world"], "simulate", "plan", "--out", "plan.wrl")
        self.assert_refused(5, ["no/plan.wrl"], "simulate", "plan", "--world", "offices:1", "--out", "no/plan.wrl")

    def test_a_file_that_is_there_is_kept(self):
        (self.folder / "plan.wrl").write_text("mine")
        self.assert_refused(4, ["plan.wrl", "already"], "simulate", "plan", "--world", "offices:1", "--out", "plan.wrl")


if __name__ == "__main__":
    executable = sys.argv.pop(1)
    CliTest.program = Program(executable, Path(executable).parent / "cli-cache")
    unittest.main()
