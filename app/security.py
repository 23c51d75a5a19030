"""Private ends of Panel and Bokeh, which may move with any version: the page runs without each of them.

Each is used at one place, here, with what it gains. One that has moved is left out, with a line in the log.
Those in the browser are in common/js/private.js, in the same manner, with the line in the console.
"""

import asyncio
import logging
import re
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from importlib import import_module
from pathlib import Path
from secrets import token_urlsafe
from typing import Any
from urllib.parse import urlsplit

from bokeh.settings import settings
from bokeh.util.token import check_token_signature, get_session_id
from tornado.web import HTTPError, RequestHandler

from .common.ui import JS

_LOG = logging.getLogger(__name__)
#: As wide as the screen: a phone would lay the page out for a desk. The theme is known before anything is
#: drawn, and the private ends in the browser come before all other scripts.
_HEAD = f"""{{% block postamble %}}
<meta name="viewport" content="width=device-width, initial-scale=1">
<script>{{% raw %}}{JS["head"]}{JS["private"]}{JS["page"]}{{% endraw %}}</script>
<link rel="modulepreload" href="app/static/parts.js">{{% endblock %}}"""
_WITHOUT_WEBGL = """{% block js_resources %}
{% for line in bokeh_js.splitlines() if "bokeh-gl" not in line %}{{ line }}
{% endfor %}{% endblock %}"""


class NotFound(RequestHandler):
    """404, whatever is asked for."""

    def initialize(self, **given):
        """Take what Bokeh gives the handlers of an app."""

    def prepare(self):
        raise HTTPError(404)


def no_components() -> None:
    """Answer 404 to what is asked for below /components/, before anything is imported.

    Panel imports the module that such an address names, whichever it is: `unittest.__main__` ends the
    server. The page asks for none. Routes are built from this name once the app is loaded.
    """
    if _private_attribute("panel.io.server", "ComponentResourceHandler"):
        import_module("panel.io.server").ComponentResourceHandler = NotFound


#: Types of the arrays that are taken, of at most eight bytes.
_NUMBERS = {"bool", "int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"}


def no_packed_bytes() -> None:
    """Refuse bytes that come packed in a message, and arrays of anything but numbers.

    Unpacked, or as texts of a given length, they may be a million times as large. Bokeh makes them without
    a bound, in the thread of the server. Browsers send bytes as buffers beside the message, and no arrays.
    """
    deserializer = _private_attribute("bokeh.core.serialization", "Deserializer")
    decode = getattr(deserializer, "_decode_bytes", None)
    decode_numbers = getattr(deserializer, "_decode_ndarray", None)
    if decode is None or decode_numbers is None:
        return

    def decode_bytes(self, obj):
        if isinstance(obj["data"], str):
            self.error("packed bytes are not taken; they are sent as a buffer")
        return decode(self, obj)

    def decode_ndarray(self, obj):
        if obj["dtype"] not in _NUMBERS:
            self.error("arrays of numbers alone are taken")
        return decode_numbers(self, obj)

    deserializer._decode_bytes, deserializer._decode_ndarray = decode_bytes, decode_ndarray  # noqa: SLF001


#: Types are not guessed, and no other site is told the address, which has the scene or the name of a file.
_HEADERS = {"X-Content-Type-Options": "nosniff", "Referrer-Policy": "same-origin"}


def headers() -> None:
    """Send headers with each answer: by options of Panel there are none, and tornado asks its handlers."""

    def set_default_headers(self):
        for name, value in _HEADERS.items():
            self.set_header(name, value)

    RequestHandler.set_default_headers = set_default_headers


def page(path: str, text: str) -> None:
    """Serve a page that is the same for everybody as a file of the app: it needs no session."""
    data = text.encode()

    class Written(RequestHandler):
        """Page that is written already; a browser that has it is told so."""

        def initialize(self, **given):
            """Take what Bokeh gives the handlers of an app."""

        def get(self):
            self.write(data)

    if patterns := _private_attribute("bokeh.server.urls", "per_app_patterns"):
        patterns.append((re.escape(path), Written))


