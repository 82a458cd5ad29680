#!/usr/bin/env python3
"""Kills the server over and over (SIGKILL, at a random moment) while pictures are uploaded, a map is edited in every way,
drafts of it are edited and published, and another map is built. After each kill what is there is held against what was
acknowledged; the request that was in flight may have come through, but whole. Counts what is lost, and how long each
start takes until the server is ready.

usage: kills.py BIN_FOLDER [--kills 300] [--seed 1] [--lean] [--keep FOLDER]
--lean: without uploads and builds. --keep: the server's data and what was found wrong stay there.
Prints one JSON object; exits with 1 where something is lost.
"""
import argparse
import collections
import contextlib
import hashlib
import http.client
import json
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time
import urllib.request

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "deploy"))
import demo  # noqa: E402
from kept_edits import Found, Ledger, Request, add, asked, log_difference, log_of, redo, undo  # noqa: E402
from random_edits import RandomEdits  # noqa: E402
from rest_client import Failed, Server  # noqa: E402

PORT = 18479
GONE = (OSError, http.client.HTTPException, Failed)  # the server was killed meanwhile
MOST_DRAFTS = 4
FRESH_AFTER = 300  # edits in the log of a map, then another is edited: who edits by hand does not make thousands


class Kills:
    def __init__(self, binaries, data, seed):
        self.binaries, self.data = binaries, data
        self.random = random.Random(seed)
        self.server = Server(f"http://127.0.0.1:{PORT}")
        self.process = None
        self.ending = False
        self.pictures = {}  # (tour, number): SHA-256 of what was acknowledged
        self.builds = 0
        self.ready_s = []
        self.start()
        while not (data / "setup-link").exists():
            time.sleep(0.01)
        demo.set_up_account(self.server, data)

    def start(self):
        began = time.monotonic()
        with open(self.data / "server.log", "ab") as log:
            self.process = subprocess.Popen([self.binaries / "homeward-server", "--data", self.data / "server", "--listen",
                                             f"127.0.0.1:{PORT}", "--print-setup-file", self.data / "setup-link"],
                                            stdout=log, stderr=subprocess.STDOUT)
        while True:
            if self.process.poll() is not None:
                sys.exit(f"the server did not start again: see {self.data / 'server.log'}")
            try:
                if self.server.send("GET", "/readyz")[0] == 200:
                    break
            except OSError:
                pass
            time.sleep(0.005)
        self.ready_s.append(time.monotonic() - began)

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()

    def caller(self):
        server = Server(self.server.address)
        server.cookie = self.server.cookie
        return server

    def upload(self, files, camera):
        server = self.caller()
        while not self.ending:
            try:
                tour = server.call("POST", "/api/v1/tours", {"name": "t", "camera": camera})["id"]
                for number, file in enumerate(files):
                    bytes_ = file.read_bytes()
                    status, _ = server.send("PUT", f"/api/v1/tours/{tour}/images/{number}", bytes_, "image/jpeg")
                    if status in (200, 201):
                        self.pictures[tour, number] = hashlib.sha256(bytes_).hexdigest()
            except GONE:
                time.sleep(0.01)

    def build(self, map_id):
        server = self.caller()
        while not self.ending:
            try:
                job = server.call("POST", f"/api/v1/maps/{map_id}/builds", {"kind": "build"}, expect=(202, 409))
                while not self.ending and "job" in job:
                    state = server.call("GET", f"/api/v1/jobs/{job['job']['id']}")["state"]
                    if state not in ("queued", "running"):
                        self.builds += state == "done"
                        break
                    time.sleep(0.1)
            except GONE:
                pass
            time.sleep(0.05)

    def lost_pictures(self):
        """What was acknowledged and is not there, once nobody works any more."""
        missing = []
        for (tour, number), digest in self.pictures.items():
            file = self.data / "server" / "tours" / tour / f"{number}.jpg"
            known = file.exists() and hashlib.sha256(file.read_bytes()).hexdigest() == digest
            if not known:
                missing.append(f"{tour}/{number}")
        for tour in {tour for tour, _ in self.pictures}:
            count = sum(1 for one, _ in self.pictures if one == tour)
            if self.server.call("GET", f"/api/v1/tours/{tour}")["images"] < count:
                missing.append(f"{tour}: rows")
        return missing


