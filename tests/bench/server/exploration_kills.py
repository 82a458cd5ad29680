#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Kills the server or the robot's program (SIGKILL) again and again while a simulated robot explores a generated house, and
while its pictures go to the server. After each kill what is kept is held against what was kept before, and the robot has
to stand until a person sends it on, and to go on from where it stood then; some kills come before that. In the end its
tour has to hold every picture.

usage: exploration_kills.py BIN_FOLDER [--world house:1] [--kills 20] [--uploading 4] [--seed 1] [--keep FOLDER]
--uploading: so many of the kills come while pictures go to the server. --keep: what the programs wrote stays there.
Prints one JSON object; exits with 1 where something was lost, moved or did not go on.
"""
import argparse
import contextlib
import hashlib
import json
import math
import pathlib
import random
import sqlite3
import sys
import tempfile
import threading
import time
import urllib.request

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "loop"))
from exploring_robot import ExploringRobot  # noqa: E402
from rest_client import Failed  # noqa: E402

PORT = 18490
LONGEST_S = 15.0       # from being sent on to the next kill
LONGEST_DOWN_S = 2.0   # from a kill to the next start
HELD_S = (1.5, 4.0)    # and then until it is sent on
AGAIN = 0.2            # share of kills after which the next comes before it was sent on
RESTS_WITHIN_S = 0.75  # where the server is gone
AT_REST = 0.01         # m/s and rad/s, and metres from where it stood
WENT_ON_M = 0.1
FURTHER_M = 0.6        # driven after the last kill under way
GOES_ON_WITHIN_S = 60.0
UPLOADED_WITHIN_S = 60.0


class Kept:
    """The pictures that are whole on the robot's disk, and those that were there before and are not any more."""

    def __init__(self, root):
        self.root = root
        self.digests = []
        self.told = 0  # so many are safe, as the robot has said
        self.lost = []

    def on_disk(self):
        folders = list(self.root.iterdir()) if self.root.exists() else []
        digests = []
        while folders:
            picture = folders[0] / "tour" / f"{len(digests):05}.jpg"
            view = folders[0] / "views" / f"{len(digests):05}.json"
            if not picture.exists() or not view.exists():
                break
            json.loads(view.read_text())
            digests.append(hashlib.sha256(picture.read_bytes()).hexdigest())
        if len(folders) > 1:
            self.lost.append(f"{len(folders)} explorations in place of one")
        return digests

    def look(self, when):
        found = self.on_disk()
        for number, digest in enumerate(self.digests):
            if number >= len(found) or found[number] != digest:
                self.lost.append(f"{when}: picture {number}")
        if len(found) < self.told:
            self.lost.append(f"{when}: {self.told} were said to be safe, {len(found)} are there")
        self.digests = found


