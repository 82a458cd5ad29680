#!/usr/bin/env python3
"""The demo behind demo.sh: a generated house, a guided tour, a map, and a simulated wheelchair that drives.

Starts the server and the agent, teaches the house over the same REST calls that an installer's browser makes, then
waits for clicks; with --headless it drives one mission itself and ends with 0 when the chair arrived. Python's
standard library only.
"""
import argparse
import json
import math
import pathlib
import secrets
import shutil
import signal
import subprocess
import sys
import time

from rest_client import Failed, Server, setup_token

ROOMS = "hall,living_room,kitchen,dining_room,bedroom,bathroom,study,hall"
WORLD = "house:1"
ARRIVED_WITHIN_M = 0.3
# A password is read off the screen and may be given to programs: no two alike, no sign that starts an option.
EASY_TO_TYPE = "abcdefghijkmnpqrstuvwxyz23456789"


def bar(label, share):
    width = 30
    done = int(round(max(0.0, min(1.0, share)) * width))
    end = "\n" if share >= 1 else ""
    if sys.stdout.isatty():
        print(f"\r{label:<22}[{'#' * done}{'.' * (width - done)}] {share:4.0%}", end=end, flush=True)
    elif share >= 1:
        print(f"{label}: done", flush=True)


def set_up_account(server, data):
    """Signs in, making the first account with the one-time set-up token when there is none yet."""
    login_file = data / "login.json"
    if server.call("GET", "/api/v1/setup")["needed"]:
        token = setup_token(data / "setup-link")
        login = {"name": "demo", "password": "".join(secrets.choice(EASY_TO_TYPE) for _ in range(14))}
        login_file.touch(mode=0o600)
        login_file.write_text(json.dumps(login))
        server.call("POST", "/api/v1/setup", {"token": token, **login})
    login = json.loads(login_file.read_text())
    server.call("POST", "/api/v1/login", login)
    return login


def teach(server, binaries, data, token_file):
    """The guided tour: rendered once, uploaded over REST, built into a map. Returns the map's id."""
    maps = [m for m in server.call("GET", "/api/v1/maps")["maps"] if m["state"] == "ready"]
    if maps:
        return maps[0]["id"]
    tour = data / "tour"
    if not (tour / "poses.csv").exists():
        shutil.rmtree(tour, ignore_errors=True)
        print("leading the chair on a tour of the generated house ...", flush=True)
        subprocess.run([binaries / "homeward", "simulate", "tour", "--world", WORLD, "--rooms", ROOMS, "--marks",
                        "--seed", "1", "--out", tour], check=True)
    subprocess.run([binaries / "homeward-agent", "upload", "--server", server.address, "--token-file", token_file,
                    "--tour", tour, "--name", "demo tour"], check=True, stdout=subprocess.DEVNULL)
    tours = [t for t in server.call("GET", "/api/v1/tours")["tours"] if t["state"] == "complete"]
    answer = server.call("POST", "/api/v1/maps", {"name": "Demo house", "tours": [tours[-1]["id"]]})
    job = answer["job"]["id"]
    while True:
        state = server.call("GET", f"/api/v1/jobs/{job}")
        if state["state"] == "done":
            bar("building the map", 1.0)
            return answer["map"]["id"]
        if state["state"] in ("failed", "cancelled"):
            raise Failed(f"the map could not be built: {(state.get('error') or {}).get('detail', state['state'])}")
        bar("building the map", min(0.99, (state.get("progress") or {}).get("share", 0.0)))
        time.sleep(0.5)


def robot_with_token(server, data):
    token_file = data / "robot-token"
    robots = server.call("GET", "/api/v1/robots")["robots"]
    if robots and token_file.exists():
        return robots[0]["id"], token_file
    made = server.call("POST", "/api/v1/robots", {"name": "Demo chair"})
    token_file.touch(mode=0o600)
    token_file.write_text(made["token"])
    return made["id"], token_file


def last_truth(file):
    """The simulator's own account of where the chair is; no method reads it."""
    lines = file.read_text().splitlines() if file.exists() else []
    return json.loads(lines[-1]) if lines else None


