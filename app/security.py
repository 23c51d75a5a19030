"""Private names of Panel and Bokeh, which any version may change; the page works without each of them.

Only this module uses them, each at one place. It skips a missing name, with a warning in the log.
In the browser common/js/private.js does the same, with a warning in the console.
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
#: The viewport is as wide as the screen; by default a phone uses the layout of a desktop. The theme is set
#: before anything is drawn, and the private names in the browser come before all other scripts.
_HEAD = f"""{{% block postamble %}}
<meta name="viewport" content="width=device-width, initial-scale=1">
<script>{{% raw %}}{JS["head"]}{JS["private"]}{JS["page"]}{{% endraw %}}</script>
<link rel="modulepreload" href="app/static/parts.js">{{% endblock %}}"""
_WITHOUT_WEBGL = """{% block js_resources %}
{% for line in bokeh_js.splitlines() if "bokeh-gl" not in line %}{{ line }}
{% endfor %}{% endblock %}"""


class NotFound(RequestHandler):
    """Handler that answers every request with 404."""

    def initialize(self, **given):
        """Accept Bokeh's arguments for the handlers of an app."""

    def prepare(self):
        raise HTTPError(404)


def no_components() -> None:
    """Answer requests below /components/ with 404, before any import.

    Panel imports any module in such an address: `unittest.__main__` ends the server. The page needs no such
    address. Panel builds its routes from this name after it has loaded the app.
    """
    if _private_attribute("panel.io.server", "ComponentResourceHandler"):
        import_module("panel.io.server").ComponentResourceHandler = NotFound


#: Accepted types of arrays, of at most eight bytes.
_NUMBERS = {"bool", "int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"}


def no_packed_bytes() -> None:
    """Reject packed bytes in a message, and arrays of anything except numbers.

    Unpacked, or as texts of a given length, they may be a million times as large. Bokeh creates them
    without a bound, in the thread of the server. Browsers send bytes in separate buffers, and no arrays.
    """
    deserializer = _private_attribute("bokeh.core.serialization", "Deserializer")
    decode = getattr(deserializer, "_decode_bytes", None)
    decode_numbers = getattr(deserializer, "_decode_ndarray", None)
    if decode is None or decode_numbers is None:
        return

    def decode_bytes(self, obj):
        if isinstance(obj["data"], str):
            self.error("packed bytes are not accepted: send them as a buffer")
        return decode(self, obj)

    def decode_ndarray(self, obj):
        if obj["dtype"] not in _NUMBERS:
            self.error("only arrays of numbers are accepted")
        return decode_numbers(self, obj)

    deserializer._decode_bytes, deserializer._decode_ndarray = decode_bytes, decode_ndarray  # noqa: SLF001


#: Browsers do not guess types, and do not send other sites the address with the scene or a file name.
_HEADERS = {"X-Content-Type-Options": "nosniff", "Referrer-Policy": "same-origin"}


def headers() -> None:
    """Send headers with each answer: Panel has no option for this, but tornado's handlers have a method."""

    def set_default_headers(self):
        for name, value in _HEADERS.items():
            self.set_header(name, value)

    RequestHandler.set_default_headers = set_default_headers


def page(path: str, text: str) -> None:
    """Serve a static page as a file of the app, without a session."""
    data = text.encode()

    class Written(RequestHandler):
        """Static page; tornado answers 304 if the browser has it."""

        def initialize(self, **given):
            """Accept Bokeh's arguments for the handlers of an app."""

        def get(self):
            self.write(data)

    if patterns := _private_attribute("bokeh.server.urls", "per_app_patterns"):
        patterns.append((re.escape(path), Written))


