# SPDX-License-Identifier: Apache-2.0
"""A server, and a robot of it that explores while somebody watches: programs of their own, so that each can be killed.
What the robot truly did is read from its file."""
import json
import math
import os
import pathlib
import subprocess
import sys
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "deploy"))
from rest_client import Failed, Server, setup_token  # noqa: E402

LOGIN = {"name": "anna", "password": "correct horse battery"}
BY_NOW_S = 60
AT_REST_M = 0.001
AT_REST_RAD = 0.001


class ExploringRobot:
    """`data` is a folder of its own, `web` the dashboard's or None. `beside`: another one, whose server is this one's too."""

    def __init__(self, binaries, web, port, data, beside=None):
        self.binaries, self.web, self.port = pathlib.Path(binaries).resolve(), web, port
        self.data = pathlib.Path(data)
        self.truth_file = self.data / "truth"
        self.server = Server(f"http://127.0.0.1:{port}")
        self.watching = Server(self.server.address)
        self.beside = beside
        self.processes = {}
        self.lease = None
        self.ends = threading.Event()
        self.watcher = threading.Thread(target=self.keep_lease, daemon=True)
        try:
            self.set_up()
        except BaseException:
            self.close()
            raise

    def set_up(self):
        if self.beside is None:
            self.start_server()
            self.server.call("POST", "/api/v1/setup", {"token": setup_token(self.data / "setup-link"), **LOGIN})
        self.sign_in()
        made = self.server.call("POST", "/api/v1/robots", {"name": "Chair" if self.beside is None else "Second chair"})
        self.id = made["id"]
        self.robot = f"/api/v1/robots/{self.id}"
        self.token = self.data / "token"
        self.token.touch(mode=0o600)
        self.token.write_text(made["token"])
        self.watcher.start()

    def close(self):
        self.ends.set()
        if self.watcher.is_alive():
            self.watcher.join()
        for name in list(self.processes):
            self.kill(name)

    def start(self, name, *command):
        with open(self.data / f"{name}.log", "ab") as log:
            self.processes[name] = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT)

    def kill(self, name):
        process = self.processes.pop(name)
        process.kill()
        process.wait()

    def start_server(self):
        web = ["--web", self.web] if self.web else []
        self.start("server", self.binaries / "homeward-server", "--data", self.data / "server", "--listen",
                   f"127.0.0.1:{self.port}", *web, "--print-setup-file", self.data / "setup-link")
        self.server.wait_until_up(self.processes["server"])

    def sign_in(self):
        for server in (self.server, self.watching):
            server.call("POST", "/api/v1/login", LOGIN)

    def start_agent(self, program, *options):
        """homeward-agent or homeward-simulated-agent; returns when the server has it."""
        self.start("agent", self.binaries / program, "run", "--server", self.server.address, "--token-file", self.token, "--robot",
                   self.id, "--explorations", self.data / "explorations", *options)
        self.until("the robot is there", self.online)

    def start_simulated_agent(self, world, *options):
        """It stands where the one before stood."""
        pose = self.stands()
        where = ["--start-pose", *(f"{value:.4f}" for value in pose)] if pose else []
        self.start_agent("homeward-simulated-agent", "--driver", "simulator", "--world", world, "--truth-file", self.truth_file,
                         *where, *options)

    def state(self):
        return self.server.call("GET", self.robot)

    def online(self):
        return self.state()["online"]

    def truth(self):
        """The latest that the simulator has told; nothing before it has told anything."""
        if not self.truth_file.exists():
            return None
        with open(self.truth_file, "rb") as file:
            file.seek(max(0, file.seek(0, os.SEEK_END) - 4096))
            lines = [line for line in file.read().split(b"\n") if line.startswith(b"{") and line.endswith(b"}")]
        return json.loads(lines[-1]) if lines else None

    def stands(self):
        """Where the robot truly is: x, y, heading."""
        truth = self.truth()
        return (truth["x_m"], truth["y_m"], truth["theta_rad"]) if truth else None

    def collisions(self):
        """Of each start of the simulator, which counts from none."""
        worst = 0
        for line in self.truth_file.read_text().splitlines():
            if line.endswith("}"):
                worst = max(worst, json.loads(line)["collisions"])
        return worst

    def moved(self, seconds):
        """Metres and radians from where it stands to where it stands after so long."""
        before = self.stands()
        time.sleep(seconds)
        after = self.stands()
        turned = (after[2] - before[2] + math.pi) % (2 * math.pi) - math.pi
        return math.hypot(after[0] - before[0], after[1] - before[1]), abs(turned)

    def logs(self):
        return {file.stem: file.read_text(errors="replace")[-1500:] for file in self.data.glob("*.log")}

    def until(self, what, is_so, for_s=BY_NOW_S):
        """Gives what that gave that was so. Raises Failed when it was not in time."""
        ends = time.monotonic() + for_s
        while time.monotonic() < ends:
            found = is_so()
            if found:
                return found
            time.sleep(0.1)
        raise Failed(f"not in {for_s} s: {what}; robot {self.state()} {self.logs()}")

    def report(self):
        """How far the exploration is, as the server says; nothing where the robot has told of none."""
        try:
            return self.server.call("GET", f"{self.robot}/exploration")
        except Failed:
            return None

    def uploaded(self):
        """The report once the pictures are on the server."""
        report = self.report()
        return report if report and report["tour"] else None

    def pictures(self, least, phase="exploring", for_s=BY_NOW_S):
        def so():
            report = self.report()
            return report if report and report["phase"] == phase and report["pictures"] >= least else None
        return self.until(f"{least} pictures, {phase}", so, for_s)

    def keep_lease(self):
        while not self.ends.wait(2.0):
            if self.lease is None:
                continue
            try:
                self.watching.call("PUT", f"{self.robot}/lease", {"lease_id": self.lease})
            except (Failed, OSError):
                pass  # the server is down just now

    def take_lease(self):
        self.lease = self.server.call("POST", f"{self.robot}/lease", {"take_over": True})["lease"]["id"]

    def explore(self, **more):
        """A person begins an exploration, or sends the robot on with one. Gives the mission."""
        self.take_lease()
        return self.server.call("POST", f"{self.robot}/explorations", {"lease_id": self.lease, **more})

    def share_with(self, other):
        """This one's exploration is shared with the other's; that one's with this one's, once that says so too."""
        self.server.call("PUT", f"{self.robot}/exploration/companion", {"lease_id": self.lease, "robot": other.id})

    def build_map(self, *tours):
        """Gives the map's id. Raises Failed when it cannot be built."""
        answer = self.server.call("POST", "/api/v1/maps", {"name": "House", "tours": list(tours)})
        path = f"/api/v1/jobs/{answer['job']['id']}"
        self.until("the map is built", lambda: self.server.call("GET", path)["state"] not in ("queued", "running"), 300)
        job = self.server.call("GET", path)
        if job["state"] != "done":
            raise Failed(f"the map is not built: {job}")
        return answer["map"]["id"]

    def is_one_piece(self, map_id):
        """Whether every place of a map leads to every other."""
        graph = self.server.call("GET", f"/api/v1/maps/{map_id}/graph")
        beside = {place["id"]: set() for place in graph["places"]}
        for edge in graph["edges"]:
            beside[edge["from"]].add(edge["to"])
            beside[edge["to"]].add(edge["from"])
        reached, left = set(), list(beside)[:1]
        while left:
            place = left.pop()
            if place not in reached:
                reached.add(place)
                left += beside[place]
        return len(reached) == len(beside) > 0
