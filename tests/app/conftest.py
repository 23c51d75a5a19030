"""The page served as a person would, in a headless Chromium that records everything."""

import importlib.util
import os
import re
import shlex
import signal
import socket
import subprocess
import sys
import threading
from contextlib import closing
from http.client import HTTPConnection
from pathlib import Path
from shutil import which
from urllib.parse import parse_qsl, urlsplit
from urllib.request import urlopen

import numpy as np
import pytest

collect_ignore_glob = [] if importlib.util.find_spec("panel") else ["*"]
ROOT = Path(__file__).parents[2]
#: The one without windows takes a seventh less of the processor, and shows the same pages.
CHROMIUM = os.environ.get("CHROMIUM") or which("chromium-headless-shell") or "/usr/bin/chromium"
FLAGS = [
    "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync",
]  # fmt: skip
#: Presets of which some tests need what they are: the opening, an impact, one without yield, a punch.
GOLD, DROP, ELASTIC = "berkovich-gold", "striker-glass_epoxy-drop-weight", "ball-epoxy-elastic"
PUNCH = "punch-glass_epoxy"
#: Whether a page beside the explorer is there.
READY = "window.Bokeh?.documents.length && Bokeh.documents.every((each) => each.is_idle)"
FOCUSED = Path(__file__).with_name("focused.js").read_text(encoding="utf-8")
#: `mdr-explorer` as it is started by hand.
PROGRAM = ("-c", "import mdr_explorer; mdr_explorer.main()")
# What the page draws: rows by name, axes, and whether all is done.
SCRIPT = """
window.explorer = {
  model: (name) => window.Bokeh?.documents[0]?.get_model_by_name(name),
  row: (figure, row) => {
    for (const { data_source: { data } } of explorer.model(figure)?.renderers ?? []) {
      const k = data.row?.indexOf(row) ?? -1
      if (k < 0) continue
      const mine = (part) => Array.from(part).filter((_, n) => data.row[n] === row)
      return data.xs ? [Array.from(data.xs[k]), Array.from(data.ys[k])] : [mine(data.x), mine(data.y)]
    }
  },
  text: (figure, row) => {
    for (const { data_source: { data } } of explorer.model(figure).renderers)
      if (data.text && data.row.includes(row)) return data.text[data.row.indexOf(row)]
  },
  axis: (figure) => {
    const { x_range, y_range, below, left } = explorer.model(figure)
    const [x, y] = [x_range, y_range].map((range) => [range.start, range.end])
    return { x, y, labels: [below[0].axis_label, left[0].axis_label] }
  },
  // What is shown once the input is still.
  scene: () => explorer.model("messages").address,
  played: () => explorer.model("messages").frames.length > 0,
  all: (root = document) => [...root.querySelectorAll("*")].flatMap(
    (each) => [each, ...(each.shadowRoot ? explorer.all(each.shadowRoot) : [])]),
  idle: () => typeof explorer.model("messages")?.address === "string" &&
    Bokeh.documents.every((each) => each.is_idle) &&
    (explorer.made ||= explorer.all().some((each) => each.tagName === "H1")) &&
    explorer.row("force", "now")?.[0].length === 1,
}
"""
MODULE = ("-m", "panel")


class Server:
    """`panel serve app`, or another program, from the project root or a copy, on a free port; its log."""

    def __init__(
        self, *options, port=0, root=ROOT, program=("-m", "panel", "serve", "app"), environment=()
    ):
        command = [sys.executable, *program, *options, "--port", str(port)]
        self.lines, self._ready = [], threading.Event()
        output = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
        output["env"] = os.environ | dict(environment)
        self.process = subprocess.Popen(command, cwd=root, start_new_session=True, **output)
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
        closed = r"Task exception was never retrieved\n(?:(?!Task exc).)*?\ntornado\S+ClosedError\n"
        log = re.sub(closed, "", self.log, flags=re.DOTALL)
        return log if re.search(r"Traceback|ERROR|\b[EW]-1\d{3}\b", log) else ""

    def stop(self, kill=False):
        # The group, as a service manager does: a server of several processes would leave its children.
        os.killpg(self.process.pid, signal.SIGKILL if kill else signal.SIGTERM)
        self.process.wait(20)
        self._reader.join(20)
        assert not self._reader.is_alive(), "a process of the server did not end"
        self.process.stdout.close()


def free_port():
    with socket.create_server(("127.0.0.1", 0)) as probe:
        return probe.getsockname()[1]


