"""The page served as a person would, in a headless Chromium that records everything."""

import importlib.util
import os
import re
import signal
import subprocess
import sys
import threading
from html import unescape
from pathlib import Path
from urllib.parse import parse_qsl, urlsplit
from urllib.request import urlopen

import pytest

collect_ignore_glob = [] if importlib.util.find_spec("panel") else ["*.py"]

ROOT = Path(__file__).parents[2]
CHROMIUM = os.environ.get("CHROMIUM", "/usr/bin/chromium")
FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]

# What the page draws: layers by name, axes, colours, and whether all is painted.
SCRIPT = """
window.explorer = {
  figure: (name) => Bokeh.documents.map((each) => each.get_model_by_name(name)).find((each) => each),
  column: (name, layer, key) => {
    const glyph = explorer.figure(name).renderers.find((each) => each.name === layer)
    // An image is an array of arrays, which not every playwright brings over as it is.
    return Array.from(glyph.data_source.data[key], (each) => ArrayBuffer.isView(each) ? [...each] : each)
  },
  axis: (name) => {
    const { x_range, y_range, below, left } = explorer.figure(name)
    return { x: [x_range.start, x_range.end], y: [y_range.start, y_range.end],
             labels: [below[0].axis_label, left[0].axis_label] }
  },
  frame: (name) => {
    const { left, right } = Bokeh.index.find_one(explorer.figure(name)).frame.bbox
    return [left, right]
  },
  notices: () => explorer.main().querySelectorAll(".notice").length,
  listen: () => {
    explorer.sent = []
    const send = explorer.send ?? WebSocket.prototype.send
    explorer.send = send
    WebSocket.prototype.send = function (data) {
      explorer.sent.push(String(data).slice(0, 200))
      send.call(this, data)
    }
  },
  main: () => Bokeh.index.roots[0]?.shadow_el?.querySelector("main"),
  idle: () => window.Bokeh !== undefined && Bokeh.documents.length > 0 &&
    Bokeh.documents.every((each) => each.is_idle) &&
    Boolean(explorer.main()?.dataset.drawn) && explorer.main().getAttribute("aria-busy") !== "true",
  colours: (name) => {
    const view = Bokeh.index.find_one(explorer.figure(name))
    const canvas = view.export("png", false).canvas
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height)
    const counts = {}
    for (let i = 0; i < data.length; i += 4) {
      const key = [data[i], data[i + 1], data[i + 2]].join()
      counts[key] = (counts[key] ?? 0) + 1
    }
    return counts
  },
}
"""


