# SPDX-License-Identifier: Apache-2.0
"""A server, a map of the generated house, a simulated robot behind a rosbridge and its agent: all of them
programs of their own, so that each can be killed, frozen or silenced. What the robot truly did is read from its file."""
import json
import os
import pathlib
import signal
import struct
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "deploy"))
import demo  # noqa: E402
import taught_house  # noqa: E402
from rest_client import Failed, Server  # noqa: E402

AT_REST = 0.01
UNDER_WAY_MPS = 0.2
FULL = 32767


def at_rest(truth):
    """Whether it stands, and is told to."""
    return (abs(truth["speed_mps"]) <= AT_REST and abs(truth["turn_radps"]) <= AT_REST
            and truth["commanded_mps"] == 0 and truth["commanded_radps"] == 0)


class BridgedChair:
    def __init__(self, binaries, web, port, base_timeout_s, under_way_mps=UNDER_WAY_MPS):
        self.under_way_mps = under_way_mps
        self.binaries, self.web, self.port = pathlib.Path(binaries).resolve(), pathlib.Path(web).resolve(), port
        self.scratch = tempfile.TemporaryDirectory(prefix="homeward-chair-")
        self.data = pathlib.Path(self.scratch.name)
        self.processes = {}
        self.server = Server(f"http://127.0.0.1:{port}")
        self.mission_id = self.lease = self.hand = None
        try:
            self.set_up(base_timeout_s)
        except BaseException:
            self.close()
            raise

    def set_up(self, base_timeout_s):
        taught_house.bring(self.data)
        self.start_server()
        demo.set_up_account(self.server, self.data)
        self.robot, self.token_file = demo.robot_with_token(self.server, self.data)
        self.map_id = demo.teach(self.server, self.binaries, self.data, self.token_file)
        self.server.call("PUT", f"/api/v1/robots/{self.robot}/map", {"map": self.map_id})
        graph = self.server.call("GET", f"/api/v1/maps/{self.map_id}/graph")
        self.destinations = {d["label"]: d["id"] for d in graph["destinations"]}
        self.start("robot", self.binaries.parent / "tests" / "homeward-rosbridge-robot", str(self.port + 1), demo.WORLD,
                   "living_room", "disc", self.data / "truth.jsonl", self.data / "camera.json", str(base_timeout_s))
        self.wait("the robot is there", lambda: (self.data / "camera.json").exists(), 120)
        described = json.loads((ROOT / "proto/examples/rosbridge/valid/ros2_round.json").read_text())
        described.update(address=f"ws://127.0.0.1:{self.port + 1}", body={
            "radius_m": 0.35, "max_speed_mps": 0.8, "max_turn_radps": 1.2, "deceleration_mps2": 1.0,
            "turn_deceleration_radps2": 5.0})
        described["image"]["topic"] = "/image"
        described["scan"]["robot_from_scan"]["x_m"] = 0.0
        (self.data / "robot.json").write_text(json.dumps(described))
        self.joystick = self.data / "js0"
        os.mkfifo(self.joystick)
        self.hand = os.open(self.joystick, os.O_RDWR)
        self.start_agent()

    def start(self, name, *command):
        with open(self.data / f"{name}.log", "ab") as log:
            self.processes[name] = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT)

    def start_server(self):
        self.start("server", self.binaries / "homeward-server", "--data", self.data / "server", "--listen",
                   f"127.0.0.1:{self.port}", "--web", self.web, "--print-setup-file", self.data / "setup-link")
        self.server.wait_until_up(self.processes["server"])

    def start_agent(self):
        self.start("agent", self.binaries / "homeward-agent", "run", "--server", self.server.address, "--robot",
                   self.robot, "--token-file", self.token_file, "--driver", "rosbridge", "--rosbridge",
                   self.data / "robot.json", "--joystick", self.joystick)

    def send(self, name, number):
        self.processes[name].send_signal(number)

    def close(self):
        for process in self.processes.values():
            if process.poll() is None:
                process.send_signal(signal.SIGCONT)
                process.terminate()
        for process in self.processes.values():
            try:
                process.wait(timeout=10)
            except subprocess.TimeoutExpired:
                process.kill()
        if self.hand is not None:
            os.close(self.hand)
        self.scratch.cleanup()

    def log(self, name):
        return (self.data / f"{name}.log").read_text(errors="replace")

    def push(self, axis, value):
        """The rider's hand: an event of the Linux joystick interface."""
        os.write(self.hand, struct.pack("<IhBB", int(time.monotonic() * 1000) & 0xFFFFFFFF, value, 2, axis))

    def wait(self, what, holds, limit_s=60.0):
        end = time.monotonic() + limit_s
        while time.monotonic() < end:
            if holds():
                return
            time.sleep(0.02)
        raise Failed(f"within {limit_s} s not so: {what}\n" + "\n".join(self.log("agent").splitlines()[-15:]))

    def truths(self, since_us=0):
        file = self.data / "truth.jsonl"
        lines = file.read_text().splitlines() if file.exists() else []
        truths = (json.loads(line) for line in reversed(lines) if line.endswith("}"))
        newest = []
        for truth in truths:
            if truth["t_us"] < since_us or (since_us == 0 and newest):
                break
            newest.append(truth)
        return newest[::-1]

    def truth(self):
        return self.truths()[-1]

    def state(self):
        return self.server.call("GET", f"/api/v1/robots/{self.robot}")

    def mission(self):
        return self.server.call("GET", f"/api/v1/robots/{self.robot}/missions/{self.mission_id}")

    def order(self, room):
        """Asks for a mission; gives its path."""
        self.lease = self.server.call("POST", f"/api/v1/robots/{self.robot}/lease", {"take_over": True})["lease"]["id"]
        mission = self.server.call("POST", f"/api/v1/robots/{self.robot}/missions", {
            "lease_id": self.lease, "destination": self.destinations[room]})
        self.mission_id = mission["id"]
        return mission["path"]

    def wait_until_located(self):
        def located():
            belief = self.state().get("belief")
            return self.state()["online"] and belief and not belief["lost"] and belief["updates"] >= 3
        self.wait("it knows where it is", located, 120)

    def set_off(self, *rooms):
        """A mission to one of the rooms, the first that is not right here, well under way. A machine that does other
        work may be too slow for pictures; it is tried again then."""
        for _ in range(3):
            self.wait_until_located()
            if self.gets_under_way(rooms):
                return
            print(f"it did not get under way: {self.mission()}", file=sys.stderr, flush=True)
        raise Failed(f"it did not get under way: {self.mission()}")

    def gets_under_way(self, rooms):
        for room in rooms:
            if len(self.order(room)) > 3:
                break
        renewed = time.monotonic()
        end = renewed + 60
        while abs(self.truth()["speed_mps"]) < self.under_way_mps:
            if time.monotonic() > end or self.mission()["state"] not in ("accepted", "driving"):
                return False
            if time.monotonic() - renewed > 1:
                self.server.call("PUT", f"/api/v1/robots/{self.robot}/lease", {"lease_id": self.lease})
                renewed = time.monotonic()
            time.sleep(0.02)
        return True

    def moved(self, seconds):
        """The truths of so long in which it moved or was told to."""
        since_us = time.time_ns() // 1000
        time.sleep(seconds)
        after = self.truths(since_us)
        if not after:
            raise Failed("the robot tells nothing any more")
        return [t for t in after if not at_rest(t)]

    def stood(self, since_us, seconds=2.5):
        """Seconds until the robot was told to stand for good, and until it stood, since then."""
        time.sleep(seconds)
        after = self.truths(since_us)
        commanded = [i for i, t in enumerate(after) if t["commanded_mps"] != 0 or t["commanded_radps"] != 0]
        moving = [i for i, t in enumerate(after) if abs(t["speed_mps"]) > AT_REST or abs(t["turn_radps"]) > AT_REST]
        if not moving or max([*commanded, *moving]) + 1 >= len(after):
            raise Failed("it stood before anything happened" if not moving else "it never stood")
        def at(last):
            return (after[last[-1] + 1 if last else 0]["t_us"] - since_us) / 1e6
        return at(commanded), at(moving)
