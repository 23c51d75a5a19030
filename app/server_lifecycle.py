"""Hooks of the server, run once before it starts."""

import asyncio
import gc
from contextlib import suppress

from bokeh.server.urls import per_app_patterns
from panel.io.document import dispatch_tornado
from panel.io.server import WSHandler
from tornado.websocket import WebSocketClosedError

# Here, so that the first visitor does not wait for it, and that the server does not start if it fails.
from . import extras as extras
from . import page as page
from .fit import page as measurement  # noqa: F401


class PromptHandler(WSHandler):
    """Websocket that sends each part of a message at once.

    A message has three parts. With Nagle's algorithm the second one waits for the acknowledgement of the
    first one, which browsers delay by up to 40 ms in a drag: with a client that does so a move is answered
    after 59 ms instead of 100 (medians of 120).
    """

    def open(self, *args, **kwargs):
        self.set_nodelay(True)
        return super().open(*args, **kwargs)

    async def send_message(self, message):
        """Send a message without Bokeh's lock of the websocket.

        While that is taken, Panel puts off what is changed, and where two such messages overlap (Panel 1.9,
        `_dispatch_msgs`) the second one stays behind until something else is changed: an answer is lost.
        All parts are written before anything else can run, so that messages stay apart as well.
        """
        # As in Bokeh, a browser may have gone.
        with suppress(WebSocketClosedError):
            await asyncio.gather(*dispatch_tornado(self.connection, msg=message))


# The first pattern that matches is used.
per_app_patterns.insert(0, (r"/ws", PromptHandler))


def on_server_loaded(server_context):
    """Rare garbage collections, of sessions only: with 24 of them a full one takes half a second."""
    gc.freeze()
    gc.set_threshold(10_000)
