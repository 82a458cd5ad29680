#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""One tour, one map, bit for bit: without the truth, with any number of threads, in whatever order a folder is listed."""

import os
import random
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from program import CliTest, Program


class SameMap(CliTest):
    def map_bytes(self, tour, *options, before=()):
        """The map file as it is on disk, but for the time that building took and the checksum that holds it."""
        file = self.folder / "made.map"
        done = subprocess.run([*before, self.program.executable, "map", "build", "--tour", str(tour), "--camera",
                               str(self.shared / "tour" / "camera.json"), "--out", str(file), *map(str, options)],
                              env=self.program.environment, capture_output=True, text=True, timeout=300)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        database = sqlite3.connect(file)
        self.assertEqual(database.execute("DELETE FROM meta WHERE key IN ('build_seconds', 'checksum')").rowcount, 2)
        database.commit()
        database.execute("VACUUM")
        database.close()
        content = bytearray(file.read_bytes())
        file.unlink()
        return bytes(content)

    def test_the_truth_is_never_read(self):
        with_truth = self.map_bytes(self.tour(without=()))
        self.assertTrue((self.folder / "tour" / "poses.csv").exists())
        (self.folder / "tour" / "poses.csv").unlink()
        self.assertEqual(self.map_bytes(self.folder / "tour"), with_truth)
        (self.folder / "tour" / "poses.csv").write_text("nonsense\n")
        self.assertEqual(self.map_bytes(self.folder / "tour"), with_truth)

    def test_threads(self):
        tour = self.tour()
        one = self.map_bytes(tour, "--threads", 1)
        for threads in (2, 3, 8):
            self.assertEqual(self.map_bytes(tour, "--threads", threads), one, f"{threads} threads")
        if shutil.which("taskset"):
            self.assertEqual(self.map_bytes(tour, before=("taskset", "-c", str(min(os.sched_getaffinity(0))))), one)

    def test_the_order_of_a_folder(self):
        # In memory a folder is listed by the age of its files; elsewhere often by a hash of their names.
        place = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
        holder = Path(tempfile.mkdtemp(prefix="homeward-order-", dir=place))
        self.addCleanup(shutil.rmtree, holder, ignore_errors=True)
        names = sorted(file.name for file in (self.shared / "tour").iterdir() if file.name != "poses.csv")
        shuffled = random.Random(4).sample(names, len(names))
        maps, listings = [], []
        for number, order in enumerate((names, names[::-1], shuffled)):
            folder = holder / str(number) / "tour"
            folder.mkdir(parents=True)
            for name in order:
                shutil.copy(self.shared / "tour" / name, folder / name)
            listings.append(tuple(os.listdir(folder)))
            maps.append(self.map_bytes(folder))
        self.assertEqual(maps[1], maps[0])
        self.assertEqual(maps[2], maps[0])
        if len(set(listings)) == 1:
            self.skipTest("this file system lists a folder in one order, however it was filled")


if __name__ == "__main__":
    executable = sys.argv.pop(1)
    CliTest.program = Program(executable, Path(executable).parent / "cli-cache")
    unittest.main()
