"""What a person sees and does on the served page where it once went wrong: keys, address, theme, speed."""

import time

import pytest

from .conftest import Explorer

FOCUSED = """() => {
  let on = document.activeElement
  while (on?.shadowRoot?.activeElement) on = on.shadowRoot.activeElement
  return on?.ariaLabel ?? on?.textContent ?? ""
}"""


def test_a_key_that_undoes_leaves_the_focus_where_it_is(explorer):
    """*Undo*, which Ctrl+Z acts on, disappears; *Redo* in its place would have taken the next Space."""
    page = explorer.page
    explorer.change(explorer.type, "d_max", "5 nm")
    explorer.slider("d_max").focus()
    explorer.change(page.keyboard.press, "Control+z")
    assert page.get_by_role("button", name="Undo").count() == 0
    assert page.evaluate(FOCUSED) == "d_max, largest depth, slider"
    assert explorer.readout("depth") == "8.978 nm"
    # A button that is pressed and disappears hands its focus on, as ever.
    explorer.change(explorer.type, "d_max", "5 nm")
    page.get_by_role("button", name="Undo").focus()
    explorer.change(page.keyboard.press, "Enter")
    assert page.evaluate(FOCUSED) == "Redo"


def test_the_opening_scene_has_an_address_without_a_query(explorer):
    explorer.change(explorer.type, "d_max", "5 nm")
    explorer.link("max_depth")
    explorer.change(explorer.press, "Undo")
    explorer.wait("!location.href.includes('?')")


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


@pytest.mark.slow
def test_the_player_has_a_speed_once_it_is_played(explorer):
    page = explorer.page
    chosen = page.get_by_label("Speed of the player")
    assert not chosen.is_visible()
    explorer.press("▶ Play")
    explorer.wait("explorer.played()")
    chosen.select_option(label="¼×")
    page.evaluate("window.player.go(0)")
    explorer.press("▶ Play")
    begun = time.perf_counter()
    explorer.wait("window.player.value > 40")
    # Half of the states, which take 6 s, not 1.5 s.
    assert time.perf_counter() - begun > 3
