"""Latency of the served page and of a saved scene: key presses, drags and playback, until all is painted.

Run from the project root: python -m tests.benchmarks.page_latency
"""

import math
import os
import statistics
import time
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from app.explorer.extras.scene_file import scene_file
from app.explorer.page import Page
from tests.app.conftest import CHROMIUM, FLAGS, SCRIPT, Server

PRESSES = 60
CHANGES, WARM = 100, 40
FIGURES = ["springs", "pressure", "force"]
#: Scenes that are dragged, by their links, each with the symbol of its slider.
SCENES = {
    "pressing": ("", "d_max"),
    "dry impact": ("?preset=striker-glass_epoxy-drop-weight", "v_0"),
    "viscous impact": ("?preset=striker-glass_epoxy-drop-weight&damping=eta&eta=524000", "v_0"),
    "oblique": ("?preset=striker-glass_epoxy-drop-weight&drive=oblique&incoming_speed=2", "V_0"),
    "plate without edges": ("?preset=small_ball-carbon_epoxy", "v_0"),
    "plate with edges": ("?preset=ball-carbon_laminate", "v_0"),
    "sweep beside an impact": ("?preset=striker-glass_epoxy-drop-weight&tiles=sweep", "v_0"),
}

# Notes the time of each key press and of every paint of a plot, which begins by clearing its canvas.
HOOK = """(names) => {
  window.bench = { painted: new Map(), pressed: 0, frames: 0, any: false }
  const note = (name) => {
    bench.any = true
    bench.painted.set(name, performance.now())
  }
  document.addEventListener("keydown", () => {
    bench.pressed = performance.now()
    bench.painted.clear()
  }, true)
  const owner = new Map()
  for (const name of names) {
    const all = (root) => [...root.querySelectorAll("*")].flatMap(
      (each) => [each, ...(each.shadowRoot ? all(each.shadowRoot) : [])])
    const { el } = Bokeh.index.find_one(explorer.model(name))
    for (const each of all(el.shadowRoot)) if (each.tagName === "CANVAS") owner.set(each, name)
  }
  const clear = CanvasRenderingContext2D.prototype.clearRect
  CanvasRenderingContext2D.prototype.clearRect = function (...box) {
    clear.apply(this, box)
    const name = owner.get(this.canvas)
    // What is drawn after the canvas was cleared is drawn in the same turn.
    if (name) queueMicrotask(() => note(name))
  }
  const tick = () => {
    if (bench.any) bench.frames += 1
    bench.any = false
    requestAnimationFrame(tick)
  }
  requestAnimationFrame(tick)
  bench.last = () => Math.max(...bench.painted.values())
  bench.done = () => bench.painted.size === names.length && performance.now() - bench.last() > 100
}"""

# A hand on the slider of a saved scene: a browser passes one move on in each frame.
HAND = """(seconds) => new Promise((done) => {
  const slider = document.querySelector(".player input"), begin = performance.now()
  const move = (now) => {
    const time = (now - begin) / 1000
    slider.value = slider.max * (0.5 + 0.4 * Math.sin(4 * time))
    slider.dispatchEvent(new Event("input"))
    if (time < seconds) requestAnimationFrame(move)
    else done()
  }
  requestAnimationFrame(move)
})"""


