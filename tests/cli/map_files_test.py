#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every command that reads a map, on files that are no whole map: what it says, and that it does not crash."""

import json
import os
import random
import shutil
import sqlite3
import subprocess
import sys
import unittest
from pathlib import Path

from program import ENDINGS_OF_A_CRASH, CliTest, Program

EVERY_READER = (
    ("map", "inspect", "{}"),
    ("map", "inspect", "{}", "--json"),
    ("map", "export", "{}", "--format", "json"),
    ("map", "shortcuts", "{}"),
    ("localise", "--map", "{}", "--images", "{tour}"),
    ("route", "--map", "{}", "--from", "corridor", "--to", "office_1"),
)


class MapFiles(CliTest):
    def assert_refused_by_all(self, code, names, file):
        for command in EVERY_READER:
            with self.subTest(file=file, command=command):
                words = [word.format(file, tour=self.shared / "tour") for word in command]
                self.assert_refused(code, [file, *names], *words)

    def test_no_such_map(self):
        self.assert_refused_by_all(3, ["no map file"], "none.map")

    def test_files_that_are_no_map(self):
        (self.folder / "text.map").write_text("This is no map.\n" * 100)
        (self.folder / "short.map").write_text("no")
        shutil.copy(self.shared / "tour" / "00001.jpg", self.folder / "picture.map")
        other = sqlite3.connect(self.folder / "other.map")
        other.execute("CREATE TABLE cheese (name TEXT)")
        other.commit()
        other.close()
        (self.folder / "empty.map").write_bytes(b"")
        (self.folder / "folder.map").mkdir()
        for name in ("text.map", "short.map", "picture.map", "other.map"):
            self.assert_refused_by_all(2, ["not a Homeward map"], name)
        self.assert_refused_by_all(2, ["empty"], "empty.map")
        self.assert_refused_by_all(2, ["folder"], "folder.map")

    def test_shortcuts_that_the_map_does_not_have(self):
        self.good_map()
        self.assert_refused(2, ["There is no shortcut 1000"], "map", "shortcuts", "good.map", "--accept", "1000")
        self.assert_refused(2, ["There is no shortcut 0"], "map", "shortcuts", "good.map", "--reject", "0")
        listed = json.loads(self.result_of("map", "shortcuts", "good.map", "--json"))
        self.assertEqual(listed["revision"], 1)
        accepted = json.loads(self.result_of("map", "shortcuts", "good.map", "--accept-all", "--json"))
        self.assertEqual(accepted["revision"], 1 + len(listed["shortcuts"]))
        self.assertEqual({one["state"] for one in accepted["shortcuts"]} - {"accepted"}, set())

    def test_another_version(self):
        for version, advice in ((1, "Rebuild the map"), (1000, "newer Homeward")):
            database = sqlite3.connect(self.good_map(f"v{version}.map"))
            database.execute(f"PRAGMA user_version = {version}")
            database.commit()
            database.close()
            self.assert_refused_by_all(2, [f"version {version}", advice], f"v{version}.map")

    def test_changed_content(self):
        database = sqlite3.connect(self.good_map("changed.map"))
        database.execute("UPDATE edges SET bearing_rad = bearing_rad + 1")
        database.commit()
        database.close()
        self.assert_refused_by_all(2, ["damaged", "checksum"], "changed.map")

    def test_cut_short(self):
        whole = self.good_map().read_bytes()
        for length in (1, 15, 16, 99, 100, 1024, len(whole) // 3, len(whole) // 2, len(whole) - 1024, len(whole) - 1):
            (self.folder / "cut.map").write_bytes(whole[:length])
            self.assert_refused(2, ["cut.map"], "map", "inspect", "cut.map")
        self.assert_refused_by_all(2, ["ends early"], "cut.map")

    def test_a_flipped_bit_is_refused_or_changes_no_answer(self):
        whole = self.good_map().read_bytes()
        right = self.result_of("map", "inspect", "good.map", "--json")
        rng = random.Random(3)
        refused = 0
        for _ in range(60):
            bit = rng.randrange(8 * len(whole))
            damaged = bytearray(whole)
            damaged[bit // 8] ^= 1 << bit % 8
            (self.folder / "good.map").write_bytes(damaged)
            done = self.run_program("map", "inspect", "good.map", "--json")
            if done.returncode == 0:
                self.assertEqual(done.stdout, right, f"byte {bit // 8}")
                continue
            refused += 1
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("good.map", done.stderr)
            for ending in ENDINGS_OF_A_CRASH:
                self.assertNotIn(ending, done.stderr)
        self.assertGreater(refused, 30)

    def test_a_map_that_may_not_be_read(self):
        file = self.good_map()
        file.chmod(0)
        self.folder.chmod(0o755)
        as_nobody = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
        try:
            done = subprocess.run([self.program.executable, "map", "inspect", str(file)], capture_output=True, text=True,
                                  timeout=60, cwd="/", **as_nobody)
        except PermissionError:
            self.skipTest("nobody may not run the program where it lies")
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn("Permission denied", done.stderr)
        self.assertIn(str(file), done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1)


if __name__ == "__main__":
    executable = sys.argv.pop(1)
    CliTest.program = Program(executable, Path(executable).parent / "cli-cache")
    unittest.main()
