"""The REST calls that the demo and the end-to-end tests make, signed in like a browser. Python's standard library only."""
import json
import time
import urllib.error
import urllib.request
import uuid


class Failed(Exception):
    """The demo cannot go on; the message says why."""


def setup_token(file, limit_s=10.0):
    """The one-time token that a server writes with its set-up link, once it has its port; raises Failed when it does not."""
    end = time.monotonic() + limit_s
    while time.monotonic() < end:
        text = file.read_text() if file.exists() else ""
        if text.endswith("\n"):
            return text.strip().split("token=")[-1]
        time.sleep(0.02)
    raise Failed(f"there is no set-up link in {file}")


class Server:
    """The REST calls of the demo, signed in with a bearer token or a session cookie."""

    def __init__(self, address):
        self.address = address
        self.cookie = None

    def call(self, method, path, body=None, expect=(200, 201, 202, 204)):
        """Sends `body` as JSON and gives the parsed answer. Raises Failed when the status is not in `expect`."""
        data = None if body is None else json.dumps(body).encode()
        status, parsed = self.send(method, path, data, "application/json")
        if status not in expect:
            raise Failed(f"{method} {path} was refused with {status}: {parsed.get('detail') or parsed.get('title')}")
        return parsed

    def send(self, method, path, data=None, content_type="application/octet-stream", extra_headers=None):
        """Sends bytes; gives the status and the parsed JSON answer ({} when there is none)."""
        headers = {"Origin": self.address, "Accept": "application/json", **(extra_headers or {})}
        if data is not None:
            headers["Content-Type"] = content_type
        if method == "POST":
            headers["Idempotency-Key"] = str(uuid.uuid4())
        if self.cookie:
            headers["Cookie"] = self.cookie
        request = urllib.request.Request(self.address + path, data, headers, method=method)
        try:
            with urllib.request.urlopen(request, timeout=30) as answer:
                if answer.headers.get("Set-Cookie"):
                    self.cookie = answer.headers["Set-Cookie"].split(";")[0]
                text = answer.read()
                status = answer.status
        except urllib.error.HTTPError as error:
            text, status = error.read(), error.code
        try:
            return status, json.loads(text) if text else {}
        except ValueError:
            return status, {"detail": text[:200].decode(errors="replace")}

    def wait_until_up(self, process, seconds=20):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if process.poll() is not None:
                raise Failed(f"the server ended with {process.returncode}; see its log above")
            try:
                with urllib.request.urlopen(self.address + "/healthz", timeout=2):
                    return
            except OSError:
                time.sleep(0.1)
        raise Failed("the server did not come up")
