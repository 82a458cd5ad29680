#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the command line says to bad input: an exit code, one sentence that names what and where, and no half results."""

import json
import random
import shutil
import sys
import time
import unittest
from pathlib import Path

from program import CliTest, Program, write_png

# Pictures of one grey level, named by what is said about them.
FLAT = {"black.png": 0, "all_of_one_brightness.png": 128, "over-exposed.png": 255}

BUILD = ("map", "build", "--tour", "tour", "--camera", "tour/camera.json", "--out", "out.map")


class BadTours(CliTest):
    def test_no_such_folder(self):
        self.tour("other")
        self.assert_refused(3, ["no-tour"], "map", "build", "--tour", "no-tour", "--camera", "other/camera.json", "--out", "out.map")

    def test_empty_folder(self):
        self.tour("other")
        (self.folder / "tour").mkdir()
        self.assert_refused(2, ["tour", "no pictures"], "map", "build", "--tour", "tour", "--camera", "other/camera.json", "--out", "out.map")

    def test_what_cannot_be_read_is_left_out_and_listed(self):
        tour = self.tour()
        pictures = sorted(tour.glob("*.jpg"))
        (marked,) = (mark["image"] for mark in json.loads((tour / "tour.json").read_text())["marks"][-1:])
        broken = [picture for picture in pictures[1::2] if picture.name != marked]
        for number, picture in enumerate(broken):
            whole = picture.read_bytes()
            picture.write_bytes((b"", b"This is no picture.", whole[:len(whole) // 2])[number % 3])
        done = self.run_program(*BUILD, "--json", "--report", "report")
        self.assertEqual(done.returncode, 0, done.stderr)
        answer = json.loads(done.stdout)
        self.assertEqual(answer["images"], len(pictures) - len(broken))
        names = [f"tour/{picture.name}" for picture in broken]
        self.assertEqual([skipped["image"] for skipped in answer["skipped"]], names)
        self.assertEqual({skipped["code"] for skipped in answer["skipped"]}, {"unsupported_image", "truncated_image"})
        page = (self.folder / "report" / "report.html").read_text()
        for name in names:
            self.assertIn(name, done.stderr)
            self.assertIn(name.split("/")[1], page)
        self.assertIn(f"{len(broken)} of {len(pictures)} pictures", done.stderr)
        inspected = json.loads(self.result_of("map", "inspect", "out.map", "--json"))
        self.assertEqual(inspected["images"], len(pictures) - len(broken))

    def test_a_destination_that_goes_with_its_picture_is_said(self):
        tour = self.tour()
        mark = json.loads((tour / "tour.json").read_text())["marks"][0]
        (tour / mark["image"]).write_bytes(b"")
        done = self.run_program(*BUILD)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f'destination "{mark["label"]}"', done.stderr)

    def test_all_unreadable(self):
        tour = self.tour()
        for picture in tour.glob("*.jpg"):
            picture.write_text("This is no picture.")
        self.assert_refused(2, ["00000.jpg", "None of the 10"], *BUILD)

    def test_too_few_that_can_be_read(self):
        tour = self.tour()
        for picture in sorted(tour.glob("*.jpg"))[2:]:
            picture.write_bytes(b"")
        self.assert_refused(4, ["00002.jpg", "Only 2 of the 10"], *BUILD)

    def test_picture_of_another_size(self):
        tour = self.tour(without=("poses.csv", "scans.csv", "times.csv", "odometry.csv"))
        (tour / "00003.jpg").unlink()
        write_png(tour / "00003.png", 640, 480, 90)
        self.assert_refused(2, ["00003.png", "640", "1024", "1 of 10"], *BUILD)

    def test_pictures_of_another_size_from_one_on(self):
        tour = self.tour(without=("poses.csv", "scans.csv", "times.csv", "odometry.csv", "tour.json"))
        for number in range(6, 10):
            (tour / f"{number:05}.jpg").unlink()
            write_png(tour / f"{number:05}.png", 640, 480, 90)
        self.assert_refused(2, ["00006.png", "From this picture on", "4 of 10"], *BUILD)

    def test_the_same_picture_again_and_again(self):
        tour = self.tour(without=("*.csv", "tour.json"))
        pictures = sorted(tour.glob("*.jpg"))
        for picture in pictures[1:]:
            picture.write_bytes(pictures[0].read_bytes())
        self.assert_refused(4, ["tour/00000.jpg", "same view", "stood still"], *BUILD)

    def test_one_picture(self):
        tour = self.tour(without=("*.csv", "tour.json"))
        for picture in sorted(tour.glob("*.jpg"))[1:]:
            picture.unlink()
        self.assert_refused(4, ["1 picture;", "at least 3"], *BUILD)

    def test_two_pictures(self):
        tour = self.tour(without=("poses.csv", "scans.csv", "tour.json", "times.csv", "odometry.csv"))
        for picture in sorted(tour.glob("*.jpg"))[2:]:
            picture.unlink()
        self.assert_refused(4, ["2"], *BUILD)

    def test_black_pictures(self):
        tour = self.tour(without=("*.csv", "*.jpg", "tour.json"))
        for number in range(5):
            write_png(tour / f"{number:05}.png", 1024, 512, 0)
        self.assert_refused(4, ["0000"], *BUILD)

    def test_broken_tables(self):
        (self.tour() / "odometry.csv").write_text("t_us,x_m,y_m,theta_rad\n0,here,0,0\n")
        self.assert_refused(2, ["odometry.csv:2"], *BUILD)

    def test_broken_marks(self):
        (self.tour() / "tour.json").write_text('{"marks": [{"image": 3}]}')
        self.assert_refused(2, ["tour.json"], *BUILD)

    def test_mark_of_a_picture_that_is_not_there(self):
        (self.tour() / "tour.json").write_text('{"marks": [{"image": "99999.jpg", "label": "cellar"}]}')
        self.assert_refused(2, ["99999.jpg"], *BUILD)

    def test_an_older_map_outlives_a_build_that_fails(self):
        self.good_map("out.map")
        for picture in self.tour().glob("*.jpg"):
            picture.write_text("This is no picture.")
        self.assert_refused(2, ["00000.jpg"], *BUILD)  # checks that no file has changed

    def test_a_map_that_cannot_be_written(self):
        self.tour()
        self.assert_refused(5, ["none/out.map"], *BUILD[:-1], "none/out.map")

    def test_a_report_that_cannot_be_written_is_told_before_the_work(self):
        self.tour()
        self.assert_refused(5, ["tour/tour.json"], *BUILD, "--report", "tour/tour.json")
        self.assert_refused(5, ["tour/tour.json/report"], *BUILD, "--report", "tour/tour.json/report")
        self.assert_refused(2, ["--report-pictures"], *BUILD, "--report", "report", "--report-pictures", "-1")


class MixedTours(CliTest):
    """Tours that hold together picture by picture and not as a whole."""

    def render(self, name, *options):
        self.result_of("simulate", "tour", "--world", "offices:1", "--out", name, *options)
        return sorted((self.folder / name).glob("*.jpg"))

    def refill(self, pictures, camera):
        (self.folder / "tour").mkdir()
        for number, picture in enumerate(pictures):
            shutil.copy(picture, self.folder / "tour" / f"{number:05}.jpg")
        shutil.copy(camera, self.folder / "tour" / "camera.json")

    def test_a_mirror_and_a_window_of_one_size(self):
        options = ("--rooms", "corridor,office_1", "--step-m", 1.5)
        mirror = self.render("mirror", "--camera", "hyperbolic_mirror", *options)
        window = self.render("window", "--camera", "pinhole", *options)
        for camera, pictures in (("mirror", mirror[:4] + window[4:]), ("window", window[:4] + mirror[4:])):
            self.refill(pictures, self.folder / camera / "camera.json")
            self.assert_refused(2, ["tour/00004.jpg", "From this picture on", "another camera"], *BUILD)
            shutil.rmtree(self.folder / "tour")

    def test_pictures_out_of_order(self):
        pictures = self.render("drive", "--camera", "hyperbolic_mirror", "--rooms", "corridor,office_1,office_2", "--step-m", 0.5)
        camera = self.folder / "drive" / "camera.json"
        self.refill(pictures, camera)
        self.result_of(*BUILD)  # not a word on the tour as it was driven
        shutil.rmtree(self.folder / "tour")
        shuffled = list(pictures)
        random.Random(1).shuffle(shuffled)
        self.refill(shuffled, camera)
        (self.folder / "out.map").unlink()
        self.assert_refused(2, ["out of order", "tour/0000"], *BUILD)
        shutil.rmtree(self.folder / "tour")
        by_name = sorted(range(len(pictures)), key=str)
        self.refill([pictures[number] for number in by_name], camera)
        done = self.run_program(*BUILD, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        (warning,) = json.loads(done.stdout)["warnings"]
        self.assertIn(warning["reason"]["code"], ("tour_jumps", "tour_jumps_against_times"))
        self.assertIn("out of order", done.stderr)
        self.assertIn(warning["image"], done.stderr)


class BadCameras(CliTest):
    def build_with(self, code, names, change):
        camera = json.loads((self.tour() / "camera.json").read_text())
        change(camera)
        (self.folder / "camera.json").write_text(json.dumps(camera))
        self.assert_refused(code, ["camera.json", *names], "map", "build", "--tour", "tour", "--camera", "camera.json", "--out", "out.map")

    def test_unknown_key(self):
        self.build_with(2, ["colour"], lambda camera: camera.update(colour="red"))

    def test_missing_key(self):
        self.build_with(2, ["width_px"], lambda camera: camera.pop("width_px"))

    def test_another_version(self):
        self.build_with(2, ["version"], lambda camera: camera.update(version=9))

    def test_number_out_of_range(self):
        self.build_with(2, ["width_px"], lambda camera: camera.update(width_px=-4))

    def test_no_json(self):
        self.tour()
        (self.folder / "camera.json").write_text('{"format": ')
        self.assert_refused(2, ["camera.json"], "map", "build", "--tour", "tour", "--camera", "camera.json", "--out", "out.map")

    def test_no_file(self):
        self.tour()
        self.assert_refused(3, ["nowhere.json"], "map", "build", "--tour", "tour", "--camera", "nowhere.json", "--out", "out.map")


class BadMaps(CliTest):
    def test_unknown_place(self):
        self.good_map()
        self.assert_refused(3, ["cellar"], "route", "--map", "good.map", "--from", "p1", "--to", "cellar")
        self.assert_refused(3, ["cellar"], "route", "--map", "good.map", "--from", "cellar", "--to", "p1")

    def test_no_route(self):
        self.good_map()
        graph = json.loads(self.result_of("map", "export", "good.map", "--format", "json"))
        ways = {tuple(sorted((edge["from"], edge["to"]))) for edge in graph["edges"]}
        edits = [{"kind": "remove_edge", "from": a, "to": b} for a, b in sorted(ways)]
        (self.folder / "edits.json").write_text(json.dumps({"edits": edits}))
        self.result_of("map", "edit", "--map", "good.map", "--edits", "edits.json", "--out", "good.map")
        self.assert_refused(4, ["corridor", "office_1"], "route", "--map", "good.map", "--from", "corridor", "--to", "office_1")

    def test_pictures_of_another_camera(self):
        self.good_map()
        (self.folder / "pictures").mkdir()
        write_png(self.folder / "pictures" / "a.png", 320, 240, 90)
        self.assert_refused(2, ["a.png"], "localise", "--map", "good.map", "--images", "pictures")

    def test_no_pictures(self):
        self.good_map()
        (self.folder / "pictures").mkdir()
        self.assert_refused(2, ["pictures"], "localise", "--map", "good.map", "--images", "pictures")
        self.assert_refused(3, ["nowhere"], "localise", "--map", "good.map", "--images", "nowhere")

    def test_odometry_of_a_walk_that_cannot_be_read(self):
        self.good_map()
        odometry = self.tour() / "odometry.csv"
        odometry.write_text("t_us,x_m,y_m,theta_rad\n12,here,0,0\n")
        self.assert_refused(2, ["odometry.csv:2"], "localise", "--map", "good.map", "--images", "tour")
        self.result_of("localise", "--map", "good.map", "--images", "tour", "--no-odometry")


class BadPictures(CliTest):
    def home(self, current, target):
        return ("home", "--camera", "tour/camera.json", "--current", current, "--target", target)

    def test_no_such_picture(self):
        self.tour()
        self.assert_refused(3, ["none.jpg"], *self.home("tour/00001.jpg", "tour/none.jpg"))

    def test_pictures_that_show_nothing_give_no_direction(self):
        self.tour()
        for name, grey in FLAT.items():
            write_png(self.folder / "tour" / name, 1024, 512, grey)
            for pair in (("tour/00001.jpg", f"tour/{name}"), (f"tour/{name}", "tour/00001.jpg")):
                (answer,) = self.lines_of(*self.home(*pair))
                for key in ("bearing_rad", "turn_rad", "nearness"):
                    self.assertIsNone(answer[key], name)
                self.assertEqual(answer["confidence"], 0.0)
                self.assertIn("features", answer["reason"])

    def test_pictures_that_show_nothing_are_no_measure_s_business(self):
        self.tour()
        compare = ("compare", "--camera", "tour/camera.json")
        for name, grey in FLAT.items():
            write_png(self.folder / "tour" / name, 1024, 512, grey)
            for measure in ("moments", "jeffrey", "chi2", "sad", "fourier", "invariants", "rgb_jeffrey", "row_fourier",
                            "vlad"):
                why = name.removesuffix(".png").replace("_", " ")
                self.assert_refused(4, [name, why], *compare, "--measure", measure, "tour/00001.jpg", f"tour/{name}")
            (line,) = self.lines_of(*compare, "tour/00001.jpg", f"tour/{name}")
            self.assertIsNone(line["dissimilarity"])
            self.assertIsNone(line["turn_rad"])

    def test_pictures_that_are_too_small(self):
        write_png(self.tour() / "tiny.png", 8, 4, 90)
        self.assert_refused(2, ["tiny.png", "8 x 4"], *self.home("tour/00001.jpg", "tour/tiny.png"))
        for measure in ("features", "jeffrey"):
            self.assert_refused(2, ["tiny.png", "8 x 4"], "compare", "--camera", "tour/camera.json", "--measure", measure,
                                "tour/00001.jpg", "tour/tiny.png")

    def test_comparing_what_cannot_be_compared(self):
        write_png(self.tour() / "black.png", 1024, 512, 0)
        compare = ("compare", "--camera", "tour/camera.json")
        self.assert_refused(4, ["Two pictures"], *compare, "tour/00001.jpg")
        self.assert_refused(2, ["--measure", "magic"], *compare, "--measure", "magic", "tour/00001.jpg", "tour/00002.jpg")
        self.assert_refused(4, ["black.png", "is black"], *compare, "--measure", "jeffrey", "tour/00001.jpg",
                            "tour/black.png")
        self.assert_refused(2, ["--draw"], *compare, "--measure", "sad", "--draw", "x.png", "tour/00001.jpg", "tour/00002.jpg")
        (line,) = self.lines_of(*compare, "tour/00001.jpg", "tour/black.png")
        self.assertIsNone(line["dissimilarity"])

    def test_one_picture_alone(self):
        self.tour()
        self.assert_refused(2, ["--target"], "home", "--camera", "tour/camera.json", "--current", "tour/00001.jpg")

    def test_hints_of_a_method_that_has_none(self):
        self.tour()
        self.assert_refused(2, ["--uncertain", "epipolar"], "home", "--camera", "tour/camera.json", "--current",
                            "tour/00001.jpg", "--target", "tour/00002.jpg", "--method", "scale-space", "--uncertain")

    def test_table_without_its_columns(self):
        self.tour()
        (self.folder / "pairs.csv").write_text("from,to\n00001.jpg,00002.jpg\n")
        for command in ("home", "compass"):
            self.assert_refused(2, ["pairs.csv", "current"], command, "--camera", "tour/camera.json", "--pairs", "pairs.csv")

    def test_neither_a_pair_nor_a_table_and_both(self):
        self.tour()
        camera = ("--camera", "tour/camera.json")
        for command in ("home", "compass"):
            self.assert_refused(2, [command, "--pairs"], command, *camera, "--current", "tour/00001.jpg")
            self.assert_refused(2, [command, "--pairs"], command, *camera, "--current", "tour/00001.jpg", "--target",
                                "tour/00002.jpg", "--pairs", "pairs.csv")


class WrongUse(CliTest):
    def test_unknown_option(self):
        self.assert_refused(2, ["--fast"], *BUILD, "--fast")

    def test_missing_option(self):
        self.assert_refused(2, ["--out"], *BUILD[:-2])

    def test_number_that_is_none(self):
        self.assert_refused(2, ["--threads", "many"], *BUILD, "--threads", "many")

    def test_unknown_format(self):
        self.good_map()
        self.assert_refused(2, ["pdf", "graphml"], "map", "export", "good.map", "--format", "pdf")

    def test_no_command(self):
        self.assert_refused(2, ["subcommand"])
        self.assert_refused(2, ["subcommand"], "map")

    def test_unknown_command(self):
        self.assert_refused(2, ["biuld"], "map", "biuld", "--out", "out.map")
        self.assert_refused(2, ["mpa"], "mpa")

    def test_unknown_room_world_light_and_step(self):
        tour = ("simulate", "tour", "--out", "new")
        self.assert_refused(3, ["cellar", "corridor"], *tour, "--world", "offices:1", "--rooms", "corridor,cellar")
        self.assert_refused(3, ["none.json"], *tour, "--world", "none.json", "--rooms", "a,b")
        self.assert_refused(2, ["noon"], *tour, "--world", "offices:1", "--rooms", "corridor,office_1", "--light", "noon")
        self.assert_refused(2, ["step"], *tour, "--world", "offices:1", "--rooms", "corridor,office_1", "--step-m", "0")

    def test_explorations_that_cannot_begin(self):
        explore = ("explore", "--world", "offices:1")
        self.assert_refused(3, ["cellar", "corridor"], *explore, "--start", "cellar", "--out", "new")
        self.assert_refused(2, ["plane", "chair"], *explore, "--robot", "plane", "--out", "new")
        self.assert_refused(3, ["none.json"], "explore", "--world", "none.json", "--out", "new")
        self.assert_refused(2, ["noon"], *explore, "--light", "noon", "--out", "new")
        self.assert_refused(2, ["limit-m"], *explore, "--limit-m", "0", "--out", "new")
        for share in ("-0.1", "1.5", "nan", "some"):
            self.assert_refused(2, ["glass-share", share], *explore, "--glass-share", share, "--out", "new")
            self.assert_refused(2, ["spurious-share", share], *explore, "--spurious-share", share, "--out", "new")
            self.assert_refused(2, ["shut-doors", share], *explore, "--shut-doors", share, "--out", "new")
        self.assert_refused(2, ["limit-s", "nan"], *explore, "--limit-s", "nan", "--out", "new")
        self.assert_refused(2, ["start2", "robots"], *explore, "--start2", "office_1", "--out", "new")
        self.assert_refused(2, ["start", "office_1"], *explore, "--shut-doors", "1", "--start", "office_1", "--out", "new")
        for fence in ("1,2 3", "1,2 3,4", "1,2 3,2 3,4 5", "1,2 3,2 3,4 5,", "1,2 3,2 3,4x", "1,2 3,2 1e300,4"):
            self.assert_refused(2, ["fence"], *explore, "--fence", fence, "--out", "new")
        self.assert_refused(2, ["fence", "survey"], *explore, "--method", "thesis", "--fence", "1,2 3,2 3,4", "--out", "new")
        self.assert_refused(2, ["limit-s", "survey"], *explore, "--method", "thesis", "--limit-s", "60", "--out", "new")
        self.assert_refused(2, ["pictures-every"], *explore, "--pictures-every", "0", "--out", "new")
        self.assert_refused(2, ["pictures-every", "survey"], *explore, "--method", "thesis", "--pictures-every", "9", "--out", "new")
        self.assert_refused(2, ["back-after-s"], *explore, "--back-after-s", "1e300", "--out", "new")
        self.assertFalse((self.folder / "new").exists())
        (self.folder / "full").mkdir()
        (self.folder / "full" / "mine.txt").write_text("kept")
        self.assert_refused(4, ["full"], *explore, "--out", "full")
        self.assertEqual((self.folder / "full" / "mine.txt").read_text(), "kept")

    def test_broken_scenario(self):
        (self.folder / "scenario.json").write_text('{"format": "homeward-scenario", "version": 1, "wrold": "house:1"}')
        self.assert_refused(2, ["scenario.json"], "simulate", "run", "--scenario", "scenario.json", "--json")
        self.assert_refused(3, ["none.json"], "simulate", "run", "--scenario", "none.json", "--json")


class ScenariosThatCannotBeDriven(CliTest):
    """Refused as a whole before anything is rendered: in seconds, with not a word on teaching."""

    WITHIN_S = 30  # of a busy machine; teaching takes minutes

    def write(self, missions, world="house:1", rooms=("hall", "kitchen")):
        (self.folder / "scenario.json").write_text(json.dumps({
            "format": "homeward-scenario", "version": 1, "world": world, "seed": 1,
            "camera": {"model": "hyperbolic_mirror"}, "tour": {"rooms": list(rooms)}, "missions": missions}))

    def assert_refused_at_once(self, names, *more, code=2):
        began = time.monotonic()
        self.assert_refused(code, names, "simulate", "run", "--scenario", "scenario.json", *more)
        self.assertLess(time.monotonic() - began, self.WITHIN_S)

    def test_mission_that_a_scenario_does_not_have(self):
        self.write([{"from": "hall", "to": "kitchen"}, {"random": 2}])
        for wrong in ("0", "4"):
            self.assert_refused_at_once(["no mission " + wrong, "has 3"], "--only", "2", wrong)

    def test_mission_to_a_room_that_the_tour_does_not_visit(self):
        self.write([{"from": "hall", "to": "kitchen"}, {"random": 2}, {"from": "hall", "to": "bathroom"}])
        self.assert_refused_at_once(
            ["missions[2].to: the tour does not visit 'bathroom'; it visits hall, kitchen.", "(scenario.json)"])

    def test_all_that_is_wrong_is_said_at_once(self):
        self.write([{"from": "cellar", "to": "hall"}, {"from": "hall", "to": "pantry"}], rooms=("hall", "attic", "kitchen"))
        self.assert_refused_at_once(["3 problems", "tour.rooms[1]", "'attic'", "missions[0].from", "'cellar'",
                                     "missions[1].to", "'pantry'"])

    def test_furniture_of_a_mesh_cannot_be_moved(self):
        (self.folder / "floor.obj").write_text("v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nf 1 2 3 4\n")
        (self.folder / "world.json").write_text(json.dumps({
            "format": "homeward-world", "version": 1, "name": "floor", "mesh": "floor.obj", "mesh_up": "z", "outdoor": False,
            "start": {"x_m": 2, "y_m": 2, "theta_rad": 0}, "lamps": [],
            "rooms": [{"name": "a", "x_m": 2, "y_m": 2}, {"name": "b", "x_m": 7, "y_m": 7}]}))
        self.write([{"from": "a", "to": "b", "moved_furniture": 1}], "world.json", "ab")
        self.assert_refused_at_once(["missions[0].moved_furniture", "generated worlds alone"])

    def test_world_that_is_not_there(self):
        self.write([], "none.json")
        self.assert_refused_at_once(["none.json"], code=3)


if __name__ == "__main__":
    executable = sys.argv.pop(1)
    CliTest.program = Program(executable, Path(executable).parent / "cli-cache")
    unittest.main()
