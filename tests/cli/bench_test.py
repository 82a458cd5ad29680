#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`homeward bench localise` on a tiny setting: its tables, its JSON, the pictures that it keeps."""

import json
import sys
import unittest
from pathlib import Path
from xml.etree import ElementTree

from program import CliTest, Program

TINY = ("bench", "localise", "--rooms", 1, "--rows", 2, "--pictures", 4, "--camera", "small.json")


class BenchLocalise(CliTest):
    def setUp(self):
        super().setUp()
        camera = json.loads((self.shared / "tour" / "camera.json").read_text())
        camera.update(width_px=512, height_px=256)
        (self.folder / "small.json").write_text(json.dumps(camera))

    def test_tables_json_and_pictures_agree(self):
        result = json.loads(self.result_of(*TINY, "--json", "--out", "kept"))
        self.assertEqual([line["training"] for line in result["table_3_2"]], ["original_0", "original_1"])
        self.assertEqual([line["apart_m"] for line in result["table_3_2"]], [0.0, 0.3])
        self.assertIn("winlit_1", [line["training"] for line in result["table_3_3"]])
        self.assertIn("moved_1", [line["training"] for line in result["table_3_3"]])
        for measure in ("moments", "jeffrey", "chi2", "sad", "fourier", "invariants", "rgb_jeffrey", "row_fourier", "vlad",
                        "features"):
            self.assertIn(measure, result["measures"])
            for line in result["table_3_2"] + result["table_3_3"]:
                for share in (line["localised"][measure], line["filtered"][measure]):
                    self.assertGreaterEqual(share, 0.0)
                    self.assertLessEqual(share, 1.0)
            curve = result["figure_3_6"]["dissimilarity"][measure]
            self.assertEqual(len(curve), 4)
            self.assertAlmostEqual(curve[0], 0.0, places=3)
        self.assertEqual(result["table_3_2"][0]["localised"]["features"], 1.0)
        self.assertEqual(json.loads((self.folder / "kept" / "tables.json").read_text()), result)
        table = (self.folder / "kept" / "curves.csv").read_text().splitlines()
        self.assertEqual(table[0].split(","), ["along_m"] + result["measures"])
        self.assertEqual([float(line.split(",")[0]) for line in table[1:]],
                         [round(along_m, 6) for along_m in result["figure_3_6"]["along_m"]])
        svg = ElementTree.fromstring((self.folder / "kept" / "curves.svg").read_text())
        curves = [path for path in svg.iter("{http://www.w3.org/2000/svg}path") if path.get("class") == "curve"]
        self.assertEqual(len(curves), len(result["measures"]))
        rows = self.folder / "kept" / "room_1"
        self.assertEqual(len(list((rows / "original_0_test").glob("*.png"))), 4)
        self.assertEqual(len(list((rows / "original_1").glob("*.png"))), 2)
        self.assertEqual(len((rows / "original_0_test" / "poses.csv").read_text().splitlines()), 5)
        self.assertEqual(json.loads((rows / "moved_1" / "condition.json").read_text())["arrangement"], 1)
        # The same place of the same room gives the same picture, whatever row it belongs to.
        self.assertEqual((rows / "original_0_test" / "00003.png").read_bytes(),
                         (rows / "original_0" / "00001.png").read_bytes())
        self.assertNotEqual((rows / "original_1" / "00001.png").read_bytes(),
                            (rows / "winlit_1" / "00001.png").read_bytes())
        text = (self.folder / "kept" / "tables.txt").read_text()
        self.assertIn("Table 3.2", text)
        header = next(line for line in text.splitlines() if line.startswith("training"))
        self.assertEqual(header.split()[2:], result["measures"])
        first = next(line for line in text.splitlines() if line.startswith("original_1"))
        self.assertEqual(float(first.split()[-1].rstrip("%")), round(100 * result["table_3_2"][1]["localised"][result["measures"][-1]], 1))

    def test_bad_use_is_refused(self):
        self.assert_refused(2, ["--rows"], "bench", "localise", "--rows", 0)
        self.assert_refused(2, ["--pictures"], "bench", "localise", "--pictures", 1)
        self.assert_refused(3, ["nowhere.json"], "bench", "localise", "--camera", "nowhere.json")
        full = self.folder / "full"
        full.mkdir()
        (full / "something.txt").write_text("kept")
        self.assert_refused(4, ["full"], *TINY, "--out", "full")


if __name__ == "__main__":
    executable = sys.argv.pop(1)
    CliTest.program = Program(executable, Path(executable).parent / "cli-cache")
    unittest.main()
