#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`homeward calibrate`: a camera from pictures of a board that are drawn here, and what bad input gets."""

import json
import math
import shutil
import struct
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

from program import CliTest, Program, write_png

WIDTH, HEIGHT, FOCAL = 320, 240, 290.0
COLS, ROWS, SQUARE = 7, 5, 0.03
CALIBRATE = ("calibrate", "--images", "pictures", "--board", "7x5", "--square-m", "0.03", "--model", "pinhole",
             "--out", "camera.json")


def rotation(x, y, z):
    """Turns about x, then y, then z."""
    def times(a, b):
        return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
    cx, sx, cy, sy, cz, sz = math.cos(x), math.sin(x), math.cos(y), math.sin(y), math.cos(z), math.sin(z)
    return times([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]],
                 times([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]], [[1, 0, 0], [0, cx, -sx], [0, sx, cx]]))


def draw_board(file, turned, right_m, down_m, ahead_m):
    """The board as a camera without distortion sees it, its principal point in the middle; 2 x 2 rays a pixel."""
    turn = rotation(*turned)
    middle = (SQUARE * (COLS - 1) / 2, SQUARE * (ROWS - 1) / 2)
    origin = [at - turn[i][0] * middle[0] - turn[i][1] * middle[1]
              for i, at in enumerate((right_m, down_m, ahead_m))]
    # Board coordinates of a ray: it meets the plane where normal . (distance * ray - origin) = 0.
    normal = [turn[i][2] for i in range(3)]
    towards_plane = sum(normal[i] * origin[i] for i in range(3))

    def grey(u, v):
        ray = ((u - (WIDTH - 1) / 2) / FOCAL, (v - (HEIGHT - 1) / 2) / FOCAL, 1.0)
        distance = towards_plane / (normal[0] * ray[0] + normal[1] * ray[1] + normal[2])
        off = [distance * ray[i] - origin[i] for i in range(3)]
        col = math.floor(sum(turn[i][0] * off[i] for i in range(3)) / SQUARE)
        row = math.floor(sum(turn[i][1] * off[i] for i in range(3)) / SQUARE)
        if not (-2 <= col <= COLS and -2 <= row <= ROWS):
            return 110
        return 25 if -1 <= col < COLS and -1 <= row < ROWS and (col + row) % 2 == 0 else 230

    rows = bytearray()
    for v in range(HEIGHT):
        rows.append(0)
        for u in range(WIDTH):
            rows.append(sum(grey(u + x, v + y) for x in (-0.25, 0.25) for y in (-0.25, 0.25)) // 4)

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 0, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(bytes(rows))) + chunk(b"IEND", b""))


class Calibrate(CliTest):
    boards = None

    @classmethod
    def setUpClass(cls):  # no tour is needed here
        Calibrate.boards = Path(tempfile.mkdtemp(prefix="homeward-cli-"))
        cls.addClassCleanup(shutil.rmtree, Calibrate.boards, ignore_errors=True)
        for number, (turned, at) in enumerate([((0.5, 0.1, 0.1), (-0.04, -0.02, 0.32)), ((-0.5, 0.2, 1.2), (0.05, 0, 0.36)),
                                               ((0.1, 0.6, -0.3), (0, 0.03, 0.28)), ((0.2, -0.6, 2.0), (0, 0, 0.42))]):
            draw_board(Calibrate.boards / f"{number}.png", turned, *at)

    def pictures(self, count=4):
        folder = self.folder / "pictures"
        folder.mkdir()
        for file in sorted(self.boards.iterdir())[:count]:
            shutil.copy(file, folder)
        return folder

    def test_a_camera_and_a_picture_of_the_residuals(self):
        self.pictures()
        result = json.loads(self.result_of(*CALIBRATE, "--residuals", "residuals.png", "--json"))
        self.assertLess(result["rms_px"], 0.2)
        self.assertEqual(len(result["used"]), 4)
        focal = result["parameters"]["fx_px"]
        self.assertLess(abs(focal["value"] - FOCAL), max(3.0, 4 * focal["deviation"]))
        camera = json.loads((self.folder / "camera.json").read_text())
        self.assertEqual(camera, result["camera"])
        self.assertEqual((camera["model"], camera["width_px"], camera["height_px"]), ("pinhole", WIDTH, HEIGHT))
        self.assertTrue((self.folder / "residuals.png").read_bytes().startswith(b"\x89PNG"))

    def test_unusable_pictures_are_named_and_skipped(self):
        folder = self.pictures()
        (folder / "letter.jpg").write_text("This is no picture.")
        write_png(folder / "grey.png", WIDTH, HEIGHT, 90)
        write_png(folder / "small.png", 100, 80, 90)
        done = self.run_program(*CALIBRATE)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 3, done.stderr)
        for name in ("letter.jpg", "grey.png", "small.png"):
            self.assertIn(name, done.stderr)

    def test_two_views_are_too_few(self):
        self.pictures(2)
        self.assert_refused(2, ["2 views", "pictures"], *CALIBRATE)

    def test_no_pictures(self):
        (self.folder / "pictures").mkdir()
        self.assert_refused(2, ["pictures"], *CALIBRATE)
        self.assert_refused(2, ["pictures"], "calibrate", "mirror", "--images", "pictures")
        self.assert_refused(3, ["nowhere"], "calibrate", "mirror", "--images", "nowhere")

    def test_wrong_options(self):
        self.pictures()

        def refused(names, option, value):
            at = CALIBRATE.index(option)
            self.assert_refused(2, names, *CALIBRATE[:at + 1], value, *CALIBRATE[at + 2:])
        for board in ("7", "7x", "x5", "7x5x3", "7 by 5", "2x5", "-7x5", "7x5000000000"):
            refused(["--board"], "--board", board)
        refused(["square"], "--square-m", "-1")
        refused(["--square-m"], "--square-m", "0")
        refused(["ocam", "fisheye"], "--model", "ocam")
        self.assert_refused(2, ["--mirror"], *CALIBRATE, "--mirror")
        for option in ("--images", "--board", "--square-m", "--model", "--out"):
            at = CALIBRATE.index(option)
            self.assert_refused(2, [option], *CALIBRATE[:at], *CALIBRATE[at + 2:])
        self.assert_refused(2, ["--images"], "calibrate", "mirror")

    def test_a_camera_that_cannot_be_written(self):
        self.pictures()
        self.assert_refused(5, ["none/camera.json"], *CALIBRATE[:-1], "none/camera.json")

    def test_no_mirror(self):
        self.pictures()
        self.assert_refused(4, ["mirror", "pictures"], "calibrate", "mirror", "--images", "pictures")


if __name__ == "__main__":
    executable = sys.argv.pop(1)
    CliTest.program = Program(executable, Path(executable).parent / "cli-cache")
    unittest.main()
