"""The documented command for serving others, in two processes."""

import asyncio
import re
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from http.client import HTTPConnection

import pytest

from ...benchmarks.page_sessions import Client
from ..conftest import Server, deployed, free_port


@pytest.fixture(scope="module")
def server():
    port = free_port()
    told = "--num-procs", "2", "--log-level", "info", "--log-format", "%(process)d %(message)s"
    server = Server(*deployed(port), *told, port=port)
    yield server
    server.stop()
    assert server.faults == ""


async def work(url):
    """Open the page, move a slider, leave."""
    client = await Client().open(url)
    await client.move(1)
    await client.leave()


def test_every_process_serves_sessions(server):
    """Also those whose page another process has sent."""
    # In a thread of its own: a browser's driver may have left a loop running in this one.
    with ThreadPoolExecutor(1) as thread:
        for _ in range(30):
            thread.submit(asyncio.run, work(f"http://127.0.0.1:{server.port}/app")).result()
            serving = set(re.findall(r"(\d+) ServerConnection created", server.log))
            if len(serving) == 2:
                break
    assert len(serving) == 2


def status(server, path, headers):
    with closing(HTTPConnection("127.0.0.1", server.port, timeout=20)) as connection:
        connection.request("GET", path, headers=headers)
        return connection.getresponse().status


def test_every_process_has_the_theory(server):
    """It is written before they part; each connection may be another's."""
    assert {status(server, "/app/theory.html", {}) for _ in range(20)} == {200}


def test_the_log_has_the_address_of_the_person_and_not_of_the_proxy(server):
    # As a proxy that ends TLS passes it on.
    assert status(server, "/nothing", {"X-Real-IP": "203.0.113.7", "X-Scheme": "https"}) == 404
    # The line is written after the answer.
    for _ in range(100):
        if "404 GET /nothing" in server.log:
            break
        time.sleep(0.1)
    assert "404 GET /nothing (203.0.113.7)" in server.log


def test_other_origins_are_refused(server):
    upgrade = {
        "Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13",
        "Sec-WebSocket-Key": "AAAAAAAAAAAAAAAAAAAAAA==", "Origin": "https://elsewhere.example.org",
    }  # fmt: skip
    assert status(server, "/app/ws", upgrade) == 403