class Mending:
    """Two callers that change a map and drafts of it, and the ledger of what they were told."""

    def __init__(self, kills, exported):
        self.kills, self.exported = kills, exported
        self.counts = {"map": collections.Counter(), "drafts": collections.Counter(), "refused": collections.Counter()}
        self.in_flight = {"came through": 0, "did not": 0}
        self.past = []  # of maps that are no longer edited: path, what they held
        self.wrong = []
        self.going = threading.Event()  # cleared while what is there is looked at
        self.waiting = threading.Semaphore(0)
        self.begin_map()

    def begin_map(self):
        status, made = self.kills.server.send("POST", "/api/v1/maps/import?name=edited", self.exported, "application/vnd.sqlite3")
        if status != 201:
            sys.exit(f"the map is not imported: {status} {made}")
        self.map = made["map"]["id"]
        self.path = f"/api/v1/maps/{self.map}"
        self.ledger = Ledger(Found(self.kills.server.call, self.map), self.in_flight)

    def wait(self):
        """Of a caller: until what is there has been looked at."""
        if not self.going.is_set():
            self.waiting.release()
            self.going.wait()

    def check(self):
        """After a start, with both callers waiting."""
        found = Found(self.kills.server.call, self.map)
        told = self.ledger.differences(found)
        for draft in found.drafts.values():
            graph = self.kills.server.call("GET", f"{self.path}/drafts/{draft['id']}/graph")
            told += self.ledger.other_draft_graph(draft, graph)
        self.ledger.forget_graphs()
        if told:
            self.wrong.append({"kill": len(self.kills.ready_s), "map": self.map, "told": told})
            print(f"wrong after start {len(self.kills.ready_s)}: {[one for one in told if isinstance(one, str)]}",
                  file=sys.stderr, flush=True)
        if len(found.history) > FRESH_AFTER:
            self.past.append(found)
            self.begin_map()

    def check_past(self):
        for before in self.past:
            if vars(Found(self.kills.server.call, before.map)) != vars(before):
                self.wrong.append({"map": before.map, "told": "is another one than when it was left"})

    def change(self, server, caller, request, method, path, body, tag):
        """Asks for a change; gives what was answered, or None where it was refused. Raises one of GONE."""
        self.ledger.sent(caller, request)
        headers = {"If-Match": f'"{tag}"'} if tag else {}
        data = None if body is None else json.dumps(body).encode()
        status, answer = server.send(method, path, data, "application/json", headers)
        done = status in (200, 201, 204)
        self.ledger.answered(caller, request, answer if done and answer else {"done": True} if done else None)
        if done:
            for one in getattr(request, "edits", [None]):
                kind = one["kind"] if one else request.kind
                self.counts["drafts" if caller == "drafter" else "map"][kind] += 1
        else:
            self.counts["refused"][f"{request.kind} {status}"] += 1
            if status >= 500:
                self.wrong.append({"refused": status, "answer": answer, "request": vars(request)})
        return answer if done else None

    def work(self, step, seed):
        """Steps until the end; each that the kill interrupts waits for the next start."""
        server, chance = self.kills.caller(), random.Random(seed)
        edits = RandomEdits(chance)
        while not self.kills.ending:
            self.wait()
            try:
                step(server, chance, edits)
            except GONE:
                while self.going.is_set() and not self.kills.ending:
                    time.sleep(0.002)

    def edit(self, server, chance, edits):
        graph = server.call("GET", f"{self.path}/graph")
        self.ledger.read_graph(graph)
        kind = chance.choices(("edit", "undo", "redo"), (70, 20, 10))[0]
        asked_for = {"revision": graph["revision"]}
        if kind == "edit":
            asked_for["edits"] = edits.batch(graph)
            if not asked_for["edits"]:
                return
        body = {"edits": asked_for["edits"]} if kind == "edit" else {}
        path = f"{self.path}/{'edits' if kind == 'edit' else kind}"
        done = self.change(server, "editor", Request(kind, **asked_for), "POST", path, body, f"r{graph['revision']}")
        if done and chance.random() < 0.3:
            self.ledger.read_history(server.call("GET", f"{self.path}/history")["edits"])

    def draft(self, server, chance, edits):
        drafts = server.call("GET", f"{self.path}/drafts")["drafts"]
        if not drafts or (len(drafts) < MOST_DRAFTS and chance.random() < 0.15):
            name = edits.label()
            self.change(server, "drafter", Request("add", name=name), "POST", f"{self.path}/drafts", {"name": name}, None)
            return
        draft = chance.choice(drafts)
        of_draft = {"draft": draft["id"], "version": draft["version"]}
        path, tag = f"{self.path}/drafts/{draft['id']}", f"d{draft['version']}"
        kind = chance.choices(("draft_edit", "draft_undo", "draft_redo", "publish", "discard"), (50, 10, 5, 30, 5))[0]
        if kind == "discard":
            self.change(server, "drafter", Request(kind, **of_draft), "DELETE", path, None, None)
        elif kind == "publish":
            leave = chance.random() < 0.5 or any(one["lost"] for one in draft["edits"] if not one["undone"])
            request = Request(kind, leave_out_lost=leave, seen=draft, **of_draft)
            self.change(server, "drafter", request, "POST", f"{path}/publish", {"leave_out_lost": leave}, tag)
        else:
            self.edit_draft(server, edits, draft, Request(kind, **of_draft), path, tag)

    def edit_draft(self, server, edits, draft, request, path, tag):
        graph = server.call("GET", f"{path}/graph")
        self.ledger.read_graph(graph, draft["id"], draft["version"])
        expected, body = log_of(draft["edits"]), {}
        if request.kind == "draft_edit":
            request.edits = edits.batch(graph)
            if not request.edits:
                return
            body = {"edits": request.edits}
            add(expected, [asked(one) for one in request.edits])
        else:
            (undo if request.kind == "draft_undo" else redo)(expected)
        end = "edits" if request.kind == "draft_edit" else request.kind.removeprefix("draft_")
        after = self.change(server, "drafter", request, "POST", f"{path}/{end}", body, tag)
        if after and (other := log_difference(expected, after["edits"])):
            self.wrong.append({"answer": after, "expected": expected, "told": other})


