"""Everything that stands on the page says what it is, and leads to the theory."""

import re
from math import radians, tan
from urllib.parse import urlencode

import pytest

from app import link, theory
from app.drives import follow
from app.explorer import Explorer
from app.page import Page
from app.parts import linked, marked, plain
from app.plots import PLOTS
from app.presets import PRESETS
from app.quantities import ABOUT, CHOICES, DATA, QUANTITIES, SHAPES
from app.readouts import cells, heads
from app.tip import read_tip
from app.tour import TOURS
from app.view import View

from .conftest import DROP

# Without a server; Panel's widgets are named as its oldest version allowed asks for.
alone = pytest.mark.filterwarnings("ignore:Widget.name is deprecated:PendingDeprecationWarning")


def places(html):
    """Where the links to the theory of a text lead to."""
    return re.findall(r'href="\?theory=([\w-]+)"', html)


def test_every_number_that_is_read_says_what_it_is():
    for preset in PRESETS:
        explorer = Explorer(preset)
        for more in ({}, {"damping": "tau"}, {"surface": "imprint"}):
            explorer.param.update(**more)
            rows = cells(follow(explorer.scene(), 1.0))
            html = heads(rows)
            assert html.count("popovertarget=") == html.count(" popover id=") == len(rows)
            ids = re.findall(r' popover id="([^"]+)"', html)
            assert len(set(ids)) == len(rows)
    assert all(words["help"].endswith(".") for words in DATA["readouts"].values())
    assert ABOUT.keys() == CHOICES.keys() | {"preset", "shape"}


def test_every_equation_leads_to_the_theory():
    ids = set(re.findall(r'id="((?:eq|section)-\d+)"', theory.html()))
    texts = [plot.formula for plot in PLOTS.values()] + list(ABOUT.values())
    texts += [part for q in QUANTITIES.values() for part in (q.help, q.equation)]
    texts += [part for words in DATA["readouts"].values() for part in words.values()]
    led = {place for text in texts for place in places(linked(text))}
    assert len(led) > 20
    assert led <= ids
    # Each plot and each choice leads somewhere.
    assert all(places(linked(plot.formula)) for plot in PLOTS.values())


def test_the_theory_has_its_formulas_and_begins_where_they_are_explained():
    html = theory.html()
    source = (theory.ASSETS / "theory.md").read_text(encoding="utf-8")
    assert html.count("<p>$$") == source.count("```math")
    assert "```" not in html
    # (11) is where the criterion is stated, not where it is first spoken of.
    after = html[html.index('id="eq-11"') :]
    assert after.index("Then the force at yield") < after.index("</p>")
    assert html.index('id="section-2"') < html.index('id="eq-3"') < html.index('id="section-3"')


@alone
def test_half_angle_beside_the_slope_and_drop_height_beside_the_speed():
    page = Page()
    assert page.controls.notes["slope"].object == "Half-angle 70.30°, flank 19.70° to the surface"
    assert page.explorer.cone_slope == pytest.approx(tan(radians(19.7)), rel=1e-3)
    page.explorer.load(DROP)
    # 5.5 kg at 1 m/s: half a joule a kilogram; v²/2g is 1 m²/s² over 19.6133 m/s².
    said = re.sub("<[^>]+>", "", page.controls.notes["drive"].object)
    assert "= 2.750 J" in said
    assert "= 50.99 mm" in said
    assert page.controls.notes["slope"].object == ""
    assert page.explorer.density == 1900


@alone
def test_a_link_with_another_preset_keeps_its_numbers():
    page = Page({"preset": [DROP.encode()], "drive": [b"impact"], "speed": [b"3.0"]})
    assert page.explorer.speed == 3.0
    assert float(page.way.hit.speed) == 3.0
    page.explorer.load(next(iter(PRESETS)))
    page.tell(page.explorer.undo)
    assert page.explorer.speed == 3.0


def stepped(title):
    """The deepest or present state after each step of a guided scene."""
    for step in TOURS[title]:
        explorer = Explorer()
        link.apply(explorer, link.arguments(urlencode(step["set"])))
        yield follow(explorer.scene(), explorer.progress)


