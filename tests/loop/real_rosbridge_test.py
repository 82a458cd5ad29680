#!/usr/bin/env python3
"""The agent with a rosbridge as robots have it: one of ROS 1, unmodified, a roscore, and the simulated robot as a ROS node.

It needs ../shared/peers/rosbridge beside the checkout and the Debian packages that its start.sh names, and is skipped
where they are absent. A joystick is enough for most of it; missions need the server too.
usage: real_rosbridge_test.py BIN_FOLDER WEB_FOLDER [TEST ...] [--profile disc|chair] [--to ROOM ...]
"""
import argparse
import json
import os
import pathlib
import shutil
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
from rest_client import Failed, Server  # noqa: E402

PEER = ROOT.parent / "shared" / "peers" / "rosbridge"
PYTHON = "/usr/bin/python3"  # Debian's, which has ROS's packages
PORT = 18491
ROBOT_PORT, BRIDGE_PORT, SLOW_PORT, MASTER_PORT = PORT + 1, PORT + 2, PORT + 3, PORT + 4
SLOW_BYTES_PER_S = 400_000  # less than the robot's pictures take
LATE_S = 0.8  # a motion so long after the stick was let go is an old one: 0.3 s of its age, 0.3 s of a hand, and some
BODIES = {"disc": {"radius_m": 0.35}, "chair": {"rectangle": {"front_m": 0.85, "back_m": 0.25, "width_m": 0.65}}}
LOSSY_BYTES_PER_S, LOSSY_JITTER_S, LOSSY_SHARE = 500_000, 0.2, 0.05
TYPES = {"cmd_vel": "geometry_msgs/Twist", "odom": "nav_msgs/Odometry", "scan": "sensor_msgs/LaserScan",
         "image": "sensor_msgs/CompressedImage"}


def lacking():
    """What is not there of what this test needs; nothing where all is."""
    if not (PEER / "start.sh").exists():
        return "../shared/peers/rosbridge is not there"
    if shutil.which("roscore") is None:
        return "there is no roscore: install the packages that ../shared/peers/rosbridge/start.sh names"
    modules = "import nav_msgs.msg, rosbridge_library.rosbridge_protocol, rosbridge_server, sensor_msgs.msg, websocket"
    sources = [PEER / "shims", PEER / "suite/rosbridge_library/src", PEER / "suite/rosbridge_server/src"]
    tried = subprocess.run([PYTHON, "-c", modules], capture_output=True, text=True,
                           env={**os.environ, "PYTHONPATH": ":".join(map(str, sources))})
    if tried.returncode != 0:
        return f"the rosbridge lacks packages (python3-tornado and python3-rosservice among them): {tried.stderr[-200:]}"
    return ""


LACKING = lacking()


