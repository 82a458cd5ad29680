#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The command line from a tour to a way home: render, build, inspect, localise, route, home."""

import csv
import json
import math
import sqlite3
import sys
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from program import CliTest, Program


def wrapped(angle_rad):
    return math.atan2(math.sin(angle_rad), math.cos(angle_rad))


class HappyPath(CliTest):
    def inspect(self, name):
        return json.loads(self.result_of("map", "inspect", name, "--json"))

    def content(self, name):
        """All rows of a map file, but for the time that building took and the checksum that holds it."""
        database = sqlite3.connect(self.folder / name)
        rows = [line for line in database.iterdump() if "'build_seconds'" not in line and "'checksum'" not in line]
        database.close()
        return rows

    def poses(self):
        with open(self.shared / "tour" / "poses.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        return {row["filename"]: (float(row["x_m"]), float(row["y_m"]), float(row["theta_rad"])) for row in rows}

    def test_a_tour_has_all_its_files(self):
        tour = self.shared / "tour"
        pictures = sorted(tour.glob("*.jpg"))
        self.assertGreater(len(pictures), 5)
        for name, header in (("times.csv", "filename,t_us"), ("odometry.csv", "t_us,x_m,y_m,theta_rad")):
            lines = (tour / name).read_text().splitlines()
            self.assertEqual(lines[0], header)
            self.assertEqual(len(lines), len(pictures) + 1)
        self.assertIn("room", (tour / "poses.csv").read_text().splitlines()[0].split(","))
        self.assertTrue((tour / "scans.csv").exists())
        labels = [mark["label"] for mark in json.loads((tour / "tour.json").read_text())["marks"]]
        self.assertEqual(labels, ["corridor", "office_1"])

    def test_the_same_command_renders_the_same_tour(self):
        self.result_of("simulate", "tour", "--world", "offices:1", "--rooms", "corridor,office_1", "--step-m", 1, "--marks",
                       "--camera", "equirectangular", "--out", "tour")
        for file in sorted((self.shared / "tour").iterdir()):
            self.assertEqual(file.read_bytes(), (self.folder / "tour" / file.name).read_bytes(), file.name)

    def test_the_same_tour_gives_the_same_map_with_any_number_of_threads(self):
        self.tour(without=("poses.csv",))
        for name, threads in (("one.map", 1), ("two.map", 2)):
            self.result_of("map", "build", "--tour", "tour", "--camera", "tour/camera.json", "--out", name, "--threads", threads)
        self.good_map()
        reports = []
        for name in ("one.map", "two.map", "good.map"):
            report = self.inspect(name)
            self.assertGreater(report.pop("build_seconds"), 0.0)
            reports.append(report)
        self.assertEqual(reports[0], reports[1])
        self.assertEqual(reports[0], reports[2])
        self.assertEqual([line for line in self.content("one.map") if "'name'" not in line],
                         [line for line in self.content("two.map") if "'name'" not in line])

    def test_inspect_holds_together(self):
        report = self.inspect(self.good_map().name)
        places = {place["id"] for place in report["places"]}
        members = [member for place in report["places"] for member in place["members"]]
        self.assertEqual(report["images"], len(members))
        self.assertEqual(len(members), len(set(members)))
        for place in report["places"]:
            self.assertIn(place["prototype"], place["members"])
            self.assertGreater(place["features"], 50)
        self.assertGreater(len(report["edges"]), 0)
        for edge in report["edges"]:
            self.assertIn(edge["from"], places)
            self.assertIn(edge["to"], places)
            self.assertEqual(edge["length_from"], "odometry")
            self.assertTrue(0.0 <= edge["confidence"] <= 1.0)
            self.assertEqual(edge["weak"], edge["confidence"] < 0.2)
        for hypothesis in report["hypotheses"]:
            self.assertLessEqual(hypothesis["support"], hypothesis["plausibility"] + 1e-9)
            self.assertIn(hypothesis["decision"], ("accepted", "rejected", "undecided"))

    def test_export_in_its_formats(self):
        places = {place["id"] for place in self.inspect(self.good_map().name)["places"]}
        graph = json.loads(self.result_of("map", "export", "good.map", "--format", "json"))
        self.assertEqual({place["id"] for place in graph["places"]}, places)
        xml = ElementTree.fromstring(self.result_of("map", "export", "good.map", "--format", "graphml"))
        nodes = xml.findall(".//{http://graphml.graphdrawing.org/xmlns}node")
        self.assertEqual({node.get("id") for node in nodes}, places)
        geo = json.loads(self.result_of("map", "export", "good.map", "--format", "geojson"))
        self.assertEqual(geo["type"], "FeatureCollection")
        kinds = [feature["geometry"]["type"] for feature in geo["features"]]
        self.assertEqual(kinds.count("Point"), len(places))
        self.assertEqual(kinds.count("LineString"), len(graph["edges"]))

    def test_localises_its_own_tour(self):
        report = self.inspect(self.good_map().name)
        place_of = {member.split("/")[-1]: place["id"] for place in report["places"] for member in place["members"]}
        answers = self.lines_of("localise", "--map", "good.map", "--images", self.shared / "tour")
        self.assertEqual([answer["image"] for answer in answers], sorted(place_of))
        right = sum(answer["place"] == place_of[answer["image"]] for answer in answers)
        self.assertGreaterEqual(right, 0.6 * len(answers))
        for number, answer in enumerate(answers, 1):
            self.assertEqual(answer["updates"], number)
            chances = [entry["probability"] for entry in answer["top"]]
            self.assertEqual(chances, sorted(chances, reverse=True))
            self.assertLessEqual(sum(chances), 1.0 + 1e-9)
        alone = self.lines_of("localise", "--map", "good.map", "--images", self.shared / "tour", "--restart-every", 1)
        self.assertTrue(all(answer["updates"] == 1 for answer in alone))
        self.assertGreaterEqual(sum(answer["place"] == place_of[answer["image"]] for answer in alone), 0.6 * len(alone))

    def test_a_stated_start_is_believed_and_no_certainty(self):
        report = self.inspect(self.good_map().name)
        place_of = {member.split("/")[-1]: place["id"] for place in report["places"] for member in place["members"]}
        localise = ("localise", "--map", "good.map", "--images", self.shared / "tour")
        uniform = self.lines_of(*localise)
        first = place_of[uniform[0]["image"]]
        output = self.lines_of(*localise, "--start", first)

        def share(line, place):
            return sum(entry["probability"] for entry in line["top"] if entry["place"] == place)

        self.assertGreaterEqual(share(output[0], first), share(uniform[0], first))
        # Told wrong, it comes to what it sees all the same.
        wrong = self.lines_of(*localise, "--start", place_of[uniform[-1]["image"]])
        right = sum(answer["place"] == place_of[answer["image"]] for answer in wrong)
        self.assertGreaterEqual(right, 0.5 * len(wrong))
        self.assert_refused(3, ["--start", "cellar"], *localise, "--start", "cellar")

    def test_odometry_is_used_when_there_is_one(self):
        self.good_map()
        self.tour("with")
        self.tour("without", without=("poses.csv", "scans.csv", "odometry.csv"))

        def beliefs(*arguments):
            lines = self.lines_of("localise", "--map", "good.map", *arguments)
            return [{key: value for key, value in line.items() if key != "ms"} for line in lines]

        used, aside, absent = (beliefs("--images", "with"), beliefs("--images", "with", "--no-odometry"),
                               beliefs("--images", "without"))
        self.assertEqual(aside, absent)
        self.assertEqual(used[0], absent[0])  # the first picture knows of no way
        self.assertNotEqual(used, absent)
        # A restart forgets where the last picture was taken.
        self.assertEqual(beliefs("--images", "with", "--restart-every", 1), beliefs("--images", "without", "--restart-every", 1))

    def test_routes_from_label_to_label(self):
        self.good_map()
        there = json.loads(self.result_of("route", "--map", "good.map", "--from", "corridor", "--to", "office_1", "--json"))
        back = json.loads(self.result_of("route", "--map", "good.map", "--from", "office_1", "--to", "corridor", "--json"))
        self.assertGreater(len(there["places"]), 2)
        self.assertEqual(there["places"], back["places"][::-1])
        self.assertEqual(there["length_from"], "odometry")
        self.assertGreater(there["time_s"], there["length_m"] / 0.4 - 1e-6)

    def test_tells_what_stands_in_the_way(self):
        self.good_map()
        ends = ("route", "--map", "good.map", "--from", "corridor", "--to", "office_1", "--by", "time", "--json")
        places = json.loads(self.result_of(*ends))["places"]
        closed = self.program.run(*ends, "--closed", places[-2], places[-1], cwd=self.folder)
        if closed.returncode == 0:  # there is another way, round the edge
            around = json.loads(closed.stdout)["places"]
            self.assertNotIn((places[-2], places[-1]), list(zip(around, around[1:])))
        middle = self.program.run(*ends, "--avoid", *places[1:-1], "--closed", places[0], places[-1], cwd=self.folder)
        self.assertEqual(middle.returncode, 4, middle.stderr)
        answer = json.loads(middle.stdout)
        self.assertIsNone(answer["places"])
        self.assertTrue(answer["connected"])
        self.assertGreater(len(answer["obstacles"]), 0)
        self.assertEqual(answer["reason"]["code"], "no_way")
        self.assertEqual(answer["reason"]["parameters"]["from"].split()[0], places[0])
        self.assertNotEqual(self.program.run(*ends, "--routes", 0, cwd=self.folder).returncode, 0)

    def test_homes_from_picture_to_picture(self):
        poses = self.poses()
        names = sorted(poses)
        (self.folder / "pairs.csv").write_text(
            "current,target\n" + "".join(f"{self.shared}/tour/{a},{self.shared}/tour/{b}\n" for a, b in zip(names, names[1:])))
        camera = self.shared / "tour" / "camera.json"
        answers = self.lines_of("home", "--camera", camera, "--pairs", "pairs.csv")
        self.assertEqual(len(answers), len(names) - 1)
        good = compared = 0
        for answer, (a, b) in zip(answers, zip(names, names[1:])):
            dx, dy = poses[b][0] - poses[a][0], poses[b][1] - poses[a][1]
            if math.hypot(dx, dy) < 0.3 or answer.get("bearing_rad") is None:
                continue
            compared += 1
            good += abs(wrapped(answer["bearing_rad"] - (math.atan2(dy, dx) - poses[a][2]))) < math.radians(15)
        self.assertGreaterEqual(compared, 4)
        self.assertGreaterEqual(good, compared - 1)
        one = self.lines_of("home", "--camera", camera, "--current", self.shared / "tour" / names[0], "--target",
                            self.shared / "tour" / names[1])
        self.assertEqual(len(one), 1)
        self.assertAlmostEqual(one[0]["bearing_rad"], answers[0]["bearing_rad"])
        self.assertIsNone(one[0]["nearness"])
        for sure, hint in zip(answers, self.lines_of("home", "--camera", camera, "--pairs", "pairs.csv", "--uncertain")):
            self.assertIsNotNone(hint["bearing_rad"])
            if sure["bearing_rad"] is None:
                self.assertLessEqual(hint["confidence"], 0.02)
            else:
                self.assertEqual(hint["bearing_rad"], sure["bearing_rad"])

    def test_tells_the_turn_from_picture_to_picture_by_the_pictures_as_a_whole(self):
        x, y, _ = self.poses()[sorted(self.poses())[0]]
        self.result_of("simulate", "grid", "--world", "offices:1", "--within", x - 0.3, y - 0.3, x + 0.3, y + 0.3, "--step-m",
                       0.2, "--turned", "--out", "grid")
        with open(self.folder / "grid" / "poses.csv", newline="") as table:
            turned = [(row["filename"], float(row["theta_rad"])) for row in csv.DictReader(table)]
        pairs = list(zip(turned, turned[1:]))
        self.assertGreaterEqual(len(pairs), 5)
        (self.folder / "grid" / "pairs.csv").write_text(
            "current,target\n" + "".join(f"{a},{b}\n" for (a, _), (b, _) in pairs))
        camera = ("compass", "--camera", self.folder / "grid" / "camera.json")
        answers = self.lines_of(*camera, "--pairs", "grid/pairs.csv")
        self.assertEqual([(answer["current"], answer["target"]) for answer in answers], [(a, b) for (a, _), (b, _) in pairs])
        right = [abs(wrapped(answer["turn_rad"] - (there - here))) < math.radians(3)
                 for answer, ((_, here), (_, there)) in zip(answers, pairs)]
        self.assertGreaterEqual(right.count(True), len(pairs) - 1)  # offices look much the same turned about
        one, = self.lines_of(*camera, "--current", f"grid/{turned[0][0]}", "--target", f"grid/{turned[1][0]}")
        self.assertEqual([one["turn_rad"], one["residual"]], [answers[0]["turn_rad"], answers[0]["residual"]])

    def test_a_grid_of_pictures_of_one_part_each_with_a_heading_of_its_own(self):
        middle = self.poses()[sorted(self.poses())[0]]
        within = [middle[0] - 0.6, middle[1] - 0.6, middle[0] + 0.6, middle[1] + 0.6]
        grid = ("simulate", "grid", "--world", "offices:1", "--within", *within, "--step-m", 0.5)

        def poses_of(folder):
            with open(self.folder / folder / "poses.csv", newline="") as table:
                return [[float(row[key]) for key in ("x_m", "y_m", "theta_rad")] for row in csv.DictReader(table)]

        self.result_of(*grid, "--out", "even", "--theta-rad", 0.5)
        self.result_of(*grid, "--out", "turned", "--turned", "--seed", 2)
        self.result_of(*grid, "--out", "again", "--turned", "--seed", 2)
        even, turned, again = (poses_of(folder) for folder in ("even", "turned", "again"))
        self.assertGreaterEqual(len(even), 4)
        for x, y, theta in even:
            self.assertTrue(within[0] <= x <= within[2] and within[1] <= y <= within[3])
            self.assertAlmostEqual(theta, 0.5, places=6)
        self.assertEqual([pose[:2] for pose in even], [pose[:2] for pose in turned])
        self.assertEqual(len({pose[2] for pose in turned}), len(turned))
        self.assertEqual(turned, again)

    def test_compares_pictures_by_every_measure(self):
        self.tour()
        near, far = sorted((self.folder / "tour").glob("*.jpg"))[1], sorted((self.folder / "tour").glob("*.jpg"))[-1]
        first = sorted((self.folder / "tour").glob("*.jpg"))[0]
        for measure in ("moments", "jeffrey", "chi2", "sad", "fourier", "invariants", "rgb_jeffrey", "row_fourier", "vlad",
                        "features"):
            lines = self.lines_of("compare", "--camera", "tour/camera.json", "--measure", measure, first, first, near, far)
            self.assertEqual([line["measure"] for line in lines], [measure] * 3)
            same, step, other = (line["dissimilarity"] for line in lines)
            self.assertAlmostEqual(same, 0.0, places=3)
            self.assertGreater(step, same)
            if measure == "invariants":
                continue  # three numbers of a building's colours: of two of its places they need not say which is nearer
            self.assertTrue(other is None or other > step, measure)

    def test_draws_what_two_pictures_have_in_common(self):
        self.tour()
        first, near = sorted((self.folder / "tour").glob("*.jpg"))[:2]
        line, = self.lines_of("compare", "--camera", "tour/camera.json", first, near, "--draw", "both.png")
        self.assertGreater(line["verified"], 12)
        self.assertEqual((self.folder / "both.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_reports_on_a_map_in_one_page(self):
        self.tour()
        output = self.result_of("map", "build", "--tour", "tour", "--camera", "tour/camera.json", "--out", "told.map", "--name",
                                "Ward <3> & hall", "--report", "new/report", "--report-pictures", 3)
        self.assertIn("report: new/report/report.html", output)
        self.assertEqual([file.name for file in (self.folder / "new" / "report").iterdir()], ["report.html"])
        text = (self.folder / "new" / "report" / "report.html").read_text(encoding="utf-8")
        self.assertLess(len(text), 3_000_000)
        page = ElementTree.fromstring(text)  # raises where it is not well-formed
        xhtml, svg = "{http://www.w3.org/1999/xhtml}", "{http://www.w3.org/2000/svg}"
        self.assertEqual(page.find(f".//{xhtml}h1").text, "Ward <3> & hall")
        report = self.inspect("told.map")
        tiles = {tile.find(f"{xhtml}dt").text: tile.find(f"{xhtml}dd").text for tile in page.iterfind(f".//{xhtml}dl/{xhtml}div")}
        self.assertEqual(tiles["pictures"], str(report["images"]))
        self.assertEqual(tiles["places"], str(len(report["places"])))
        for decision in ("accepted", "rejected", "undecided"):
            self.assertEqual(tiles[f"loops {decision}"], str(sum(h["decision"] == decision for h in report["hypotheses"])))
        self.assertEqual(len(page.findall(f".//{xhtml}article")), min(3, len(report["hypotheses"])))
        names = {element.text for element in page.iterfind(f".//{svg}text")}
        self.assertTrue({"corridor", "office_1"} <= names, names)
        for picture in [*page.iterfind(f".//{xhtml}img"), *page.iterfind(f".//{svg}image")]:
            self.assertTrue((picture.get("src") or picture.get("href")).startswith("data:image/"))
        for element in page.iterfind(f".//{xhtml}img"):
            self.assertGreater(len(element.get("alt")), 20)

    def test_a_report_changes_nothing_in_the_map(self):
        self.tour()
        for name, report in (("with.map", ("--report", "report")), ("without.map", ())):
            self.result_of("map", "build", "--tour", "tour", "--camera", "tour/camera.json", "--out", name, *report)
        self.assertEqual(self.content("with.map"), self.content("without.map"))

    def test_helps(self):
        for command in ((), ("map",), ("map", "build"), ("map", "export"), ("localise",), ("home",), ("route",), ("simulate", "tour")):
            self.assertIn("Usage:", self.result_of(*command, "--help"))


if __name__ == "__main__":
    executable = sys.argv.pop(1)
    CliTest.program = Program(executable, Path(executable).parent / "cli-cache")
    unittest.main()
