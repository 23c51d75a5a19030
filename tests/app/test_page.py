"""The served page in a real browser: what a person sees agrees with the core, whatever they do."""

import re

import numpy as np
import pytest

import mdr_core as mdr
from app.explorer import changes
from app.explorer.drives import follow, scene_of
from app.explorer.figures import Picture
from app.explorer.plots import PLOTS
from app.explorer.state import PRESETS, State, preset_state
from mdr_core.show.units import UNITS, written

from ..approx import approx
from .conftest import DROP, ELASTIC, GOLD, PUNCH, Explorer
from .states import state_with, table, view_of


def unit(label, kind):
    """SI size of the unit that an axis label names."""
    name = label.rpartition("(")[2].rstrip(")")
    return next(each.factor for each in UNITS[kind] if each.name == name)


def now(explorer):
    """Depth and force (SI) of the mark in the plot of force and depth."""
    labels = explorer.axis("force")["labels"]
    x, y = explorer.row("force", "now")
    return [x[0] * unit(labels[0], "length"), y[0] * unit(labels[1], "force")]


def assert_draws(explorer, state: State):
    """All that the page draws of the present state is what the plots have of `state`."""
    view = view_of(state, state.at)
    shown = view.course.state
    np.testing.assert_allclose(now(explorer), (shown.depth, shown.force), rtol=1e-3, atol=1e-30)
    for figure, name in (("springs", "yielded"), ("springs", "profile g(x)"), ("pressure", "p(r)")):
        columns = Picture(PLOTS[figure]).columns(view, view.course.now)
        data = next(data for data in columns.values() if name in data["row"])
        k = data["row"].index(name)
        places = np.array([data["xs"][k], data["ys"][k]], float)
        np.testing.assert_allclose(explorer.row(figure, name), places, rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize(("width", "height"), [(1280, 720), (1440, 900)])
def test_the_first_screen_has_what_a_person_comes_for(server, context, width, height):
    """The drive with its slider first, shape, E* and q_c; one line of readouts; three plots, all whole."""
    explorer = Explorer(context.new_page(), server.url, window=(width, height))
    page = explorer.page
    # A field and a slider each.
    inputs = [each.bounding_box() for each in page.locator(".number input:visible").all()]
    assert [box["y"] + box["height"] <= height for box in inputs] == 8 * [True]
    assert explorer.slider("d_max").bounding_box()["y"] < 0.3 * height
    for name in ("springs", "pressure", "force"):
        card = page.locator(f".card.{name}").bounding_box()
        assert card["y"] + card["height"] <= height
        assert card["x"] + card["width"] <= width
        assert card["width"] > 0.3 * width
        assert card["height"] > 0.3 * height
    assert page.locator("output").count() <= 8
    assert page.locator(".header .act:visible, .more .act:visible").count() == 5
    assert page.locator(".top").bounding_box()["height"] < 70
    assert page.evaluate("document.documentElement.scrollHeight") <= height
    assert explorer.problems == []
    explorer.page.close()


def test_the_page_opens_on_a_cone_that_has_yielded_and_says_what_everything_is(explorer):
    """Every control has a name and an explanation; tooltips are of the data and their own axis."""
    assert_draws(explorer, preset_state())
    assert explorer.page.title() == "Indentation explorer"
    assert explorer.readout("force") == "4.514 µN"
    assert explorer.readout("relative_depth") == "5.000"
    assert explorer.slider("d_max").input_value() == "200"
    assert explorer.axis("springs")["x"] == explorer.axis("pressure")["x"]
    page = explorer.page
    for each in page.locator("input:visible, select:visible, textarea:visible").all():
        named = each.evaluate("(on) => on.ariaLabel || on.labels?.[0]?.textContent.trim()")
        assert named, each.evaluate("(on) => on.outerHTML")
    assert page.get_by_role("slider", name="State along the path").count() == 1
    page.get_by_label("What is q_c, yield constant?").click()
    about = explorer.number("q_c").locator(".about")
    assert "Hardness times contact radius" in about.inner_text()
    assert "(11)" in about.inner_text()
    explorer.open("Hardness", "hardness", "yielding")
    a, _ = explorer.row("hardness", "yielding")
    tip = explorer.hover("hardness", "yielding", len(a) * 2 // 3)
    assert re.fullmatch(r"pₘ = [\d.]+ GPa", tip[1])
    assert re.fullmatch(r"a = [\d.]+ nm", tip[2])


def test_it_plays_by_the_space_bar_also_while_the_scene_changes(explorer):
    """From the end of the path it begins anew; where it pauses is the state of the page and its link."""
    page = explorer.page
    slider, play = page.get_by_label("State along the path"), page.locator(".player button")
    # The state of the largest depth is marked, below the middle of the thumb, which is 14 px wide.
    box = slider.bounding_box()
    thumb = (
        box["x"] + 7 + (box["width"] - 14) * int(slider.input_value()) / int(slider.get_attribute("max"))
    )
    mark = page.locator(".player .marks i").first.bounding_box()
    assert abs(mark["x"] + mark["width"] / 2 - thumb) < 1
    assert slider.locator("xpath=..").locator(".marks span").all_inner_texts() == [
        "largest depth",
        "loss of contact",
    ]
    plot = "Bokeh.index.find_one(explorer.model('force')).el"
    explorer.wait(f"{plot}.ariaDescription?.includes('depth 8.978 nm')")
    assert slider.get_attribute("aria-valuetext") == "force 4.514 µN, depth 8.978 nm"
    slider.press("End")
    explorer.wait("explorer.played() && explorer.idle()")
    slider.press("Space")
    assert play.inner_text() == "❚❚ Pause"
    explorer.wait("explorer.row('force', 'now')[1][0] > 0")
    explorer.slider("q_c").press("PageUp")
    explorer.wait("explorer.played() && explorer.idle()")
    assert play.inner_text() == "❚❚ Pause"
    seen = now(explorer)
    explorer.wait("(depth) => Math.abs(explorer.row('force', 'now')[0][0] - depth) > 0.5", seen[0] * 1e9)
    # Long before the end, which is the state that the link has.
    explorer.wait("player.value > 5 && player.value < 40")
    explorer.change(play.click)
    assert play.inner_text() == "▶ Play"
    stopped, words = slider.input_value(), slider.get_attribute("aria-valuetext")
    drawn, text = now(explorer), explorer.readout("depth")
    assert words.endswith(f"depth {text}")
    explorer.goto(page.url)
    assert slider.input_value() == stopped
    assert now(explorer) == drawn
    assert explorer.readout("depth") == text


def test_keys_player_and_hand_move_every_plot(explorer):
    """Playing needs no server; the indenter and the mark are dragged."""
    page = explorer.page
    for symbol in ("s", "q_c", "d_max"):
        before, text = now(explorer), explorer.field(symbol).input_value()
        explorer.slider(symbol).focus()
        explorer.change(page.keyboard.press, "PageUp")
        assert explorer.field(symbol).input_value() != text
        assert now(explorer) != before
    explorer.choose("Preset", PRESETS[GOLD].label)
    assert_draws(explorer, preset_state())
    # The indenter is taken by the hand: deeper, and one change to undo.
    explorer.drag("springs", (0, 0.2))
    explorer.wait("explorer.row('force', 'now')[0][0] > 9.5 && explorer.model('dragging').depth === null")
    explorer.wait("explorer.idle()")
    explorer.link("max_depth=")
    assert explorer.slider("d_max").input_value() != "200"
    explorer.change(explorer.press, "Undo")
    assert_draws(explorer, preset_state())
    page.get_by_label("State along the path").press("End")
    explorer.wait("explorer.played() && explorer.row('force', 'now')[1][0] === 0")
    assert explorer.readout("contact_radius") == "0"
    explorer.link("at=2.2")
    # A frame is the picture that the server draws of its state.
    page.evaluate("player.go(70)")
    explorer.wait("explorer.row('force', 'now')[1][0] > 0 && explorer.idle()")
    canvases = [page.locator(f".card.{name} canvas").first for name in ("springs", "pressure")]
    frame = [canvas.screenshot() for canvas in canvases]
    page.evaluate("player.rest()")
    assert explorer.link("at=0.")["at"] != "2.2"
    assert frame == [canvas.screenshot() for canvas in canvases]
    page.mouse.move(0, 0)
    explorer.sent.clear()
    before = explorer.row("force", "now")
    explorer.drag("force", (-0.15, 0.1))
    explorer.wait("(old) => explorer.row('force', 'now')[0][0] !== old", before[0][0])
    # Where it ends is all that the server hears.
    assert len(explorer.sent) <= 6
    page.locator("h1").click()
    page.keyboard.press(" ")
    first = explorer.row("force", "now")[0][0]
    explorer.wait("(old) => Math.abs(explorer.row('force', 'now')[0][0] - old) > 0.01", first)
    page.keyboard.press(" ")
    page.get_by_role("button", name="▶ Play").wait_for()
    assert 0 <= float(explorer.link("at=")["at"]) <= 2.2


def test_titles_of_axes_are_painted_with_their_new_units(explorer):
    """Also where a legend gets shorter, so that Bokeh paints the title before it has made the new one."""
    page, canvas = explorer.page, explorer.page.locator(".card.force canvas").first

    def title():
        return page.screenshot(clip=canvas.bounding_box() | {"width": 40})

    page.set_viewport_size({"width": 1280, "height": 720})
    explorer.wait("explorer.model('force').inner_width < 420")
    explorer.change(explorer.type, "d_max", "1.5")
    assert explorer.axis("force")["labels"][1] == "F, normal force (nN)"
    seen = title()
    page.evaluate("explorer.model('force').change.emit()")
    page.wait_for_function("Bokeh.documents[0].is_idle")
    assert title() == seen


def test_typed_numbers_are_read_as_they_say_refused_where_they_stand_and_undone(explorer):
    """What is refused stays in its field, which says why."""
    number, field = explorer.number("d_max"), explorer.field("d_max")
    explorer.change(explorer.type, "d_max", "1e3")
    assert now(explorer)[0] == approx(1e-6)
    # In the unit that the field shows, with an exponent or without.
    assert field.input_value() == "1000 nm"
    # Its slider begins anew about what it does not reach.
    assert explorer.slider("d_max").input_value() == "200"
    explorer.change(explorer.press, "Undo")
    refused = {"abc": "is not a number", "1000 m": "out of bounds", "<img src=x>": "<img src=x>"}
    for text, why in refused.items():
        explorer.type("d_max", text)
        number.locator("p.said", has_text=why).wait_for()
        assert field.input_value() == text
        assert field.get_attribute("aria-invalid") == "true"
        assert number.locator("img").count() == 0
    assert_draws(explorer, preset_state())
    explorer.change(explorer.type, "d_max", "5 nm")
    assert field.get_attribute("aria-invalid") == "false"
    explorer.change(explorer.slider("d_max").dblclick, position={"x": 3, "y": 2})
    explorer.wait("explorer.row('force', 'now')[0][0].toFixed(3) === '8.978'")


def test_presets_shapes_drives_and_media_are_drawn(explorer):
    for key in (PUNCH, "berkovich-pdms"):
        explorer.choose("Preset", PRESETS[key].label)
        assert_draws(explorer, preset_state(key))
    state = preset_state("berkovich-pdms")
    explorer.choose("Shape", "Sphere")
    state = changes.choose(state, "shape", "sphere")
    assert_draws(explorer, state)
    explorer.press("More about the medium")
    for text, *choice in (
        ("force", "drive", "force"),
        ("E*", "elasticity", "modulus"),
    ):  # fmt: skip
        explorer.pick(text)
        state = changes.choose(state, *choice)
        assert_draws(explorer, state)
    assert explorer.page.get_by_text("Altered. Where the preset's numbers come from").count() == 1
    # Elements of the page after many changes of drive are as many as before.
    counts = []
    for _ in range(3):
        for drive in ("depth", "path", "impact", "oblique", "force"):
            explorer.pick(drive)
        counts.append(explorer.page.evaluate("explorer.all().length"))
    assert counts[2] == approx(counts[0], rel=0.05)


def test_an_impact_is_swept_shown_in_time_and_repeated_on_the_same_spot(explorer):
    """The sweep moves with a slider, each axis in time has its own unit, and one plot can be large."""
    explorer.choose("Preset", PRESETS[DROP].label)
    hit = scene_of(preset_state(DROP)).solve()
    explorer.open("Sweep", "sweep", "this scene")

    def present():
        labels = explorer.axis("sweep")["labels"]
        (x,), (y,) = explorer.row("sweep", "present value")
        return x * unit(labels[0], "energy"), y * unit(labels[1], "area")

    assert present() == approx((2.75, float(hit.damaged_area)), rel=1e-4)
    explorer.slider("v_0").focus()
    explorer.change(explorer.page.keyboard.press, "PageUp")
    assert present()[0] > 2.75
    before = explorer.page.locator(".card.springs").bounding_box()
    explorer.page.locator(".card.springs").get_by_role("button", name="Large").click()
    explorer.wait("(wide) => explorer.model('springs').inner_width > 1.5 * wide", before["width"] * 0.8)
    slider, springs = explorer.slider("v_0"), explorer.page.locator(".card.springs")
    assert slider.bounding_box()["x"] + slider.bounding_box()["width"] <= springs.bounding_box()["x"]
    springs.get_by_role("button", name="Small").click()
    explorer.change(explorer.press, "Undo")
    explorer.open("In time", "motion", "depth d")
    assert re.fullmatch(r"d = [\d.]+ [µm]m", explorer.hover("motion", "depth d", 20)[1])
    assert re.fullmatch(r"F = [\d.]+ kN", explorer.hover("motion", "force F", 40)[1])
    explorer.change(explorer.press, "Hit again")
    again = mdr.impact(hit.profile, hit.medium, hit.mass, hit.speed, plastic_depth=hit.plastic_depth)
    assert explorer.readout("restitution") == f"{float(again.restitution):.4f}"


def test_an_oblique_impact_a_path_and_a_section_are_found_at_rest(explorer):
    explorer.choose("Preset", PRESETS[ELASTIC].label)
    explorer.pick("oblique")
    explorer.page.get_by_label("Fourth plot").select_option(label="Friction")
    hit = scene_of(state_with(ELASTIC, "oblique")).solve()
    explorer.wait("explorer.model('forces')")
    explorer.page.locator(".lights span", has_text="so far").wait_for(state="hidden")
    explorer.link("tiles=forces")
    _, force = explorer.row("forces", "tangential force Fₓ")
    assert np.max(np.abs(force)) == approx(float(hit.max_tangential_force), rel=1e-3)
    explorer.pick("path")
    explorer.choose("Pattern", "five cycles, growing")
    explorer.change(explorer.type, "d_max", "8 µm")
    explorer.open("Section", "section", "contact radius a")
    state = state_with(ELASTIC, "path", pattern="cycles").replace(max_depth=8e-6)
    a = float(follow(state).turning_point.contact_radius)
    found = "(a) => Math.abs(explorer.row('section', 'contact radius a')[0][0] / a - 1) < 1e-3"
    explorer.wait(found, a * 1e6)


def test_scenes_are_held_and_come_back_from_the_address_in_the_dark(explorer):
    page = explorer.page
    for depth in ("4 nm", "7 nm"):
        explorer.change(explorer.type, "d_max", depth)
        explorer.change(explorer.press, "Compare")
    for k, text in ((1, "= 4 nm"), (2, "= 7 nm")):
        page.locator(".held .key").get_by_text(text).first.wait_for()
        box = page.get_by_role("button", name=f"Remove {k}").bounding_box()
        assert box["x"] + box["width"] <= 312
    explorer.change(explorer.press, "Remove 2")
    explorer.press("Dark")
    explorer.wait("document.documentElement.classList.contains('dark')")
    explorer.change(explorer.type, "q_c", "90 N/m")
    explorer.link("q_c=90")
    # It has the name of what differs from the present scene, in the legend, too.
    name, legend = "dₘₐₓ = 4 nm, qc = 100 N/m", page.locator(".card.force .key")
    legend.get_by_text("= 4 nm").wait_for()
    assert "dmax = 4 nm, qc = 100 N/m" in legend.inner_text()
    held = explorer.row("force", name)
    page.reload()
    explorer.wait("window.explorer?.idle() && document.documentElement.classList.contains('dark')")
    np.testing.assert_allclose(explorer.row("force", name), held, rtol=1e-6)
    assert explorer.field("q_c").input_value() == "90 N/m"
    assert page.get_by_role("button", name="Undo").count() == 0


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


def test_an_error_of_a_tip_stands_beside_its_field_until_a_good_file(explorer, tmp_path):
    """No notice covers a plot."""
    page, path, r = explorer.page, tmp_path / "tip.csv", np.linspace(0, 60, 40)
    page.get_by_label("Shape", exact=True).select_option(label="Measured tip: a file")
    tip, said = page.get_by_label("CSV file of a measured tip: r, z"), page.locator(".file .said:visible")
    path.write_text(table({"r": r, "z": r**2 / 100}), encoding="utf-8")
    tip.set_input_files(path)
    # It is read in a process of its own.
    said.filter(has_not_text="Reading").wait_for()
    assert said.inner_text().startswith("tip.csv: the header must name the units of r and z")
    assert "unit=" not in said.inner_text()
    assert page.locator(".notyf__toast").count() == 0
    path.write_text(table({"r (metres)": 1e-3 * r, "z (metres)": 1e-5 * r**2}), encoding="utf-8")
    tip.set_input_files(path)
    said.wait_for(state="detached")
    chosen = page.get_by_label("Shape", exact=True).locator("option:checked")
    chosen.filter(has_text=re.compile("^Measured tip$")).wait_for(state="attached")


def test_a_held_scene_that_is_none_is_told_and_leaves_the_address(server, context):
    explorer = Explorer(context.new_page(), f"{server.url}?held.scenes=garbage&q_c=50")
    explorer.page.get_by_text(
        "Unknown names in this link are ignored: held.scenes=garbage"
    ).first.wait_for()
    assert explorer.field("q_c").input_value() == "50 N/m"
    explorer.wait("!location.search.includes('garbage')")
    assert explorer.link("q_c") == {"q_c": "50.0"}
    explorer.page.close()
    assert explorer.problems == []


def test_what_is_shared_comes_back(explorer, tmp_path):
    """A picture with title and legend; link and Python; a measured tip."""
    png = explorer.save("pressure")
    width, height = (int.from_bytes(png[k : k + 4], "big") for k in (16, 20))
    assert min(width / 840, height / 600) >= 1
    page = explorer.page
    explorer.press("Share")
    code = page.get_by_label("This scene in Python")
    page.wait_for_function("(on) => on.value.includes('scene.solve()')", arg=code.element_handle())
    assert page.get_by_label("Link to this page").input_value() == page.url.split("?")[0]
    explorer.press("Share")
    page.get_by_label("Shape", exact=True).select_option(label="Measured tip: a file")
    path, r = tmp_path / "tip.csv", np.linspace(0, 60, 40)
    path.write_text(table({"r (nm)": r, "z (nm)": r**2 / 100}, "; ", comma=True))
    explorer.change(page.get_by_label("CSV file of a measured tip: r, z").set_input_files, path)
    assert explorer.chosen("Shape") == "Measured tip"
    assert page.get_by_text("40 samples, as in the file").count() == 1


def test_a_slider_that_is_moved_while_the_player_runs_is_as_quick_as_at_rest(explorer):
    """No frames arrive between its moves, the readouts are those of the scene, and then it plays on."""
    page = explorer.page
    explorer.press("▶ Play")
    explorer.wait("explorer.played() && player.value !== 0")
    page.evaluate("""() => {
      const messages = explorer.model("messages")
      window.heard = []
      messages.properties.frames.change.connect(() => heard.push(["frames", messages.frames.length]))
      messages.properties.words.change.connect(() => {
        if (!messages.frames.length) heard.push(["depth", messages.words.match(/"depth">([^<]*)/)[1]])
      })
    }""")
    before = float(preset_state().max_depth)
    explorer.slider("d_max").focus()
    for _ in range(4):
        page.keyboard.press("PageUp")
    explorer.wait("explorer.played() && heard.length > 2")
    heard = page.evaluate("heard")
    frames = [count for kind, count in heard if kind == "frames"]
    # Taken back at a move, and sent at rest: once, unless the input rests between keys on a slow machine.
    assert frames == len(frames) // 2 * [0, 4]
    explorer.link("max_depth=")
    depth = float(explorer.link("max_depth=")["max_depth"])
    assert depth > before
    # What is told before the new frames is of the scenes that are set, at their largest depth.
    told = [text for kind, text in heard if kind == "depth"]
    assert told[-1] == written(depth, "length")
    value = page.evaluate("player.value")
    explorer.wait("(old) => player.value !== old", value)
    explorer.press("❚❚ Pause")