@unittest.skipIf(LACKING, LACKING)
class RealRosbridge(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="homeward-real-rosbridge-")
        self.data = pathlib.Path(self.folder.name)
        self.processes = {}
        self.environment = {**os.environ, "ROS_MASTER_URI": f"http://127.0.0.1:{MASTER_PORT}", "ROS_IP": "127.0.0.1",
                            "ROS_HOSTNAME": "127.0.0.1", "ROS_HOME": str(self.data / "ros"), "PYTHONUNBUFFERED": "1"}
        self.start("robot", BIN.parent / "tests" / "homeward-rosbridge-robot", str(ROBOT_PORT), demo.WORLD, "bedroom",
                   OPTIONS.profile, self.data / "truth.jsonl", self.data / "camera.json")
        self.start("master", "roscore", "-p", str(MASTER_PORT))
        self.wait("the robot is there", lambda: (self.data / "camera.json").exists(), 120)
        self.wait("the master is there", lambda: "started core service" in self.log("master"), 60)

    def tearDown(self):
        for process in reversed(self.processes.values()):
            if process.poll() is None:
                process.terminate()
        for process in self.processes.values():
            try:
                process.wait(timeout=10)
            except subprocess.TimeoutExpired:
                process.kill()
        for name in ("bridge", "agent"):
            print(f"--- end of {name}.log ---", *self.log(name).splitlines()[-12:], sep="\n", flush=True)
        self.folder.cleanup()

    def start(self, name, *command, **more):
        with open(self.data / f"{name}.log", "ab") as log:
            self.processes[name] = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT,
                                                    env={**self.environment, **more})

    def log(self, name):
        file = self.data / f"{name}.log"
        return file.read_text(errors="replace") if file.exists() else ""

    def wait(self, what, holds, limit_s=30.0):
        end = time.monotonic() + limit_s
        while time.monotonic() < end:
            if holds():
                return
            time.sleep(0.05)
        self.fail(f"within {limit_s} s not so: {what}")

    def start_bridge(self, *parameters):
        self.start("bridge", "bash", PEER / "start.sh", str(BRIDGE_PORT), "rosbridge", *parameters)
        self.wait("the bridge listens", lambda: "server started" in self.log("bridge"), 60)

    def start_node(self, twist="plain"):
        """The robot as a ROS node, which writes each Twist that it hears."""
        self.start("node", PYTHON, PEER / "kit" / "robot_node.py", str(ROBOT_PORT), self.data / "twists", TWIST=twist)
        self.wait("the node is there", lambda: (self.data / "twists").exists())
        time.sleep(1.0)

    def start_agent(self, port=BRIDGE_PORT, server=f"http://127.0.0.1:{PORT}", robot="1", token_file=None, **types):
        described = json.loads((ROOT / "proto/examples/rosbridge/valid/ros2_round.json").read_text())
        described.update(address=f"ws://127.0.0.1:{port}", body={
            **BODIES[OPTIONS.profile], "max_speed_mps": 0.8, "max_turn_radps": 1.2, "deceleration_mps2": 1.0,
            "turn_deceleration_radps2": 5.0})
        for key, name in {**TYPES, **types}.items():
            described[key]["type"] = name
        described["scan"]["robot_from_scan"]["x_m"] = 0.0
        described["rider"] = {"topic": "/joy_vel", "type": TYPES["cmd_vel"], "motion": "relayed"}
        (self.data / "robot.json").write_text(json.dumps(described))
        if token_file is None:
            token_file = self.data / "no-token"
            token_file.write_text("nobody\n")
        self.start("agent", BIN / "homeward-agent", "run", "--server", server, "--robot", robot, "--token-file",
                   token_file, "--driver", "rosbridge", "--rosbridge", self.data / "robot.json")
        self.wait("the agent is connected", lambda: f"connected to 127.0.0.1:{port}" in self.log("agent"))

    def push(self, seconds, turn_radps=0.5, tail_s=0.5):
        """The rider turns for so long; gives when the stick was let go."""
        subprocess.run([PYTHON, PEER / "kit" / "joy.py", str(seconds), "0", str(turn_radps)],
                       env={**self.environment, "TAIL": str(tail_s)}, stdout=subprocess.DEVNULL, check=True)
        return time.monotonic() - tail_s

    def twists(self):
        """When each came by the monotonic clock, its turn, and the seconds of its stamp where it bears one."""
        file = self.data / "twists"
        lines = [line.split() for line in file.read_text().splitlines()] if file.exists() else []
        return [(float(words[0]), float(words[2]), float(words[3]) if len(words) > 3 else None)
                for words in lines if "WATCHDOG" not in words]

    def moved(self):
        return any(turn != 0 for _, turn, _ in self.twists())

    def start_server(self):
        """A server with a map of the house; gives it, the robot, its token and the map."""
        taught_house.bring(self.data)
        self.start("server", BIN / "homeward-server", "--data", self.data / "server", "--listen", f"127.0.0.1:{PORT}",
                   "--web", WEB, "--print-setup-file", self.data / "setup-link")
        server = Server(f"http://127.0.0.1:{PORT}")
        server.wait_until_up(self.processes["server"])
        demo.set_up_account(server, self.data)
        robot, token_file = demo.robot_with_token(server, self.data)
        map_id = demo.teach(server, BIN, self.data, token_file)
        server.call("PUT", f"/api/v1/robots/{robot}/map", {"map": map_id})
        return server, robot, token_file, map_id

    def test_missions_arrive(self):
        server, robot, token_file, map_id = self.start_server()
        self.start_bridge()
        self.start_node()
        self.start_agent(server=server.address, robot=robot, token_file=token_file)
        for room in OPTIONS.to:
            self.assertTrue(demo.drive(server, robot, map_id, room, self.data), room)
        self.assertNotIn("no command comes back", self.log("agent"))

    def test_on_a_link_that_loses_nothing_moves_late_and_the_robot_says_why_it_stands(self):
        server, robot, token_file, map_id = self.start_server()
        self.start_bridge()
        self.start_node()
        self.start("lossy", sys.executable, ROOT / "tests/loop/lossy_link.py", str(SLOW_PORT), str(BRIDGE_PORT),
                   str(LOSSY_BYTES_PER_S), str(LOSSY_JITTER_S), str(LOSSY_SHARE))
        self.wait("the link carries", lambda: "carries" in self.log("lossy"))
        self.start_agent(SLOW_PORT, server=server.address, robot=robot, token_file=token_file)
        time.sleep(4.0)
        let_go = self.push(2.0, tail_s=6.0)
        late = [(at - let_go, turn) for at, turn, _ in self.twists() if turn != 0 and at > let_go + LATE_S]
        self.assertEqual(late, [], "after the stick was let go")
        arrived, ended = None, None
        try:
            arrived = demo.drive(server, robot, map_id, OPTIONS.to[0], self.data)
            ended = time.monotonic()
        except Failed as failed:  # it never found out where it is
            self.assertIn("did not find out where it is", str(failed))
        state = server.call("GET", f"/api/v1/robots/{robot}")
        print("on the lossy link:", "arrived" if arrived else json.dumps(state)[:600], flush=True)
        collisions = json.loads((self.data / "truth.jsonl").read_text().splitlines()[-1])["collisions"]
        self.assertEqual(collisions, 0)
        if ended is not None:
            time.sleep(3.0)
            late = [at - ended for at, turn, _ in self.twists() if turn != 0 and at > ended + LATE_S]
            self.assertEqual(late, [], "after the mission ended")
        if not arrived:
            self.assertRegex(self.log("agent"), "lagged|connection lost")

    def test_a_hand_is_obeyed_and_let_go_the_wheels_are_told_so(self):
        self.start_bridge()
        self.start_node()
        self.start_agent()
        time.sleep(2.0)
        let_go = self.push(2.0, tail_s=2.0)
        self.assertTrue(self.moved())
        self.assertLess(max(at for at, turn, _ in self.twists() if turn != 0), let_go + LATE_S)
        self.assertEqual(self.twists()[-1][1], 0)

    def test_on_a_slow_link_an_old_hand_moves_nothing(self):
        self.start_bridge()
        self.start_node()
        self.start("slow", PYTHON, PEER / "kit" / "slow.py", str(SLOW_PORT), str(BRIDGE_PORT), str(SLOW_BYTES_PER_S))
        time.sleep(1.0)
        self.start_agent(SLOW_PORT)
        time.sleep(4.0)
        let_go = self.push(2.0, tail_s=12.0)
        late = [(at - let_go, turn) for at, turn, _ in self.twists() if turn != 0 and at > let_go + LATE_S]
        self.assertEqual(late, [])
        self.assertIn("passed over", self.log("agent"))
        self.assertIn("it has lagged for more than", self.log("agent"))

    def test_a_quiet_robot_is_named_and_heard_as_soon_as_it_speaks(self):
        self.start_bridge()
        self.start_agent()
        time.sleep(7.0)
        self.assertNotIn("connection lost", self.log("agent"))
        for topic in ("/odom (nav_msgs/Odometry)", "/scan (sensor_msgs/LaserScan)", "/camera/image/compressed"):
            self.assertIn(f"nothing comes on {topic}", self.log("agent"))
        self.start_node()
        time.sleep(2.0)
        self.push(1.0)
        self.assertTrue(self.moved())

    def test_stamped_commands_bear_the_robots_time(self):
        self.start_bridge()
        self.start_node("stamped")
        self.start_agent(cmd_vel="geometry_msgs/TwistStamped")
        time.sleep(2.0)
        self.push_without_listening(1.5)
        self.assertTrue(self.moved())
        for _, _, stamp_s in self.twists():
            self.assertLess(abs(stamp_s - time.time()), 60)

    def push_without_listening(self, seconds):
        """As `push`, of a joystick that does not listen to a plain /cmd_vel beside a stamped one."""
        publisher = ("import rospy, sys, time\nfrom geometry_msgs.msg import Twist\nrospy.init_node('stick')\n"
                     "stick = rospy.Publisher('/joy_vel', Twist, queue_size=1)\ntime.sleep(1.0)\nt = Twist()\n"
                     f"t.angular.z = 0.5\nend = time.time() + {seconds}\n"
                     "while time.time() < end:\n    stick.publish(t)\n    time.sleep(0.05)\n"
                     "stick.publish(Twist())\ntime.sleep(0.5)\n")
        subprocess.run([PYTHON, "-c", publisher], env=self.environment, stdout=subprocess.DEVNULL, check=True)

    def test_commands_of_another_type_are_missed(self):
        self.start_bridge()
        self.start_node("stamped")
        self.start_agent()
        time.sleep(2.0)
        self.push_without_listening(3.0)
        self.assertFalse(self.moved())
        self.assertIn("no command comes back on /cmd_vel (geometry_msgs/Twist)", self.log("agent"))

    def test_the_names_of_ros_2_are_understood(self):
        self.start_bridge()
        self.start_node()
        self.start_agent(**{key: name.replace("/", "/msg/") for key, name in TYPES.items()})
        time.sleep(8.0)
        self.push(3.0)
        self.assertTrue(self.moved())

    def test_fragments_are_not_what_it_is_sent(self):
        self.start_bridge("_max_message_size:=1000")
        self.start_node()
        self.start_agent()
        time.sleep(6.0)
        self.assertNotIn("fragments", self.log("agent"))
        for topic in ("/odom", "/scan", "/camera"):
            self.assertNotIn(f"nothing comes on {topic}", self.log("agent"))

    def test_a_bridge_that_wants_a_password_is_asked_less_and_less_often(self):
        self.start_bridge("_authenticate:=true")
        self.start_agent()
        time.sleep(8.0)
        self.assertEqual(self.log("agent").count("parameter 'authenticate'"), 1)
        self.assertLessEqual(self.log("bridge").count("Client connected"), 8)

    def test_at_the_end_the_wheels_are_told_to_stand(self):
        self.start_bridge()
        self.start_node()
        self.start_agent()
        time.sleep(2.0)
        with subprocess.Popen([PYTHON, PEER / "kit" / "joy.py", "4", "0", "0.5"], env={**self.environment, "TAIL": "0.1"},
                              stdout=subprocess.DEVNULL):
            self.wait("it turns", lambda: self.twists() and self.twists()[-1][1] != 0, 10)
            self.processes["agent"].send_signal(signal.SIGTERM)
            self.processes["agent"].wait(timeout=10)
            time.sleep(0.5)
            self.assertEqual(self.twists()[-1][1], 0)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    BIN = pathlib.Path(sys.argv[1]).resolve()
    WEB = pathlib.Path(sys.argv[2]).resolve()
    options = argparse.ArgumentParser(usage=__doc__)
    options.add_argument("--profile", choices=BODIES, default="disc")
    options.add_argument("--to", nargs="+", default=["kitchen"])
    OPTIONS, rest = options.parse_known_args(sys.argv[3:])
    unittest.main(argv=[sys.argv[0], *rest], verbosity=2)
