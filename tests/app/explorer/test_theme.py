"""The dark theme: of the system, of the browser, and of a link."""

from app.explorer.page import Page

from ..conftest import Explorer

#: Themes of a page since before its document is parsed.
THEMES = """
  window.themes = []
  new MutationObserver(() => {
    if (document.body) themes.push(document.documentElement.classList.contains("dark"))
  }).observe(document, { childList: true, subtree: true })
"""
DARK = "document.documentElement.classList.contains('dark')"


def test_the_theme_is_that_of_the_system_until_another_one_is_chosen_or_asked_for(server, browser):
    """The browser keeps what is chosen; a link has it only if it was opened with it."""
    window = {"width": 1280, "height": 720}
    with browser.new_context(viewport=window, color_scheme="dark") as context:
        page = context.new_page()
        page.add_init_script(THEMES)
        explorer = Explorer(page, server.url)
        explorer.wait(DARK)
        # Of a second visit the server draws the data so, too, and the page is dark from the beginning.
        explorer.goto(server.url)
        assert set(page.evaluate("themes")) == {True}
        cookies = "; ".join(f"{each['name']}={each['value']}" for each in context.cookies())
        assert "#e4e7eb" in page.request.get(server.url, headers={"cookie": cookies}).text()
        explorer.press("Dark")
        explorer.wait(f"!{DARK}")
        explorer.change(explorer.type, "q_c", "80")
        assert explorer.link("q_c=80") == {"q_c": "80.0"}
        # A link that asks for it is followed, and stays as it is; the browser keeps its own.
        explorer.goto(f"{server.url}?dark=1")
        explorer.wait(DARK)
        explorer.change(explorer.type, "q_c", "70")
        assert explorer.link("q_c=70") == {"q_c": "70.0", "dark": "1"}
        explorer.goto(server.url)
        explorer.wait(f"!{DARK}")
        assert explorer.problems == []


def test_a_page_opens_in_the_theme_that_the_browser_has_told():
    dark = Page("", True)
    assert dark.state.dark
    ink = dark.layout.cards["force"].picture.layers[-1].source.data["text_color"][0]
    assert ink == "#e4e7eb"
    # A link that asks for a theme is right; the address then has it.
    assert not Page("dark=0", True).state.dark
    assert dark.query()[0] == ""
