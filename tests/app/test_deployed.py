"""The documented line for serving others, in two processes, behind a proxy on loopback."""

import asyncio
import re
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from http.client import HTTPConnection
from urllib.error import HTTPError
from urllib.request import urlopen

import pytest

from ..benchmarks.page_sessions import Client
from .conftest import Server
from .deployed import PERSON, Proxy, deployed


@pytest.fixture(scope="module")
def site():
    """Server and proxy; each needs to know the other's port."""
    proxy = Proxy()
    told = "--num-procs", "2", "--log-level", "info", "--log-format", "%(process)d %(message)s"
    server = Server(*deployed(f"127.0.0.1:{proxy.port}"), *told)
    proxy.target = server.port
    yield server, proxy
    proxy.stop()
    server.stop()
    assert server.faults == ""


async def work(url):
    """Open the page, move a slider, leave."""
    client = await Client().open(url)
    seconds = await client.move(1)
    client.socket.close()
    return seconds


def test_every_process_serves_sessions(site):
    """Also those whose page another process has sent."""
    server, proxy = site
    # In a thread of its own: a browser's driver may have left a loop running in this one.
    with ThreadPoolExecutor(1) as thread:
        for _ in range(30):
            thread.submit(asyncio.run, work(f"http://127.0.0.1:{proxy.port}/app")).result()
            serving = set(re.findall(r"(\d+) ServerConnection created", server.log))
            if len(serving) == 2:
                break
    assert len(serving) == 2


def test_the_proxy_is_believed_about_persons(site):
    """What is worth a line in the log has the person's address, not the proxy's."""
    server, proxy = site
    with pytest.raises(HTTPError, match="404"):
        urlopen(f"http://127.0.0.1:{proxy.port}/nothing")
    # The line is written after the answer.
    for _ in range(100):
        if "404 GET /nothing" in server.log:
            break
        time.sleep(0.1)
    assert f"404 GET /nothing ({PERSON})" in server.log


def test_other_origins_are_refused(site):
    upgrade = {
        "Connection": "Upgrade",
        "Upgrade": "websocket",
        "Sec-WebSocket-Version": "13",
        "Sec-WebSocket-Key": "AAAAAAAAAAAAAAAAAAAAAA==",
        "Origin": "https://elsewhere.example.org",
    }
    with closing(HTTPConnection("127.0.0.1", site[1].port, timeout=20)) as connection:
        connection.request("GET", "/app/ws", headers=upgrade)
        assert connection.getresponse().status == 403
