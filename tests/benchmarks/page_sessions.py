"""Many people at the served page at once: opening, drags, server time of a move, memory, what stays behind.

Opening is page, websocket and document, beside a plain page of Panel's that is served by the same process.
A move is also timed while somebody else fits on the page for measurements. A soak has many people who move,
sweep and upload files for minutes.

Run from the project root: python -m tests.benchmarks.page_sessions, or with "soak" for that alone
"""

import asyncio
import json
import os
import re
import statistics
import sys
import tempfile
import time
from pathlib import Path
from urllib.request import urlopen

from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.websocket import websocket_connect

import mdr_core as mdr
from tests.app.conftest import Server

#: Seconds to wait for a page: the first one of a process builds all its plots.
PATIENCE = 180.0
#: People at once, moves of each a second, for so long (s); the p95 (ms) beyond which no more are tried.
SESSIONS, RATE, SECONDS, ENOUGH = (8, 16, 24, 32, 40, 48), 2.0, 10.0, 200.0
#: Most moves a second of a drag, and how long it lasts and then rests (s), again and again.
DRAG, STROKE, REST = 25.0, 2.0, 0.6
#: Sessions opened and closed before memory is looked at.
OPENED = (15, 100)
#: How long a session without its page is kept, as the explorer's page says.
LIFETIME = ("--check-unused-sessions", "15000", "--unused-session-lifetime", "600000")
#: Openings of each page one after the other, people who open the page at once, and figures of a whole page.
ALONE, CLASS, FIGURES = 10, 60, 3
#: People of a soak: who move, who move beside a sweep, who upload; how long, and how often each acts (s).
MOVERS, SWEEPERS, UPLOADERS, SOAK, PAUSE, PAUSE_OF_FILES = 50, 30, 20, 300.0, 4.0, 20.0


def objects(part):
    """Every object within a document as it was sent."""
    if isinstance(part, dict):
        yield part
        part = list(part.values())
    for each in part if isinstance(part, list) else ():
        yield from objects(each)


def dig(part, *keys):
    """What lies in nested objects under some keys, None if it is not there."""
    for key in keys:
        part = part.get(key) if isinstance(part, dict) else None
    return part


async def ended(socket):
    """Wait until a websocket is closed, by an answer of the server: before that its loop must not end."""
    while await asyncio.wait_for(socket.read_message(), 60) is not None:
        pass


class Visitor:
    """A person's browser as far as the server sees it, until the page is there."""

    #: Figures of the page.
    figures = FIGURES

    async def open(self, url):
        """Load the page, connect, and wait until all its figures are in the document."""
        patience = {"connect_timeout": PATIENCE, "request_timeout": PATIENCE}
        page = await AsyncHTTPClient().fetch(url, **patience)
        token = re.search(r'"token":"([^"]+)"', page.body.decode())[1]
        address = url.partition("?")[0].replace("http", "ws", 1) + "/ws"
        # The cookie is that of a proxy, which may have set one.
        told = {"Sec-WebSocket-Protocol": f"bokeh, {token}", "Cookie": page.headers.get("Set-Cookie", "")}
        request = HTTPRequest(address, headers=told, **patience)
        self.socket = await websocket_connect(request, max_message_size=10**8)
        # As browsers do: each part of a message at once.
        self.socket.protocol.stream.set_nodelay(True)
        await self._message()
        # Another process than the one that sent the page may hold the session: its models are what counts.
        await self._send("PULL-DOC-REQ", "pull", {})
        kind = None
        while kind != "PULL-DOC-REPLY":
            kind, content = await self._message()
        self.document = json.loads(content)
        # As a browser does: before this Panel holds back what a callback changes.
        event = {"type": "event", "name": "document_ready", "values": {"type": "map", "entries": []}}
        await self._event("ready", event)
        count = figures(content)
        while count < self.figures:
            _, content = await self._message()
            count += figures(content)
        return self

    async def leave(self):
        """Close the connection."""
        self.socket.close()
        await ended(self.socket)

    async def _send(self, kind, name, content, buffers=()):
        header = {"msgid": f"{id(self)}-{name}", "msgtype": kind}
        if buffers:
            header["num_buffers"] = len(buffers)
        for part in (header, {}, content):
            await self.socket.write_message(json.dumps(part))
        for k, buffer in enumerate(buffers):
            await self.socket.write_message(json.dumps({"id": f"{k}"}))
            await self.socket.write_message(buffer, binary=True)

    async def _event(self, name, event, buffers=()):
        patch = {"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": event}
        await self._send("PATCH-DOC", name, {"events": [patch]}, buffers)

    async def _message(self):
        """The next message: its type and content, with the buffers that belong to it."""
        header = json.loads(await self.socket.read_message())
        await self.socket.read_message()
        content = await self.socket.read_message()
        for _ in range(2 * header.get("num_buffers", 0)):
            await self.socket.read_message()
        return header["msgtype"], content


