"""Hooks of the server, run once before it starts."""

import gc

from bokeh.server.urls import per_app_patterns
from panel.io.server import WSHandler

# Here, so that the first visitor does not wait for it.
from . import page as page


class PromptHandler(WSHandler):
    """Websocket that sends each part of a message at once.

    A message has three parts. With Nagle's algorithm the second one waits for the acknowledgement of the
    first one, which browsers delay by up to 40 ms in a drag: with a client that does so a move is answered
    after 59 ms instead of 100 (medians of 120).
    """

    def open(self, *args, **kwargs):
        self.set_nodelay(True)
        return super().open(*args, **kwargs)


# The first pattern that matches is used.
per_app_patterns.insert(0, (r"/ws", PromptHandler))


def on_server_loaded(server_context):
    """Rare garbage collections, of sessions only: with 24 of them a full one takes half a second."""
    gc.freeze()
    gc.set_threshold(10_000)
