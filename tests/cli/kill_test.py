#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A build that is killed at any moment: the older map is whole or the new one is, and little is left behind."""

import json
import os
import random
import sqlite3
import subprocess
import sys
import time
import unittest
from pathlib import Path

from program import CliTest, Program

KILLS_ANY_TIME = 18
KILLS_WHEN_WRITING = 24  # as soon as the unfinished file is seen, or a moment later
KILLS_AROUND_THE_END = 8
PICTURES = 3


class KilledBuilds(CliTest):
    def setUp(self):
        super().setUp()
        tour = self.tour(without=("*.csv", "tour.json"))
        for picture in sorted(tour.glob("*.jpg"))[PICTURES:]:
            picture.unlink()
        (self.folder / "maps").mkdir()
        self.map = self.folder / "maps" / "house.map"
        self.part = self.folder / "maps" / "house.map.part"

    def command(self, name):
        return ["map", "build", "--tour", "tour", "--camera", "tour/camera.json", "--out", "maps/house.map", "--name", name]

    def start(self, name):
        return subprocess.Popen([self.program.executable, *self.command(name)], cwd=self.folder, env=self.program.environment,
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def kill_after(self, name, seconds):
        build = self.start(name)
        try:
            build.wait(seconds)
        except subprocess.TimeoutExpired:
            build.kill()
        build.wait()

    def kill_when_writing(self, name, seconds_more):
        build = self.start(name)
        while build.poll() is None and not self.part.exists():
            time.sleep(5e-5)
        if seconds_more > 0:
            time.sleep(seconds_more)
        build.kill()
        build.wait()

    def said_by_the_map(self):
        """Its name, and all else that it says but for the time that building took."""
        said = json.loads(self.result_of("map", "inspect", self.map, "--json"))
        said.pop("build_seconds")
        said.pop("bytes")
        database = sqlite3.connect(f"file:{self.map}?mode=ro", uri=True)
        name = json.loads(database.execute("SELECT value FROM meta WHERE key = 'name'").fetchone()[0])
        database.close()
        return name, said

    def test_fifty_kills(self):
        self.result_of(*self.command("before"))
        begin = time.monotonic()
        self.result_of(*self.command("before"))
        whole_s = time.monotonic() - begin
        name, right = self.said_by_the_map()
        self.assertEqual(name, "before")
        rng = random.Random(50)
        plan = ([("time", rng.uniform(0.0, whole_s)) for _ in range(KILLS_ANY_TIME)] +
                [("writing", rng.choice((0.0, rng.uniform(0.0, 0.004)))) for _ in range(KILLS_WHEN_WRITING)] +
                [("time", whole_s + rng.uniform(-0.06, 0.01)) for _ in range(KILLS_AROUND_THE_END)])
        rng.shuffle(plan)
        cut_in_the_write = replaced = 0
        before = "before"
        for number, (kind, seconds) in enumerate(plan):
            wanted = f"build {number}"
            was = self.map.read_bytes()
            if kind == "time":
                self.kill_after(wanted, seconds)
            else:
                if self.part.exists():  # what the one before left would be taken for what this one makes
                    self.part.unlink()
                self.kill_when_writing(wanted, seconds)
            self.assertLessEqual(set(os.listdir(self.map.parent)), {"house.map", "house.map.part"})
            cut_in_the_write += self.part.exists() and kind == "writing"
            now, said = self.said_by_the_map()
            self.assertEqual(said, right, f"kill {number}, {kind} {seconds}")
            self.assertIn(now, (before, wanted))
            if now == before:
                self.assertEqual(self.map.read_bytes(), was)
            replaced += now == wanted
            before = now
        self.assertGreater(cut_in_the_write, 0)  # else this test did not reach what it is for
        print(f"{cut_in_the_write} of {len(plan)} kills cut the write, {replaced} builds were through", file=sys.stderr)
        self.part.write_bytes(b"left by a killed build")
        self.result_of(*self.command("after"))
        self.assertEqual(self.said_by_the_map(), ("after", right))
        self.assertEqual(os.listdir(self.map.parent), ["house.map"])


if __name__ == "__main__":
    executable = sys.argv.pop(1)
    CliTest.program = Program(executable, Path(executable).parent / "cli-cache")
    unittest.main()
