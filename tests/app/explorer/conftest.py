"""Pages of the explorer that tests of a file share."""

import pytest

from app.explorer.page import Page

from ..conftest import Explorer


@pytest.fixture
def page():
    """A page without a browser, with a list of its notices."""
    page, notices = Page(), []
    page.notify, page.notices = notices.append, notices
    return page


@pytest.fixture
def notices(monkeypatch):
    """Notices of all pages."""
    notices = []
    monkeypatch.setattr(Page, "notify", lambda page, text: notices.append(text))
    return notices


@pytest.fixture(scope="module")
def projector(server, context):
    """The page on a projector; tests leave it as it was opened."""
    explorer = Explorer(context.new_page(), server.url, window=(1280, 720))
    yield explorer
    assert explorer.problems == []
    explorer.page.close()


@pytest.fixture(scope="module")
def phone(server, handheld):
    """The page on a phone; tests leave it as it was opened."""
    explorer = Explorer(handheld.new_page(), server.url)
    yield explorer
    assert explorer.problems == []
    explorer.page.close()