class Client(Visitor):
    """A person at work."""

    async def open(self, url):
        """Load the page and connect."""
        await super().open(url)
        # The control of the largest depth, by what it is called.
        for each in objects(self.document):
            shown = json.loads(dig(each, "attributes", "data", "attributes", "payload") or "[0, []]")
            for known in shown[1]:
                if known.get("spoken") == "d_max, largest depth":
                    self.form, self.control = each["id"], known["name"]
                if known["kind"] == "player":
                    self.player = each["id"]
        self.count = 0
        return self

    async def _tell(self, name, component, part, message):
        """What a person does with a part of a component."""
        values = [["model", {"id": component}], ["data", [part, message]]]
        event = {"type": "event", "name": "data_event", "values": {"type": "map", "entries": values}}
        await self._event(name, event)

    async def play(self):
        """Let the player move."""
        await self._tell("play", self.player, "player", None)

    async def sweep(self):
        """Show the plot *Sweep* beside the three."""
        await self._tell("sweep", self.player, "fourth plot", "sweep")

    async def move(self, n):
        """Move a slider; seconds until the server has answered with a new picture."""
        self.count += 1
        data = {"text": f"{5 + 0.1 * (n % 100):.3g}e-9", "dragged": True}
        message = {"type": "map", "entries": [list(item) for item in data.items()]}
        begin = time.perf_counter()
        await self._tell(n, self.form, self.control, message)
        while True:
            _, content = await self._message()
            if f'"[{self.count},[' in content.replace(" ", ""):
                return time.perf_counter() - begin

    async def work(self, offset):
        """Move at an even rate; the seconds that each answer took."""
        await asyncio.sleep(offset)
        times, begin = [], time.perf_counter()
        for n in range(1, int(RATE * SECONDS) + 1):
            times.append(await self.move(n))
            await asyncio.sleep(max(begin + n / RATE - time.perf_counter(), 0))
        return times

    async def drag(self):
        """Drag a slider, one value under way at a time, with rests; the seconds that each answer took."""
        times, begin = [], time.perf_counter()
        while time.perf_counter() < begin + SECONDS:
            stroke = time.perf_counter()
            while time.perf_counter() < stroke + STROKE:
                times.append(await self.move(len(times) + 1))
                await asyncio.sleep(max(1 / DRAG - times[-1], 0))
            await asyncio.sleep(REST)
        return times


class Fitter(Visitor):
    """A person who fits the sample again and again."""

    figures = 2

    async def open(self, url):
        """Load the page for measurements, and find the button of the sample."""
        await super().open(f"{url}?fit")
        labelled = (each for each in objects(self.document) if dig(each, "attributes", "label"))
        sample = "Sample: fused silica"
        self.button = next(each["id"] for each in labelled if each["attributes"]["label"] == sample)
        return self

    async def work(self, done):
        """Click and wait for the number, until `done` is set; how many fits there were."""
        count = 0
        while not done.is_set():
            event = {"type": "event", "name": "button_click"}
            values = {"type": "map", "entries": [["model", {"id": self.button}]]}
            await self._event(f"fit {count}", event | {"values": values})
            content = ""
            while "of the unloading" not in content and "from the unloading" not in content:
                _, content = await self._message()
            count += 1
            # Who changes something looks at the number first.
            await asyncio.sleep(0.5)
        return count