def test_guided_scenes_say_what_is_so():
    elastic, begun, deep, lifted = stepped("First yield")
    assert elastic.state.plastic_radius == 0
    assert elastic.state.pressure(0.0) == float("inf")
    assert begun.state.plastic_radius > 0
    assert begun.state.pressure(0.0) < float("inf")
    # (21): the ring a − c stays as wide as it is.
    rings = [float(way.state.contact_radius - way.state.plastic_radius) for way in (begun, deep)]
    assert rings[0] == pytest.approx(rings[1], rel=1e-9)
    assert lifted.force[lifted.now] == 0
    assert float(lifted.state.depth) == pytest.approx(
        float(deep.state.depth) - elastic.onset.depth, rel=1e-9
    )
    slow, onset, fast, cone, twice = (way.hit for way in stepped("A fast impact, and what it destroys"))
    assert slow.restitution == 1
    assert slow.damaged_area == 0
    assert onset.damaged_area > 0
    assert fast.plastic_work / (fast.mass * fast.speed**2 / 2) > 0.9
    # (24) holds in the limit; d_c/d is 1/20 and 1/40 here.
    assert twice.damaged_area / cone.damaged_area == pytest.approx(4, rel=0.05)
    fast, slow, thick, thin = (way.hit for way in stepped("Why a slow drop bounces better"))
    assert slow.restitution > 4 * fast.restitution
    assert thin.contact_time > 2 * thick.contact_time
    assert thin.restitution > thick.restitution
    assert thick.plastic_work == thin.plastic_work == 0


@alone
def test_a_guided_scene_is_stepped_through_and_undone():
    page = Page()
    page.asked["map"].value = True
    opening = page.explorer.snapshot()
    for at, step in enumerate(TOURS["First yield"]):
        page.tour.next.clicks += 1
        assert page.explorer.max_depth == step["set"]["max_depth"]
        assert page.way.progress[page.way.now] == step["set"].get("at", 1.0)
        assert f"{at + 1} of 4" in page.tour.words.object
        assert "{" not in page.tour.words.object
    assert page.tour.next.disabled
    page.tour.title.value = "A fast impact, and what it destroys"
    assert "e = 1.00" in re.sub("<[^>]+>", "", page.tour.words.object)
    assert page.explorer.plots == ["map"]
    # What it says is gone while the page shows something else.
    page.explorer.speed = 2 * page.explorer.speed
    assert "1 of 5. The page shows something else" in page.tour.words.object
    page.tell(page.explorer.undo)
    assert "e = 1.00" in re.sub("<[^>]+>", "", page.tour.words.object)
    # Each step that sets something is one change.
    for _ in range(4):
        page.tell(page.explorer.undo)
    assert "something else" in page.tour.words.object
    assert page.explorer.snapshot()[0] == opening[0]


def test_python_and_raw_indices_are_not_on_the_page():
    explorer = Explorer()
    shown = [text for texts in CHOICES.values() for text in texts.values()] + [ABOUT["shape"]]
    shown += [quantity.label for quantity in QUANTITIES.values()]
    shown += [axis.label for choice in ("units", "ratio") for axis in axes(explorer, choice)]
    assert [text for text in shown if "_" in text] == []
    for shape in SHAPES.values():
        assert "_" not in marked(shape.height + shape.reduced)
    with pytest.raises(ValueError, match=r"E₁ = 1\.000 mPa is out of bounds"):
        explorer.checked("E_1", 1e-3)
    explorer.choose("shape", "flat_punch")
    explorer.choose("drive", "path")
    explorer.choose("prescribed", "force")
    most = 2 * explorer.medium().yield_line_load * explorer.profile().wall
    explorer.path = [(k * most / 3,) for k in range(1, 6)]
    with pytest.raises(ValueError, match="of 5 entries") as refused:
        explorer.scene().solve()
    said = plain(str(refused.value))
    assert "[" not in said
    assert "entries" not in said
    with pytest.raises(ValueError, match="header must name") as refused:
        read_tip("0, 0\n1, 1\n")
    assert plain(str(refused.value)).endswith("m, mm, um, µm, μm, nm")
    assert plain("give depth_noise, about 54 pm") == "give depth noise, about 54 pm"
    assert (
        plain("scene medium: effective modulus E_star = -1 Pa") == "scene medium: effective modulus = -1 Pa"
    )
    with pytest.raises(ValueError, match="no JSON text"):
        link.load_scene(explorer, "")


def axes(explorer, choice):
    way = follow(explorer.scene(), 1.0)
    return View(way, chosen={"axes": choice}).axes.values()