class Server:
    """`panel serve app` from the project root, on a free port, with its log."""

    def __init__(self, *options, port=0):
        command = [sys.executable, "-m", "panel", "serve", "app", *options, "--port", str(port)]
        self.lines, self._ready = [], threading.Event()
        self.process = subprocess.Popen(
            command,
            cwd=ROOT,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()
        try:
            assert self._ready.wait(60), f"the server did not start:\n{self.log}"
            # Plots are built for the first page; on a busy machine a browser would not wait for that.
            urlopen(self.url, timeout=180).read()
        except BaseException:
            self.stop(kill=True)
            raise

    def _read(self):
        for line in self.process.stdout:
            self.lines.append(line)
            if found := re.search(r"running at: (http\S+)", line):
                self.url = found[1]
                self.port = int(re.search(r":(\d+)", self.url)[1])
                self._ready.set()

    @property
    def log(self):
        return "".join(self.lines)

    @property
    def faults(self):
        """What the log complains about, but for pages that closed while an answer was on its way."""
        closed = (
            r"Task exception was never retrieved\n(?:(?!Task exc).)*?\ntornado\S+WebSocketClosedError\n"
        )
        log = re.sub(closed, "", self.log, flags=re.DOTALL)
        return log if "Traceback" in log or "ERROR" in log else ""

    def stop(self, kill=False):
        # The group, as a service manager does: a server of several processes would leave its children.
        os.killpg(self.process.pid, signal.SIGKILL if kill else signal.SIGTERM)
        self.process.wait(20)
        self._reader.join(20)
        assert not self._reader.is_alive(), "a process of the server did not end"
        self.process.stdout.close()


class Explorer:
    """The page as a person sees it, and what it said on the way."""

    def __init__(self, page, url):
        self.page, self.requests, self.problems = page, [], []
        page.on("request", lambda request: self.requests.append(request.url))
        page.on("pageerror", lambda error: self.problems.append(str(error)))
        page.on("console", self._heard)
        # Long enough for a busy machine, on which the first page of a server waits for all its imports.
        page.set_default_timeout(60_000)
        page.add_init_script(SCRIPT)
        page.goto(url)
        page.wait_for_function("explorer.idle()")

    def _heard(self, message):
        if message.type in ("error", "warning"):
            self.problems.append(message.text)

    def off_host(self):
        """Requests that left the host."""
        inside = ("localhost", "127.0.0.1", None)
        return [url for url in self.requests if urlsplit(url).hostname not in inside]

    def column(self, figure, layer, key):
        return self.page.evaluate("(args) => explorer.column(...args)", [figure, layer, key])

    def axis(self, figure):
        return self.page.evaluate("(name) => explorer.axis(name)", figure)

    def colours(self, figure):
        return self.page.evaluate("(name) => explorer.colours(name)", figure)

    def slider(self, symbol):
        return self.page.locator(f'input[type="range"][aria-label^="{symbol},"]')

    def field(self, symbol):
        return self.page.locator(f'input[type="text"][aria-label^="{symbol},"]')

    def readout(self, symbol):
        """A number of the strip above the plots, with its unit."""
        return (
            self.page.locator(f'.readouts [data-symbol="{symbol}"] dd')
            .inner_text()
            .replace("\n", "")
            .strip()
        )

    def pick(self, name, option, label):
        """Pick an option of a choice, however it is offered, and wait until it is drawn."""
        with self.change():
            self.page.locator(f'input[type="radio"][name="{name}"][value="{option}"]').check()

    def menu(self, label):
        self.page.locator(".menu summary").click()
        self.page.get_by_role("button", name=label).click()

    def take(self, label):
        """Path of the file that an entry of the menu gives."""
        with self.page.expect_download() as download:
            self.menu(label)
        return download.value.path()

    def save(self, figure, kind):
        """Path of the picture of a plot."""
        with self.page.expect_download() as download:
            self.page.locator(f'[data-plot="{figure}"] button', has_text=kind).click()
        return download.value.path()

    def drawing(self, figure):
        """All that is written in the SVG of a plot, and what stands between."""
        text = re.sub("<[^>]*>", "", self.save(figure, "SVG").read_text(encoding="utf-8"))
        return unescape(text).replace("\u200b", "")

    def bring(self, label, path):
        """Give the page a file."""
        self.page.locator(f'input[type="file"][aria-label^="{label}"]').set_input_files(path)

    def hush(self):
        """Take the notices away, which go by themselves after a while: how soon is no matter of a test."""
        self.page.evaluate("explorer.main().querySelectorAll('.notice').forEach((each) => each.remove())")

    def link(self):
        """What the address of the page says, once it has settled."""
        self.page.wait_for_function("explorer.idle()")
        self.page.wait_for_timeout(400)
        query = dict(parse_qsl(urlsplit(self.page.url).query))
        return query | {"at": float(query["at"])}

    def wait_for_frames(self):
        """Wait until the fields of all states are in the browser."""
        self.page.wait_for_function(
            "explorer.main().dataset.frames === explorer.main().dataset.scene && explorer.idle()"
        )

    def listen(self):
        """What the page sends from now on: a function that gives the messages so far."""
        self.page.evaluate("explorer.listen()")
        return lambda: self.page.evaluate("explorer.sent")

    def choose(self, label, option):
        """Choose from a list, and wait until what is drawn has changed and been painted."""
        with self.change():
            self.page.get_by_label(label, exact=True).select_option(label=option)

    def type(self, symbol, text):
        self.field(symbol).fill(text)
        self.field(symbol).press("Enter")

    def change(self):
        """Context in which something is done, left when a new scene is there and all is painted."""
        return _Change(self.page)


class _Change:
    def __init__(self, page):
        self.page = page

    def __enter__(self):
        self.page.evaluate("window.before = explorer.main().dataset.scene")

    def __exit__(self, kind, *_):
        if kind is None:
            self.page.wait_for_function("explorer.main().dataset.scene !== before && explorer.idle()")


@pytest.fixture(scope="session")
def server():
    server = Server()
    yield server
    server.stop()
    assert server.faults == ""


@pytest.fixture(scope="session")
def browser():
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def context(browser):
    """One profile for all pages, so that scripts are fetched and compiled once."""
    with browser.new_context(viewport={"width": 1440, "height": 900}) as context:
        yield context


@pytest.fixture
def explorer(server, context):
    """A page freshly opened; afterwards nothing may have been complained about or left the host."""
    page = context.new_page()
    explorer = Explorer(page, server.url)
    yield explorer
    assert explorer.problems == []
    assert explorer.off_host() == []
    page.evaluate("localStorage.clear()")
    page.close()
    assert server.faults == ""
