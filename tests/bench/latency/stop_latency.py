#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How soon the robot is told to stand, and stands, after a stop request and after each kind of silence.

The real server and agent and a simulated robot behind a rosbridge, each a program of its own; every time the robot is
under way on a mission (above 0.2 m/s, or --above). Measured on the robot: from just before the request is sent, the key is pressed
or the signal is given, to the first moment at which its wheels are told zero for good, and to that at which it stands.
usage: stop_latency.py BIN_FOLDER WEB_FOLDER [--runs N] [--above MPS] [--only CASE] [--json FILE]
Ends with 1 when a bound does not hold.
"""
import argparse
import json
import os
import pathlib
import signal
import statistics
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests" / "loop"))
from bridged_chair import FULL, UNDER_WAY_MPS, BridgedChair  # noqa: E402

BASE_TIMEOUT_S = 0.2
STOP_BOUND_S = 0.2     # to the zero at the driver
SILENCE_BOUND_S = 0.5  # to rest


class Latencies:
    def __init__(self, chair):
        self.chair = chair
        self.rooms = ("kitchen", "hall", "living_room")
        self.count = 0

    def stop_request(self):
        self.chair.server.call("POST", f"/api/v1/robots/{self.chair.robot}/stop", {})

    def server_killed(self):
        self.chair.send("server", signal.SIGKILL)

    def server_frozen(self):
        self.chair.send("server", signal.SIGSTOP)

    def camera_silent(self):
        self.chair.send("robot", signal.SIGUSR1)

    def scanner_silent(self):
        self.chair.send("robot", signal.SIGUSR2)

    def agent_frozen(self):
        self.chair.send("agent", signal.SIGSTOP)

    def agent_killed(self):
        self.chair.send("agent", signal.SIGKILL)

    def rider(self):
        # A touch of the joystick, and released again at once.
        self.chair.push(1, FULL)
        time.sleep(0.06)
        self.chair.push(1, 0)

    def mend(self, what):
        chair = self.chair
        if what == "server_killed":
            chair.processes["server"].wait()
            chair.start_server()
        elif what == "server_frozen":
            chair.send("server", signal.SIGCONT)
        elif what == "camera_silent":
            chair.send("robot", signal.SIGUSR1)
        elif what == "scanner_silent":
            chair.send("robot", signal.SIGUSR2)
        elif what == "agent_frozen":
            chair.send("agent", signal.SIGCONT)
        elif what == "agent_killed":
            chair.processes["agent"].wait()
            chair.start_agent()
        if moved := chair.moved(1.5):
            raise SystemExit(f"it moved again by itself after {what}: {moved[0]}")

    def run(self, what):
        self.count += 1
        first = self.count % len(self.rooms)
        self.chair.set_off(*self.rooms[first:], *self.rooms[:first])
        speed_mps = self.chair.truth()["speed_mps"]
        since_us = time.time_ns() // 1000
        getattr(self, what)()
        told_s, stood_s = self.chair.stood(since_us)
        self.mend(what)
        print(f"{what}: {speed_mps:.2f} m/s, told {told_s:.3f} s, stood {stood_s:.3f} s", file=sys.stderr, flush=True)
        return {"speed_mps": speed_mps, "told_s": told_s, "stood_s": stood_s}


CASES = {"stop_request": "a stop request", "rider": "a touch of the joystick (let go after 0.06 s)",
         "server_killed": "the server is killed", "server_frozen": "the server freezes",
         "camera_silent": "no more pictures", "scanner_silent": "no more sweeps",
         "agent_killed": "the agent is killed", "agent_frozen": "the agent freezes"}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("binaries")
    parser.add_argument("web")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--above", type=float, default=UNDER_WAY_MPS, metavar="MPS")
    parser.add_argument("--only", choices=list(CASES), action="append")
    parser.add_argument("--json")
    options = parser.parse_args()
    chair = BridgedChair(options.binaries, options.web, 18485, BASE_TIMEOUT_S, options.above)
    results = {}
    try:
        latencies = Latencies(chair)
        for what in options.only or CASES:
            results[what] = [latencies.run(what) for _ in range(options.runs)]
    finally:
        chair.close()
    good = True
    print(f"| what happens | runs | speed | told to stand: median, largest | stands: median, largest |\n|---|---|---|---|---|")
    for what, runs in results.items():
        def words(key):
            values = [run[key] for run in runs]
            return f"{statistics.median(values):.2f} s, {max(values):.2f} s"
        speeds = [run["speed_mps"] for run in runs]
        if what in ("stop_request", "rider"):
            good = good and max(run["told_s"] for run in runs) <= STOP_BOUND_S
        else:
            good = good and max(run["stood_s"] for run in runs) <= SILENCE_BOUND_S
        print(f"| {CASES[what]} | {len(runs)} | {min(speeds):.2f} to {max(speeds):.2f} m/s | {words('told_s')} "
              f"| {words('stood_s')} |")
    if options.json:
        pathlib.Path(options.json).write_text(json.dumps(results, indent=1))
    load = os.getloadavg()[0]
    print(f"{os.cpu_count()} processors, load average {load:.1f}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
