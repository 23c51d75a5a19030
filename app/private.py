"""Private ends of Panel and Bokeh, which may move with any version: the page runs without each of them.

Each is used at one place, here, with what it gains. One that has moved is left out, with a line in the log.
Those in the browser are in js/private.js, in the same manner, with the line in the console.
"""

import asyncio
import logging
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from tornado.web import HTTPError, RequestHandler

from .ui import JS

_LOG = logging.getLogger(__name__)
#: As wide as the screen: a phone would lay the page out for a desk. The theme is known before anything is
#: drawn, and the private ends in the browser come before all other scripts.
_HEAD = f"""{{% block postamble %}}
<meta name="viewport" content="width=device-width, initial-scale=1">
<script>{{% raw %}}{JS["theme"]}{JS["private"]}{JS["refused"]}{{% endraw %}}</script>
<link rel="modulepreload" href="app/static/parts.js">{{% endblock %}}"""
_WITHOUT_WEBGL = """{% block js_resources %}
{% for line in bokeh_js.splitlines() if "bokeh-gl" not in line %}{{ line }}
{% endfor %}{% endblock %}"""


class NoComponents(RequestHandler):
    """404, whatever is asked for."""

    def prepare(self):
        raise HTTPError(404)


def no_components() -> None:
    """Answer 404 to what is asked for below /components/, before anything is imported.

    Panel imports the module that such an address names, whichever it is: `unittest.__main__` ends the
    server. The page asks for none. Routes are built from this name once the app is loaded.
    """
    if _end("panel.io.server", "ComponentResourceHandler"):
        import_module("panel.io.server").ComponentResourceHandler = NoComponents


def no_packed_bytes() -> None:
    """Refuse bytes that come packed in a message: unpacked they may be a thousand times as large.

    Bokeh unpacks them without a bound, in the thread of the server. Browsers send bytes as buffers beside
    the message.
    """
    deserializer = _end("bokeh.core.serialization", "Deserializer")
    decode = getattr(deserializer, "_decode_bytes", None)
    if decode is None:
        return

    def decode_bytes(self, obj):
        if isinstance(obj["data"], str):
            self.error("packed bytes are not taken; they are sent as a buffer")
        return decode(self, obj)

    deserializer._decode_bytes = decode_bytes


#: Types are not guessed, and no other site is told the address, which has the scene or the name of a file.
_HEADERS = {"X-Content-Type-Options": "nosniff", "Referrer-Policy": "same-origin"}


def headers() -> None:
    """Send headers with each answer: by options of Panel there are none, and tornado asks its handlers."""

    def set_default_headers(self):
        for name, value in _HEADERS.items():
            self.set_header(name, value)

    RequestHandler.set_default_headers = set_default_headers


#: Hosts to which no name of another site can be bound.
_LOOPBACK = ("127.0.0.1", "::1", "localhost")


def is_own(origin: str, host: str, port: int) -> bool:
    """Whether an origin is the host of its request, and that one of this machine, at the served port."""
    place = urlsplit(f"//{host}")
    same = urlsplit(origin).netloc.lower() == host.lower()
    return same and place.hostname in _LOOPBACK and (place.port or 80) == port


def websockets() -> None:
    """Have websockets refuse other origins, and send each part of a message at once, one after the other.

    A page at a name that is not allowed may connect to that name (Host = Origin): tornado 6.6 asks nothing
    then. Bound to 127.0.0.1, the name reaches the server of a person (DNS rebinding).

    A message has three parts. With Nagle's algorithm the second one waits for the acknowledgement of the
    first one, which browsers delay by up to 40 ms in a drag: with a client that does so a move is answered
    after 59 ms instead of 100 (medians of 120).
    """
    patterns = _end("bokeh.server.urls", "per_app_patterns")
    handler = _end("panel.io.server", "WSHandler")
    dispatch = _end("panel.io.document", "dispatch_tornado")
    if patterns and handler:
        # The first pattern that matches is used.
        patterns.insert(0, (r"/ws", websocket(handler, dispatch)))


def websocket(handler: Any, dispatch: Callable[..., Any] | None) -> Any:
    """A class of Panel's websockets that is for allowed origins only, and sends promptly."""

    class Websocket(handler):
        """Websocket that asks for the origin, and sends each part of a message at once."""

        async def prepare(self):
            origin = self.request.headers.get("Origin")
            # Programs other than browsers send none.
            if origin is not None and not self.check_origin(origin):
                raise HTTPError(403)
            await super().prepare()

        def check_origin(self, origin):
            address = self.request.connection.stream.socket.getsockname()
            try:
                return is_own(origin, self.request.host, address[1]) or super().check_origin(origin)
            except ValueError:
                # No address at all, as "http://[".
                return False

        def open(self, *args, **kwargs):
            self.set_nodelay(True)
            return super().open(*args, **kwargs)

    async def send_message(self, message):
        """Send a message without Bokeh's lock of the websocket.

        While that is taken, Panel puts off what is changed, and where two such messages overlap (Panel 1.9,
        `_dispatch_msgs`) the second one stays behind until something else is changed: an answer is lost.
        All parts are written before anything else can run, so that messages stay apart as well.
        """
        closed = import_module("tornado.websocket").WebSocketClosedError
        # As in Bokeh, a browser may have gone.
        with suppress(closed):
            await asyncio.gather(*dispatch(self.connection, msg=message))

    if dispatch:
        Websocket.send_message = send_message
    return Websocket


def template() -> str:
    """Template of the page, of which no plot is drawn with WebGL: 194 of 3,060 kB of a first visit less."""
    base = _end("panel.io.resources", "BASE_TEMPLATE")
    try:
        source = Path(base.filename).read_text(encoding="utf-8")
    except (AttributeError, TypeError, OSError):
        source = ""
    known = "block js_resources" in source and "bokeh_js" in source
    if base and not known:
        _missing("the block js_resources of the template with bokeh_js")
    return _HEAD + _WITHOUT_WEBGL * known


def _end(module: str, name: str) -> Any:
    """A name of a module, or None where it has moved."""
    try:
        return getattr(import_module(module), name)
    except (ImportError, AttributeError):
        _missing(f"{module}.{name}")
        return None


def _missing(what: str) -> None:
    _LOG.warning("%s is not there in this version of Panel or Bokeh; the page goes on without it", what)
