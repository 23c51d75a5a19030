"""The explorer without a server beside the served one: starts, computations, and key presses, in one run.

Run from the project root, with the folder of a whole Pyodide:

    OPENBLAS_NUM_THREADS=1 MDR_PYODIDE=… python -m tests.benchmarks.in_browser

writes its section of assets/benchmarks.md. A browser has one thread, and so have both sides.
"""

import os
import threading
import time
from contextlib import suppress
from datetime import UTC, datetime
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from tempfile import TemporaryDirectory

from mdr_explorer import static
from tests.app.conftest import CHROMIUM, FLAGS, SCRIPT, Server

from .page_latency import FIGURES, HOOK, cpu_seconds
from .report import IN_BROWSER, write_section

ROUNDS, PRESSES = 8, 40
#: What is timed on both sides: milliseconds of a case, the first time, and the shortest later.
CODE = """
import time
import mdr_core as mdr
gold = mdr.Medium.from_bodies(E1=78e9, nu1=0.42, q_c=100.0)
gel = mdr.Medium.from_bodies(E1=3e6, nu1=0.5, q_c=1.0, eta=10.0)
cone, ball = mdr.Cone(slope=0.3), mdr.Sphere(radius=200e-9)
cases = {
    "state of a cone, with its force": lambda: mdr.indent(cone, gold, 9e-9).force,
    "state of a sphere, with its force": lambda: mdr.indent(ball, gold, 9e-9).force,
    "impact of a cone, restitution": lambda: mdr.impact(cone, gold, mass=1e-15, speed=0.1).restitution,
    "impact of a sphere, restitution": lambda: mdr.impact(ball, gold, mass=1e-15, speed=0.1).restitution,
    "impact of a sphere, contact time": lambda: mdr.impact(ball, gold, mass=1e-15, speed=0.1).contact_time,
    "viscous impact of a cone": lambda: mdr.impact(cone, gel, mass=1e-12, speed=0.1).restitution,
    "viscous impact of a sphere": lambda: mdr.impact(ball, gel, mass=1e-15, speed=0.01).restitution,
}
def once(name):
    begin = time.perf_counter()
    cases[name]()
    return 1000 * (time.perf_counter() - begin)
def again(name):
    # The clock of a browser has steps of 0.1 ms, and other programs take turns of some milliseconds.
    shortest, end = float("inf"), time.perf_counter() + 0.3
    while time.perf_counter() < end:
        count, begin = 0, time.perf_counter()
        while not count or time.perf_counter() < begin + 0.002:
            cases[name]()
            count += 1
        shortest = min(shortest, (time.perf_counter() - begin) / count)
    return 1000 * shortest
"""
LOAD = """async (code) => {
  const { loadPyodide } = await import(location.origin + "/pyodide/pyodide.mjs")
  const indexURL = location.origin + "/pyodide/"
  window.python = await loadPyodide({ indexURL, packages: ["numpy", "scipy"] })
  const sources = await (await fetch("/explorer.zip")).arrayBuffer()
  python.unpackArchive(sources, "zip", { extractDir: "/explorer" })
  python.runPython("import sys; sys.path.insert(0, '/explorer')")
  python.runPython(code)
}"""
STARTED = "!document.getElementById('start') && window.explorer?.idle()"


class Files(SimpleHTTPRequestHandler):
    def log_message(self, *arguments):
        pass


def computations(page):
    """Rows of computations: here and in the browser in turns, each name first once and then again."""
    names = {}
    exec(CODE, names)
    page.evaluate(LOAD, CODE)
    for name in names["cases"]:
        asked = partial(page.evaluate, "(call) => python.runPython(call)")
        first = names["once"](name), asked(f"once({name!r})")
        pairs = [(names["again"](name), asked(f"again({name!r})")) for _ in range(ROUNDS)]
        # The shortest, because other programs take time of the longer ones.
        yield name, first, [min(side) for side in zip(*pairs, strict=True)]


