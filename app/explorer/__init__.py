"""The explorer: one state, what you set on its page, and what is drawn."""

from . import extras as extras
