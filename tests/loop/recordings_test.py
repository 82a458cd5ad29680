#!/usr/bin/env python3
"""Recorded missions in the generated house, replayed: every vector, decision and command again, bit for bit.

usage: recordings_test.py BIN_FOLDER WEB_FOLDER
"""
import json
import pathlib
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(sys.argv[1]).resolve()
SCENARIO = {"format": "homeward-scenario", "version": 1, "world": "house:1", "seed": 1,
            "camera": {"model": "hyperbolic_mirror"},
            "tour": {"rooms": ["hall", "kitchen", "living_room", "hall"], "light": "day"},
            "missions": [
                {"from": "hall", "to": "kitchen"},
                {"from": "hall", "to": "kitchen", "people": 1, "faults": [
                    {"kind": "camera_occluded", "at_s": 2, "for_s": 1, "share": 0.6},
                    {"kind": "camera_frozen", "at_s": 4, "for_s": 0.5},
                    {"kind": "scan_lost", "at_s": 6, "for_s": 60}]},
                {"from": "hall", "to": "kitchen", "faults": [{"kind": "link_lost", "at_s": 3, "for_s": 60}]}]}
CODES = ["", "range_sensor_silent", "link_lost"]


class Recordings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="homeward-recordings-")
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.schema = json.loads((ROOT / "proto/schemas/replay.schema.json").read_text())
        cls.scenario = cls.folder / "scenario.json"
        cls.scenario.write_text(json.dumps(SCENARIO))
        done = subprocess.run([BIN / "homeward", "simulate", "run", "--scenario", cls.scenario, "--json", "--record",
                               cls.folder / "recordings"], check=True, capture_output=True, text=True)
        cls.results = [json.loads(line) for line in done.stdout.splitlines()]
        cls.files = sorted((cls.folder / "recordings").iterdir())

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def replay(self, file, *options):
        return subprocess.run([BIN / "homeward", "replay", file, "--json", *options], capture_output=True, text=True)

    def test_each_mission_is_one_file(self):
        self.assertEqual([file.name for file in self.files],
                         [f"00{n}-hall-to-kitchen.hwrec" for n in (1, 2, 3)])

    def test_every_vector_comes_out_again_bit_for_bit(self):
        for file, result, code in zip(self.files, self.results, CODES, strict=True):
            with self.subTest(file=file.name):
                done = self.replay(file)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                replayed = json.loads(done.stdout)
                self.assertEqual(set(replayed), set(self.schema["required"]))
                why = self.schema["properties"]["why_stopped"]
                self.assertEqual(set(replayed["why_stopped"]), set(why["required"]))
                self.assertEqual(replayed["differing"], [])
                self.assertTrue(replayed["complete"], replayed)
                self.assertEqual(replayed["compared"], replayed["steps"])
                self.assertGreater(replayed["vectors"], 20)
                self.assertEqual(replayed["why_stopped"]["state"], "stopped" if code else "arrived")
                if code:
                    self.assertEqual(replayed["why_stopped"]["reason"]["code"], code)
                    self.assertEqual(replayed["why_stopped"]["reason"], result["stops"][0]["reason"])
                    self.assertAlmostEqual(replayed["why_stopped"]["after_s"], result["stops"][0]["t_s"])
                else:
                    self.assertIsNone(replayed["why_stopped"]["reason"])
                    self.assertTrue(result["arrived"], result)

    def test_how_many_features_were_tracked_recovered_and_lost_stands_beside_each_vector(self):
        with sqlite3.connect(f"file:{self.files[1]}?mode=ro", uri=True) as database:
            rows = database.execute("SELECT bearing_rad IS NULL, tracked, recovered, lost FROM steps").fetchall()
        for without_vector, *counts in rows:
            self.assertEqual([count is None for count in counts], 3 * [bool(without_vector)])
        counts = [row[1:] for row in rows if not row[0]]
        self.assertGreater(max(tracked for tracked, _, _ in counts), 30)
        self.assertGreater(max(recovered for _, recovered, _ in counts), 0)
        self.assertGreater(max(lost for _, _, lost in counts), 0)
        self.assertTrue(all(recovered <= tracked for tracked, recovered, _ in counts))

    def test_why_it_stopped_is_one_query(self):
        with sqlite3.connect(f"file:{self.files[1]}?mode=ro", uri=True) as database:
            rows = database.execute("SELECT state, reason, since_sweep_s FROM why_did_it_stop").fetchall()
        self.assertEqual(len(rows), 1)
        self.assertEqual((rows[0][0], json.loads(rows[0][1])["code"]), ("stopped", "range_sensor_silent"))
        self.assertGreater(rows[0][2], 0.4)
        self.assertEqual(json.loads(self.replay(self.files[1], "--why").stdout)["since_sweep_s"], rows[0][2])

    def test_a_changed_recording_does_not_pass(self):
        file = self.folder / "changed.hwrec"
        file.write_bytes(self.files[2].read_bytes())
        with sqlite3.connect(file) as database:
            database.execute("UPDATE pictures SET bytes = (SELECT bytes FROM pictures WHERE step = 1) WHERE step = 20")
        done = self.replay(file)
        self.assertNotEqual(done.returncode, 0)
        replayed = json.loads(done.stdout)
        self.assertGreater(replayed["differences"], 0)
        self.assertEqual(replayed["differing"][0]["step"], 20)

    def test_what_was_recorded_survives_a_kill(self):
        folder = self.folder / "killed"
        process = subprocess.Popen([BIN / "homeward", "simulate", "run", "--scenario", self.scenario, "--record", folder],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        file = folder / "001-hall-to-kitchen.hwrec"
        ends = time.monotonic() + 300
        while self.steps(file) < 30:
            self.assertIsNone(process.poll(), "it ended before it could be killed")
            self.assertLess(time.monotonic(), ends)
            time.sleep(0.2)
        process.send_signal(signal.SIGKILL)
        process.wait()
        done = self.replay(file)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        replayed = json.loads(done.stdout)
        self.assertGreaterEqual(replayed["compared"], 30)
        self.assertEqual(replayed["compared"], replayed["steps"])
        self.assertFalse(replayed["complete"])
        self.assertIn("cut off", replayed["note"])
        self.assertEqual(replayed["why_stopped"]["state"], "driving")

    @staticmethod
    def steps(file):
        if not file.exists():
            return 0
        try:
            with sqlite3.connect(f"file:{file}?mode=ro", uri=True) as database:
                return database.execute("SELECT count(*) FROM steps").fetchone()[0]
        except sqlite3.OperationalError:  # it is only being made
            return 0


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
