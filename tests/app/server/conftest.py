"""The server as it is started by hand."""

import pytest

from ..conftest import PROGRAM, Server


@pytest.fixture(scope="session")
def command(browser):
    """`mdr-explorer` as it is started by hand."""
    server = Server(program=PROGRAM)
    yield server
    server.stop()
