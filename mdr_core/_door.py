"""The one door upward: what solves imports through it what shows a result, and what a user wrote."""

from importlib import import_module
from typing import Any


def above(module: str) -> Any:
    """A module that stands above the kernel, as "show.plots", imported when it is asked for."""
    return import_module(f"mdr_core.{module}")
