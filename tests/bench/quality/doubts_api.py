# SPDX-License-Identifier: Apache-2.0
"""The maps of doubts.py on a server of their own, answered by the calls that the dashboard makes.

Answers that split a place need its pictures, and a server has those of tours that were uploaded to it, under the tour's
id: so the sound map is built there, exported, broken (of the tour under that id) and imported again.
"""
import contextlib
import functools
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.request

import doubts

sys.path.insert(0, str(doubts.ROOT / "deploy"))
import demo  # noqa: E402
from rest_client import Server  # noqa: E402

PORT = 18478
SQLITE = "application/vnd.sqlite3"


@contextlib.contextmanager
def server(options):
    """Gives what makes a case on a server that runs meanwhile, from nothing."""
    with tempfile.TemporaryDirectory(prefix="homeward-doubts-") as folder:
        data = pathlib.Path(folder)
        with open(options.work / "server.log", "ab") as log:
            process = subprocess.Popen([options.bin / "homeward-server", "--data", data / "server", "--listen",
                                        f"127.0.0.1:{PORT}", "--print-setup-file", data / "setup-link"], stdout=log, stderr=log)
        try:
            caller = Server(f"http://127.0.0.1:{PORT}")
            caller.wait_until_up(process)
            demo.set_up_account(caller, data)
            _, token_file = demo.robot_with_token(caller, data)
            yield functools.partial(ServedCase, caller, token_file, data)
        finally:
            process.terminate()
            process.wait()


class ServedCase(doubts.Case):
    def __init__(self, caller, token_file, data, options, world, seed):
        self.caller, self.token_file, self.data = caller, token_file, data
        super().__init__(options, world, seed)

    def build(self):
        doubts.run(self.options.bin / "homeward-agent", "upload", "--server", self.caller.address, "--token-file",
                   self.token_file, "--tour", self.tour, "--name", self.name)
        tour = next(one for one in self.caller.call("GET", "/api/v1/tours")["tours"] if one["name"] == self.name)["id"]
        made = self.caller.call("POST", "/api/v1/maps", {"name": self.name, "tours": [tour]})
        while (job := self.caller.call("GET", f"/api/v1/jobs/{made['job']['id']}"))["state"] in ("queued", "running"):
            time.sleep(0.2)
        if job["state"] != "done":
            raise RuntimeError(f"{self.name} is not built: {job}")
        shutil.rmtree(self.data / "tours", ignore_errors=True)
        named = self.data / "tours" / tour
        named.mkdir(parents=True)
        for file in self.tour.iterdir():
            (named / file.name).symlink_to(file.resolve())
        self.tour = named
        self.sound, self.broken = (self.data / file.name for file in (self.sound, self.broken))
        self.export(made["map"]["id"], self.sound)

    def export(self, map_id, file):
        headers = {"Cookie": self.caller.cookie, "Origin": self.caller.address}
        request = urllib.request.Request(f"{self.caller.address}/api/v1/maps/{map_id}/export", headers=headers)
        with urllib.request.urlopen(request, timeout=60) as answer:
            file.write_bytes(answer.read())

    def answered(self):
        status, made = self.caller.send("POST", "/api/v1/maps/import?name=broken", self.broken.read_bytes(), SQLITE)
        if status != 201:
            raise RuntimeError(f"{self.name} is not imported: {status} {made}")
        path = f"/api/v1/maps/{made['map']['id']}"
        file = self.broken.with_name(f"{self.broken.stem}-answered.map")
        self.export(made["map"]["id"], file)
        known, figures = set(), self.judged(file)
        while len(known) < doubts.MOST_ANSWERS and not doubts.whole(figures):
            page = self.caller.call("GET", f"{path}/doubts?limit=1000")
            doubt = next((one for one in page["doubts"] if self.identity(one) not in known), None)
            if doubt is None:
                break
            known.add(self.identity(doubt))
            edits = self.answer(doubt)
            if not edits:
                continue
            body = doubts.json.dumps({"edits": edits}).encode()
            status, answer = self.caller.send("POST", f"{path}/edits", body, "application/json",
                                              {"If-Match": f'"r{page["revision"]}"'})
            if status != 200:
                raise RuntimeError(f"{self.name}: {edits} is refused with {status}: {answer}")
            self.export(made["map"]["id"], file)
            figures = self.judged(file)
        return len(known), figures
