#!/usr/bin/env python3
"""Missions of the demo with a robot behind a rosbridge, and what happens when its connection is cut.

The same agent as everywhere, but all it knows of the simulated robot comes over the WebSocket of the tests' rosbridge; for the
wheelchair both that and the server are behind TLS.
usage: rosbridge_test.py BIN_FOLDER WEB_FOLDER [ROOM ...]      both robots drive to these rooms, in turn
"""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "deploy"))
import demo  # noqa: E402
import taught_house  # noqa: E402
import tls_front  # noqa: E402
from rest_client import Server  # noqa: E402

BIN = pathlib.Path(sys.argv[1]).resolve()
WEB = pathlib.Path(sys.argv[2]).resolve()
PORT = 18477
BRIDGE_PORT = 18478
SERVER_TLS_PORT = 18468
BRIDGE_TLS_PORT = 18469
UNDER_WAY_MPS = 0.15
AT_REST = 0.01


class Rosbridge(unittest.TestCase):
    """A disc of 0.35 m radius."""

    PROFILE = "disc"
    BODY = {"radius_m": 0.35}
    ROOMS = sys.argv[3:] or ("living_room",)
    SERVER = f"http://127.0.0.1:{PORT}"
    BRIDGE = f"ws://127.0.0.1:{BRIDGE_PORT}"

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="homeward-rosbridge-")
        cls.data = pathlib.Path(cls.folder.name)
        taught_house.bring(cls.data)
        cls.processes = []
        cls.logs = {}
        server_process = cls.start("server", BIN / "homeward-server", "--data", cls.data / "server", "--listen",
                                   f"127.0.0.1:{PORT}", "--web", WEB, "--print-setup-file", cls.data / "setup-link")
        cls.server = Server(f"http://127.0.0.1:{PORT}")
        cls.server.wait_until_up(server_process)
        demo.set_up_account(cls.server, cls.data)
        cls.robot, token_file = demo.robot_with_token(cls.server, cls.data)
        cls.map_id = demo.teach(cls.server, BIN, cls.data, token_file)
        cls.server.call("PUT", f"/api/v1/robots/{cls.robot}/map", {"map": cls.map_id})
        cls.bridge = cls.start("bridge", BIN.parent / "tests" / "homeward-rosbridge-robot", str(BRIDGE_PORT),
                               demo.WORLD, "bedroom", cls.PROFILE, cls.data / "truth.jsonl", cls.data / "camera.json")
        end = time.monotonic() + 120
        while not (cls.data / "camera.json").exists() and time.monotonic() < end:
            time.sleep(0.2)
        example = ROOT / "proto" / "examples" / "rosbridge" / "valid" / "ros2_round.json"
        robot = json.loads(example.read_text())
        robot["address"] = cls.BRIDGE
        robot["image"]["topic"] = "/image"
        robot["scan"]["robot_from_scan"]["x_m"] = 0.0
        robot["body"] = {**cls.BODY, "max_speed_mps": 0.8, "max_turn_radps": 1.2, "deceleration_mps2": 1.0,
                         "turn_deceleration_radps2": 5.0}
        (cls.data / "robot.json").write_text(json.dumps(robot))
        cls.agent_command = [BIN / "homeward-agent", "run", "--server", cls.SERVER, "--robot", cls.robot, "--token-file",
                             token_file, "--driver", "rosbridge", "--rosbridge", cls.data / "robot.json"]
        cls.start_agent()

    @classmethod
    def start_agent(cls):
        cls.start("agent", *cls.agent_command)

    @classmethod
    def start(cls, name, *command, **environment):
        cls.logs[name] = open(cls.data / f"{name}.log", "ab")
        process = subprocess.Popen(command, stdout=cls.logs[name], stderr=subprocess.STDOUT, env={**os.environ, **environment})
        cls.processes.append(process)
        return process

    @classmethod
    def tearDownClass(cls):
        for process in reversed(cls.processes):
            process.send_signal(signal.SIGCONT)
            process.terminate()
        for process in cls.processes:
            try:
                process.wait(timeout=10)
            except subprocess.TimeoutExpired:
                process.kill()
        for name in cls.logs:
            print(f"--- end of {name}.log ---", *(cls.data / f"{name}.log").read_text().splitlines()[-12:], sep="\n")
        cls.folder.cleanup()

    def truth(self):
        return demo.last_truth(self.data / "truth.jsonl")

    def wait(self, what, holds, limit_s=60.0):
        end = time.monotonic() + limit_s
        while time.monotonic() < end:
            if holds():
                return
            time.sleep(0.02)
        self.fail(f"within {limit_s} s not so: {what}")

    def test_1_missions_arrive_as_with_the_simulator(self):
        for room in self.ROOMS:
            with self.subTest(to=room):
                self.assertTrue(demo.drive(self.server, self.robot, self.map_id, room, self.data))

    def test_2_a_silent_robot_ends_the_mission_and_nothing_moves_when_it_speaks_again(self):
        self.wait("it knows where it is", lambda: (self.server.call(
            "GET", f"/api/v1/robots/{self.robot}").get("belief") or {}).get("updates", 0) >= 3)
        graph = self.server.call("GET", f"/api/v1/maps/{self.map_id}/graph")
        destination = next(d for d in graph["destinations"] if d["label"] == "kitchen")
        lease = self.server.call("POST", f"/api/v1/robots/{self.robot}/lease", {"take_over": True})["lease"]
        mission = self.server.call("POST", f"/api/v1/robots/{self.robot}/missions",
                                   {"lease_id": lease["id"], "destination": destination["id"]})
        def under_way():
            self.server.call("PUT", f"/api/v1/robots/{self.robot}/lease", {"lease_id": lease["id"]})
            return abs(self.truth()["speed_mps"]) > UNDER_WAY_MPS
        self.wait("under way", under_way)
        # The robot's computer hangs for longer than the connection bears, and goes on with the last Twist it heard.
        self.bridge.send_signal(signal.SIGSTOP)
        self.wait("the mission has ended", lambda: self.server.call(
            "GET", f"/api/v1/robots/{self.robot}/missions/{mission['id']}")["state"] == "stopped", 5.0)
        time.sleep(3.0)
        self.bridge.send_signal(signal.SIGCONT)
        self.wait("the agent is connected again", lambda: (
            self.data / "agent.log").read_text().count(f"connected to 127.0.0.1:{BRIDGE_PORT}") >= 2, 20.0)
        self.wait("it stands", lambda: abs(self.truth()["speed_mps"]) < AT_REST, 3.0)
        before = self.truth()
        time.sleep(2.0)
        after = self.truth()
        self.assertLess(abs(after["x_m"] - before["x_m"]) + abs(after["y_m"] - before["y_m"]), AT_REST)
        self.assertEqual(after["collisions"], 0)
        ended = self.server.call("GET", f"/api/v1/robots/{self.robot}/missions/{mission['id']}")
        self.assertEqual(ended["reason"]["code"], "robot_link_lost")