class Uploader(Visitor):
    """A person who drops a curve again and again, and waits for its number."""

    figures = 2

    async def open(self, url):
        """Load the page for measurements with tip and sample, and find the field for the file."""
        await super().open(f"{url}?fit&tip=berkovich&medium=constant")
        fields = (each for each in objects(self.document) if str(each.get("name")).endswith("FileDropper"))
        self.field = next(fields)["id"]
        self.data = mdr.example("silica.csv").read_bytes()
        return self

    async def act(self, n):
        """Upload; seconds until the number is there."""
        begin = time.perf_counter()
        # As the browser sends bytes: beside the message.
        data = {"type": "bytes", "data": {"id": "0"}}
        told = {"name": f"run {n}.csv", "chunk": 1, "total_chunks": 1, "data": data, "type": "text/csv"}
        entries = {"type": "map", "entries": [list(item) for item in told.items()]}
        values = {"type": "map", "entries": [["model", {"id": self.field}], ["data", entries]]}
        event = {"type": "event", "name": "upload_event", "values": values}
        await self._event(f"upload {n}", event, (self.data,))
        content = ""
        while not re.search(r"Effective modulus|No E\* to quote|No fit|cannot be read", content):
            _, content = await self._message()
        return time.perf_counter() - begin


async def again(act, pause, offset):
    """Act once in a while until the soak is over; the seconds that each answer took."""
    await asyncio.sleep(offset)
    times, end = [], time.perf_counter() + SOAK
    while time.perf_counter() < end:
        begin = time.perf_counter()
        times.append(await act(len(times) + 1))
        await asyncio.sleep(max(begin + pause - time.perf_counter(), 0))
    return times


async def at_work(url):
    """All people of a soak at work; seconds of the moves, of those beside a sweep, and of the files."""
    movers = [await Client().open(url) for _ in range(MOVERS)]
    sweepers = [await Client().open(url) for _ in range(SWEEPERS)]
    for each in sweepers:
        await each.sweep()
    uploaders = [await Uploader().open(url) for _ in range(UPLOADERS)]
    works = [
        asyncio.gather(*(again(act, pause, k * pause / len(acts)) for k, act in enumerate(acts)))
        for acts, pause in (
            ([each.move for each in movers], PAUSE),
            ([each.move for each in sweepers], PAUSE),
            ([each.act for each in uploaders], PAUSE_OF_FILES),
        )
    ]
    found = [[t for row in await each for t in row] for each in works]
    for each in (*movers, *sweepers, *uploaders):
        each.socket.close()
    return found


def soak():
    """Many people for minutes: what they wait, and what is left of memory, sessions and files."""
    short = ("--unused-session-lifetime", "2000", "--check-unused-sessions", "1000")
    with tempfile.TemporaryDirectory() as folder:
        server = Server("tests/benchmarks/probe.py", *short, environment={"TMPDIR": folder})
        try:
            url, pid = server.url.rpartition("/")[0], server.process.pid
            asyncio.run(asyncio.wait_for(come_and_go(f"{url}/app", 5), 300))
            time.sleep(5)
            before = resident(pid)
            found = asyncio.run(asyncio.wait_for(at_work(f"{url}/app"), 4 * SOAK + 600))
            for what, times in zip(("moves", "moves beside a sweep", "files"), found, strict=True):
                times = sorted(times)
                p95 = times[int(0.95 * len(times))]
                print(
                    f"{len(times)} {what}: median {statistics.median(times):.2f} s, p95 {p95:.2f} s, "
                    f"worst {times[-1]:.2f} s; load of the machine {os.getloadavg()[0]:.1f}",
                    flush=True,
                )
            during = resident(pid)
            time.sleep(10)
            urlopen(f"{url}/probe").read()
            time.sleep(1)
            alive = re.findall("live Documents.*", server.log)[-1]
            left = sum(len([*each.iterdir()]) - 1 for each in Path(folder).iterdir() if each.is_dir())
            people = MOVERS + SWEEPERS + UPLOADERS
            print(
                f"{people} sessions for {SOAK:.0f} s: {before:.0f} MB resident before, "
                f"{during:.0f} MB with all of them, {resident(pid):.0f} MB after they have gone; {alive}; "
                f"{left} folders of sessions left, {len(server.faults)} characters of faults in the log",
                flush=True,
            )
        finally:
            server.stop()
        print(f"after the server: {len([*Path(folder).iterdir()])} folders left", flush=True)


