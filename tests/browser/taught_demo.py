"""The demo with a house that was taught before, its chair connected: what tests and benchmarks in a real browser look at."""
import contextlib
import json
import pathlib
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "loop"))
import taught_house  # noqa: E402


class DidNotStart(Exception):
    pass


@contextlib.contextmanager
def running(bin_folder, web_folder, port):
    """The server's address, the login of its account and the folder of its data, while it runs; raises DidNotStart."""
    with tempfile.TemporaryDirectory(prefix="homeward-demo-") as folder:
        data = pathlib.Path(folder)
        taught_house.bring(data)
        demo = subprocess.Popen([sys.executable, HERE.parents[1] / "deploy" / "demo.py", "--port", str(port), "--data", data,
                                 "--bin", bin_folder, "--web", web_folder], stdout=subprocess.PIPE, text=True)
        try:
            for line in demo.stdout:
                print(line, end="", flush=True, file=sys.stderr)
                if line.strip().startswith("password"):
                    break
            else:
                raise DidNotStart("the demo ended before it was ready")
            time.sleep(2)  # until the chair is connected
            yield f"http://127.0.0.1:{port}", json.loads((data / "login.json").read_text()), data
        finally:
            demo.terminate()
            demo.wait(timeout=30)
