"""The dark theme: of the system, of the browser, and of a link."""

import pytest

from app.explorer.page import Page

from ..conftest import Explorer


@pytest.mark.parametrize("system", ["light", "dark"])
def test_the_theme_is_of_the_browser_and_in_a_link_if_it_was_asked_for(server, browser, system):
    """As the system is, until another one is chosen, which this browser keeps; links do not have it."""
    other = {"light": "dark", "dark": "light"}[system]
    with browser.new_context(viewport={"width": 1280, "height": 720}, color_scheme=system) as context:
        explorer = Explorer(context.new_page(), server.url)
        page, is_dark = explorer.page, "document.documentElement.classList.contains('dark')"
        seen = {"dark": is_dark, "light": f"!{is_dark}"}
        explorer.wait(seen[system])
        explorer.change(explorer.type, "q_c", "90")
        assert explorer.link("q_c") == {"q_c": "90.0"}
        explorer.press("Dark")
        explorer.wait(seen[other])
        explorer.change(explorer.type, "q_c", "80")
        assert explorer.link("q_c=80") == {"q_c": "80.0"}
        page.reload()
        explorer.wait(f"window.explorer?.idle() && {seen[other]}")
        # A link that asks for it is followed, and stays as it is; the browser keeps its own.
        asked = {"dark": "1", "light": "0"}[system]
        explorer.goto(f"{server.url}?dark={asked}")
        explorer.wait(seen[system])
        explorer.change(explorer.type, "q_c", "70")
        assert explorer.link("q_c=70") == {"q_c": "70.0", "dark": asked}
        explorer.goto(server.url)
        explorer.wait(seen[other])
        assert explorer.problems == []


def test_a_dark_browser_is_served_a_dark_page(server, browser):
    """From the first script on the page is dark; of a second visit the server draws the data so, too."""
    with browser.new_context(color_scheme="dark", viewport={"width": 1280, "height": 720}) as context:
        first = Explorer(context.new_page(), server.url)
        first.wait("document.documentElement.classList.contains('dark')")
        page = context.new_page()
        # Before the document is parsed; what Bokeh draws first is what the server has sent.
        page.add_init_script("""
          window.themes = []
          new MutationObserver(() => {
            if (document.body) themes.push(document.documentElement.classList.contains("dark"))
          }).observe(document, { childList: true, subtree: true })
          window.first = () => Bokeh.documents[0]?.get_model_by_name("messages")?.dark
        """)
        explorer = Explorer(page, server.url)
        assert set(page.evaluate("themes")) == {True}
        drawn = server.url, {"cookie": "; ".join(f"{c['name']}={c['value']}" for c in context.cookies())}
        assert "#e4e7eb" in page.request.get(drawn[0], headers=drawn[1]).text()
        assert explorer.problems == first.problems == []


def test_a_page_opens_in_the_theme_that_the_browser_has_told():
    dark = Page("", True)
    assert dark.state.dark
    ink = dark.layout.cards["force"].picture.layers[-1].source.data["text_color"][0]
    assert ink == "#e4e7eb"
    # A link that asks for a theme is right; the address then has it.
    assert not Page("dark=0", True).state.dark
    assert dark.query()[0] == ""