async def beside_a_fit(url):
    """Moves of a slider alone, and beside a person who fits again and again, in turn; medians (ms)."""
    client, fitter = await Client().open(url), await Fitter().open(url)
    found, fits = {False: [], True: []}, 0
    for _ in range(3):
        for fitting in (False, True):
            done = asyncio.Event()
            others = asyncio.ensure_future(fitter.work(done)) if fitting else None
            await asyncio.sleep(1.0)
            found[fitting] += await client.work(0.0)
            done.set()
            fits += await others if others else 0
    quiet, busy = (1000 * statistics.median(found[each]) for each in (False, True))
    print(
        f"a move beside {fits} fits in {3 * SECONDS:.0f} s: median {busy:.0f} ms, alone {quiet:.0f} ms, "
        f"{busy / quiet:.2f} times; load of the machine {os.getloadavg()[0]:.1f}",
        flush=True,
    )


def fits():
    """What a person at the explorer feels of one who fits."""
    server = Server()
    try:
        asyncio.run(asyncio.wait_for(come_and_go(server.url, 2), 300))
        asyncio.run(asyncio.wait_for(beside_a_fit(server.url), 600))
    finally:
        server.stop()


def figures(content):
    """How many figures there are in a document or a change of it, as they were sent."""
    return content.replace(" ", "").count('"name":"Figure"')


def resident(pid):
    """Resident memory of a process (MB)."""
    return int(re.search(r"VmRSS:\s+(\d+)", Path(f"/proc/{pid}/status").read_text())[1]) / 1024


def spent(pid):
    """Processor time of a process, and how long its threads waited for a core (ms)."""
    threads = Path(f"/proc/{pid}/task").glob("*/schedstat")
    times = [path.read_text().split()[:2] for path in threads]
    return [sum(map(int, each)) / 1e6 for each in zip(*times, strict=True)]


def computed(pid):
    """Processor time of a process (ms)."""
    return spent(pid)[0]


async def many(url, pid, count):
    """So many people at work; the 95th percentile of what they wait (ms)."""
    before = resident(pid)
    clients = [await Client().open(url) for _ in range(count)]
    begin = computed(pid)
    times = await asyncio.gather(*(c.work(k / RATE / count) for k, c in enumerate(clients)))
    each, used = (resident(pid) - before) / count, computed(pid) - begin
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


async def beside(url, play):
    """One person drags, with the player on or off, and a second one moves now and then; what both wait."""
    dragging, other = await Client().open(url), await Client().open(url)
    if play:
        await dragging.play()
        await asyncio.sleep(1)
    found = await asyncio.gather(dragging.drag(), other.work(0.1))
    for client in (dragging, other):
        client.socket.close()
    said = []
    for who, times in zip(("dragged", "a second visitor"), found, strict=True):
        times = sorted(1000 * t for t in times)
        p95 = times[int(0.95 * len(times))]
        said.append(
            f"{who}: {len(times)} values, median {statistics.median(times):.0f}, p95 {p95:.0f}, "
            f"longest {times[-1]:.0f} ms"
        )
    print(f"{'player on' if play else 'player off'}; {'; '.join(said)}", flush=True)


def drags():
    """A drag with and without the player, beside a second visitor."""
    server = Server()
    try:
        asyncio.run(asyncio.wait_for(come_and_go(server.url, 2), 300))
        for play in (False, True):
            asyncio.run(asyncio.wait_for(beside(server.url, play), 300))
    finally:
        server.stop()


