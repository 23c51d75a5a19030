"""The page in a browser by Pyodide, without a server: no threads, no processes, one document.

Only this module uses private names of Pyodide.
"""

import asyncio
from collections.abc import Callable, Coroutine
from functools import partial
from typing import Any

import js
import panel as pn
import pyodide.ffi
from panel.io import pyodide as browser
from tqdm import tqdm

from ..common.host import Sliced, Steps
from ..common.ui import SHEETS
from .page import Address, Page

# JavaScript's null in Python since Pyodide 0.28: Panel compares each value from the browser with it. In
# earlier versions null is None, so no value equals this object.
if not hasattr(pyodide.ffi, "jsnull"):
    pyodide.ffi.jsnull = object()
# tqdm would start a thread to watch its bars.
tqdm.monitor_interval = 0


class Browser(Sliced):
    """Host for one page in its browser, which draws and answers clicks between slices of a search."""

    def __init__(self) -> None:
        self._shows = False
        self._waiting: list[Callable[[], None]] = []

    def shows(self) -> bool:
        return self._shows

    def on_load(self, act: Callable[[], None]) -> None:
        if self._shows:
            act()
        else:
            self._waiting.append(act)

    def shown(self) -> None:
        """Run the waiting functions: the browser shows the page now."""
        self._shows = True
        for act in self._waiting:
            act()

    def call_later(self, act: Callable[[], None], milliseconds: int) -> Callable[[], None]:
        return asyncio.get_running_loop().call_later(milliseconds / 1000, act).cancel

    def next_tick(self, act: Callable[[], None]) -> None:
        self.call_later(act, 0)

    def run(self, act: Callable[[], Coroutine[Any, Any, None]]) -> None:
        pn.state.execute(act)

    def search(self, steps: Steps, wanted: Callable[[], bool], done: Callable[[Any], None]) -> None:
        # After the click that starts the search.
        self.next_tick(lambda: self.make(steps, wanted, done))


async def start(query: str, dark: bool) -> None:
    """Show the page of a query in this browser, with the theme of the last visit."""
    browser.init_doc()
    document = pn.state.curdoc
    pn.extension(notifications=True, css_files=SHEETS)
    host = Browser()
    page = Page(query, dark, host)
    pn.panel(page).server_doc(document, "Indentation explorer", Address())
    # Panel finds the places of the roots by the order of this attribute.
    for k in range(len(document.roots)):
        place = js.document.createElement("div")
        place.id, place.style.display = f"root-{k}", "contents"
        place.setAttribute("data-root-id", f"{k:03}")
        js.document.body.append(place)
    # Answer a message after the script that sends it has ended, as a server does.
    answer = document.apply_json_patch
    document.apply_json_patch = lambda patch, setter=None: host.next_tick(
        partial(answer, patch, setter=setter)
    )
    await browser.write_doc(document)
    host.shown()
