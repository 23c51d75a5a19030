"""Phones: one column, large targets, and swipes that scroll or drag."""

from itertools import pairwise

from ..conftest import heights

# All elements, also within components; targets smaller than so many pixels but links within a text, and
# of a radio button its label; what can be scrolled sideways.
SEEN = """(least) => {
  const box = (each) => each.getBoundingClientRect()
  const within = explorer.all()
  const targets = within.filter((each) => each.matches(
    "button, input:not([type=radio]), label:has(input), select, summary, .button a, [role=slider]"))
  const size = (each) => Math.min(box(each).width, box(each).height)
  const small = targets.filter((each) => box(each).width > 0 && size(each) < least)
  const sideways = within.filter((each) => each.scrollWidth > each.clientWidth + 1 &&
    ["auto", "scroll"].includes(getComputedStyle(each).overflowX))
  const name = (each) => `${each.tagName}.${each.className} ${each.ariaLabel ?? each.innerText}`
  const scroll = document.documentElement.scrollWidth
  return { small: small.map(name), sideways: sideways.map(name), scroll }
}"""


def test_small_screens(phone):
    """A phone, in one column, with nothing over anything; and smaller windows.

    Numbers, springs, force and the slider of the depth are on the first screen together, the pressure is
    next, and then all other sliders; 44 pixels are what a finger needs (WCAG 2.2, 2.5.5).
    """
    page = phone.page
    assert page.evaluate(SEEN, 44) == {"small": [], "sideways": [], "scroll": 390}
    numbers = page.locator("output")
    assert numbers.count() == 8
    places = [numbers.last, page.locator(".card.springs"), page.locator(".card.force")]
    places += [phone.slider("d_max"), page.locator(".card.pressure")]
    places += [phone.slider(symbol) for symbol in ("s", "E*", "q_c")]
    boxes = [place.bounding_box() for place in places]
    assert all(box["width"] > 0 for box in [each.bounding_box() for each in numbers.all()])
    assert boxes[1]["y"] < 500
    assert boxes[3]["y"] + boxes[3]["height"] < 844
    page.get_by_text("●").first.wait_for()
    assert min(heights(phone, "springs", "force")) > 100
    tops = page.locator(".header button:visible, .header select:visible")
    middles = {round(box["y"] + box["height"] / 2) for box in (each.bounding_box() for each in tops.all())}
    assert len(middles) == 1
    for one, other in pairwise(boxes):
        assert one["y"] + one["height"] <= other["y"]
    page.set_viewport_size({"width": 720, "height": 450})
    phone.wait("explorer.model('force').inner_width > 400")
    assert page.evaluate(SEEN, 44)["scroll"] == 720
    for width in (1001, 1280):
        page.set_viewport_size({"width": width, "height": 800})
        assert page.evaluate(SEEN, 44)["scroll"] == width
    page.set_viewport_size({"width": 390, "height": 844})


def swipe(page, begin, moved):
    """Put a finger down at a place of the screen, move it by pixels, and lift it."""
    touch = page.context.new_cdp_session(page)
    for k in range(9):
        place = {side: start + way * k / 8 for side, start, way in zip("xy", begin, moved, strict=True)}
        told = {"type": "touchMove" if k else "touchStart", "touchPoints": [place]}
        touch.send("Input.dispatchTouchEvent", told)
    touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    # What was thrown comes to rest before anything is placed on the screen.
    page.evaluate("""async () => {
        const frame = () => new Promise(requestAnimationFrame)
        for (let still = 0, last = NaN; still < 10; last = scrollY) {
            await frame()
            still = scrollY === last ? still + 1 : 0
        }
    }""")


def test_a_finger_scrolls_the_page_and_drags_by_the_mark(phone):
    """Over the indenter, beside it and over the curve a swipe changes nothing, whatever way it goes."""
    page = phone.page
    for figure, down in (("springs", -120), ("force", 120)):
        card = page.locator(f".card.{figure}")
        for shares in ((0.5, 0.4), (0.4, 0.8)):
            for moved in ((100, 0), (0, down)):
                card.scroll_into_view_if_needed()
                box = card.locator("canvas").first.bounding_box()
                scrolled = page.evaluate("scrollY")
                begin = box["x"] + shares[0] * box["width"], box["y"] + shares[1] * box["height"]
                swipe(page, begin, moved)
                if moved[1]:
                    # A busy browser drops a swipe now and then.
                    for _ in range(2):
                        if page.evaluate("scrollY") == scrolled:
                            swipe(page, begin, moved)
                    assert (scrolled - page.evaluate("scrollY")) * down > 0
    # What is asked now is answered after anything that the swipes may have asked.
    phone.change(phone.type, "q_c", "101 N/m")
    assert phone.readout("depth") == phone.field("d_max").input_value() == "8.978 nm"
    assert phone.link("q_c=")["q_c"] == "101.0"
    pixel = page.evaluate("""() => {
        const { y_range: { start, end }, inner_height } = explorer.model("springs")
        return (end - start) / inner_height
    }""")
    page.evaluate("() => addEventListener('pointercancel', () => ++window.cancelled, true)")
    for figure, row, moved, told in (
        # The tip goes as far as the finger, to a pixel; then the mark on the curve goes back.
        ("springs", "handle", (0, 40), f"Math.abs(way - {40 * pixel}) < {pixel}"),
        ("force", "now", (-60, 0), f"way < {-5 * pixel}"),
    ):
        page.locator(f".card.{figure}").scroll_into_view_if_needed()
        scrolled = page.evaluate("scrollY")
        # A busy browser cancels a touch that is not answered in time; the finger then comes again.
        for _ in range(3):
            page.evaluate("window.cancelled = 0")
            begun = phone.row("force", "now")[0][0]
            swipe(page, phone.place(figure, row, 0), moved)
            if not page.evaluate("cancelled"):
                break
            phone.wait("explorer.idle()")
        phone.wait(f"((way) => {told})(explorer.row('force', 'now')[0][0] - {begun}) && explorer.idle()")
        assert page.evaluate("scrollY") == scrolled
    # A drag that is cancelled ends where it was last: the event has no place.
    begun = phone.row("force", "now")[0][0]
    page.locator(".card.springs").scroll_into_view_if_needed()
    x, y = phone.place("springs", "handle", 0)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x, y + 20, steps=4)
    page.evaluate("""() => {
        const { shadowRoot } = Bokeh.index.find_one(explorer.model("springs")).el
        const canvas = explorer.all(shadowRoot).find((each) => each.matches(".bk-events"))
        canvas.dispatchEvent(new PointerEvent("pointercancel", { pointerId: 1, composed: true }))
    }""")
    page.mouse.up()
    phone.change(phone.type, "q_c", "102 N/m")
    # To the digits that are drawn.
    assert float(phone.field("d_max").input_value().removesuffix(" nm")) >= begun - 1e-3


