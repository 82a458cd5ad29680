# SPDX-License-Identifier: Apache-2.0
"""Runs the program under test and keeps a small tour to work on."""

import json
import os
import shutil
import struct
import subprocess
import tempfile
import unittest
import zlib
from pathlib import Path

ENDINGS_OF_A_CRASH = ("terminate called", "what():", "Segmentation", "Assertion", "AddressSanitizer", "runtime error", "Traceback")


class Program:
    """The executable, run in a folder of its own, with its cache kept beside the build."""

    def __init__(self, executable, cache):
        self.executable = executable
        self.environment = dict(os.environ, XDG_CACHE_HOME=str(cache))

    def run(self, *arguments, cwd):
        return subprocess.run([self.executable, *map(str, arguments)], cwd=cwd, env=self.environment,
                              capture_output=True, text=True, timeout=300)


def write_png(file, width, height, grey):
    """A grey picture of one colour."""
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
    rows = (b"\0" + bytes([grey]) * width) * height
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class CliTest(unittest.TestCase):
    """One tour of a corridor and an office, rendered once, and its map; each test works in a new folder."""

    program = None  # set by the main program
    shared = None

    @classmethod
    def setUpClass(cls):
        if CliTest.shared is not None:
            return
        CliTest.shared = Path(tempfile.mkdtemp(prefix="homeward-cli-"))
        unittest.addModuleCleanup(shutil.rmtree, CliTest.shared, ignore_errors=True)
        made = cls.program.run("simulate", "tour", "--world", "offices:1", "--rooms", "corridor,office_1", "--step-m", 1,
                               "--marks", "--camera", "equirectangular", "--out", "tour", cwd=CliTest.shared)
        assert made.returncode == 0, made.stderr
        built = cls.program.run("map", "build", "--tour", "tour", "--camera", "tour/camera.json", "--out", "good.map",
                                cwd=CliTest.shared)
        assert built.returncode == 0, built.stderr

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="homeward-cli-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def run_program(self, *arguments):
        return self.program.run(*arguments, cwd=self.folder)

    def result_of(self, *arguments):
        """Standard output of a run that must succeed without a word on standard error."""
        done = self.run_program(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")
        return done.stdout

    def lines_of(self, *arguments):
        return [json.loads(line) for line in self.result_of(*arguments).splitlines()]

    def tour(self, name="tour", without=("poses.csv", "scans.csv")):
        """A copy of the tour that a test may damage."""
        shutil.copytree(self.shared / "tour", self.folder / name, ignore=shutil.ignore_patterns(*without))
        return self.folder / name

    def good_map(self, name="good.map"):
        shutil.copy(self.shared / "good.map", self.folder / name)
        return self.folder / name

    def assert_refused(self, code, names, *arguments):
        """The run fails with this exit code and one sentence that has all `names`, and leaves no file behind."""
        before = self.files()
        done = self.run_program(*arguments)
        shown = f"{arguments}\nexit code {done.returncode}\n{done.stderr}"
        self.assertEqual(done.returncode, code, shown)
        for ending in ENDINGS_OF_A_CRASH:
            self.assertNotIn(ending, done.stderr, shown)
        lines = [line for line in done.stderr.splitlines() if line != "Run with --help for more information."]
        self.assertEqual(len(lines), 1, shown)
        for name in names:
            self.assertIn(name, lines[0], shown)
        self.assertEqual(done.stdout, "", shown)
        self.assertEqual(self.files(), before, shown)

    def files(self):
        """What lies in the test's folder, with its content."""
        return {str(file.relative_to(self.folder)): file.read_bytes() for file in self.folder.rglob("*") if file.is_file()}
