"""Someone who sees the page for the first time, and someone who holds it in the hand or uses keys only."""

from itertools import pairwise

from .conftest import Explorer
from .test_report import plain

# All elements, also within components; targets smaller than 24 pixels but links within a text, and of a
# radio button its label; what can be scrolled sideways.
SEEN = """() => {
  const box = (each) => each.getBoundingClientRect()
  const within = explorer.all()
  const targets = within.filter((each) => each.matches(
    "button, input:not([type=radio]), label:has(input), select, summary, .button a, [role=slider]"))
  const size = (each) => Math.min(box(each).width, box(each).height)
  const small = targets.filter((each) => box(each).width > 0 && size(each) < 24)
  const sideways = within.filter((each) => each.scrollWidth > each.clientWidth + 1 &&
    ["auto", "scroll"].includes(getComputedStyle(each).overflowX))
  const name = (each) => `${each.tagName}.${each.className} ${each.ariaLabel ?? each.innerText}`
  const scroll = document.documentElement.scrollWidth
  return { small: small.map(name), sideways: sideways.map(name), scroll }
}"""


def test_a_newcomer_takes_the_report_home(explorer, context):
    """Open, see first yield, change the tip, hit it, read what was destroyed, take the report home."""
    page = explorer.page
    explorer.press("Guide")
    for d in ("1.5", "2"):
        explorer.change(explorer.press, "Next")
        explorer.wait("(d) => explorer.row('force', 'now')[0][0].toFixed(1) === Number(d).toFixed(1)", d)
    page.get_by_role("status").get_by_text("2 of 4.").wait_for()
    explorer.choose("Shape", "Paraboloid")
    explorer.pick("impact")
    assert explorer.readout("damaged_area").endswith("m²")
    page.get_by_role("button", name="A damaged area").click()
    page.get_by_text("Damaged area π c²").wait_for()
    page.keyboard.press("Escape")
    explorer.press("Share")
    with page.expect_download() as download:
        page.get_by_text("Report", exact=True).click()
    path = download.value.path()
    assert "Paraboloid" in plain(path.read_text(encoding="utf-8"))
    kept, outside = context.new_page(), []
    kept.on("request", lambda request: outside.append(request.url))
    kept.goto(f"file://{path.rename(path.with_suffix('.html'))}")
    kept.wait_for_function("window.Bokeh?.documents[0]?.is_idle")
    figures = kept.get_by_role("img", name=": ")
    assert figures.count() == 3
    assert all(figure.bounding_box()["height"] > 200 for figure in figures.all())
    assert [url for url in outside if not url.startswith(("file:", "data:", "blob:"))] == []
    kept.close()


def test_small_screens(server, browser):
    """A phone, in one column, with nothing over anything, where a finger drags; and smaller windows."""
    phone = {"viewport": {"width": 390, "height": 844}, "is_mobile": True, "has_touch": True}
    with browser.new_context(**phone) as context:
        explorer = Explorer(context.new_page(), server.url)
        page = explorer.page
        assert page.evaluate(SEEN) == {"small": [], "sideways": [], "scroll": 390}
        places = [explorer.slider(symbol) for symbol in ("d_max", "s", "E*", "q_c")]
        places += [page.locator(f".card.{name}") for name in ("springs", "pressure", "force")]
        boxes = [place.bounding_box() for place in places]
        assert boxes[0]["y"] < 300
        for one, other in pairwise(boxes):
            assert one["y"] + one["height"] <= other["y"]
        page.locator(".card.springs").scroll_into_view_if_needed()
        box = page.locator(".card.springs canvas").first.bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        touch, places = context.new_cdp_session(page), [[{"x": x, "y": y + 6 * k}] for k in range(8)]
        for kind, points in zip(["touchStart", *7 * ["touchMove"], "touchEnd"], [*places, []], strict=True):
            touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        explorer.wait("explorer.row('force', 'now')[0][0] > 9.2")
        explorer.press("Fit a measurement")
        explorer.change(explorer.press, "Fused silica")
        page.get_by_label("Unit of force").wait_for()
        assert page.evaluate(SEEN)["scroll"] == 390
        page.set_viewport_size({"width": 720, "height": 450})
        explorer.wait("explorer.model('force').inner_width > 400")
        assert page.evaluate(SEEN)["scroll"] == 720
        for width in (1001, 1280):
            page.set_viewport_size({"width": width, "height": 800})
            assert page.evaluate(SEEN)["scroll"] == width
        assert explorer.problems == []


def test_everything_is_reached_by_keys_and_an_equation_leads_to_the_theory(explorer, context):
    """From one stop of the Tab key to the next, every control and explanation comes by, and is outlined."""
    page = explorer.page
    page.locator("h1").click()
    stops = set()
    active = """() => {
        let on = document.activeElement
        while (on?.shadowRoot?.activeElement) on = on.shadowRoot.activeElement
        if (on === document.body) return ["", ""]
        return [on.ariaLabel || on.labels?.[0]?.textContent.trim() || on.textContent.trim(),
                getComputedStyle(on).outlineStyle]
    }"""
    for _ in range(80):
        page.keyboard.press("Tab")
        name, outline = page.evaluate(active)
        stops.add(name)
        assert outline != "none", name
    expected = {
        "Preset", "What is q_c, yield constant?", "q_c, yield constant", "q_c, yield constant, slider",
        "Shape", "Share", "Guide", "Menu", "Hold", "F normal force", "▶ Play", "State along the path",
        "(22)", "Save", "Large", "Sweep", "All numbers",
    }  # fmt: skip
    assert expected <= stops
    with context.expect_page() as opened:
        page.locator(".card.force").get_by_role("link", name="(22)").click()
    page = opened.value
    # The formulas are set, and the page stands where the equation is.
    page.locator("math").first.wait_for()
    page.wait_for_function("scrollY > 500")
    assert page.locator("#eq-22").bounding_box()["y"] < 100
    page.close()
