"""A server as the documentation says it is run for others, and what stands between it and a person."""

import asyncio
import contextlib
import re
import shlex
import threading

from .conftest import ROOT

HOST = "explorer.example.org"
#: The person's address as the proxy tells it.
PERSON = "203.0.113.7"


def deployed(host):
    """Options of the line in assets/docs/explorer.md, to be answered as `host`, but for its port."""
    text = (ROOT / "assets/docs/explorer.md").read_text(encoding="utf-8")
    line = re.search(r"panel serve app (--address.*?)\n```", text, re.DOTALL)[1].replace("\\\n", " ")
    options = shlex.split(line.replace(HOST, host))
    at = options.index("--port")
    return [*options[:at], *options[at + 2 :]]


class Proxy:
    """A reverse proxy on a port of loopback, in a thread of its own, that says it has ended TLS.

    It passes every request on to the port `target`, with `Host` as it came; one connection carries one
    request, or one websocket, and `cut` ends all of them.
    """

    target = None

    def __init__(self):
        self._writers = set()
        self._loop, ready = asyncio.new_event_loop(), threading.Event()
        self._thread = threading.Thread(target=self._serve, args=(ready,), daemon=True)
        self._thread.start()
        assert ready.wait(10)

    def _serve(self, ready):
        asyncio.set_event_loop(self._loop)
        server = self._loop.run_until_complete(asyncio.start_server(self._connected, "127.0.0.1", 0))
        self.port = server.sockets[0].getsockname()[1]
        self._loop.call_soon(ready.set)
        self._loop.run_forever()
        server.close()
        pending = asyncio.all_tasks(self._loop)
        for task in pending:
            task.cancel()
        self._loop.run_until_complete(asyncio.gather(*pending, return_exceptions=True))
        self._loop.close()

    async def _connected(self, reader, writer):
        with contextlib.suppress(OSError, asyncio.IncompleteReadError):
            head = await reader.readuntil(b"\r\n\r\n")
            behind = await asyncio.open_connection("127.0.0.1", self.target)
            self._writers |= {writer, behind[1]}
            behind[1].write(self._told(head))
            await asyncio.gather(self._pipe(reader, behind[1]), self._pipe(behind[0], writer))
        writer.close()

    @staticmethod
    def _told(head):
        request, *lines = head.decode("latin-1").split("\r\n")[:-2]
        kept = [line for line in lines if not line.lower().startswith(("connection:", "x-"))]
        upgraded = any(line.lower().startswith("upgrade:") for line in lines)
        kept += [f"Connection: {'Upgrade' if upgraded else 'close'}"]
        kept += [f"X-Real-IP: {PERSON}", "X-Scheme: https"]
        return "\r\n".join([request, *kept, "", ""]).encode("latin-1")

    async def _pipe(self, reader, writer):
        with contextlib.suppress(OSError):
            while data := await reader.read(65536):
                writer.write(data)
                await writer.drain()
        writer.close()
        self._writers.discard(writer)

    def cut(self):
        """End all connections at once, as a cable that is pulled: TCP resets on both sides."""

        def abort():
            for writer in self._writers:
                writer.transport.abort()
            self._writers.clear()

        self._loop.call_soon_threadsafe(abort)

    def stop(self):
        self.cut()
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join(10)
