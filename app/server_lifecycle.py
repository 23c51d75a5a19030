"""Hooks of the server, run once before it starts."""

import gc

# Here, so that the first visitor does not wait for it, and that the server does not start if it fails.
from . import extras as extras
from . import page as page
from . import private
from .fit import page as measurement  # noqa: F401

private.prompt_messages()


def on_server_loaded(server_context):
    """Rare garbage collections, of sessions only: with 24 of them a full one takes half a second."""
    gc.freeze()
    gc.set_threshold(10_000)
