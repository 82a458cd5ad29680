#!/usr/bin/env python3
"""What survives SIGKILL: the server is killed during an upload, a build, while a map learns, and during a mission, and
frozen during another.

Nothing that was acknowledged may be lost, the killed build must end, the chair must stop by itself within 0.5 s, and
nothing may move again until a person says so. Then the robot is killed, and what it recorded is replayed. Real
programs, real pictures, a folder of its own.
usage: kill_test.py BIN_FOLDER WEB_FOLDER
"""
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "deploy"))
from rest_client import Server, setup_token  # noqa: E402

BIN = pathlib.Path(sys.argv[1]).resolve()
WEB = pathlib.Path(sys.argv[2]).resolve()
PORT = 18473
AT_REST_MPS = 0.01
AT_REST_RADPS = 0.01
UNDER_WAY_MPS = 0.3
LIMIT_S = 0.5


def moves(truth):
    return abs(truth["speed_mps"]) > AT_REST_MPS or abs(truth["turn_radps"]) > AT_REST_RADPS


class Kill(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="homeward-kill-")
        cls.data = pathlib.Path(cls.folder.name)
        cls.tour = cls.data / "tour"
        subprocess.run([BIN / "homeward", "simulate", "tour", "--world", "house:1", "--rooms",
                        "hall,kitchen,living_room,hall", "--marks", "--seed", "3", "--out", cls.tour], check=True,
                       stdout=subprocess.DEVNULL)
        cls.pictures = sorted(cls.tour.glob("*.jpg"))
        cls.server = Server(f"http://127.0.0.1:{PORT}")
        cls.process = None
        cls.agent = None
        cls.start_server()
        token = setup_token(cls.data / "setup-link")
        cls.login = {"name": "anna", "password": "correct horse battery"}
        cls.server.call("POST", "/api/v1/setup", {"token": token, **cls.login})
        cls.server.call("POST", "/api/v1/login", cls.login)

    @classmethod
    def tearDownClass(cls):
        for process in (cls.agent, cls.process):
            if process and process.poll() is None:
                process.kill()
                process.wait()
        cls.folder.cleanup()

    @classmethod
    def start_server(cls):
        with open(cls.data / "server.log", "ab") as log:
            cls.process = subprocess.Popen([BIN / "homeward-server", "--data", cls.data / "server", "--listen",
                                            f"127.0.0.1:{PORT}", "--web", WEB, "--print-setup-file",
                                            cls.data / "setup-link"], stdout=log, stderr=subprocess.STDOUT)
        cls.server.wait_until_up(cls.process)

    @classmethod
    def kill_server(cls):
        cls.process.send_signal(signal.SIGKILL)
        cls.process.wait()

    def put(self, tour, number):
        picture = self.pictures[number]
        return self.server.send("PUT", f"/api/v1/tours/{tour}/images/{number}", picture.read_bytes(), "image/jpeg",
                                {"X-Homeward-Filename": picture.name})[0]

    def put_sweep(self, tour, number, range_m):
        sweep = {"ranges_m": [range_m, None], "angle_min_rad": 0, "angle_step_rad": 0.5, "range_max_m": 12,
                 "robot_from_scan": {"x_m": 0, "y_m": 0, "theta_rad": 0}}
        return self.server.send("PUT", f"/api/v1/tours/{tour}/images/{number}/sweep", json.dumps(sweep).encode(),
                                "application/json")[0]

    def test_1_upload_keeps_every_acknowledged_picture_and_sweep(self):
        camera = json.loads((self.tour / "camera.json").read_text())
        tour = self.server.call("POST", "/api/v1/tours", {"name": "house", "camera": camera})["id"]
        half = len(self.pictures) // 2
        for number in range(half):
            self.assertIn(self.put(tour, number), (200, 201))
            self.assertEqual(self.put_sweep(tour, number, number), 204)
        self.kill_server()
        self.start_server()
        self.assertGreaterEqual(self.server.call("GET", f"/api/v1/tours/{tour}")["images"], half)
        for number in range(half):
            self.assertEqual(self.put(tour, number), 200, "an acknowledged picture was lost")
            self.assertEqual(self.put_sweep(tour, number, number + 0.5), 409, "an acknowledged sweep was lost")
            self.assertEqual(self.put_sweep(tour, number, number), 204)
        for number in range(half, len(self.pictures)):
            self.assertIn(self.put(tour, number), (200, 201))
        marks = json.loads((self.tour / "tour.json").read_text())["marks"]
        self.server.call("PUT", f"/api/v1/tours/{tour}/marks", {"marks": marks})
        self.server.call("POST", f"/api/v1/tours/{tour}/complete", {})
        type(self).tour_id = tour

    def test_2_a_killed_build_ends_after_the_restart(self):
        answer = self.server.call("POST", "/api/v1/maps", {"name": "house", "tours": [self.tour_id]})
        job = answer["job"]["id"]
        state = self.killed_while_it_runs(job)
        self.assertEqual(state["state"], "done", state)
        type(self).map_id = answer["map"]["id"]
        graph = self.server.call("GET", f"/api/v1/maps/{self.map_id}/graph")
        self.assertEqual(sum(len(place["members"]) for place in graph["places"]), len(self.pictures))

    def killed_while_it_runs(self, job):
        """Kills the server well within a job and starts it again. Gives the job as it ended."""
        end = time.monotonic() + 60
        while time.monotonic() < end:
            state = self.server.call("GET", f"/api/v1/jobs/{job}")
            if state["state"] == "running" and (state["progress"] or {}).get("share", 0) > 0.05:
                break
            self.assertIn(state["state"], ("queued", "running"), "the job was over before it could be killed")
            time.sleep(0.02)
        self.kill_server()
        self.start_server()
        end = time.monotonic() + 300
        while time.monotonic() < end:
            state = self.server.call("GET", f"/api/v1/jobs/{job}")
            if state["state"] in ("done", "failed", "cancelled"):
                return state
            time.sleep(0.5)
        return self.fail(f"the job never ended: {state}")

    def test_2b_a_map_that_was_killed_while_it_learnt_is_whole_and_learns_again(self):
        again = self.data / "again"
        subprocess.run([BIN / "homeward", "simulate", "tour", "--world", "house:1", "--rooms",
                        "hall,kitchen,living_room,hall", "--seed", "8", "--out", again], check=True,
                       stdout=subprocess.DEVNULL)
        type(self).pictures, first = sorted(again.glob("*.jpg")), self.pictures
        camera = json.loads((again / "camera.json").read_text())
        tour = self.server.call("POST", "/api/v1/tours", {"name": "again", "camera": camera})["id"]
        for number in range(len(self.pictures)):
            self.assertIn(self.put(tour, number), (200, 201))
        self.server.call("POST", f"/api/v1/tours/{tour}/complete", {})
        type(self).pictures = first
        before = self.server.call("GET", f"/api/v1/maps/{self.map_id}/graph")
        job = self.server.call("POST", f"/api/v1/maps/{self.map_id}/builds",
                               {"kind": "refine", "tours": [tour]})["job"]["id"]
        state = self.killed_while_it_runs(job)
        self.assertEqual(state["state"], "done", state)
        after = self.server.call("GET", f"/api/v1/maps/{self.map_id}/graph")
        info = self.server.call("GET", f"/api/v1/maps/{self.map_id}")
        # Learnt once, not twice, and nothing of the map was lost.
        self.assertEqual(info["revision"], 1 + (state["gained"] > 0), state)
        self.assertEqual(info["state"], "ready")
        self.assertEqual([place["id"] for place in after["places"]], [place["id"] for place in before["places"]])
        self.assertEqual([place["members"] for place in after["places"]],
                         [place["members"] for place in before["places"]])
        file = self.data / "server" / "maps" / f"{self.map_id}.r{info['revision']}.homeward"
        inspected = subprocess.run([BIN / "homeward", "map", "inspect", file, "--json"], capture_output=True, text=True)
        self.assertEqual(inspected.returncode, 0, inspected.stderr)
        print(f"gained {state['gained']} appearances after the kill, revision {info['revision']}", file=sys.stderr)

    def truths(self):
        file = self.data / "truth.jsonl"
        lines = file.read_text().splitlines() if file.exists() else []
        return [json.loads(line) for line in lines if line.endswith("}")]

    def wait_for(self, what, seconds, condition):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if condition():
                return
            time.sleep(0.05)
        self.fail(f"{what} did not happen within {seconds} s; agent log:\n" + (self.data / "agent.log").read_text()[-3000:])

    def located(self):
        belief = self.robot().get("belief")
        return belief and not belief["lost"] and belief["updates"] >= 3

    def robot(self):
        return self.server.call("GET", f"/api/v1/robots/{self.robot_id}")

    def set_off(self, label):
        """Sends the chair to a place and waits until it is well under way. Gives the mission's id."""
        graph = self.server.call("GET", f"/api/v1/maps/{self.map_id}/graph")
        destination = next(d["id"] for d in graph["destinations"] if d["label"] == label)
        lease = self.server.call("POST", f"/api/v1/robots/{self.robot_id}/lease", {"take_over": True})["lease"]["id"]
        mission = self.server.call("POST", f"/api/v1/robots/{self.robot_id}/missions",
                                   {"lease_id": lease, "destination": destination})["id"]
        self.wait_for("driving", 60, lambda: self.truths() and abs(self.truths()[-1]["speed_mps"]) > UNDER_WAY_MPS)
        return mission

    def expect_rest(self, since_us, what):
        """The chair came to rest by itself in time, counted to the first reading at which it stood."""
        time.sleep(2.0)
        after = [t for t in self.truths() if t["t_us"] > since_us]
        moving = [i for i, t in enumerate(after) if moves(t)]
        self.assertTrue(moving, "the chair stood before anything happened")
        self.assertLess(moving[-1] + 1, len(after), "the chair never stopped")
        rest_s = (after[moving[-1] + 1]["t_us"] - since_us) / 1e6
        print(f"the chair stood {rest_s:.2f} s after {what}", file=sys.stderr)
        self.assertLessEqual(rest_s, LIMIT_S)

    def expect_no_motion(self, seconds):
        since_us = time.time_ns() // 1000
        time.sleep(seconds)
        after = [t for t in self.truths() if t["t_us"] > since_us]
        self.assertTrue(after, "the simulator tells nothing any more")
        self.assertEqual([t for t in after if moves(t)], [], "the chair moved without a person's word")

    def test_3_the_chair_stops_by_itself_and_stays(self):
        robot = self.server.call("POST", "/api/v1/robots", {"name": "chair"})
        type(self).robot_id = robot["id"]
        (self.data / "robot-token").write_text(robot["token"])
        self.server.call("PUT", f"/api/v1/robots/{robot['id']}/map", {"map": self.map_id})
        with open(self.data / "agent.log", "ab") as log:
            type(self).agent = subprocess.Popen(
                [BIN / "homeward-simulated-agent", "run", "--server", self.server.address, "--robot", robot["id"],
                 "--token-file", self.data / "robot-token", "--world", "house:1",
                 "--start-room", "living_room", "--truth-file", self.data / "truth.jsonl", "--record",
                 self.data / "recordings"], stdout=log,
                stderr=subprocess.STDOUT)
        self.wait_for("knowing where it is", 120, self.located)
        mission = self.set_off("kitchen")
        killed_us = time.time_ns() // 1000
        self.kill_server()
        self.expect_rest(killed_us, "the server was killed")
        self.assertIn("The connection to the server is lost.", (self.data / "agent.log").read_text())
        self.start_server()
        after = self.server.call("GET", f"/api/v1/robots/{robot['id']}/missions/{mission}")
        self.assertIn(after["state"], ("stopped", "failed"), after)
        self.wait_for("reconnecting", 60, lambda: self.robot()["online"])
        self.expect_no_motion(3.0)

    def test_4_a_frozen_server_stops_the_chair_too(self):
        self.wait_for("knowing where it is", 60, self.located)
        mission = self.set_off("hall")
        frozen_us = time.time_ns() // 1000
        self.process.send_signal(signal.SIGSTOP)
        self.expect_rest(frozen_us, "the server froze")
        self.assertIn("The server has fallen silent.", (self.data / "agent.log").read_text())
        self.process.send_signal(signal.SIGCONT)
        self.wait_for("the end of the mission", 30, lambda: self.server.call(
            "GET", f"/api/v1/robots/{self.robot_id}/missions/{mission}")["state"] in ("stopped", "failed"))
        self.expect_no_motion(3.0)

    def replay(self, file):
        done = subprocess.run([BIN / "homeward", "replay", file, "--json"], capture_output=True, text=True)
        self.assertTrue(done.stdout, done.stderr)
        replayed = json.loads(done.stdout)
        print(f"{replayed['compared']} steps, {replayed['vectors']} vectors: {replayed['note']}", file=sys.stderr)
        self.assertEqual(done.returncode, 0, replayed)
        self.assertEqual(replayed["compared"], replayed["steps"])
        self.assertGreater(replayed["vectors"], 3)
        return replayed

    def recordings(self):
        return sorted((self.data / "recordings").glob("*.hwrec"), key=lambda file: file.stat().st_mtime)

    def test_5_its_missions_were_recorded(self):
        self.assertEqual(len(self.recordings()), 2)
        for file, code in zip(self.recordings(), ["link_lost", "server_silent"], strict=True):
            replayed = self.replay(file)
            self.assertTrue(replayed["complete"], replayed)
            self.assertEqual(replayed["why_stopped"]["reason"]["code"], code)

    def test_6_a_robot_that_is_killed_leaves_a_recording(self):
        self.wait_for("knowing where it is", 60, self.located)
        self.set_off("kitchen")
        self.agent.kill()
        self.agent.wait()
        replayed = self.replay(self.recordings()[-1])
        self.assertFalse(replayed["complete"])
        self.assertEqual(replayed["why_stopped"]["reason"]["code"], "recording_cut_off")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
