#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`homeward teach` and `homeward repeat`: a path by the pictures of one drive, the same drive on it, and what bad input gets."""

import json
import shutil
import sqlite3
import sys
import tempfile
import unittest
from pathlib import Path

from program import CliTest, Program, write_png

CAMERA = {"format": "homeward-camera", "version": 1, "model": "pinhole", "width_px": 320, "height_px": 240,
          "intrinsics": {"fx_px": 228.5, "fy_px": 228.5, "cx_px": 159.5, "cy_px": 119.5},
          "robot_from_camera": {"translation_m": [0, 0, 1.0], "rotation_wxyz": [0.5, -0.5, 0.5, -0.5]}}
TEACH = ("teach", "--images", "drive", "--camera", "drive/camera.json", "--out", "path.hwmap")
PICTURES = 40


class Teach(CliTest):
    drive = None

    @classmethod
    def setUpClass(cls):
        Teach.drive = Path(tempfile.mkdtemp(prefix="homeward-cli-"))
        cls.addClassCleanup(shutil.rmtree, Teach.drive, ignore_errors=True)
        (cls.drive / "lens.json").write_text(json.dumps(CAMERA))
        made = cls.program.run("simulate", "tour", "--world", "house:1", "--rooms", "hall,living_room", "--step-m", 0.06,
                               "--marks", "--camera", "lens.json", "--out", "drive", cwd=cls.drive)
        assert made.returncode == 0, made.stderr
        for file in sorted((cls.drive / "drive").glob("*.jpg"))[PICTURES:]:
            file.unlink()
        # What is left of the tables would be of pictures that are not there.
        for name in ("tour.json", "odometry.csv", "times.csv", "scans.csv", "scans.json"):
            (cls.drive / "drive" / name).unlink()
        taught = cls.program.run(*TEACH, "--json", cwd=cls.drive)
        assert taught.returncode == 0, taught.stderr
        (cls.drive / "taught.json").write_text(taught.stdout)

    def setUp(self):
        super().setUp()
        shutil.copytree(self.drive / "drive", self.folder / "drive")
        shutil.copy(self.drive / "path.hwmap", self.folder / "path.hwmap")

    def test_a_drive_becomes_a_path_and_a_map_of_its_key_images(self):
        taught = json.loads((self.drive / "taught.json").read_text())
        self.assertEqual(taught["pictures"], PICTURES)
        self.assertEqual(taught["cuts"], [])
        arcs = taught["arcs"]
        self.assertEqual(len(arcs) + 1, taught["key_images"])
        self.assertEqual([arc["to"] for arc in arcs[:-1]], [arc["from"] for arc in arcs[1:]])
        self.assertGreaterEqual(len(arcs), 3)
        self.assertTrue(any(arc["scale"] for arc in arcs[1:]))
        inspected = json.loads(self.result_of("map", "inspect", "path.hwmap", "--json"))
        self.assertEqual(len(inspected["places"]), taught["key_images"])
        self.assertEqual(len(inspected["edges"]), 2 * len(arcs))

    def test_taught_again_it_is_the_same_file(self):
        again = self.result_of(*TEACH[:-1], "again.hwmap")
        self.assertIn(f"{PICTURES} pictures", again)
        self.assertEqual((self.folder / "again.hwmap").read_bytes(), (self.folder / "path.hwmap").read_bytes())

    def test_the_same_drive_is_on_its_arcs_from_wherever_it_begins(self):
        order = [file.name for file in sorted((self.folder / "drive").glob("*.jpg"))]
        for first in (0, PICTURES // 2):
            with self.subTest(first=first):
                for name in order[:first]:
                    (self.folder / "drive" / name).unlink()
                lines = self.lines_of("repeat", "--path", "path.hwmap", "--images", "drive", "--json")
                self.assertEqual([line["image"] for line in lines], order[first:])
                known = [line for line in lines if not line["lost"]]
                self.assertGreaterEqual(len(known), 0.9 * len(lines))
                for line in known:
                    self.assertLessEqual(order.index(line["from"]) - 2, order.index(line["image"]))
                    self.assertGreaterEqual(order.index(line["to"]) + 2, order.index(line["image"]))
                    self.assertLess(abs(line["lateral_over_arc"]), 0.3)

    def test_a_covered_lens_is_lost_and_says_why_and_is_found_again(self):
        order = sorted((self.folder / "drive").glob("*.jpg"))
        for file in order[10:14]:
            file.unlink()
            write_png(file.with_suffix(".png"), 320, 240, 30)
        lines = self.lines_of("repeat", "--path", "path.hwmap", "--images", "drive", "--start-arc", 0, "--json")
        for line in lines[11:14]:
            self.assertTrue(line["lost"])
            self.assertIn(line["why_lost"], ("features", "geometry", "error"))
            self.assertIsNone(line["steering_rad"])
        self.assertFalse(lines[-1]["lost"])

    def test_what_cannot_be_taught_is_named(self):
        (self.folder / "empty").mkdir()
        self.assert_refused(3, ["nowhere"], "teach", "--images", "nowhere", *TEACH[3:])
        self.assert_refused(2, ["empty"], "teach", "--images", "empty", *TEACH[3:])
        one = self.folder / "one"
        one.mkdir()
        shutil.copy(self.folder / "drive" / "00000.jpg", one)
        self.assert_refused(4, ["one"], "teach", "--images", "one", *TEACH[3:])
        for name, change in (("nominal", {"nominal": True}), ("sizes", {"width_px": 322})):
            (self.folder / f"{name}.json").write_text(json.dumps({**CAMERA, **change}))
            done = self.run_program("teach", "--images", "drive", "--camera", f"{name}.json", "--out", "other.hwmap")
            self.assertNotEqual(done.returncode, 0)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertFalse((self.folder / "other.hwmap").exists())
        plain = self.folder / "plain"
        plain.mkdir()
        for number in range(4):
            write_png(plain / f"{number}.png", 320, 240, 90)
        self.assert_refused(4, ["plain"], "teach", "--images", "plain", *TEACH[3:])

    def test_a_picture_that_cannot_be_read_is_left_out_and_named(self):
        half = self.folder / "drive" / "00007.jpg"
        half.write_bytes(half.read_bytes()[:900])
        done = self.run_program(*TEACH, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("00007.jpg", done.stderr)
        self.assertIn("00007.jpg", json.loads(done.stdout)["skipped"][0]["where"])

    def test_what_cannot_be_repeated_is_named(self):
        repeat = ("repeat", "--images", "drive", "--path")
        self.assert_refused(3, ["nothing.hwmap"], *repeat, "nothing.hwmap")
        (self.folder / "short.hwmap").write_bytes((self.folder / "path.hwmap").read_bytes()[:-3000])
        done = self.run_program(*repeat, "short.hwmap")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("short.hwmap", done.stderr)
        self.assert_refused(3, ["--start-arc"], *repeat, "path.hwmap", "--start-arc", "900")
        (self.folder / "other.json").write_text(json.dumps({**CAMERA, "intrinsics": {**CAMERA["intrinsics"], "fx_px": 260}}))
        self.assert_refused(2, ["another camera"], *repeat, "path.hwmap", "--camera", "other.json")
        (self.folder / "changed.hwmap").write_bytes((self.folder / "path.hwmap").read_bytes())
        with sqlite3.connect(self.folder / "changed.hwmap") as file:
            file.execute("UPDATE path_key_images SET picture = x'FFD8' WHERE position = 1")
        done = self.run_program(*repeat, "changed.hwmap")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("checksum", done.stderr)

    def test_pictures_of_another_place_are_lost(self):
        other = self.folder / "other"
        made = self.run_program("simulate", "tour", "--world", "laboratory:3", "--rooms", "all", "--step-m", 1, "--camera",
                                "drive/camera.json", "--out", "other")
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertTrue(list(other.glob("*.jpg")))
        lines = self.lines_of("repeat", "--path", "path.hwmap", "--images", "other", "--json")
        self.assertTrue(all(line["lost"] for line in lines), [line for line in lines if not line["lost"]][:3])


if __name__ == "__main__":
    executable = sys.argv.pop(1)
    CliTest.program = Program(executable, Path(executable).parent / "cli-cache")
    unittest.main()
