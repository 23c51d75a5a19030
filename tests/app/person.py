"""A person at the page, without a browser."""

import json
from urllib.parse import parse_qsl

from app.session import Session


class Person:
    """Talks to a session as the page does."""

    def __init__(self, arguments=None):
        self.session = Session(arguments)
        self.sent = []
        self.session.page.send = self.sent.append

    def ask(self, do, **message):
        self.session.receive({"do": do, "n": 7, **message})
        return self.meta

    @property
    def meta(self):
        return json.loads(self.session.page.meta)

    def array(self, name):
        """An array as it was sent, in SI if its axis is named."""
        start, length = self.meta["places"][name]
        return self.session.page.values[start : start + length].astype(float)

    def number(self, name):
        return self.session.state.numbers[name]


def arguments(query):
    return {name: [value.encode()] for name, value in parse_qsl(query)}
