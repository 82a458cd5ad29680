#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`homeward track`: where on a drawn plan a rendered drive was, what another plan says of it, and what bad input gets."""

import csv
import json
import math
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

from program import CliTest, Program, write_png

TOUR = ("simulate", "tour", "--world", "offices:1", "--rooms", "office_1,corridor", "--step-m", 0.3)


class DrawnPlanAndDrive(CliTest):
    """A drive in an office, its plan as it was before somebody moved things, and the plan of a house."""

    @classmethod
    def setUpClass(cls):
        cls.shared = Path(tempfile.mkdtemp(prefix="homeward-track-"))
        unittest.addModuleCleanup(shutil.rmtree, cls.shared, ignore_errors=True)
        for command in ((*TOUR, "--out", "drive"),
                        ("simulate", "plan", "--world", "offices:1", "--out", "old.wrl", "--missing", 0.2, "--moved", 0.1),
                        ("simulate", "plan", "--world", "house:2", "--out", "house.wrl")):
            made = cls.program.run(*command, cwd=cls.shared)
            assert made.returncode == 0, made.stderr
        with open(cls.shared / "drive" / "poses.csv") as file:
            cls.poses = {row["filename"]: tuple(float(row[key]) for key in ("x_m", "y_m", "theta_rad"))
                         for row in csv.DictReader(file)}
        cls.start = ",".join(str(value) for value in next(iter(cls.poses.values())))

    def track(self, plan, *options):
        said = self.result_of("track", "--model", self.shared / plan, "--camera", self.shared / "drive" / "camera.json",
                              "--images", self.shared / "drive", "--json", *options)
        return [json.loads(line) for line in said.splitlines()]

    def off_m(self, line):
        x_m, y_m, _ = self.poses[line["image"]]
        return math.hypot(line["x_m"] - x_m, line["y_m"] - y_m)

    def test_a_drive_is_followed_on_a_plan_that_is_out_of_date(self):
        lines = self.track("old.wrl", "--start", self.start)
        self.assertEqual([line["image"] for line in lines], sorted(self.poses))
        known = [line for line in lines if not line["lost"]]
        self.assertGreater(len(known), 0.8 * len(lines))
        off = sorted(self.off_m(line) for line in known)
        self.assertLess(off[len(off) // 2], 0.15)
        self.assertLess(off[-1], 0.5)
        for line in lines:
            self.assertLessEqual(line["lines_confirmed"], line["lines_expected"])
            self.assertEqual(line["x_m"] is None, line["lost"])

    def test_sweeps_are_used_when_they_are_named(self):
        lines = self.track("old.wrl", "--start", self.start, "--scans", self.shared / "drive" / "scans.csv")
        off = sorted(self.off_m(line) for line in lines if not line["lost"])
        self.assertLess(off[len(off) // 2], 0.1)

    def test_a_drive_is_not_on_the_plan_of_another_building(self):
        lines = self.track("house.wrl")
        self.assertTrue(all(line["lost"] for line in lines))
        self.assertIn("not_in_plan", [line["why_lost"] for line in lines])

    def test_it_draws_what_it_sees(self):
        few = self.folder / "few"
        few.mkdir()
        for name in sorted(self.poses)[:2]:
            shutil.copy(self.shared / "drive" / name, few)
        self.result_of("track", "--model", self.shared / "old.wrl", "--camera", self.shared / "drive" / "camera.json",
                       "--images", few, "--start", self.start, "--pictures", "drawn")
        for name in sorted(self.poses)[:2]:
            self.assertEqual((self.folder / "drawn" / name).read_bytes()[:2], b"\xff\xd8")

    def test_a_map_is_laid_onto_the_plan_by_where_its_tour_was_tracked(self):
        tracked = self.folder / "tracked.jsonl"
        tracked.write_text("".join(json.dumps(line) + "\n" for line in self.track("old.wrl", "--start", self.start)))
        self.result_of("map", "build", "--tour", self.shared / "drive", "--camera", self.shared / "drive" / "camera.json",
                       "--out", "drive.hwmap")
        pins = ("map", "pins", "--map", "drive.hwmap", "--tracked", tracked, "--plan", "p1")
        tie = json.loads(self.result_of(*pins, "--version", 3))
        self.assertEqual((tie["plan"], tie["version"]), ("p1", 3))
        self.assertGreaterEqual(len(tie["pins"]), 2)
        for pin in tie["pins"]:
            x_m, y_m, theta_rad = self.poses[pin["image"].split("/")[-1]]
            self.assertLess(math.hypot(pin["x_m"] - x_m, pin["y_m"] - y_m), 0.3)
            self.assertLess(abs(math.remainder(pin["theta_rad"] - theta_rad, 2 * math.pi)), 0.1)
        self.assertIn(f"{len(tie['pins'])} of ", self.result_of(*pins, "--out", "tie.json"))
        self.assertEqual(json.loads((self.folder / "tie.json").read_text())["pins"], tie["pins"])
        self.assert_refused(3, ["--tour", "elsewhere"], *pins, "--tour", "elsewhere")
        broken = self.folder / "broken.jsonl"
        broken.write_text(tracked.read_text().splitlines()[0] + "\n{\"image\": 4}\n")
        self.assert_refused(2, ["broken.jsonl: line 2"], *pins[:5], broken, *pins[6:])
        lost = self.folder / "lost.jsonl"
        lost.write_text('{"image": "00000.jpg", "lost": true}\n')
        self.assert_refused(4, ["fewer than two places"], *pins[:5], lost, *pins[6:])

    def test_odometry_may_come_from_another_file(self):
        own = self.folder / "own.csv"
        own.write_text("filename,x_m,y_m,theta_rad\n" + "".join(f"{name},{x},{y},{turn}\n" for name, (x, y, turn) in
                                                              self.poses.items()))
        self.assertFalse(self.track("old.wrl", "--start", self.start, "--odometry", own)[-1]["lost"])
        own.write_text("filename,x_m,y_m,theta_rad\n00000.jpg,1,here,0\n")
        self.refused(2, ["own.csv:2"], "--odometry", own)
        self.refused(3, ["none.csv"], "--odometry", "none.csv")

    def test_pictures_that_cannot_be_read_are_named(self):
        drive = self.folder / "drive"
        drive.mkdir()
        track = ("track", "--model", self.shared / "old.wrl", "--camera", self.shared / "drive" / "camera.json",
                 "--images", drive)
        self.assert_refused(2, ["no pictures"], *track)
        first = sorted(self.poses)[0]
        whole = (self.shared / "drive" / first).read_bytes()
        (drive / first).write_bytes(whole[:len(whole) // 2])
        self.assert_refused(2, [first], *track)
        write_png(drive / first.replace(".jpg", ".png"), 64, 48, 90)
        (drive / first).unlink()
        self.assert_refused(2, [first.replace(".jpg", ".png"), "64 x 48"], *track)

    def refused(self, code, words, *options, plan="old.wrl"):
        self.assert_refused(code, words, "track", "--model", self.shared / plan, "--camera",
                            self.shared / "drive" / "camera.json", "--images", self.shared / "drive", *options)

    def test_bad_input_is_refused(self):
        self.refused(3, ["nowhere.wrl"], plan="nowhere.wrl")
        (self.folder / "broken.wrl").write_text("#VRML V2.0 utf8\nShape { geometry IndexedLineSet {\n")
        self.refused(2, ["broken.wrl:"], plan=self.folder / "broken.wrl")
        (self.folder / "far.wrl").write_text("#VRML V2.0 utf8\nShape { geometry IndexedLineSet { coord Coordinate { "
                                             "point [0 0 0, 9000 0 0] } coordIndex [0 1 -1] } }\n")
        self.refused(2, ["far.wrl", "250 m"], plan=self.folder / "far.wrl")
        self.refused(2, ["--start"], "--start", "1,2")
        self.refused(2, ["--measure"], "--measure", "guess")
        (self.folder / "scans.csv").write_text("filename,r0\n00000.jpg,-1\n")
        self.refused(2, ["scans.csv:2"], "--scans", "scans.csv")
        low = json.loads((self.shared / "drive" / "camera.json").read_text())
        low["robot_from_camera"]["translation_m"][2] = 0.0
        (self.folder / "low.json").write_text(json.dumps(low))
        self.assert_refused(2, ["low.json", "above the floor"], "track", "--model", self.shared / "old.wrl", "--camera",
                            "low.json", "--images", self.shared / "drive")
        self.assert_refused(3, ["no such folder"], "track", "--model", self.shared / "old.wrl", "--camera",
                            self.shared / "drive" / "camera.json", "--images", "nobody")


if __name__ == "__main__":
    executable = sys.argv.pop(1)
    CliTest.program = Program(executable, Path(executable).parent / "cli-cache")
    unittest.main()
