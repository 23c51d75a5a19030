"""The explorer as a folder of files, and a host of files."""

import subprocess
import sys
import threading
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer

import pytest

from ..conftest import DROP, ELASTIC, GOLD, PUNCH, ROOT

#: Presets whose drawings are looked at; the others take most of the time in which a folder is written.
DRAWN = GOLD, PUNCH, DROP, ELASTIC
CODE = f"""
from app.explorer.extras import scene_file
draw = scene_file.scene_file
scene_file.scene_file = lambda view, bokeh: draw(view, bokeh) if view.state.preset in {DRAWN!r} else ""
import mdr_explorer
mdr_explorer.main()
"""


@pytest.fixture(scope="session")
def written(tmp_path_factory):
    """The folder with a runtime from elsewhere, in the place of an earlier one; what the command says."""
    folder = tmp_path_factory.mktemp("static") / "explorer"
    (folder / "pyodide").mkdir(parents=True)
    (folder / "explorer.zip").touch()
    run = [sys.executable, "-c", CODE, "--static", folder]
    done = subprocess.run(run, cwd=ROOT, capture_output=True, text=True, check=True)
    return folder, done.stdout


@contextmanager
def host_of(folder):
    """The address of a folder from a host of files."""

    class Files(SimpleHTTPRequestHandler):
        def log_message(self, *arguments):
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Files, directory=folder))
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    yield f"http://127.0.0.1:{server.server_port}/"
    server.shutdown()
    server.server_close()
    thread.join()
