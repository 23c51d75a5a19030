"""Sessions belong to those who opened them: a client of the raw protocol tries to enter another one."""

import asyncio
import base64
import json
import re
from concurrent.futures import ThreadPoolExecutor

import pytest
from bokeh.util.token import get_session_id
from tornado.httpclient import HTTPRequest
from tornado.websocket import websocket_connect

from ...benchmarks.page_sessions import ended
from ..conftest import get


@pytest.fixture(params=["panel serve app", "mdr-explorer"])
def served(request):
    return request.getfixturevalue("server" if request.param == "panel serve app" else "command")


#: The name of a session that somebody else has chosen.
CHOSEN = "fix123"


def token_of(server, query="", headers=None):
    """The token in a page."""
    status, _, body = get(server, f"/app?{query}", headers)
    assert status == 200
    (token,) = re.findall(r'"token":"([^"]+)"', body.decode())
    return token


def written(session):
    """A token that a sender writes himself, without a key."""
    payload = {"session_id": session, "session_expiry": 9_000_000_000_000}
    return base64.urlsafe_b64encode(json.dumps(payload).encode()).decode().rstrip("=")


def test_no_link_leads_into_a_session_of_its_sender_or_one_that_is_there(served):
    """Also not by a token that this server has signed."""
    token = token_of(served)
    names = {get_session_id(token)}
    asked = [
        (f"bokeh-session-id={CHOSEN}", None), (f"bokeh-token={written(CHOSEN)}", None),
        ("", {"Bokeh-Session-Id": CHOSEN}), (f"fit&bokeh-session-id={CHOSEN}", None),
        (f"bokeh-session-id={CHOSEN}&bokeh-token={written(CHOSEN)}", {"Bokeh-Session-Id": CHOSEN}),
        (f"bokeh-token={token}", None), (f"bokeh-session-id={get_session_id(token)}", None),
    ]  # fmt: skip
    for query, headers in asked:
        name = get_session_id(token_of(served, query, headers))
        assert CHOSEN not in name
        assert name not in names
        names.add(name)


def test_a_token_of_somebody_else_opens_no_websocket(served):
    def opened(token):
        # As a plain request: the library's client leaves its socket open where it is refused.
        headers = {
            "Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13",
            "Sec-WebSocket-Key": base64.b64encode(bytes(16)).decode(),
            "Sec-WebSocket-Protocol": f"bokeh, {token}",
        }  # fmt: skip
        return get(served, "/app/ws", headers)[0]

    for token in (written(CHOSEN), written(CHOSEN) + ".c2lnbmVk", "", "x", "." * 9000):
        assert opened(token) == 403, token
    assert opened(token_of(served)) == 101


def in_a_loop(scenario):
    # In a thread of its own: a browser's driver may have left a loop running in this one.
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(asyncio.run, scenario).result()


async def socket(server, token):
    """A websocket with a token."""
    request = HTTPRequest(f"ws://127.0.0.1:{server.port}/app/ws")
    return await websocket_connect(request, subprotocols=["bokeh", token])


async def acknowledged(socket):
    """The first message, by which the server says that the session is there, or None if it has closed."""
    head = await asyncio.wait_for(socket.read_message(), 60)
    if head is None:
        return None
    for _ in range(2):
        await asyncio.wait_for(socket.read_message(), 60)
    return json.loads(head)["msgtype"]


def test_of_two_websockets_with_one_token_the_newer_one_is_served(served):
    """As after a connection that was lost comes back; who has copied a token is seen."""

    async def scenario():
        token = token_of(served)
        first = await socket(served, token)
        assert await acknowledged(first) == "ACK"
        second = await socket(served, token)
        assert await acknowledged(second) == "ACK"
        await ended(first)
        assert first.close_code == 1008
        first.close()
        second.close()
        await ended(second)

    in_a_loop(scenario())


def test_a_script_that_embeds_gets_no_session(served):
    for more in ("", f"&bokeh-session-id={CHOSEN}"):
        assert get(served, f"/app/autoload.js?bokeh-autoload-element=1{more}")[0] == 404