def own_sessions() -> None:
    """Let only this server name sessions, and sign their names.

    A link with a session name or a token from its sender would lead a visitor into a session of the sender.
    The sender would then see the files of the visitor and run scripts in the page. The key must exist
    before the server forks processes; BOKEH_SECRET_KEY takes precedence.
    """
    patterns, handler = (
        _private_attribute("bokeh.server.urls", "per_app_patterns"),
        _private_attribute("panel.io.server", "DocHandler"),
    )
    if not (patterns and handler):
        return
    if not settings.secret_key():
        settings.secret_key = token_urlsafe(32)
        # A cached value from before the key.
        vars(settings).pop("_secret_key_bytes", None)
    settings.sign_sessions = True
    # The page does not use embedding by a script, which would also request a session.
    patterns[:0] = [(r"/autoload.js", NotFound), (r"/?", document(handler))]


def document(handler: Any) -> Any:
    """Return a class of Panel's pages that ignores session names in a request.

    Earlier links to the theory, such as `?theory=eq-11`, lead to its anchor, without a session.
    """

    class Document(handler):
        """Page in a new session."""

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


#: Hosts to which no other site can bind its name.
_LOOPBACK = ("127.0.0.1", "::1", "localhost")


def same_loopback_origin(origin: str, host: str, port: int) -> bool:
    """Whether an origin equals the host of its request, which is this machine at the served port."""
    place = urlsplit(f"//{host}")
    same = urlsplit(origin).netloc.lower() == host.lower()
    return same and place.hostname in _LOOPBACK and (place.port or 80) == port


def websockets() -> None:
    """Make websockets reject other origins, and send each part of a message at once, in order.

    A page at a disallowed name may connect to this name (Host = Origin): tornado 6.6 then checks nothing.
    If the name resolves to 127.0.0.1, it reaches the user's own server (DNS rebinding).

    A message has three parts. With Nagle's algorithm the second part waits for the acknowledgement of the
    first part. Browsers delay this by up to 40 ms in a drag. Without the algorithm such a client gets the
    answer to a move after 59 ms instead of 100 ms (medians of 120).
    """
    patterns = _private_attribute("bokeh.server.urls", "per_app_patterns")
    handler = _private_attribute("panel.io.server", "WSHandler")
    dispatch = _private_attribute("panel.io.document", "dispatch_tornado")
    if patterns and handler:
        # Tornado uses the first matching pattern.
        patterns.insert(0, (r"/ws", websocket(handler, dispatch)))


def websocket(handler: Any, dispatch: Callable[..., Any] | None) -> Any:
    """Return a class of Panel's websockets that checks origin and token, and sends without delay."""
    #: Websockets by the names of their sessions; of two websockets with the same token the newer stays.
    sockets: dict[str, Any] = {}

    class Websocket(handler):
        """Websocket that checks origin and token, and sends each part of a message at once."""

        async def prepare(self):
            origin = self.request.headers.get("Origin")
            # Only browsers send an origin.
            if origin is not None and not self.check_origin(origin):
                raise HTTPError(403)
            token = self.request.headers.get("Sec-WebSocket-Protocol", "").partition(",")[2].strip()
            known, app = False, self.application
            # Before the token is unpacked; some texts are no tokens.
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
                # An invalid address such as "http://[".
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

        While the lock is held, Panel postpones changes. If two such messages overlap (Panel 1.9,
        `_dispatch_msgs`), the second message waits for the next change: an answer is lost. Here all parts
        are written before other code can run, so that messages do not mix either.
        """
        closed = import_module("tornado.websocket").WebSocketClosedError
        # As in Bokeh: the browser may have left.
        with suppress(closed):
            await asyncio.gather(*dispatch(self.connection, msg=message))

    if dispatch:
        Websocket.send_message = send_message
    return Websocket


def template() -> str:
    """Return the template of the page, without WebGL: this saves 194 of 3,060 kB at a first visit."""
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
    """Return an attribute of a module, or None if it does not exist."""
    try:
        return getattr(import_module(module), name)
    except (ImportError, AttributeError):
        _log_missing(f"{module}.{name}")
        return None


@cache
def _log_missing(what: str) -> None:
    _LOG.warning("%s is not there in this version of Panel or Bokeh; the page goes on without it", what)