def presses(pages):
    """Milliseconds from a press of a key to all plots painted, of each page in turns."""
    for page in pages:
        page.evaluate(HOOK, FIGURES)
        page.locator('input[type="range"][aria-label^="d_max,"]').focus()
    found = [[] for _ in pages]
    for _ in range(PRESSES):
        for page, times in zip(pages, found, strict=True):
            page.bring_to_front()
            page.keyboard.press("ArrowRight")
            page.wait_for_function("bench.done()", polling=100)
            times.append(page.evaluate("bench.last() - bench.pressed"))
    return [min(times) for times in found]


def processor_seconds():
    """Processor time of all processes that this one has started, and of theirs."""
    parents = {}
    for path in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):
            parents[int(path.parent.name)] = int(path.read_text().rpartition(")")[2].split()[1])
    own = {os.getpid()}
    for _ in range(9):
        own |= {pid for pid, parent in parents.items() if parent in own}
    found = 0.0
    for pid in own - {os.getpid()}:
        with suppress(OSError):
            found += cpu_seconds(pid)
    return found


def start(page, url):
    """Seconds to the first picture and to the live page, of a processor, and megabytes that were loaded."""
    begin, used = time.perf_counter(), processor_seconds()
    page.goto(url, wait_until="commit")
    page.frame_locator("#start iframe").locator("canvas").first.wait_for()
    picture = time.perf_counter() - begin
    page.wait_for_function(STARTED, polling=50)
    live = time.perf_counter() - begin
    size = "performance.getEntriesByType('resource').reduce((sum, each) => sum + each.transferSize, 0)"
    return picture, live, processor_seconds() - used, page.evaluate(size) / 1e6


def main():
    from playwright.sync_api import sync_playwright

    with TemporaryDirectory() as place, sync_playwright() as playwright:
        folder = Path(place) / "explorer"
        static.write(folder, os.environ["MDR_PYODIDE"])
        host = ThreadingHTTPServer(("127.0.0.1", 0), partial(Files, directory=folder))
        threading.Thread(target=host.serve_forever, daemon=True).start()
        url = f"http://127.0.0.1:{host.server_port}/"
        server = Server()
        try:
            browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
            context = browser.new_context(viewport={"width": 1280, "height": 720})
            context.set_default_timeout(300_000)
            context.add_init_script(SCRIPT)
            one, other = context.new_page(), context.new_page()
            starts = [start(one, url), start(one, url)]
            other.goto(server.url)
            other.wait_for_function("explorer.idle()")
            served, static_page = presses([other, one])
            other.goto(url + "LICENSES.txt")
            write(starts, list(computations(other)), served, static_page)
            browser.close()
        finally:
            server.stop()
            host.shutdown()


def write(starts, rows, served, static_page):
    """The section, in the place of the last one."""
    (picture, live, used, size), (_, second, again, _) = starts
    lines = [
        "## The explorer without a server",
        "",
        f"Made by `python -m tests.benchmarks.in_browser` on {datetime.now(UTC).date()}, with Pyodide",
        f"{static.PYODIDE} in Chromium and all files on this machine. Both sides take turns. These are",
        "the shortest times, because other programs also ran. The first picture appears after",
        f"{picture:.1f} s, the live page after {live:.0f} s, the second time after {second:.0f} s. The",
        f"processor works {used:.0f} s and {again:.0f} s. {size:.0f} MB are loaded.",
        "",
        "| what | here | in the browser | ratio | the first time |",
        "|---|---|---|---|---|",
    ]
    for name, firsts, sides in rows:
        here, there, first, first_there = (f"{each:.2g} ms" for each in (*sides, *firsts))
        lines.append(f"| {name} | {here} | {there} | {sides[1] / sides[0]:.1f} | {first}, {first_there} |")
    here, there, ratio = f"{served:.0f} ms", f"{static_page:.0f} ms", f"{static_page / served:.1f}"
    lines += [
        f"| key press to all plots painted, from a server | {here} | {there} | {ratio} | |",
        "",
        "The first time, a case imports modules and makes tables of its shape. A browser also compiles",
        "each function of NumPy at its first call, and better after many calls.",
        "",
    ]
    text = "\n".join(lines)
    print(text)
    write_section(IN_BROWSER, text)


if __name__ == "__main__":
    main()
