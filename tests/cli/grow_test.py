#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Maps that grow: several tours in one map, tours added later, drives that refine."""

import json
import shutil
import sqlite3
import sys
import unittest
from pathlib import Path

from program import CliTest, Program


class Grow(CliTest):
    second = None

    def setUp(self):
        super().setUp()
        if Grow.second is None:
            Grow.second = CliTest.shared / "second"
            made = self.program.run("simulate", "tour", "--world", "offices:1", "--rooms", "corridor,office_1", "--step-m", 0.7,
                                    "--seed", 5, "--marks", "--camera", "equirectangular", "--out", Grow.second, cwd=self.folder)
            self.assertEqual(made.returncode, 0, made.stderr)

    def second_tour(self, name="second"):
        shutil.copytree(Grow.second, self.folder / name, ignore=shutil.ignore_patterns("poses.csv", "scans.csv"))
        return self.folder / name

    def inspect(self, name):
        return json.loads(self.result_of("map", "inspect", name, "--json"))

    def content(self, name):
        database = sqlite3.connect(self.folder / name)
        rows = [line for line in database.iterdump() if not any(key in line for key in ("'build_seconds'", "'checksum'"))]
        database.close()
        return rows

    def change(self, name, statement):
        database = sqlite3.connect(self.folder / name)
        database.execute(statement)
        database.commit()
        database.close()

    def add(self, *more, out="grown.map", tour="second"):
        return "map", "build", "--add-to", "good.map", "--tour", tour, "--out", out, *more

    def test_a_tour_joins_a_map(self):
        before = self.good_map().read_bytes()
        pictures = len(list(self.second_tour().glob("*.jpg")))
        result = json.loads(self.result_of(*self.add("--json")))
        self.assertEqual(self.good_map("again.map").read_bytes(), before)
        self.assertEqual((self.folder / "good.map").read_bytes(), before)
        old, grown = self.inspect("good.map"), self.inspect("grown.map")
        added = result["added"]
        self.assertEqual(added["images"], pictures)
        self.assertEqual(grown["images"], old["images"] + pictures)
        self.assertEqual(len(grown["places"]), len(old["places"]) + added["places"])
        self.assertEqual(len(grown["edges"]), len(old["edges"]) + added["edges"])
        self.assertEqual(result["places"], len(grown["places"]))
        self.assertEqual(result["components"], grown["components"])
        self.assertEqual(result["skipped"], [])
        for place, kept in zip(old["places"], grown["places"]):
            for key in ("id", "label", "prototype", "features"):
                self.assertEqual(kept[key], place[key])
            self.assertEqual(kept["members"][:len(place["members"])], place["members"])
        self.assertEqual(grown["edges"][:len(old["edges"])], old["edges"])
        held = [member for place in grown["places"] for member in place["members"]]
        self.assertEqual(len(held), len(set(held)))
        self.assertEqual(len(held), grown["images"])
        self.assertGreater(added["joined_images"], 0)
        self.assertEqual(len(grown["components"]), 1)

    def test_the_same_with_any_number_of_threads(self):
        self.good_map()
        self.second_tour()
        for threads in (1, 2):
            self.result_of(*self.add("--threads", threads, out=f"{threads}.map"))
        self.assertEqual(self.content("1.map"), self.content("2.map"))

    def test_a_map_grows_in_place_once(self):
        self.good_map()
        self.second_tour()
        self.assertIn("added: ", self.result_of(*self.add(out="good.map")))
        self.assertGreater(self.inspect("good.map")["images"], 0)
        self.assert_refused(2, ["second/00000.jpg", "already"], *self.add(out="good.map"))

    def test_tours_that_do_not_touch_are_told(self):
        self.good_map()
        self.result_of("simulate", "tour", "--world", "house:4", "--rooms", "hall,kitchen", "--step-m", 1, "--camera",
                       "equirectangular", "--out", "elsewhere")
        result = self.result_of(*self.add(tour="elsewhere"))
        for text in ("2 parts", "of tour", "of elsewhere", "Drive a tour that passes through both"):
            self.assertIn(text, result)
        self.assertIn("2 parts", self.result_of("map", "inspect", "grown.map"))
        components = self.inspect("grown.map")["components"]
        self.assertEqual([part["tours"] for part in components], [["tour"], ["elsewhere"]])
        self.assertEqual(sum(len(part["places"]) for part in components), len(self.inspect("grown.map")["places"]))

    def test_several_tours_make_one_map(self):
        self.tour()
        self.second_tour()
        result = json.loads(self.result_of("map", "build", "--tour", "tour", "--tour", "second", "--camera",
                                           "tour/camera.json", "--out", "both.map", "--json"))
        pictures = len(list(self.folder.glob("*/*.jpg")))
        self.assertEqual(result["images"], pictures)
        self.assertEqual({tour for part in result["components"] for tour in part["tours"]}, {"tour", "second"})
        (self.folder / "in").mkdir()
        shutil.copytree(self.folder / "tour", self.folder / "in" / "tour")
        self.assert_refused(2, ["named tour", "in/tour"], "map", "build", "--tour", "tour", "--tour", "in/tour", "--camera",
                            "tour/camera.json", "--out", "both.map")

    def test_unreadable_pictures_are_left_out_and_named(self):
        self.good_map()
        (self.second_tour() / "00002.jpg").write_bytes(b"")
        done = self.run_program(*self.add("--json"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("00002.jpg", done.stderr)
        skipped, = json.loads(done.stdout)["skipped"]
        self.assertEqual(skipped["image"].split("/")[-1], "00002.jpg")

    def test_maps_that_cannot_grow(self):
        self.second_tour()
        self.assert_refused(3, ["good.map"], *self.add())
        self.good_map()
        self.assert_refused(4, ["another kind of camera"], *self.add("--camera", self.mirror()))
        self.change("good.map", "PRAGMA user_version = 99")
        self.assert_refused(2, ["version 99"], *self.add())
        (self.folder / "good.map").write_text("This is no map.\n" * 100)
        self.assert_refused(2, ["good.map"], *self.add())
        self.assert_refused(2, ["camera"], "map", "build", "--tour", "second", "--out", "new.map")

    def mirror(self):
        file = self.folder / "mirror.json"
        file.write_text(json.dumps({
            "format": "homeward-camera", "version": 1, "model": "hyperbolic_mirror", "width_px": 640, "height_px": 480,
            "intrinsics": {"fx_px": 598.4579, "fy_px": 598.4579, "cx_px": 319.5, "cy_px": 239.5},
            "mirror": {"a_mm": 28.095, "b_mm": 23.4125}, "valid_radius_px": [43.05, 231.0],
            "robot_from_camera": {"translation_m": [0, 0, 1.2], "rotation_wxyz": [0.70710678, 0, 0, 0.70710678]}}))
        return file

    def test_a_drive_in_the_same_light_changes_nothing(self):
        self.good_map()
        before = self.inspect("good.map")
        result = json.loads(self.result_of("map", "refine", "--map", "good.map", "--images", self.shared / "tour", "--out",
                                           "refined.map", "--json"))
        self.assertEqual(result["gained"], [])
        self.assertEqual(self.inspect("refined.map"), before)

    def test_refining_adds_nothing_but_appearances(self):
        self.good_map()
        self.second_tour()
        self.result_of("map", "refine", "--map", "good.map", "--images", "second", "--out", "refined.map", "--sure", 0.5,
                       "--least-gain", 0.01, "--closeness", 2, "--kb-per-place", 1000)
        old, refined = self.inspect("good.map"), self.inspect("refined.map")
        self.assertGreater(sum(place["appearances"] for place in refined["places"]),
                           sum(place["appearances"] for place in old["places"]))
        for report in (old, refined):
            report.pop("bytes")
            for place in report["places"]:
                self.assertLessEqual(place.pop("appearances"), 3)
        self.assertEqual(old, refined)

    def test_what_refining_refuses(self):
        self.good_map()
        (self.folder / "none").mkdir()
        self.assert_refused(2, ["no pictures"], "map", "refine", "--map", "good.map", "--images", "none")
        self.assert_refused(3, ["nowhere"], "map", "refine", "--map", "good.map", "--images", "nowhere")
        self.assert_refused(3, ["no.map"], "map", "refine", "--map", "no.map", "--images", "none")
        self.second_tour()
        self.assert_refused(4, ["another kind of camera"], "map", "refine", "--map", "good.map", "--images", "second", "--camera",
                            self.mirror())


if __name__ == "__main__":
    executable = sys.argv.pop(1)
    CliTest.program = Program(executable, Path(executable).parent / "cli-cache")
    unittest.main()
