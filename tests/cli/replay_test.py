#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `homeward replay` says to files that are no recordings; tests/loop/recordings_test.py replays real ones."""

import sqlite3
import sys
import unittest
from pathlib import Path

from program import CliTest, Program

RECORDING_ID = 0x48575243


class Replay(CliTest):
    def database(self, application_id, version):
        file = self.folder / "mission.hwrec"
        with sqlite3.connect(file) as database:
            database.execute(f"PRAGMA application_id = {application_id}")
            database.execute(f"PRAGMA user_version = {version}")
            database.execute("CREATE TABLE meta (key TEXT PRIMARY KEY, value TEXT NOT NULL)")
        database.close()
        return file

    def refuse(self, code, *words):
        for options in ((), ("--json",), ("--why",), ("--export", "out"), ("--states", "out")):
            with self.subTest(options=options):
                self.assert_refused(code, ["mission.hwrec", *words], "replay", "mission.hwrec", *options)
                self.assertFalse((self.folder / "out").exists())

    def test_there_is_no_such_file(self):
        self.refuse(3, "no recording")

    def test_a_folder(self):
        (self.folder / "mission.hwrec").mkdir()
        self.refuse(2, "plain file")

    def test_no_database(self):
        (self.folder / "mission.hwrec").write_text("t_us,x_m,y_m\n")
        self.refuse(2, "not a recording")

    def test_a_map(self):
        self.good_map("mission.hwrec")
        self.refuse(2, "SQLite file is not a recording")

    def test_of_a_newer_program(self):
        self.database(RECORDING_ID, 8)
        self.refuse(2, "version 8", "newer")

    def test_without_anything_in_it(self):
        self.database(RECORDING_ID, 1)
        self.refuse(2, "lacks the entry 'agent'")

    def test_cut_short(self):
        file = self.database(RECORDING_ID, 1)
        file.write_bytes(file.read_bytes()[:-100])
        self.refuse(2, "ends early")

    def test_wrong_use(self):
        self.assert_refused(2, ["recording"], "replay")
        self.assert_refused(2, ["--why"], "replay", "mission.hwrec", "--why", "--export", "out")

        for more in (("--why",), ("--export", "out")):
            self.assert_refused(2, ["--states"], "replay", "mission.hwrec", "--states", "states.csv", *more)

    def test_states_over_a_file(self):
        file = self.database(RECORDING_ID, 1)
        before = file.read_bytes()
        self.assert_refused(4, ["mission.hwrec", "already"], "replay", "mission.hwrec", "--states", "mission.hwrec")
        self.assertEqual(file.read_bytes(), before)

    def test_recording_into_a_folder_that_holds_something(self):
        (self.folder / "scenario.json").write_text(
            '{"format": "homeward-scenario", "version": 1, "world": "house:1", "seed": 1, '
            '"camera": {"model": "hyperbolic_mirror"}, "tour": {"rooms": ["hall", "kitchen"], "light": "day"}, '
            '"missions": [{"from": "hall", "to": "kitchen"}]}')
        (self.folder / "kept").mkdir()
        (self.folder / "kept" / "notes.txt").write_text("mine")
        self.assert_refused(4, ["kept", "holds something"], "simulate", "run", "--scenario", "scenario.json", "--record", "kept")


if __name__ == "__main__":
    executable = sys.argv.pop(1)
    CliTest.program = Program(executable, Path(executable).parent / "cli-cache")
    unittest.main()
