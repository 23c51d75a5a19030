"""The page for measurements in a browser."""

import pytest

from ..conftest import READY, Explorer


@pytest.fixture
def measurement(server, context):
    """The page freshly opened; afterwards nothing may have been complained about or left the host."""
    opened = Explorer(context.new_page(), f"{server.url}?fit", READY)
    yield opened
    assert opened.problems == []
    opened.page.close()
    assert server.faults == ""