class Wheelchair(Rosbridge):
    """A chair of 1.10 m x 0.65 m that turns about its rear axle, its links encrypted."""

    PROFILE = "chair"
    BODY = {"rectangle": {"front_m": 0.85, "back_m": 0.25, "width_m": 0.65}}
    ROOMS = sys.argv[3:] or ("study",)
    SERVER = f"https://localhost:{SERVER_TLS_PORT}"
    BRIDGE = f"wss://localhost:{BRIDGE_TLS_PORT}"
    test_2_a_silent_robot_ends_the_mission_and_nothing_moves_when_it_speaks_again = None

    @classmethod
    def start_agent(cls):
        """Of three certificates the agent refuses the one that nobody told it to trust and the one of another host."""
        for name in ("localhost", "elsewhere.example"):
            tls_front.make_certificate(name, cls.data / f"{name}.pem", cls.data / f"{name}.key")
        cls.refused = {}
        for about, host, trusted in (("untrusted", "localhost", None), ("of another host", "elsewhere.example", "elsewhere.example"),
                                     ("trusted", "localhost", "localhost")):
            fronts = [cls.start("front", sys.executable, ROOT / "tests/loop/tls_front.py", str(listen), str(target),
                                cls.data / f"{host}.pem", cls.data / f"{host}.key")
                      for listen, target in ((SERVER_TLS_PORT, PORT), (BRIDGE_TLS_PORT, BRIDGE_PORT))]
            trust = {"SSL_CERT_FILE": str(cls.data / f"{trusted}.pem")} if trusted else {}
            agent = cls.start("agent" if about == "trusted" else f"agent {about}", *cls.agent_command, **trust)
            if about == "trusted":
                return
            time.sleep(3)
            for process in (agent, *fronts):
                process.terminate()
                process.wait(timeout=20)
            cls.refused[about] = (cls.data / f"agent {about}.log").read_text()

    def test_0_no_link_to_whose_certificate_is_not_trusted_or_of_another_host(self):
        for about, log in self.refused.items():
            with self.subTest(certificate=about):
                self.assertRegex(log, "(?i)certificate")
                self.assertNotIn("connected to", log)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
