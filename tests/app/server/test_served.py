"""The page as it is served to others: a restart, embedding, markup of others, and messages."""

import asyncio
import json
import re
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace
from urllib.request import urlopen

import panel as pn
from bokeh.document import Document
from bokeh.protocol import Protocol
from bokeh.server.connection import ServerConnection
from bokeh.server.session import ServerSession
from panel.io.document import dispatch_tornado, init_doc
from panel.io.server import WSHandler
from panel.io.state import set_curdoc
from tornado.locks import Lock

from app.explorer.state import preset_state
from app.explorer.widgets import Parts
from app.security import websocket

from ..conftest import ROOT, Explorer, Server, deployed, free_port
from ..states import assert_draws, now


def test_page_comes_back_with_what_it_showed(context):
    """Once its server has died; a fault before that is told and logged once."""
    port = free_port()
    # The solver fails at 13 nm.
    options = *deployed(port), "--setup", "tests/app/fault.py"
    server, page = Server(*options, port=port), context.new_page()
    try:
        explorer = Explorer(page, f"http://127.0.0.1:{port}/app")
        kept = now(explorer)
        explorer.type("d_max", "13 nm")
        explorer.number("d_max").locator("p.said:visible").wait_for()
        assert now(explorer) == kept
        assert server.log.count("ArithmeticError: made to fail") == 1
        assert "max_depth=1.3e-08" in re.search("could not be shown, (.*)", server.log)[1]
        explorer.change(explorer.type, "d_max", "12 nm")
        explorer.link("max_depth=1.2e-08")
        page.evaluate("window.left = true")
        server.stop(kill=True)
        page.locator(".notyf__disconnect").first.wait_for()
        server = Server(*options, port=port)
        # It loads itself again, once the server answers.
        page.wait_for_function("!window.left && window.explorer?.idle()", timeout=60_000)
        assert_draws(explorer, preset_state().replace(max_depth=12e-9))
    finally:
        page.close()
        server.stop()


def test_the_page_is_embedded_as_documented(server, context):
    """In a frame of a page from elsewhere it connects to its server and draws."""
    text = (ROOT / "assets/docs/how_do_i.md").read_text(encoding="utf-8")
    (frame,) = re.findall(r"<iframe.*?</iframe>", text, re.DOTALL)
    page = context.new_page()
    page.set_content(frame.replace("https://explorer.example.org/app", server.url))
    page.frame_locator("iframe").locator("canvas").first.wait_for()
    page.close()


def test_an_answer_does_not_wait_until_another_message_is_written():
    """Panel would put it off, and could forget it: both messages are on their way, whole and in order."""
    sent = []

    def write_message(part, binary=False):
        sent.append(json.loads(part))
        # The browser takes nothing yet.
        return asyncio.get_running_loop().create_future()

    async def answer():
        document, parts = Document(), Parts()
        document.add_root(parts.get_root(document))
        session = ServerSession("session", document)
        context = SimpleNamespace(id="session", session=session)
        document._session_context = lambda: context
        kind = websocket(WSHandler, dispatch_tornado)
        handler = kind.__new__(kind)
        handler.write_lock = Lock()
        handler.ws_connection = SimpleNamespace(is_closing=lambda: False, write_message=write_message)
        handler.connection = ServerConnection(Protocol(), handler, None, session)
        with set_curdoc(document):
            init_doc(document)
            pn.state._on_load(document)
            waiting = asyncio.ensure_future(handler.send_message(Protocol().create("OK", "earlier")))
            await asyncio.sleep(0)
            parts._on_message(SimpleNamespace(data=("none", 0)))
        waiting.cancel()

    # In a thread: where a browser is tested the main one has a loop already.
    with ThreadPoolExecutor() as pool:
        pool.submit(asyncio.run, answer()).result()
    assert [part["msgtype"] for part in sent[::3]] == ["OK", "PATCH-DOC"]
    assert [change["new"] for change in sent[5]["events"]] == ["[1, []]"]


def test_the_page_for_measurements_adds_no_byte_to_the_explorer_in_the_same_process(browser):
    """What the explorer's page loads is the same before and after somebody has opened this page."""
    server = Server()
    try:

        def loaded():
            text = urlopen(server.url).read().decode()
            # Tokens and ids differ from session to session.
            text = re.sub(r'"token":"[^"]*"|"roots?[^}]*}|[0-9a-f]{8}-[0-9a-f-]{27}|p\d{4,}', "", text)
            return text, re.findall(r'(?:src|href)="([^"]+)"', text)

        before = loaded()
        assert "filepond" in urlopen(f"{server.url}?fit").read().decode().lower()
        after = loaded()
        assert after[1] == before[1]
        assert len(after[0]) == len(before[0])
        assert not any("filepond" in each.lower() or "tabulator" in each.lower() for each in after[1])
    finally:
        server.stop()
    assert server.faults == ""