def test_plots_and_the_path_are_told_in_words(phone):
    """In the accessibility tree a plot has a name and the present numbers, and the slider its state."""
    phone.change(phone.type, "d_max", "6 nm")
    # Moves of the drag before may still be drawn.
    phone.page.locator('output[data-name="depth"]', has_text="6.000 nm").wait_for()
    phone.wait("explorer.idle()")
    numbers = {name: phone.readout(name) for name in ("force", "depth", "plastic_radius", "plastic_work")}
    assert numbers["depth"] == "6.000 nm"
    force = "Bokeh.index.find_one(explorer.model('force')).el"
    phone.wait(f"{force}.ariaDescription.includes('depth 6.000 nm')")
    tree = phone.page.context.new_cdp_session(phone.page).send("Accessibility.getFullAXTree")["nodes"]
    nodes = [node for node in tree if node.get("role", {}).get("value") in ("figure", "slider")]
    told = {node["name"]["value"]: node for node in nodes}
    for title in ("1D foundation", "Pressure under the tip", "Force and depth"):
        (name,) = [name for name in told if name.startswith(f"{title}: ")]
        for each, text in numbers.items():
            assert f"{each.replace('_', ' ')} {text}" in told[name]["description"]["value"]
    handle = phone.page.get_by_label("State along the path")
    assert handle.get_attribute("aria-valuetext") == f"force {numbers['force']}, depth 6.000 nm"
    handle.press("Home")
    phone.wait("explorer.row('force', 'now')[0][0] === 0")
    assert handle.get_attribute("aria-valuetext") == "force 0, depth 0"
    handle.press("End")
    phone.change(phone.press, "Undo")


def test_words_of_all_buttons_in_share_are_in_their_middle(phone):
    """Files are links in buttons, which are 44 pixels high for a finger."""
    page = phone.page
    phone.press("Share")
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
    phone.press("Share")


def test_the_guide_scrolls_into_view_when_it_is_opened(phone):
    """It is above the form, which is below the plots of a phone."""
    page = phone.page
    phone.press("Guide")
    title = page.get_by_label("Guided scene")
    title.wait_for()
    phone.wait("""() => {
      const { top } = explorer.all().find((on) => on.classList.contains("guide")).getBoundingClientRect()
      return top >= 0 && top < innerHeight
    }""")
    assert 0 <= title.bounding_box()["y"] < page.viewport_size["height"]
    phone.press("Guide")
    page.evaluate("scrollTo(0, 0)")


def test_a_zoomed_window_begins_with_a_plot(phone):
    """Of 1280 × 720 pixels at 200 % the whole plot of the springs is on the first screen."""
    page = phone.page
    page.set_viewport_size({"width": 640, "height": 360})
    phone.wait("explorer.model('springs').inner_width > 400")
    page.evaluate("scrollTo(0, 0)")
    box = page.locator(".card.springs").bounding_box()
    assert box["y"] > 0
    assert box["y"] + box["height"] <= 360
    page.set_viewport_size({"width": 390, "height": 844})
    phone.wait("explorer.model('springs').inner_width < 400")


def test_a_finger_zooms(phone, handheld):
    """A touched plot shows its tools, of 44 pixels; a finger draws the box."""
    page, before = phone.page, phone.axis("force")
    box = page.locator(".card.force .bk-OnOffButton")
    page.evaluate("scrollTo(0, 0)")
    place = page.locator(".card.force canvas").first.bounding_box()
    x, y = place["x"] + 0.3 * place["width"], place["y"] + 0.5 * place["height"]
    page.touchscreen.tap(x, y)
    box.wait_for()
    size = box.bounding_box()
    assert min(size["width"], size["height"]) >= 44
    box.tap()
    client = handheld.new_cdp_session(page)
    moves = ("touchStart", 0.0), ("touchMove", 0.1), ("touchMove", 0.25), ("touchEnd", None)
    for kind, share in moves:
        end = share is None
        at = [] if end else [{"x": x + share * place["width"], "y": y + share * place["height"]}]
        client.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": at})
    narrow = "([a, b]) => { const { x } = explorer.axis('force'); return x[1] - x[0] < (b - a) / 2 }"
    phone.wait(narrow, before["x"])
    assert page.evaluate("scrollY") == 0