def prepare(kills, rooms):
    """A tour of rooms and a map of it. Gives its pictures, its camera and the map's id."""
    tour = kills.data / rooms
    subprocess.run([kills.binaries / "homeward", "simulate", "tour", "--world", "house:1", "--rooms", rooms, "--seed", "3",
                    "--out", tour], check=True, stdout=subprocess.DEVNULL)
    files = sorted(tour.glob("*.jpg"))
    camera = json.loads((tour / "camera.json").read_text())
    id_ = kills.server.call("POST", "/api/v1/tours", {"name": "house", "camera": camera})["id"]
    for number, file in enumerate(files):
        kills.server.send("PUT", f"/api/v1/tours/{id_}/images/{number}", file.read_bytes(), "image/jpeg")
    kills.server.call("POST", f"/api/v1/tours/{id_}/complete", {})
    made = kills.server.call("POST", "/api/v1/maps", {"name": "built", "tours": [id_]})
    while kills.server.call("GET", f"/api/v1/jobs/{made['job']['id']}")["state"] in ("queued", "running"):
        time.sleep(0.2)
    return files, camera, made["map"]["id"]


def exported(kills, map_id):
    headers = {"Cookie": kills.server.cookie, "Origin": kills.server.address}
    request = urllib.request.Request(f"{kills.server.address}/api/v1/maps/{map_id}/export", headers=headers)
    with urllib.request.urlopen(request, timeout=30) as answer:
        return answer.read()


def run(kills, mending, workers, number):
    for worker in workers:
        worker.start()
    mending.going.set()
    for _ in range(number):
        time.sleep(kills.random.uniform(0.05, 1.5))
        mending.going.clear()
        kills.kill()
        kills.start()
        for _ in range(2):
            mending.waiting.acquire()
        mending.check()
        mending.going.set()
    kills.ending = True
    for worker in workers:
        worker.join()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binaries", type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--lean", action="store_true")
    parser.add_argument("--keep", type=pathlib.Path)
    arguments = parser.parse_args()
    if arguments.keep:
        arguments.keep.mkdir(parents=True, exist_ok=True)
    scratch = contextlib.nullcontext(arguments.keep) if arguments.keep else tempfile.TemporaryDirectory(prefix="homeward-kills-")
    with scratch as folder:
        kills = Kills(arguments.binaries.resolve(), pathlib.Path(folder), arguments.seed)
        _, _, mended = prepare(kills, "hall,kitchen,bedroom,hall")
        files, camera, built = prepare(kills, "hall,kitchen")
        mending = Mending(kills, exported(kills, mended))
        kills.ready_s.clear()
        workers = [threading.Thread(target=mending.work, args=(mending.edit, 2 * arguments.seed)),
                   threading.Thread(target=mending.work, args=(mending.draft, 2 * arguments.seed + 1))]
        if not arguments.lean:
            workers += [threading.Thread(target=kills.upload, args=(files, camera)),
                        threading.Thread(target=kills.build, args=(built,))]
        run(kills, mending, workers, arguments.kills)
        mending.check()
        mending.check_past()
        missing = kills.lost_pictures()
        quarantine = kills.data / "server" / "quarantine"
        kills.kill()
        if arguments.keep:
            (arguments.keep / "wrong.json").write_text(json.dumps(mending.wrong, indent=1, default=str))
        changes = {name: {"all": sum(counts.values()), **dict(sorted(counts.items()))} for name, counts in mending.counts.items()}
        print(json.dumps({"kills": arguments.kills, "pictures": len(kills.pictures), "builds": kills.builds,
                          "acknowledged": changes, "in_flight": mending.in_flight,
                          "lost": missing, "wrong": len(mending.wrong),
                          "ready_s": {"median": round(sorted(kills.ready_s)[len(kills.ready_s) // 2], 3),
                                      "largest": round(max(kills.ready_s), 3)},
                          "quarantined": sum(1 for file in quarantine.rglob("*") if file.is_file())}))
    return 1 if missing or mending.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
