#!/usr/bin/env python3
"""Runs a test that goes in real time, and once more where it failed while the machine itself stood still.

A robot whose computer is held up stops and waits for a person's word. So it must, and then a mission does not arrive: on
a machine that is shared with others such a failure says nothing about the programs. For each processor a thread that
does nothing but sleep and look at the clock measures whether the machine stood still. A failure beside which it did
not counts at once; the second run counts in any case.

usage: undisturbed.py SCRIPT [ARGUMENT ...]
"""
import os
import subprocess
import sys
import threading
import time

NAP_S = 0.01
# Half of what a robot's loop bears. A thread that sleeps for nearly all its time is woken within a few hundredths of a
# second however busy the processors are.
STOOD_STILL_S = 0.2


class Witness:
    """How long each processor ran nothing at all, at worst, since `begin`."""

    def __init__(self):
        self.worst_s = 0.0
        self.worst_at = ""
        self.lock = threading.Lock()
        for processor in os.sched_getaffinity(0):
            threading.Thread(target=self.watch, args=(processor,), daemon=True).start()

    def begin(self):
        with self.lock:
            self.worst_s = 0.0

    def watch(self, processor):
        os.sched_setaffinity(0, {processor})  # of this thread alone
        before = time.monotonic()
        while True:
            time.sleep(NAP_S)
            now = time.monotonic()
            late_s = now - before - NAP_S
            before = now
            with self.lock:
                if late_s > self.worst_s:
                    self.worst_s = late_s
                    self.worst_at = time.strftime("%H:%M:%S")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    command = [sys.executable, *sys.argv[1:]]
    witness = Witness()
    code = 0
    for run in (1, 2):
        witness.begin()
        code = subprocess.call(command)
        report = f"the machine stood still for {witness.worst_s:.2f} s at most, at {witness.worst_at}"
        print(report, flush=True)
        if code == 0 or witness.worst_s < STOOD_STILL_S or run == 2:
            break
        print(f"=== failed with {code} while {report}: once more", flush=True)
    sys.exit(code)


if __name__ == "__main__":
    main()
