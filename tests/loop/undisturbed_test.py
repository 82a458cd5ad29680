#!/usr/bin/env python3
"""What undisturbed.py makes of a test that fails, with the machine held up and without."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

RUNNER = pathlib.Path(__file__).resolve().parent / "undisturbed.py"
# Fails as often as it is told to; whoever watches the machine is frozen for so long each time.
SCRIPT = """
import os, pathlib, signal, sys, time
runs = pathlib.Path(sys.argv[1])
runs.write_text(runs.read_text() + "x")
if float(sys.argv[3]) > 0:
    os.kill(os.getppid(), signal.SIGSTOP)
    time.sleep(float(sys.argv[3]))
    os.kill(os.getppid(), signal.SIGCONT)
    time.sleep(0.1)
sys.exit(7 if len(runs.read_text()) <= int(sys.argv[2]) else 0)
"""


class Undisturbed(unittest.TestCase):
    def run_script(self, failures, frozen_s):
        """Exit code, how often the script ran, what was printed."""
        with tempfile.TemporaryDirectory() as folder:
            script = pathlib.Path(folder) / "script.py"
            runs = pathlib.Path(folder) / "runs"
            script.write_text(SCRIPT)
            runs.write_text("")
            ended = subprocess.run([sys.executable, RUNNER, script, runs, str(failures), str(frozen_s)],
                                   stdout=subprocess.PIPE, text=True)
            return ended.returncode, len(runs.read_text()), ended.stdout

    def test_a_test_that_passes_runs_once_however_long_the_machine_stood_still(self):
        self.assertEqual(self.run_script(0, 0.6)[:2], (0, 1))

    def test_a_failure_counts_at_once(self):
        code, runs, printed = self.run_script(1, 0.0)
        if "once more" in printed:
            self.skipTest("this machine really stood still: " + printed)
        self.assertEqual((code, runs), (7, 1))

    def test_a_failure_while_the_machine_stood_still_does_not_count(self):
        code, runs, printed = self.run_script(1, 0.6)
        self.assertEqual((code, runs), (0, 2))
        self.assertIn("=== failed with 7 while the machine stood still for 0.", printed)

    def test_the_second_run_counts_in_any_case(self):
        self.assertEqual(self.run_script(2, 0.6)[:2], (7, 2))


if __name__ == "__main__":
    unittest.main(verbosity=2)
