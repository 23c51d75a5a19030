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

from .ui import JS

_LOG = logging.getLogger(__name__)
#: As wide as the screen: a phone would lay the page out for a desk. The theme is known before anything is
#: drawn, and the private ends in the browser come before all other scripts.
_HEAD = f"""{{% block postamble %}}
<meta name="viewport" content="width=device-width, initial-scale=1">
<script>{{% raw %}}{JS["theme"]}{JS["private"]}{{% endraw %}}</script>
<link rel="modulepreload" href="app/static/parts.js">{{% endblock %}}"""
_WITHOUT_WEBGL = """{% block js_resources %}
{% for line in bokeh_js.splitlines() if "bokeh-gl" not in line %}{{ line }}
{% endfor %}{% endblock %}"""


def prompt_messages() -> None:
    """Have the websocket send each part of a message at once, and one message after the other.

    A message has three parts. With Nagle's algorithm the second one waits for the acknowledgement of the
    first one, which browsers delay by up to 40 ms in a drag: with a client that does so a move is answered
    after 59 ms instead of 100 (medians of 120).
    """
    patterns = _end("bokeh.server.urls", "per_app_patterns")
    handler = _end("panel.io.server", "WSHandler")
    dispatch = _end("panel.io.document", "dispatch_tornado")
    if patterns and handler:
        # The first pattern that matches is used.
        patterns.insert(0, (r"/ws", prompt_handler(handler, dispatch)))


def prompt_handler(handler: Any, dispatch: Callable[..., Any] | None) -> Any:
    """A class of Panel's websockets that sends promptly."""

    class PromptHandler(handler):
        """Websocket that sends each part of a message at once."""

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
        PromptHandler.send_message = send_message
    return PromptHandler


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