def deployed(port):
    """Options of the line in assets/docs/explorer.md, but for its port, answered on loopback."""
    text = (ROOT / "assets/docs/explorer.md").read_text(encoding="utf-8")
    line = re.search(r"panel serve app (--address.*?)\n```", text, re.DOTALL)[1].replace("\\\n", " ")
    line = re.sub(r"--port \S+", "", line)
    return shlex.split(line.replace("explorer.example.org", f"127.0.0.1:{port}"))


def get(server, path, headers=None, host=None):
    """Status, headers and body of an answer."""
    with closing(HTTPConnection("127.0.0.1", server.port, timeout=60)) as connection:
        host = host or f"localhost:{server.port}"
        connection.request("GET", path, headers={"Host": host} | (headers or {}))
        answer = connection.getresponse()
        # A websocket that is accepted stays open.
        body = b"" if answer.status == 101 else answer.read()
        return answer.status, answer.headers, body


class Explorer:
    """The page as a person sees it, and what it said on the way."""

    def __init__(self, page, url, ready="explorer.idle()", window=None):
        self.page, self.sent, self.problems = page, [], []
        if window:
            page.set_viewport_size(dict(zip(("width", "height"), window, strict=True)))
        page.on("websocket", lambda socket: socket.on("framesent", lambda data: self.sent.append(data)))
        page.on("request", self._requested)
        page.on("pageerror", lambda error: self.problems.append(str(error)))
        page.on("console", self._heard)
        # Long enough for a busy machine, on which the first page of a server waits for all its imports.
        page.set_default_timeout(30_000)
        page.add_init_script(SCRIPT)
        page.goto(url)
        page.wait_for_function(ready)

    def _requested(self, request):
        if urlsplit(request.url).hostname not in ("localhost", "127.0.0.1", None):
            self.problems.append(request.url)

    def _heard(self, message):
        if message.type in ("error", "warning"):
            self.problems.append(message.text)

    def row(self, figure, row):
        """Columns x and y of a row as they are drawn."""
        drawn = self.page.evaluate("(a) => explorer.row(...a)", [figure, row])
        return [np.array(part, float) for part in drawn]

    def axis(self, figure):
        return self.page.evaluate("(name) => explorer.axis(name)", figure)

    def goto(self, url):
        """Open another address, and wait until all is painted."""
        self.page.goto(url)
        self.page.wait_for_function("window.explorer?.idle()")

    def slider(self, symbol):
        return self.page.locator(f'input[type="range"][aria-label^="{symbol},"]')

    def field(self, symbol):
        return self.page.locator(f'input[type="text"][aria-label^="{symbol},"]')

    def number(self, symbol):
        """A quantity with its field, slider and explanation."""
        return self.page.locator(".number", has=self.field(symbol))

    def readout(self, name):
        """A number of the line above the plots, with its unit."""
        return self.page.locator(f'output[data-name="{name}"]').inner_text()

    def press(self, name):
        self.page.get_by_role("button", name=name, exact=True).click()

    def open(self, tab, plot, row):
        """Open an optional plot, and wait until one of its rows is drawn."""
        self.page.get_by_label("Fourth plot", exact=True).select_option(label=tab)
        self.wait("(a) => explorer.model(a[0]) && explorer.row(...a)?.[0].length > 1", [plot, row])
        # Until the address has it, its change would be taken for that of what is done next.
        self.link(f"tiles={plot}")

    def save(self, figure):
        """The picture of one plot that is saved, which is where it is large."""
        card = self.page.locator(f".card.{figure}")
        card.get_by_role("button", name="Large").click()
        with self.page.expect_download() as download:
            card.get_by_role("button", name="Save").click()
        card.get_by_role("button", name="Small").click()
        return download.value.path().read_bytes()

    def pick(self, option):
        """Pick an option of a choice by its text, and wait until it is drawn."""
        self.change(self.page.get_by_label(option, exact=True).first.check)

    def chosen(self, label):
        """Text of the option that is chosen in a list."""
        text = "(list) => list.selectedOptions[0].textContent"
        return self.page.get_by_label(label, exact=True).evaluate(text)

    def choose(self, label, option):
        """Choose from a list, and wait until it is drawn."""
        self.change(self.page.get_by_label(label, exact=True).select_option, label=option)

    def type(self, symbol, text):
        self.field(symbol).fill(text)
        self.field(symbol).press("Enter")

    def drag(self, figure, moves):
        """Drag from the middle of a plot by shares of its size, with the mouse."""
        box = self.page.locator(f".card.{figure} canvas").first.bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        self.page.mouse.move(x + moves[0] * box["width"], y + moves[1] * box["height"], steps=8)
        self.page.mouse.up()

    def place(self, figure, row, at):
        """Where one point of a row is on the screen, by its number."""
        x, y = (part[at] for part in self.row(figure, row))
        place = """([name, row, x, y]) => {
            const figure = explorer.model(name), view = Bokeh.index.find_one(figure)
            const { left, top } = view.el.getBoundingClientRect(), { y_range, renderers } = figure
            const drawn = renderers.find(({ data_source: { data } }) => data.row?.includes(row))
            const { start, end } = drawn.y_range_name === "right" ? figure.extra_y_ranges.right : y_range
            const up = y_range.start + (y - start) / (end - start) * (y_range.end - y_range.start)
            return [left + view.frame.x_scale.compute(x), top + view.frame.y_scale.compute(up)]
        }"""
        return self.page.evaluate(place, [figure, row, x, y])

    def hover(self, figure, row, at):
        """Lines of the tooltip over one point of a row, by its number."""
        self.page.mouse.move(*self.place(figure, row, at))
        said = self.page.locator(".bk-Tooltip div", has_text=re.compile(f"^{row}")).first.inner_text()
        return [line.strip() for line in said.splitlines() if line.strip()]

    def wait(self, condition, arg=None):
        self.page.wait_for_function(condition, arg=arg, timeout=20_000)

    def link(self, expected):
        """The arguments of the address, once it has a text in it."""
        self.wait("(text) => location.search.includes(text)", expected)
        return dict(parse_qsl(urlsplit(self.page.url).query))

    def change(self, act, *arguments, **options):
        """Do something, and wait until a new scene is there and all is painted."""
        # The address of an earlier change may still be on its way.
        self.page.wait_for_function("explorer.idle()")
        self.page.evaluate("window.before = explorer.scene()")
        act(*arguments, **options)
        self.page.wait_for_function("explorer.scene() !== before && explorer.idle()")