class Kills:
    def __init__(self, binaries, data, world, seed):
        self.chair = ExploringRobot(binaries, None, PORT, data)
        self.world = world
        self.random = random.Random(seed)
        self.kept = Kept(data / "explorations")
        self.killed = {"agent": 0, "server": 0}
        self.went_on = 0
        self.killed_before = 0
        self.killed_waiting = 0
        self.wrong = []
        self.rest_s = []
        self.off_m = []
        self.uploaded = []  # pictures that the server had at each kill while they went there
        self.exploration = None
        self.stands_since_us = None  # until it is sent on
        self.ended = threading.Event()
        self.listener = threading.Thread(target=self.listen, daemon=True)
        self.start_agent()
        self.began = self.chair.until("the simulator tells where it is", self.chair.stands)
        self.listener.start()

    def close(self):
        self.ended.set()
        if self.listener.is_alive():
            self.listener.join()
        self.chair.close()

    def start_agent(self):
        self.chair.start_simulated_agent(self.world)

    def listen(self):
        """What is told to be safe must be."""
        while not self.ended.wait(0.1):
            with contextlib.suppress(OSError, ValueError, Failed):
                status, report = self.chair.watching.send("GET", f"{self.chair.robot}/exploration")
                if status == 200:
                    self.kept.told = max(self.kept.told, report["pictures"])

    def truths(self, since_us):
        with open(self.chair.truth_file, "rb") as file:
            file.seek(max(0, file.seek(0, 2) - (4 << 20)))
            truths = [json.loads(line) for line in file.read().split(b"\n") if line.startswith(b"{") and line.endswith(b"}")]
        return [truth for truth in truths if truth["t_us"] > since_us]

    def moving(self, since_us):
        return [truth for truth in self.truths(since_us)
                if truth["commanded_mps"] != 0 or truth["commanded_radps"] != 0
                or abs(truth["speed_mps"]) > AT_REST or abs(truth["turn_radps"]) > AT_REST]

    def moved_m(self, since):
        now = self.chair.stands()
        return math.hypot(now[0] - since[0], now[1] - since[1])

    def send_on(self, limits):
        """A person sends it on, again where it says why it cannot. Returns at the moment at which something is killed."""
        ends = time.monotonic() + self.random.uniform(0.1, LONGEST_S)
        stood = self.chair.stands()
        mission = self.order(limits)
        while time.monotonic() < ends:
            if self.moved_m(stood) > WENT_ON_M:
                self.went_on += 1
                time.sleep(max(0.0, ends - time.monotonic()))
                return
            state = self.chair.state()["mission"]
            if state["id"] == mission and state["state"] in ("stopped", "failed", "refused"):
                self.wrong.append({"did not go on": state["reason"]})
                mission = self.order(limits)
            time.sleep(0.05)
        self.killed_before += 1

    def order(self, limits):
        going_on = {"exploration": self.exploration} if self.exploration else {}
        self.stands_since_us = None
        mission = self.chair.explore(**going_on, **limits)
        self.exploration = mission["exploration"]
        return mission["id"]

    def kill(self, uploads=False):
        """One of the two, and starts it again."""
        which = self.random.choice(("agent", "server"))
        number = sum(self.killed.values()) + 1
        self.killed[which] += 1
        self.chair.kill(which)
        killed_us = time.time_ns() // 1000
        if self.stands_since_us is None:
            self.stands_since_us = killed_us + (int(1e6 * RESTS_WITHIN_S) if which == "server" else 0)
        if uploads:
            self.uploaded.append(self.on_server())
        time.sleep(self.random.uniform(0.0, LONGEST_DOWN_S))
        self.kept.look(f"kill {number}, of the {which}")
        if which == "server":
            self.chair.start_server()
            self.chair.sign_in()
            self.chair.until("the robot is back", self.chair.online)
            self.rest_s.append(self.rested_s(killed_us))
        else:
            self.start_agent()

    def rested_s(self, killed_us):
        """How long it was told to move after the kill."""
        commanded = [truth["t_us"] for truth in self.truths(killed_us)
                     if truth["commanded_mps"] != 0 or truth["commanded_radps"] != 0]
        return (max(commanded) - killed_us) / 1e6 if commanded else 0.0

    def expect_it_waits(self):
        """Until a person says so, it stands, with all that it has kept."""
        number = sum(self.killed.values())
        report = self.chair.pictures(len(self.kept.digests), "paused")
        time.sleep(self.random.uniform(*HELD_S))
        moved = self.moving(self.stands_since_us)
        if moved:
            self.wrong.append({"moved before it was told": moved[0], "after kill": number})
        if report["id"] != self.exploration:
            self.wrong.append({"another exploration": report["id"], "after kill": number})
        self.compare_pose(report)

    def compare_pose(self, report):
        """Where it takes itself to be, with where it is."""
        if not report["pose"]:
            return
        x_m, y_m, heading_rad = self.began
        now = self.chair.stands()
        believed = (x_m + math.cos(heading_rad) * report["pose"]["x_m"] - math.sin(heading_rad) * report["pose"]["y_m"],
                    y_m + math.sin(heading_rad) * report["pose"]["x_m"] + math.cos(heading_rad) * report["pose"]["y_m"])
        self.off_m.append(math.hypot(believed[0] - now[0], believed[1] - now[1]))

    def explore(self, kills):
        waits = False
        for number in range(1, kills + 1):
            if not waits:
                self.send_on({})
            self.kill()
            waits = number < kills and self.random.random() < AGAIN
            self.killed_waiting += waits
            if not waits:
                self.expect_it_waits()

    def end_it(self, kills):
        """It is sent on for a last bit, and killed while its pictures go to the server."""
        limit_m = self.chair.report()["driven_m"] + FURTHER_M
        self.order({"limit_m": max(1.0, limit_m)})
        self.chair.until("it has ended", lambda: self.chair.state()["mission"]["state"] == "arrived", GOES_ON_WITHIN_S)
        self.went_on += 1
        self.chair.until("it stands", lambda: abs(self.chair.truth()["speed_mps"]) < AT_REST)
        ended_at, self.stands_since_us = self.chair.stands(), time.time_ns() // 1000
        for _ in range(kills):
            pictures = self.random.randint(self.on_server(), len(self.kept.on_disk()))
            ends = time.monotonic() + UPLOADED_WITHIN_S
            while self.on_server() < pictures:
                if time.monotonic() > ends:
                    raise Failed(f"{pictures} pictures do not get to the server: {self.chair.report()} {self.chair.logs()}")
                time.sleep(0.002)
            self.kill(uploads=True)
        self.chair.until("the tour is complete", lambda: [tour for tour in self.tours() if tour["state"] == "complete"],
                         UPLOADED_WITHIN_S)
        self.kept.look("in the end")
        moved = self.moving(self.stands_since_us)
        if moved or self.moved_m(ended_at) > AT_REST:
            self.wrong.append({"moved after its end": self.moved_m(ended_at), "first": moved[:1]})

    def on_server(self):
        with sqlite3.connect(f"file:{self.chair.data / 'server' / 'homeward.db'}?mode=ro", uri=True) as database:
            return database.execute("SELECT count(*) FROM tour_images").fetchone()[0]

    def tours(self):
        return self.chair.server.call("GET", "/api/v1/tours")["tours"]

    def check_tour(self):
        """Every picture that was kept is in the one tour, in its order, the same, and with its sweep."""
        if len(self.tours()) != 1:
            self.wrong.append({"tours": [(tour["id"], tour["state"], tour["images"]) for tour in self.tours()]})
        tour = next(tour["id"] for tour in self.tours() if tour["state"] == "complete")
        for number, digest in enumerate(self.kept.digests):
            request = urllib.request.Request(f"{self.chair.server.address}/api/v1/tours/{tour}/images/{number}",
                                             headers={"Cookie": self.chair.server.cookie})
            with urllib.request.urlopen(request, timeout=30) as answer:
                if hashlib.sha256(answer.read()).hexdigest() != digest:
                    self.kept.lost.append(f"in the tour: picture {number}")
        with sqlite3.connect(f"file:{self.chair.data / 'server' / 'homeward.db'}?mode=ro", uri=True) as database:
            images, swept = (database.execute(f"SELECT count(*) FROM {table} WHERE tour = ?", (tour,)).fetchone()[0]
                             for table in ("tour_images", "tour_sweeps"))
        if (images, swept) != (len(self.kept.digests), len(self.kept.digests)):
            self.kept.lost.append(f"in the tour: {images} pictures and {swept} sweeps")
        return tour

    def figures(self, tour):
        map_id = self.chair.build_map(tour)
        graph = self.chair.server.call("GET", f"/api/v1/maps/{map_id}/graph")
        in_map = sum(len(place["members"]) for place in graph["places"])
        if in_map != len(self.kept.digests) or not self.chair.is_one_piece(map_id):
            self.wrong.append({"of the map": {"pictures": in_map, "one piece": self.chair.is_one_piece(map_id)}})
        if self.chair.collisions():
            self.wrong.append({"collisions": self.chair.collisions()})
        return {"kills": self.killed, "pictures": len(self.kept.digests), "lost": self.kept.lost, "wrong": self.wrong,
                "moved_before_told": sum("moved before it was told" in one or "moved after its end" in one for one in self.wrong),
                "went_on": self.went_on, "did_not_go_on": sum("did not go on" in one for one in self.wrong),
                "killed_before_it_could": self.killed_before, "killed_again_while_it_waited": self.killed_waiting,
                "commanded_after_server_s": round(max(self.rest_s, default=0.0), 2),
                "pose_off_m": round(max(self.off_m, default=0.0), 2), "uploaded_at_kills": self.uploaded, "places": len(graph["places"])}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binaries", type=pathlib.Path)
    parser.add_argument("--world", default="house:1")
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--uploading", type=int, default=4)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path)
    arguments = parser.parse_args()
    if arguments.keep:
        arguments.keep.mkdir(parents=True)
    scratch = contextlib.nullcontext(arguments.keep) if arguments.keep else tempfile.TemporaryDirectory(prefix="homeward-kills-")
    with scratch as folder:
        kills = Kills(arguments.binaries.resolve(), pathlib.Path(folder).resolve(), arguments.world, arguments.seed)
        try:
            kills.explore(arguments.kills - arguments.uploading)
            kills.end_it(arguments.uploading)
            figures = kills.figures(kills.check_tour())
        finally:
            kills.close()
        print(json.dumps({"world": arguments.world, "seed": arguments.seed, **figures}))
    return 1 if figures["lost"] or figures["wrong"] else 0


if __name__ == "__main__":
    sys.exit(main())
