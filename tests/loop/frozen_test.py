#!/usr/bin/env python3
"""A robot's program that freezes and wakes up, and a rider who takes the joystick: real programs, a robot of its own.

Frozen, the base stands by its own timeout; awake again, nothing moves until a person says so, whatever was ordered
meanwhile. A hand on the joystick ends a mission and drives, and released the robot stands.
usage: frozen_test.py BIN_FOLDER WEB_FOLDER
"""
import os
import signal
import subprocess
import sys
import time
import unittest

from bridged_chair import FULL, BridgedChair, at_rest
from rest_client import Failed

BASE_TIMEOUT_S = 0.25


class Frozen(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.chair = BridgedChair(sys.argv[1], sys.argv[2], 18481, BASE_TIMEOUT_S)

    @classmethod
    def tearDownClass(cls):
        print("--- end of agent.log ---", *cls.chair.log("agent").splitlines()[-12:], sep="\n")
        cls.chair.close()

    def test_0_its_loop_runs_before_other_programs(self):
        self.chair.wait_until_located()  # and so it loops
        permitted = subprocess.run(["chrt", "-r", "10", "true"], stderr=subprocess.DEVNULL).returncode == 0
        policies = {os.sched_getscheduler(int(thread)) & ~os.SCHED_RESET_ON_FORK
                    for thread in os.listdir(f"/proc/{self.chair.processes['agent'].pid}/task")}
        logged = "permit this program to run in real time" in self.chair.log("agent")
        self.assertEqual((os.SCHED_RR in policies, logged), (permitted, not permitted))
        self.assertIn(os.SCHED_OTHER, policies, "what only looks must not hold up what steers")

    def freeze(self, seconds):
        """Freezes the agent while it drives. The base stands in time; the agent wakes up; gives its new log lines."""
        before = len(self.chair.log("agent"))
        frozen_us = time.time_ns() // 1000
        self.chair.send("agent", signal.SIGSTOP)
        told_s, stood_s = self.chair.stood(frozen_us, seconds)
        print(f"the base was told to stand after {told_s:.2f} s and stood after {stood_s:.2f} s", file=sys.stderr)
        self.assertLessEqual(told_s, BASE_TIMEOUT_S + 0.15)
        self.chair.send("agent", signal.SIGCONT)
        self.assertEqual(self.chair.moved(3.0), [], "it moved without a person's word")
        return self.chair.log("agent")[before:]

    def test_1_awake_again_it_stands_until_a_person_says_so(self):
        self.chair.set_off("kitchen", "hall")
        self.assertIn("The robot's computer was held up.", self.freeze(1.2))
        self.assertEqual(self.chair.mission()["state"], "stopped")
        self.chair.set_off("kitchen", "hall")  # a person's word

    def test_2_a_long_sleep_changes_nothing_of_that(self):
        if self.chair.mission()["state"] != "driving":
            self.chair.set_off("hall", "kitchen")
        self.freeze(8.0)
        self.assertEqual(self.chair.mission()["state"], "stopped")

    def test_3_what_was_ordered_while_it_was_frozen_moves_nothing(self):
        self.chair.wait_until_located()
        self.chair.send("agent", signal.SIGSTOP)
        time.sleep(0.2)
        self.chair.order("hall")  # the server does not know yet
        time.sleep(2.5)
        self.chair.send("agent", signal.SIGCONT)
        self.assertEqual(self.chair.moved(4.0), [], "an order of before it woke up moved it")
        self.assertIn(self.chair.mission()["state"], ("stopped", "refused"))

    def test_4_a_hand_on_the_joystick_ends_the_mission_and_drives(self):
        self.chair.set_off("hall", "kitchen")
        self.chair.push(1, FULL)  # backwards
        self.chair.wait("it drives backwards", lambda: self.chair.truth()["commanded_mps"] < 0, 1.0)
        self.chair.wait("the server knows", lambda: self.chair.mission()["state"] == "stopped", 2.0)
        self.assertEqual(self.chair.mission()["reason"]["code"], "rider_took_over")
        with self.subTest("a mission now is refused"):
            self.chair.order("kitchen")
            self.chair.wait("refused", lambda: self.chair.mission()["state"] == "refused", 2.0)
            self.assertEqual(self.chair.mission()["reason"]["code"], "rider_steers")
        # Until it does, it slows down from driving forwards: standing for a moment then is not having stopped.
        self.chair.wait("it moves backwards", lambda: self.chair.truth()["speed_mps"] < -0.05, 2.0)
        self.chair.push(1, 0)
        self.chair.wait("it stands", lambda: at_rest(self.chair.truth()), 2.0)
        self.assertEqual(self.chair.moved(3.0), [], "it moved with the hand off and without a person's word")

    def test_5_the_rider_needs_no_server_and_touches_nothing(self):
        self.chair.send("server", signal.SIGKILL)
        self.chair.processes["server"].wait()
        self.chair.push(0, -FULL)  # to the left
        self.chair.wait("it turns", lambda: self.chair.truth()["turn_radps"] > 0.3, 3.0)
        self.chair.push(0, 0)
        self.chair.push(1, -FULL)  # and on until something stands in the way
        time.sleep(8.0)
        self.assertEqual(self.chair.truth()["collisions"], 0)
        self.chair.push(1, 0)
        time.sleep(1.0)
        self.assertEqual(self.chair.moved(1.0), [])


if __name__ == "__main__":
    try:
        unittest.main(argv=sys.argv[:1], verbosity=2)
    except Failed as failed:
        sys.exit(str(failed))
