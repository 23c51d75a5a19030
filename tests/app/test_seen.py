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


def test_what_is_opened_leaves_the_buttons_of_a_large_plot(explorer):
    page = explorer.page
    page.set_viewport_size({"width": 1280, "height": 720})
    card = page.locator(".card.force")
    card.get_by_role("button", name="Large").click()
    small = card.get_by_role("button", name="Small")
    small.wait_for()
    explorer.press("Share")
    share = page.get_by_label("This scene in Python")
    share.wait_for()
    shown = page.locator(".share").first.bounding_box()
    for name in ("Small", "Save"):
        box = card.get_by_role("button", name=name).bounding_box()
        assert box["y"] + box["height"] <= shown["y"], name
    small.click()
    card.get_by_role("button", name="Large").wait_for()


def test_the_guide_scrolls_into_view_when_it_is_opened(server, handheld):
    """It is above the form, which is below the plots of a phone."""
    explorer = Explorer(handheld.new_page(), server.url)
    page = explorer.page
    explorer.press("Guide")
    title = page.get_by_label("Guided scene")
    title.wait_for()
    explorer.wait("""() => {
      const { top } = explorer.all().find((on) => on.classList.contains("guide")).getBoundingClientRect()
      return top >= 0 && top < innerHeight
    }""")
    assert 0 <= title.bounding_box()["y"] < page.viewport_size["height"]
    page.close()


def test_of_choices_in_quick_succession_the_last_one_counts(explorer):
    """The first is sent at once; what is chosen before it is answered waits, and replaces what waits."""
    explorer.page.evaluate("""() => {
      const drives = explorer.all().filter((on) => on.matches(".of-drive input"))
      for (const drive of drives.slice(1).concat(drives[1], drives[3])) drive.click()
    }""")
    explorer.wait("explorer.idle()")
    assert explorer.page.locator(".of-drive input:checked").get_attribute("value") == "impact"
    # One step of undo for the first one, one for the last.
    explorer.change(explorer.press, "Undo")
    explorer.change(explorer.press, "Undo")
    assert explorer.page.locator(".of-drive input:checked").get_attribute("value") == "depth"
    assert not explorer.page.get_by_role("button", name="Undo", exact=True).is_visible()


def test_words_of_all_buttons_in_share_are_in_their_middle(server, handheld):
    """Files are links in buttons, which are 44 pixels high for a finger."""
    explorer = Explorer(handheld.new_page(), server.url)
    page = explorer.page
    explorer.press("Share")
    page.get_by_text("Curves (CSV)").wait_for()
    middles = """() => explorer.all().filter((on) => on.matches("a, .bk-btn") && on.checkVisibility())
      .filter((on) => on.getRootNode().host?.classList.contains("button"))
      .filter((on) => on.matches("a, .bk-btn:not(:has(a))"))
      .map((on) => {
        const range = document.createRange()
        range.selectNodeContents(on)
        const [text, box] = [range.getBoundingClientRect(), on.getBoundingClientRect()]
        return [on.textContent.trim(), text.y + text.height / 2 - box.y - box.height / 2, box.height]
      })"""
    found = page.evaluate(middles)
    assert len(found) >= 4
    for name, away, high in found:
        assert abs(away) < 3, name
        assert high >= 44, name
    assert explorer.problems == []
    explorer.page.close()


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_page_for_measurements_shows_what_will_come_and_then_the_number_above_its_form(
    server, browser, theme
):
    """First no digits that nobody has measured; on a phone the number is above what is asked."""
    held = {"viewport": {"width": 390, "height": 844}, "color_scheme": theme}
    with browser.new_context(**held) as context:
        there = "explorer.all().some((each) => each.matches('.ghost'))"
        explorer = Explorer(context.new_page(), f"{server.url}?fit", there)
        page = explorer.page
        shown = page.locator(".ghost")
        shown.get_by_text("E* = … ± …").wait_for()
        assert not any(letter.isdigit() for letter in shown.locator(".number").inner_text())
        for step in ("Curve:", "Tip:", "Sample:"):
            assert shown.get_by_text(step).is_visible()
        page.get_by_role("button", name="Sample: fused silica").click()
        page.get_by_label("Tip", exact=True).select_option(label="Berkovich or Vickers (cone of 70.3°)")
        page.get_by_label("Sample", exact=True).select_option(index=1)
        number = page.locator(".big output")
        number.wait_for()
        form = page.get_by_label("Tip", exact=True).bounding_box()
        assert number.bounding_box()["y"] < form["y"]
        curve = page.locator(".plots-of-fit").bounding_box()
        assert curve["y"] > form["y"]
        # The samples are drawn in the theme of the browser.
        colour = """() => Bokeh.documents[0].get_model_by_name("force plot").renderers
          .find((each) => each.data_source.name === "measured").glyph.fill_color"""
        wanted = {"light": "#7a4a1e", "dark": "#d8b48a"}[theme]
        drawn = page.evaluate(colour)
        assert (drawn.get("value", drawn) if isinstance(drawn, dict) else drawn) == wanted
        assert explorer.problems == []