def at_once(count):
    """So many people at a new server; the 95th percentile of what they wait (ms)."""
    server = Server()
    try:
        asyncio.run(asyncio.wait_for(come_and_go(server.url, 2), 300))
        return asyncio.run(asyncio.wait_for(many(server.url, server.process.pid, count), 300))
    finally:
        server.stop()


async def come_and_go(url, count):
    """Sessions that are opened, used and closed."""
    for _ in range(count):
        client = await Client().open(url)
        await client.move(1)
        client.socket.close()


def left_behind():
    """Memory and live Documents after sessions have come and gone, more and more of them."""
    short = ("--unused-session-lifetime", "200", "--check-unused-sessions", "200")
    server = Server("tests/benchmarks/probe.py", *short)
    try:
        url = server.url.rpartition("/")[0]
        done = 0
        for count in OPENED:
            asyncio.run(asyncio.wait_for(come_and_go(f"{url}/app", count - done), 3000))
            done = count
            time.sleep(3)
            urlopen(f"{url}/probe").read()
            time.sleep(1)
            alive, memory = re.findall("live Documents.*", server.log)[-1], resident(server.process.pid)
            print(f"{count} sessions opened and closed: {alive}, {memory:.0f} MB resident", flush=True)
    finally:
        server.stop()


async def alone(urls, pid):
    """Processor time (ms) of one opening of each page: the median of some, one after the other, in turn."""
    costs = {url: [] for url in urls}
    for _ in range(ALONE):
        for url, found in costs.items():
            begin = computed(pid)
            visitor = await Visitor().open(url)
            # What the server does once the input rests.
            await asyncio.sleep(0.6)
            visitor.socket.close()
            found.append(computed(pid) - begin)
    return [statistics.median(found) for found in costs.values()]


async def at_the_same_time(url):
    """Seconds until each of a class that opens the page at once has it."""

    async def visit():
        begin = time.perf_counter()
        visitor = await Visitor().open(url)
        return time.perf_counter() - begin, visitor

    found = await asyncio.gather(*(visit() for _ in range(CLASS)))
    for _, visitor in found:
        visitor.socket.close()
    return [seconds for seconds, _ in found]


def openings():
    """The cost of opening the page, beside that of a plain one, and how long a class waits for it."""
    server = Server("tests/benchmarks/plain_page.py", *LIFETIME)
    try:
        url, pid = server.url.rpartition("/")[0], server.process.pid
        asyncio.run(asyncio.wait_for(come_and_go(f"{url}/app", 2), 300))
        own, plain = asyncio.run(alone([f"{url}/app", f"{url}/plain_page"], pid))
        print(
            f"one opening: {own:.0f} ms of computing, of a plain page {plain:.0f} ms: "
            f"{own / plain:.2f} times; load of the machine {os.getloadavg()[0]:.1f}",
            flush=True,
        )
        begin = spent(pid)
        last = max(asyncio.run(asyncio.wait_for(at_the_same_time(f"{url}/app"), 1200)))
        used, idle = (after - before for after, before in zip(spent(pid), begin, strict=True))
        # Cores that the server shares with this client and others say nothing of its queue.
        print(
            f"{CLASS} at once: the last one has the page after {last:.1f} s, of which the server waits "
            f"{idle / 1000:.1f} s for a core; the rest is {(1000 * last - idle) / (CLASS * own):.2f} times "
            f"{CLASS} openings; {used / CLASS:.0f} ms of computing each",
            flush=True,
        )
    finally:
        server.stop()


def main():
    # All of a class are on their way at the same time.
    AsyncHTTPClient.configure(None, max_clients=CLASS)
    openings()
    drags()
    fits()
    # More and more, until they wait.
    next((count for count in SESSIONS if at_once(count) > ENOUGH), None)
    left_behind()
    soak()


if __name__ == "__main__":
    soak() if sys.argv[1:] == ["soak"] else main()