def drive(server, robot, map_id, label, data):
    """One mission across the house. Returns whether it ended well."""
    end = time.monotonic() + 120
    state = {}
    while time.monotonic() < end:
        state = server.call("GET", f"/api/v1/robots/{robot}")
        belief = state.get("belief")
        if state["online"] and belief and not belief["lost"] and belief["updates"] >= 3:
            break
        time.sleep(0.5)
    else:
        raise Failed(f"the chair did not find out where it is within two minutes: {json.dumps(state)[:300]}")
    graph = server.call("GET", f"/api/v1/maps/{map_id}/graph")
    destination = next((d for d in graph["destinations"] if d["label"] == label), None)
    if destination is None:
        raise Failed(f"the map has no destination named {label}")
    lease = server.call("POST", f"/api/v1/robots/{robot}/lease", {"take_over": True})["lease"]
    mission = server.call("POST", f"/api/v1/robots/{robot}/missions",
                          {"lease_id": lease["id"], "destination": destination["id"]})
    print(f"driving to the {label.replace('_', ' ')} over {len(mission['path'])} places ...", flush=True)
    end = time.monotonic() + 600
    while time.monotonic() < end:
        mission = server.call("GET", f"/api/v1/robots/{robot}/missions/{mission['id']}")
        if mission["state"] in ("arrived", "refused", "stopped", "failed"):
            break
        server.call("PUT", f"/api/v1/robots/{robot}/lease", {"lease_id": lease["id"]})
        bar("on the way", min(0.99, mission["path_index"] / max(1, len(mission["path"]) - 1)))
        time.sleep(0.5)
    bar("on the way", 1.0)
    time.sleep(1.0)
    truth = last_truth(data / "truth.jsonl")
    target = mark_pose(data / "tour", destination["image"].split("/")[-1])
    error_m = math.hypot(truth["x_m"] - target[0], truth["y_m"] - target[1])
    print(f"mission {mission['state']}{': ' + mission['reason']['code'] if mission.get('reason') else ''}; "
          f"{error_m:.2f} m from the destination's true pose, {truth['collisions']} collisions", flush=True)
    return mission["state"] == "arrived" and error_m <= ARRIVED_WITHIN_M and truth["collisions"] == 0


def mark_pose(tour, image):
    for line in (tour / "poses.csv").read_text().splitlines()[1:]:
        fields = line.split(",")
        if fields[0] == image:
            return float(fields[1]), float(fields[2])
    raise Failed(f"{image} is not in the tour's poses.csv")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--headless", action="store_true", help="drive to --to and end: 0 when the chair arrived")
    parser.add_argument("--to", default="kitchen", metavar="ROOM,ROOM", help="where --headless drives, in turn")
    parser.add_argument("--port", type=int, default=8080)
    parser.add_argument("--data", type=pathlib.Path, default=pathlib.Path("build/demo"))
    parser.add_argument("--fresh", action="store_true", help="forget the last demo's tour, map and accounts")
    parser.add_argument("--bin", type=pathlib.Path, required=True, help="folder of the programs")
    parser.add_argument("--web", type=pathlib.Path, required=True, help="folder of the built dashboard")
    arguments = parser.parse_args()
    data = arguments.data.resolve()
    binaries = arguments.bin.resolve()
    if arguments.fresh:
        shutil.rmtree(data, ignore_errors=True)
    data.mkdir(parents=True, exist_ok=True)
    address = f"http://127.0.0.1:{arguments.port}"
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))

    processes = []
    logs = {name: open(data / f"{name}.log", "ab") for name in ("server", "agent")}
    try:
        server_process = subprocess.Popen(
            [binaries / "homeward-server", "--data", data / "server", "--listen", f"127.0.0.1:{arguments.port}",
             "--web", arguments.web.resolve(), "--print-setup-file", data / "setup-link"],
            stdout=logs["server"], stderr=subprocess.STDOUT)
        processes.append(server_process)
        server = Server(address)
        server.wait_until_up(server_process)
        login = set_up_account(server, data)
        robot, token_file = robot_with_token(server, data)
        map_id = teach(server, binaries, data, token_file)
        server.call("PUT", f"/api/v1/robots/{robot}/map", {"map": map_id})
        (data / "truth.jsonl").unlink(missing_ok=True)
        processes.append(subprocess.Popen(
            [binaries / "homeward-simulated-agent", "run", "--server", address, "--robot", robot, "--token-file", token_file,
             "--world", WORLD, "--start-room", "bedroom",
             "--truth-file", data / "truth.jsonl"], stdout=logs["agent"], stderr=subprocess.STDOUT))
        if arguments.headless:
            return 0 if all(drive(server, robot, map_id, label, data) for label in arguments.to.split(",")) else 1
        print(f"\n  open      {address}\n  name      {login['name']}\n  password  {login['password']}\n\n"
              "  Pick a room on the page and the chair drives there. Ctrl-C ends the demo.", flush=True)
        while all(process.poll() is None for process in processes):
            time.sleep(1)
        raise Failed(f"a program ended by itself; its log is in {data}")
    except KeyboardInterrupt:
        return 0
    except (Failed, subprocess.CalledProcessError) as failure:
        print(f"demo: {failure}", file=sys.stderr)
        for name in logs:
            tail = (data / f"{name}.log").read_text(errors="replace").splitlines()[-15:]
            print(f"--- end of {name}.log ---", *tail, sep="\n", file=sys.stderr)
        return 1
    finally:
        for process in reversed(processes):
            process.terminate()
        for process in processes:
            try:
                process.wait(timeout=10)
            except subprocess.TimeoutExpired:
                process.kill()


if __name__ == "__main__":
    sys.exit(main())
