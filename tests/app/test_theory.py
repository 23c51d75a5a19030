"""The theory is a page of its own, which links lead into, and which is as dark as the explorer."""

import re
from http.client import HTTPConnection

import pytest

from app.explorer import theory

from .conftest import Explorer

THERE = "document.querySelectorAll('math').length > 100"


@pytest.fixture
def opened(server, browser):
    """Opens the theory from a query or a path; nothing may be complained about."""
    with browser.new_context(viewport={"width": 1280, "height": 720}) as context:
        pages = []

        def open_theory(path="/theory.html"):
            pages.append(Explorer(context.new_page(), server.url + path, THERE))
            return pages[-1].page

        yield open_theory
        assert [problem for each in pages for problem in each.problems] == []


def assert_at(page, place):
    """The place is at the upper edge, once the formulas above it are as high as they will be."""
    place = f"document.getElementById('{place}').getBoundingClientRect().top"
    page.wait_for_function(f"scrollY > 500 && {place} >= 0 && {place} < 100")
    # Of the formulas no source is left.
    assert "\\(" not in page.locator("main").inner_text()


def test_links_of_today_and_earlier_ones_lead_to_a_place(opened):
    for path, place in (("?theory=eq-11", "eq-11"), ("/theory.html#section-13", "section-13")):
        page = opened(path)
        assert page.url.endswith(f"/app/theory.html#{place}")
        assert_at(page, place)
        # Nothing of a session.
        assert page.evaluate("window.Bokeh") is None


def test_the_next_equation_is_found_without_loading_the_page_again(explorer, context):
    """Links of the explorer share one window, where setting the formulas takes most of the time."""
    explorer.page.get_by_text("Numbers, equations, assumptions").click()
    links = explorer.page.locator("dd a")
    with context.expect_page() as other:
        links.first.click()
    page, places = other.value, links.evaluate_all("(links) => links.map((each) => each.hash.slice(1))")
    page.wait_for_function(THERE)
    assert_at(page, places[0])
    page.evaluate("window.kept = true")
    nth = next(k for k, place in enumerate(places) if place != places[0])
    links.nth(nth).click()
    page.wait_for_function("(place) => location.hash === place", arg=f"#{places[nth]}")
    assert_at(page, places[nth])
    assert page.evaluate("window.kept")
    page.close()


DARK = "document.documentElement.classList.contains('dark')"


def test_it_is_dark_as_the_explorer_or_else_as_the_system(explorer, context, opened):
    explorer.press("Dark")
    explorer.page.wait_for_function(DARK)
    (cookie,) = [
        each for each in context.cookies() if (each["domain"], each["path"]) == ("localhost", "/app")
    ]
    assert (cookie["name"], cookie["value"]) == ("dark", "1")
    beside = Explorer(context.new_page(), explorer.page.url.split("?")[0] + "?theory", THERE).page
    assert beside.evaluate(DARK)
    ground = "getComputedStyle(document.body).backgroundColor"
    dark = beside.evaluate(ground)
    beside.close()
    # A browser in which nothing was chosen.
    page = opened()
    assert not page.evaluate(DARK)
    assert page.evaluate(ground) != dark
    page.emulate_media(color_scheme="dark")
    page.reload()
    assert page.evaluate(DARK)
    assert page.evaluate(ground) == dark


def test_it_is_written_once_and_kept_by_the_browser(server):
    """Each answer is the same; a browser that has it is told so, and gets nothing."""

    def answer(**headers):
        connection.request("GET", "/app/theory.html", headers=headers)
        found = connection.getresponse()
        return found.status, found.headers["Etag"], found.read().decode()

    connection = HTTPConnection("127.0.0.1", server.port, timeout=20)
    status, mark, text = answer()
    assert status == 200
    assert theory.html() in text
    assert answer() == (200, mark, text)
    assert answer(**{"If-None-Match": mark}) == (304, mark, "")
    connection.close()


def test_the_theory_leads_to_no_file_that_is_not_served():
    shown = theory.html()
    assert not re.findall(r'href="(?!#|\?|http)[^"]*"', shown)
    # Its picture is in it.
    assert re.findall(r'src="([^"]{26})', shown) == ["data:image/svg+xml;base64,"]
