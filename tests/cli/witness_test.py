#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`homeward localise --plan`: what a drawn plan under a map says of the places that are believed, and what bad input gets."""

import csv
import json
import math
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

from program import CliTest, Program


class MapOnAPlan(CliTest):
    """A tour of an office and the corridor, its map, and the plan of the building as it was before somebody moved things."""

    @classmethod
    def setUpClass(cls):
        cls.shared = Path(tempfile.mkdtemp(prefix="homeward-witness-"))
        unittest.addModuleCleanup(shutil.rmtree, cls.shared, ignore_errors=True)
        for command in (("simulate", "tour", "--world", "offices:1", "--rooms", "office_1,corridor,office_2", "--step-m", 0.3, "--out", "drive"),
                        ("simulate", "plan", "--world", "offices:1", "--out", "old.wrl", "--missing", 0.2, "--moved", 0.1),
                        ("map", "build", "--tour", "drive", "--camera", "drive/camera.json", "--out", "offices.map")):
            made = cls.program.run(*command, cwd=cls.shared)
            assert made.returncode == 0, made.stderr
        with open(cls.shared / "drive" / "poses.csv") as file:
            cls.poses = {row["filename"]: (float(row["x_m"]), float(row["y_m"])) for row in csv.DictReader(file)}
        inspected = cls.program.run("map", "inspect", "offices.map", "--json", cwd=cls.shared)
        cls.places = {place["id"]: cls.poses[place["prototype"].split("/")[-1]]
                      for place in json.loads(inspected.stdout)["places"]}

    def pins(self, off_m=None, name="pins.json"):
        """Pins of all places, where they truly are, but for those in `off_m`."""
        pins = []
        for place, (x_m, y_m) in self.places.items():
            dx_m, dy_m = (off_m or {}).get(place, (0.0, 0.0))
            pins.append({"place": place, "x_m": x_m + dx_m, "y_m": y_m + dy_m})
        (self.folder / name).write_text(json.dumps({"plan": "plan1", "pins": pins}))
        return name

    def localise(self, *options):
        start = min(self.places, key=lambda place: math.dist(self.places[place], next(iter(self.poses.values()))))
        return self.lines_of("localise", "--map", self.shared / "offices.map", "--images", self.shared / "drive",
                             "--start", start, *options)

    def test_on_its_own_plan_no_place_is_impossible(self):
        alone = self.localise()
        lines = self.localise("--plan", self.shared / "old.wrl", "--pins", self.pins())
        for line, without in zip(lines, alone):
            plan = line.pop("plan")
            self.assertNotEqual(plan["place"], "impossible", line)
            self.assertEqual({**line, "ms": 0}, {**without, "ms": 0})
            self.assertEqual(plan["x_m"] is None, plan["lost"])
            line["plan"] = plan
        spoken = [line for line in lines if line["plan"]["place"] == "possible"]
        self.assertGreater(len(spoken), 0.3 * len(lines))
        for line in spoken:
            self.assertLess(math.dist((line["plan"]["x_m"], line["plan"]["y_m"]), self.poses[line["image"]]), 0.5)

    def test_a_place_that_is_elsewhere_on_the_plan_is_told_as_unsure(self):
        known = [line for line in self.localise("--plan", self.shared / "old.wrl", "--pins", self.pins())
                 if line["plan"]["place"] == "possible"]
        wrong = known[len(known) // 2]["place"]
        lines = self.localise("--plan", self.shared / "old.wrl", "--pins", self.pins({wrong: (0.0, 9.0)}, "wrong.json"))
        impossible = [line for line in lines if line["plan"]["place"] == "impossible"]
        self.assertGreater(len(impossible), 0)
        self.assertEqual({line["place"] for line in impossible}, {wrong})
        for line in impossible:
            self.assertTrue(line["plan"]["trusted"])
            self.assertLessEqual(line["probability"], 0.5)
            self.assertLessEqual(line["near_share"], 0.5)
            self.assertFalse(line["lost"])

    def test_bad_input_is_refused(self):
        command = ("localise", "--map", self.shared / "offices.map", "--images", self.shared / "drive")
        plan = ("--plan", self.shared / "old.wrl")
        self.assert_refused(2, ["--pins"], *command, *plan)
        self.assert_refused(2, ["--plan"], *command, "--pins", self.pins())
        self.assert_refused(3, ["nowhere.json"], *command, *plan, "--pins", "nowhere.json")
        self.assert_refused(3, ["nowhere.wrl"], *command, "--plan", "nowhere.wrl", "--pins", self.pins())
        (self.folder / "text.json").write_text("pins")
        self.assert_refused(2, ["text.json"], *command, *plan, "--pins", "text.json")
        (self.folder / "one.json").write_text(json.dumps({"plan": "plan1", "pins": [{"place": "p1", "x_m": 0, "y_m": 0}]}))
        self.assert_refused(2, ["one.json/pins", "two places"], *command, *plan, "--pins", "one.json")
        pins = [{"place": "p1", "x_m": 0, "y_m": 0}, {"place": "cellar", "x_m": 5, "y_m": 0}]
        (self.folder / "cellar.json").write_text(json.dumps({"plan": "plan1", "pins": pins}))
        self.assert_refused(3, ["cellar.json/pins/1/place", "cellar"], *command, *plan, "--pins", "cellar.json")


if __name__ == "__main__":
    executable = sys.argv.pop(1)
    CliTest.program = Program(executable, Path(executable).parent / "cli-cache")
    unittest.main()