def cpu_seconds(pid):
    """CPU time of a process, from its /proc entry."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def cold_load(browser, url):
    """A new page with an empty cache; seconds until every plot is painted, and bytes loaded."""
    page = browser.new_context(viewport={"width": 1440, "height": 900}).new_page()
    loaded = []
    page.on("requestfinished", lambda request: loaded.append(request.sizes()["responseBodySize"]))
    page.add_init_script(SCRIPT)
    begin = time.perf_counter()
    page.goto(url, wait_until="commit")
    page.wait_for_function("explorer.idle()", polling=20)
    return page, time.perf_counter() - begin, sum(loaded)


def moves(page, key):
    """Milliseconds from each press of a key to the last plot painted."""
    latencies = []
    for _ in range(PRESSES):
        page.keyboard.press(key)
        page.wait_for_function("bench.done()", polling=100)
        latencies.append(page.evaluate("bench.last() - bench.pressed"))
    return latencies


def frames_per_second(page, act):
    """Frames a second in which something was painted while `act` was under way."""
    page.evaluate("bench.frames = 0")
    begin = time.perf_counter()
    act()
    return page.evaluate("bench.frames") / (time.perf_counter() - begin)


def drag(page, symbol):
    """Drag a slider to and fro for two seconds, a step as soon as the browser has taken the last one."""
    slider = page.locator(f'input[type="range"][aria-label^="{symbol},"]')
    slider.scroll_into_view_if_needed()
    box, before = slider.bounding_box(), slider.input_value()
    y = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + box["width"] / 2, y)
    page.mouse.down()
    begin = time.perf_counter()
    while (seconds := time.perf_counter() - begin) < 2:
        page.mouse.move(box["x"] + box["width"] * (0.5 + 0.15 * math.sin(4 * seconds)), y)
    page.mouse.up()
    assert slider.input_value() != before, "the drag has missed its slider"


def smoothness(browser, url):
    """Print the pictures a second of a drag in each scene, and of playback in the first."""
    for name, (query, symbol) in SCENES.items():
        page, _, _ = cold_load(browser, url + query)
        page.evaluate(HOOK, FIGURES)
        rate = frames_per_second(page, partial(drag, page, symbol))
        print(f"drag, {name}: {rate:.0f} pictures/s", flush=True)
        if not query:
            play = page.locator(".player button")
            begin = time.perf_counter()
            play.click()
            page.wait_for_function("explorer.played()", polling=20)
            print(f"frames for playing: {time.perf_counter() - begin:.2f} s")
            rate = frames_per_second(page, partial(page.wait_for_timeout, 3000))
            play.click()
            print(f"playback: {rate:.0f} pictures/s")
        page.context.close()


def saved_scenes(browser):
    """Print the size of the file of each scene, and the pictures a second of its slider and playback."""
    for name, (query, _) in list(SCENES.items())[:4]:
        with TemporaryDirectory() as folder:
            path = Path(folder) / "scene.html"
            path.write_text(scene_file(Page(query.removeprefix("?")).view), encoding="utf-8")
            page = browser.new_page(viewport={"width": 1280, "height": 720})
            page.add_init_script(SCRIPT)
            page.goto(path.as_uri())
            page.wait_for_function("document.querySelector('#player input')")
            page.evaluate(HOOK, FIGURES)
            dragged = frames_per_second(page, partial(page.evaluate, HAND, 3))
            page.locator(".player button").click()
            played = frames_per_second(page, partial(page.wait_for_timeout, 3000))
            size = path.stat().st_size / 1e6
            print(f"{name}, as a file of {size:.2f} MB: {dragged:.0f} and {played:.0f} pictures/s")
            page.close()


def left_in_the_tab(browser, url):
    """Print how many elements the page has before and after many changes of drive."""
    page, _, _ = cold_load(browser, url)
    count = "explorer.all().length"
    drives = ("force", "path", "impact", "oblique", "depth")
    # Parts of the form reach the browser when they are first shown.
    for k in range(WARM + CHANGES):
        if k == WARM:
            before = page.evaluate(count)
        page.get_by_label(drives[k % len(drives)], exact=True).first.check()
        page.wait_for_function("Bokeh.documents[0].is_idle", polling=50)
    print(f"after {CHANGES} changes of drive: elements {before} → {page.evaluate(count)}")
    page.context.close()


def main():
    from playwright.sync_api import sync_playwright

    server = Server()
    time.sleep(5)
    try:
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
            for visitor in ("first visitor", "second visitor"):
                page, seconds, size = cold_load(browser, server.url)
                print(f"cold load to last plot, {visitor}: {seconds:.2f} s, {size / 1e6:.2f} MB")
            page.evaluate(HOOK, FIGURES)
            page.locator('input[type="range"][aria-label^="d_max,"]').focus()
            before = cpu_seconds(server.process.pid)
            latencies = sorted(moves(page, "ArrowRight"))
            used = cpu_seconds(server.process.pid) - before
            median, p95 = statistics.median(latencies), latencies[int(0.95 * PRESSES)]
            print(
                f"key press to all {len(FIGURES)} plots painted: median {median:.0f} ms, p95 {p95:.0f} ms"
            )
            print(f"server CPU: {1000 * used / PRESSES:.1f} ms a move")
            smoothness(browser, server.url)
            left_in_the_tab(browser, server.url)
            saved_scenes(browser)
            browser.close()
    finally:
        server.stop()


if __name__ == "__main__":
    main()
