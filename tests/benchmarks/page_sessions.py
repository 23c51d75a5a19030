"""Waiting times and memory of many users of the served page at the same time.

    python -m tests.benchmarks.page_sessions

Run it from the project root. It opens the page for a class at once, moves sliders in more and more
sessions, and counts what closed sessions leave behind.
"""

import asyncio
import json
import os
import re
import statistics
import time
from functools import partial
from pathlib import Path
from urllib.request import urlopen

from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.websocket import websocket_connect

from tests.app.conftest import Server

#: Seconds to wait for a page: the first one of a process builds all its plots.
PATIENCE = 180.0
#: Numbers of sessions, moves of each per second, and the duration (s).
SESSIONS, RATE, SECONDS = (8, 16, 24, 32, 40, 48), 2.0, 10.0
#: Largest 95th percentile (ms) of the waiting times with which more sessions are tried.
ENOUGH = 200.0
#: Sessions opened and closed before memory is measured.
OPENED = (15, 100)
#: Users who open the page at the same time, and figures of a whole page.
CLASS, FIGURES = 60, 3


def objects(part):
    """Yield every object in a received document."""
    if isinstance(part, dict):
        yield part
        part = list(part.values())
    for each in part if isinstance(part, list) else ():
        yield from objects(each)


def dig(part, *keys):
    """Return the value in nested objects under some keys, or None."""
    for key in keys:
        part = part.get(key) if isinstance(part, dict) else None
    return part


async def ended(socket):
    """Wait until the server has closed a websocket: before that its loop must not end."""
    while await asyncio.wait_for(socket.read_message(), 60) is not None:
        pass


class Client:
    """The browser of a user, for the server."""

    async def open(self, url):
        """Load the page, connect, and wait until all its figures are in the document."""
        patience = {"connect_timeout": PATIENCE, "request_timeout": PATIENCE}
        page = await AsyncHTTPClient().fetch(url, **patience)
        token = re.search(r'"token":"([^"]+)"', page.body.decode())[1]
        address = url.partition("?")[0].replace("http", "ws", 1) + "/ws"
        # A proxy may have set a cookie.
        cookie = page.headers.get("Set-Cookie", "")
        headers = {"Sec-WebSocket-Protocol": f"bokeh, {token}", "Cookie": cookie}
        request = HTTPRequest(address, headers=headers, **patience)
        self.socket = await websocket_connect(request, max_message_size=10**8)
        # Browsers send each part of a message at once.
        self.socket.protocol.stream.set_nodelay(True)
        await self._message()
        # The session may be in another process than the one that sent the page; its models count.
        await self._send("PULL-DOC-REQ", "pull", {})
        kind = None
        while kind != "PULL-DOC-REPLY":
            kind, content = await self._message()
        self._find_control(json.loads(content))
        # Browsers send this. Before it Panel holds back changes by callbacks.
        await self._event("ready", "document_ready", [])
        count = figures(content)
        while count < FIGURES:
            _, content = await self._message()
            count += figures(content)
        self.count = 0
        return self

    def _find_control(self, document):
        """Remember the control of the largest depth."""
        for each in objects(document):
            shown = json.loads(dig(each, "attributes", "data", "attributes", "payload") or "[0, []]")
            for known in shown[1]:
                if known.get("spoken") == "d_max, largest depth":
                    self.form, self.control = each["id"], known["name"]

    async def leave(self):
        """Close the connection."""
        self.socket.close()
        await ended(self.socket)

    async def _send(self, kind, name, content):
        for part in ({"msgid": f"{id(self)}-{name}", "msgtype": kind}, {}, content):
            await self.socket.write_message(json.dumps(part))

    async def _event(self, name, kind, values):
        event = {"type": "event", "name": kind, "values": {"type": "map", "entries": values}}
        patch = {"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": event}
        await self._send("PATCH-DOC", name, {"events": [patch]})

    async def _message(self):
        """Return type and content of the next message, and skip its buffers."""
        header = json.loads(await self.socket.read_message())
        await self.socket.read_message()
        content = await self.socket.read_message()
        for _ in range(2 * header.get("num_buffers", 0)):
            await self.socket.read_message()
        return header["msgtype"], content

    async def move(self, n):
        """Move a slider, and return the seconds until the server has answered with a new picture."""
        self.count += 1
        data = {"text": f"{5 + 0.1 * (n % 100):.3g}e-9", "dragged": True}
        message = {"type": "map", "entries": [list(item) for item in data.items()]}
        begin = time.perf_counter()
        values = [["model", {"id": self.form}], ["data", [self.control, message]]]
        await self._event(n, "data_event", values)
        while True:
            _, content = await self._message()
            if f'"[{self.count},[' in content.replace(" ", ""):
                return time.perf_counter() - begin

    async def work(self, offset):
        """Move at an even rate, and return the seconds of each answer."""
        await asyncio.sleep(offset)
        times, begin = [], time.perf_counter()
        for n in range(1, int(RATE * SECONDS) + 1):
            times.append(await self.move(n))
            await asyncio.sleep(max(begin + n / RATE - time.perf_counter(), 0))
        return times


