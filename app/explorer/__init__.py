"""The explorer: one state, its changes on the page, and its drawing."""

from . import extras as extras