def own_sessions() -> None:
    """Let this server alone name sessions, and sign their names.

    A link with the name of a session, or a token that its sender has written, would lead a visitor into a
    session of the sender, who sees the files of the visitor and runs scripts in the page. The key is made
    before processes are forked; one in BOKEH_SECRET_KEY goes first.
    """
    patterns, handler = (
        _private_attribute("bokeh.server.urls", "per_app_patterns"),
        _private_attribute("panel.io.server", "DocHandler"),
    )
    if not (patterns and handler):
        return
    if not settings.secret_key():
        settings.secret_key = token_urlsafe(32)
        # Kept from before there was a key.
        vars(settings).pop("_secret_key_bytes", None)
    settings.sign_sessions = True
    # The page does not embed by a script, which asks for a session, too.
    patterns[:0] = [(r"/autoload.js", NotFound), (r"/?", document(handler))]


def document(handler: Any) -> Any:
    """A class of Panel's pages that takes no name of a session from a request.

    Earlier links to the theory, such as `?theory=eq-11`, lead to its place, without a session.
    """

    class Document(handler):
        """Page in a session of its own."""

        async def prepare(self):
            request = self.request
            for given in (request.arguments, request.query_arguments, request.body_arguments):
                for name in ("bokeh-session-id", "bokeh-token"):
                    given.pop(name, None)
            request.headers.pop("Bokeh-Session-Id", None)
            given = request.query_arguments
            if "theory" in given and "fit" not in given:
                place = re.sub(rb"[^\w-]", b"", given["theory"][-1]).decode()
                folder = "" if request.path.endswith("/") else "app/"
                self.redirect(f"{folder}theory.html#{place}")
                return
            await super().prepare()

    return Document


#: Hosts to which no name of another site can be bound.
_LOOPBACK = ("127.0.0.1", "::1", "localhost")


def same_loopback_origin(origin: str, host: str, port: int) -> bool:
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
    patterns = _private_attribute("bokeh.server.urls", "per_app_patterns")
    handler = _private_attribute("panel.io.server", "WSHandler")
    dispatch = _private_attribute("panel.io.document", "dispatch_tornado")
    if patterns and handler:
        # The first pattern that matches is used.
        patterns.insert(0, (r"/ws", websocket(handler, dispatch)))


def websocket(handler: Any, dispatch: Callable[..., Any] | None) -> Any:
    """A class of Panel's websockets for allowed origins and tokens of this server, which sends promptly."""
    #: The websocket of each session by its name: of two with one token the newer one is served.
    sockets: dict[str, Any] = {}

    class Websocket(handler):
        """Websocket that asks for origin and token, and sends each part of a message at once."""

        async def prepare(self):
            origin = self.request.headers.get("Origin")
            # Programs other than browsers send none.
            if origin is not None and not self.check_origin(origin):
                raise HTTPError(403)
            token = self.request.headers.get("Sec-WebSocket-Protocol", "").partition(",")[2].strip()
            known, app = False, self.application
            # Before anything of it is unpacked; some texts are no tokens at all.
            with suppress(ValueError, KeyError, TypeError):
                known = check_token_signature(token, app.secret_key, app.sign_sessions)
            if not known:
                raise HTTPError(403)
            await super().prepare()

        def check_origin(self, origin):
            address = self.request.connection.stream.socket.getsockname()
            try:
                return same_loopback_origin(origin, self.request.host, address[1]) or super().check_origin(
                    origin
                )
            except ValueError:
                # No address at all, as "http://[".
                return False

        def open(self, *args, **kwargs):
            self.set_nodelay(True)
            name = get_session_id(self._token)
            if (other := sockets.pop(name, None)) is not None:
                other.close(1008, "the page is shown elsewhere")
            sockets[name] = self
            return super().open(*args, **kwargs)

        def on_close(self):
            for name in [name for name, each in sockets.items() if each is self]:
                del sockets[name]
            super().on_close()

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
    base = _private_attribute("panel.io.resources", "BASE_TEMPLATE")
    try:
        source = Path(base.filename).read_text(encoding="utf-8")
    except (AttributeError, TypeError, OSError):
        source = ""
    known = "block js_resources" in source and "bokeh_js" in source
    if base and not known:
        _log_missing("the block js_resources of the template with bokeh_js")
    return _HEAD + _WITHOUT_WEBGL * known


def _private_attribute(module: str, name: str) -> Any:
    """A name of a module, or None where it has moved."""
    try:
        return getattr(import_module(module), name)
    except (ImportError, AttributeError):
        _log_missing(f"{module}.{name}")
        return None


@cache
def _log_missing(what: str) -> None:
    _LOG.warning("%s is not there in this version of Panel or Bokeh; the page goes on without it", what)