def figures(content):
    """Return the number of figures in a received document or change."""
    return content.replace(" ", "").count('"name":"Figure"')


def resident(pid):
    """Return the resident memory of a process (MB)."""
    return int(re.search(r"VmRSS:\s+(\d+)", Path(f"/proc/{pid}/status").read_text())[1]) / 1024


def spent(pid):
    """Return processor time of a process, and waiting times of its threads for a core (ms)."""
    threads = Path(f"/proc/{pid}/task").glob("*/schedstat")
    times = [path.read_text().split()[:2] for path in threads]
    return [sum(map(int, each)) / 1e6 for each in zip(*times, strict=True)]


async def come_and_go(url, count):
    """Open, use and close sessions."""
    for _ in range(count):
        client = await Client().open(url)
        await client.move(1)
        client.socket.close()


async def at_the_same_time(url):
    """Return the seconds until the last user of a class has the page."""
    begin = time.perf_counter()
    clients = await asyncio.gather(*(Client().open(url) for _ in range(CLASS)))
    taken = time.perf_counter() - begin
    for client in clients:
        client.socket.close()
    return taken


async def many(url, pid, count):
    """Move sliders in so many sessions, and return the 95th percentile of the waiting times (ms)."""
    before = resident(pid)
    clients = [await Client().open(url) for _ in range(count)]
    begin, _ = spent(pid)
    times = await asyncio.gather(*(c.work(k / RATE / count) for k, c in enumerate(clients)))
    each, used = (resident(pid) - before) / count, spent(pid)[0] - begin
    times = sorted(1000 * t for row in times for t in row)
    p95 = times[int(0.95 * len(times))]
    print(
        f"{count} sessions, {RATE:g} moves/s each: median {statistics.median(times):.0f} ms, "
        f"p95 {p95:.0f} ms to the answer, {used / len(times):.1f} ms of computing a move; "
        f"{each:.2f} MB a session; load of the machine {os.getloadavg()[0]:.1f}",
        flush=True,
    )
    for client in clients:
        client.socket.close()
    return p95


def with_server(use, *options):
    """Start a server whose first page is built, and return the result of its use."""
    server = Server(*options)
    try:
        # Another file of `options` changes the address that the server prints.
        asyncio.run(asyncio.wait_for(come_and_go(f"{server.url.rpartition('/')[0]}/app", 2), 300))
        return use(server, f"{server.url.rpartition('/')[0]}/app", server.process.pid)
    finally:
        server.stop()


def opening(server, url, pid):
    """Print the time for which a class waits, and how much of it is the server's wait for a core."""
    begin = spent(pid)
    last = asyncio.run(asyncio.wait_for(at_the_same_time(url), 1200))
    used, idle = (after - before for after, before in zip(spent(pid), begin, strict=True))
    print(
        f"{CLASS} at once: the last one has the page after {last:.1f} s, of which the server waits "
        f"{idle / 1000:.1f} s for a core; {used / CLASS:.0f} ms of computing each",
        flush=True,
    )


def moves(count, server, url, pid):
    """Return the 95th percentile of the waiting times (ms) in so many sessions."""
    return asyncio.run(asyncio.wait_for(many(url, pid, count), 300))


def left_behind(server, url, pid):
    """Print memory and live Documents after more and more closed sessions."""
    done = 0
    for count in OPENED:
        asyncio.run(asyncio.wait_for(come_and_go(url, count - done), 3000))
        done = count
        time.sleep(3)
        urlopen(f"{url.removesuffix('app')}probe").read()
        time.sleep(1)
        alive = re.findall("live Documents.*", server.log)[-1]
        print(f"{count} sessions opened and closed: {alive}, {resident(pid):.0f} MB resident", flush=True)


def main():
    # All of a class are on their way at the same time.
    AsyncHTTPClient.configure(None, max_clients=CLASS)
    with_server(opening)
    for count in SESSIONS:
        if with_server(partial(moves, count)) > ENOUGH:
            break
    short = ("--unused-session-lifetime", "200", "--check-unused-sessions", "200")
    with_server(left_behind, "tests/benchmarks/probe.py", *short)


if __name__ == "__main__":
    main()
