"""Hooks of the server, run once before it starts."""

import gc

from . import security
from .common import folders
from .explorer import extras, page, theory
from .measurement import page as measurement

#: Loaded here: the first visitor does not wait, and the server does not start if a module fails.
LOADED = (extras, page, measurement)

folders.clear()
security.no_components()
security.no_packed_bytes()
security.headers()
security.own_sessions()
security.websockets()
security.page("/theory.html", theory.page(f"../static/extensions/panel/{theory.KATEX}"))


def on_server_loaded(server_context):
    """Make garbage collections rare, and only of sessions: with 24 sessions a full one takes 0.5 s."""
    gc.freeze()
    gc.set_threshold(10_000)