def heights(explorer, *names):
    """Heights (pixels) of plots within their axes."""
    return [explorer.page.evaluate(f"explorer.model('{name}').inner_height") for name in names]


def boxes(page, *selectors):
    return [page.locator(each).first.bounding_box() for each in selectors]


@pytest.fixture(scope="session")
def server(browser):
    """Without a browser none is started."""
    server = Server()
    yield server
    server.stop()
    assert server.faults == ""


@pytest.fixture(scope="session")
def browser():
    # Where the browser is required its absence is a failure.
    if not Path(CHROMIUM).exists() and os.environ.get("MDR_BROWSER") != "required":
        pytest.skip("the page's tests need Chromium; set CHROMIUM to its path")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        # A page that starts a process of its own takes twice the time of the processor.
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=[*FLAGS, "--process-per-site"])
        yield browser
        browser.close()


def keep_process(context, server):
    """Open a page that stays, and with it the process of all pages of the site."""
    context.new_page().goto(server.url.replace("/app", "/static/js/bokeh.min.js"))


@pytest.fixture(scope="session")
def context(server, browser):
    """One profile for all pages, so that scripts are fetched and compiled once."""
    with browser.new_context(viewport={"width": 1440, "height": 900}) as context:
        keep_process(context, server)
        yield context


@pytest.fixture(scope="session")
def handheld(server, browser):
    """The profile of a phone, for all pages that are touched."""
    held = {"viewport": {"width": 390, "height": 844}, "is_mobile": True, "has_touch": True}
    with browser.new_context(**held) as context:
        keep_process(context, server)
        yield context


@pytest.fixture(scope="session")
def opened(browser):
    """Opens a saved scene in a browser without a network; at the end nothing was asked or complained of."""
    with browser.new_context(viewport={"width": 1280, "height": 720}) as context:
        context.set_offline(True)
        files = []

        def open_file(path):
            ready = "document.querySelector('#player input')"
            files.append(Explorer(context.new_page(), path.as_uri(), ready))
            return files[-1]

        yield open_file
        assert [problem for each in files for problem in each.problems] == []


@pytest.fixture
def explorer(server, context):
    """A page freshly opened; afterwards nothing may have been complained about or left the host."""
    explorer = Explorer(context.new_page(), server.url)
    yield explorer
    assert explorer.problems == []
    # All pages share what the browser keeps, as the theme.
    explorer.page.evaluate("localStorage.clear()")
    explorer.page.close()
    assert server.faults == ""
