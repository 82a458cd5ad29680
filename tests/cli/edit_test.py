#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A map is edited by hand, compared with what it was, and taken back to exactly that."""

import json
import sys
import unittest
from pathlib import Path

from program import CliTest, Program


class Edit(CliTest):
    def graph(self, file):
        return json.loads(self.result_of("map", "export", file, "--format", "json"))

    def edit(self, *edits, file="good.map", out="edited.map", more=()):
        (self.folder / "edits.json").write_text(json.dumps({"edits": list(edits)}))
        return json.loads(self.result_of("map", "edit", "--map", file, "--edits", "edits.json", "--out", out, *more, "--json"))

    def diff(self, before, after):
        return json.loads(self.result_of("map", "diff", before, after, "--json"))

    def test_edits_are_one_change_that_is_taken_back_exactly(self):
        self.good_map()
        places = self.graph("good.map")["places"]
        large = max(places, key=lambda place: len(place["members"]))
        leaving = next(image for image in large["members"] if image != large["prototype"])
        done = self.edit({"kind": "rename", "place": places[0]["id"], "label": "porch"},
                         {"kind": "split", "place": large["id"], "images": [leaving]},
                         {"kind": "merge", "place": places[-1]["id"], "into": places[0]["id"]},
                         {"kind": "add_destination", "image": leaving, "label": "bay"},
                         more=("--tour", self.shared / "tour", "--by", "anna"))
        self.assertEqual(done["places"], len(places))
        difference = self.diff("good.map", "edited.map")
        changes = {one["id"]: one for one in difference["places"]}
        self.assertEqual(changes[places[0]["id"]]["after"]["label"], "porch")
        self.assertEqual(changes[places[-1]["id"]]["change"], "removed")
        self.assertEqual([one["change"] for one in difference["destinations"]], ["added"])
        words = self.result_of("map", "diff", "good.map", "edited.map")
        self.assertIn("'porch'", words)
        self.assertIn("+ destination", words)
        self.result_of("map", "edit", "--map", "edited.map", "--undo", "--out", "back.map")
        back = self.diff("good.map", "back.map")
        self.assertEqual([back["places"], back["edges"], back["destinations"]], [[], [], []])
        self.assertIn("no difference", self.result_of("map", "diff", "good.map", "back.map"))
        self.result_of("map", "edit", "--map", "back.map", "--redo", "--out", "forth.map")
        self.assertEqual(self.diff("edited.map", "forth.map")["places"], [])
        self.assert_refused(3, ["no change to redo"], "map", "edit", "--map", "forth.map", "--redo", "--out", "x.map")
        self.assertFalse((self.folder / "x.map").exists())

    def test_an_edited_map_is_tried_on_its_tour(self):
        self.good_map()
        same = json.loads(self.result_of("map", "check", "--map", "good.map", "--tour", self.shared / "tour", "--json"))
        self.assertTrue(same["harmless"])
        self.assertEqual(same["right_before"], same["right_after"])
        self.assertGreater(same["right_before"], same["pictures"] / 2)
        places = self.graph("good.map")["places"]
        far = max(places, key=lambda place: max(place["members"]))
        self.edit({"kind": "merge", "place": far["id"], "into": places[0]["id"]})
        done = self.run_program("map", "check", "--map", "edited.map", "--before", "good.map", "--tour", self.shared / "tour")
        self.assertEqual(done.returncode, 4, done.stdout + done.stderr)
        self.assertIn("worse", done.stderr)
        unedited = self.run_program("map", "check", "--map", "edited.map", "--tour", self.shared / "tour")
        self.assertEqual([unedited.returncode, unedited.stdout], [4, done.stdout], "without its edits it is what it was")
        self.assertIn(far["prototype"], done.stdout)

    def test_what_is_refused_names_the_edit_and_writes_nothing(self):
        self.good_map()
        places = self.graph("good.map")["places"]
        def refused(code, words, *edits, more=()):
            (self.folder / "edits.json").write_text(json.dumps({"edits": list(edits)}))
            self.assert_refused(code, words, "map", "edit", "--map", "good.map", "--edits", "edits.json", "--out", "new.map",
                                *more)
            self.assertFalse((self.folder / "new.map").exists())
        rename = {"kind": "rename", "place": places[0]["id"], "label": "porch"}
        refused(3, ["edits/1", "p999"], rename, {"kind": "delete", "place": "p999"})
        refused(2, ["edits/0/label"], {"kind": "rename", "place": "p1"})
        large = max(places, key=lambda place: len(place["members"]))
        leaving = next(image for image in large["members"] if image != large["prototype"])
        refused(4, ["--tour", leaving], {"kind": "split", "place": large["id"], "images": [leaving]})
        (self.folder / "edits.json").write_text("no json")
        self.assert_refused(2, ["not JSON", "edits.json"], "map", "edit", "--map", "good.map", "--edits", "edits.json",
                            "--out", "new.map")
        self.assert_refused(2, ["--edits, --undo and --redo"], "map", "edit", "--map", "good.map", "--out", "new.map")
        self.assert_refused(3, ["no map file"], "map", "diff", "good.map", "absent.map")


if __name__ == "__main__":
    executable = sys.argv.pop(1)
    CliTest.program = Program(executable, Path(executable).parent / "cli-cache")
    unittest.main()
