"""Links: what they hold, names that are gone, foreign and hostile ones, and the address."""

import numpy as np
import pytest

from app.common.tip import read_tip
from app.explorer import changes, link
from app.explorer.drives import DRIVES, scene_of
from app.explorer.page import Page
from app.explorer.state import PRESETS, VIEW, preset_state, used

from ..conftest import DROP, GOLD, PUNCH
from ..states import linked_state, press, put, state_with, view_of


def test_the_link_of_a_preset_is_its_name():
    for key in PRESETS:
        assert link.write(preset_state(key)) == ("" if key == GOLD else f"preset={key}")
    assert link.write(preset_state().replace(max_depth=2e-9)) == "max_depth=2e-09"


@pytest.mark.parametrize("drive", DRIVES)
def test_a_link_holds_the_whole_page(drive):
    state = state_with(DROP, drive, damping="eta", shape="sphere")
    state = state.replace(at=0.75, tiles=("sweep", "section"), **{"hardness.axes": "log"})
    others = {"held.scenes": (link.write(state),), "section.stress": "zz"}
    state = state.replace(**others)
    again = linked_state(state)
    assert scene_of(again) == scene_of(state)
    for name in (*VIEW, *others):
        assert again[name] == state[name], name
    assert scene_of(link.read(again["held.scenes"][0])) == scene_of(state)
    assert len(link.write(state)) < 700


#: Links, and what they say.
LINKS = {
    f"preset={DROP}&speed=2.0&at=1.5&tiles=sweep&sweep.swept=mass&sweep.against=restitution": {
        "speed": 2.0, "at": 1.5, "tiles": ("sweep",), "sweep.swept": "mass",
        "sweep.against": "restitution",
    },
    "drive=path&path.pattern=hold&path.ramp_time=0.5&damping=eta&eta=3.0": {
        "drive": "path", "path.pattern": "hold", "path.ramp_time": 0.5, "eta": 3.0,
    },
    f"preset={DROP}&drive=oblique&oblique.body=solid&oblique.incoming_speed=5.0&oblique.attack=0.5": {
        "oblique.body": "solid", "oblique.incoming_speed": 5.0, "oblique.attack": 0.5,
    },
    "tiles=section&section.stress=zz&held.scenes=shape%3Dcone%26cone_slope%3D0.2&dark=1": {
        "section.stress": "zz", "held.scenes": ("shape=cone&cone_slope=0.2",), "dark": True,
    },
    "tiles=hardness&hardness.axes=log": {"tiles": ("hardness",), "hardness.axes": "log"},
    # A hardness is that of class (b) at a radius.
    "plasticity=hardness&hardness=2000000000.0&hardness_radius=5e-08": {"q_c": 100.0, "hardness": 2e9},
}  # fmt: skip


@pytest.mark.parametrize("query", LINKS)
def test_links_are_read(query):
    state = link.read(query)
    assert {name: state[name] for name in LINKS[query]} == LINKS[query]
    assert link.unknown(query) == []


@pytest.mark.parametrize("drive", ["depth", "force", "impact", "oblique"])
@pytest.mark.parametrize("key", [GOLD, DROP, PUNCH])
def test_a_link_without_the_size_of_its_drive_has_that_of_the_button(key, drive):
    """Mass, force or depth; a link that gives it keeps it, be it the one that a state has at first."""
    chosen = changes.choose(preset_state(key), "drive", drive)
    read = link.read(f"preset={key}&drive={drive}")
    if drive in ("depth", "force") or "mass" not in PRESETS[key].values:
        assert [read[name] for name in used(read)] == [chosen[name] for name in used(chosen)]
    else:
        assert read.mass == preset_state(key).mass
    of_default = chosen.replace(mass=1.0, max_force=1.0)
    again = link.read(link.write(of_default))
    assert [again[name] for name in used(again)] == [of_default[name] for name in used(again)]


def test_a_body_of_a_link_that_names_the_drive_alone_is_seen():
    """One of 1 kg went 42 mm into gold under the nanocone, and the plots were empty."""
    states = view_of(link.read("drive=impact")).course.states
    assert states.depth.max() < 1e-7
    assert states.force.max() > 0


#: Links with names that are gone, which are told, and what is left of each.
GONE = {
    "max_depth=5e-09&tiles=radii+hardness+relief": (
        ["tiles=radii", "tiles=relief"],
        {"tiles": ("hardness",)},
    ),
    "max_depth=5e-09&log=force&hold=at%3D1": (["log", "hold"], {"held.scenes": ()}),
    "max_depth=5e-09&scales.keep=1&present.on=1": (["scales.keep", "present.on"], {"dark": False}),
    "max_depth=5e-09&fit.fixed=q_c&fit_note=fit": (["fit.fixed", "fit_note"], {"tiles": ()}),
}  # fmt: skip


@pytest.mark.parametrize("query", GONE)
def test_names_that_are_gone_are_left_out_of_a_link_with_one_line(query, notices):
    names, left = GONE[query]
    page = Page(query)
    (notice,) = notices
    assert notice.endswith(f": {', '.join(names)}")
    assert page.state.max_depth == 5e-9
    assert {name: page.state[name] for name in left} == left
    assert not any(name in page.query()[0] for name in names)


@pytest.mark.parametrize(
    ("query", "says"),
    [
        ("max_depth=1e400", "max_depth = “1e400”"), ("max_depth=-1e400", "max_depth = “-1e400”"),
        ("max_depth=deep", "max_depth = “deep”"), ("max_depth=nan", "max_depth = “nan”"),
        ("max_depth", "max_depth = “”"), ("max_depth=+", "max_depth = “ ”"), ("shape=", "shape = “”"),
        ("shape=ball", "shape = “ball”"), ("at=", "at = “”"), ("at=nan", "at = “nan”"),
        ("at=7", "at = “7” .* 2.2"), ("preset=none", "preset = “none”"), ("shape=sampled", "shape"),
        ("shape=sphere", "shape"), ("shape=sampled&samples=0,0 1", "samples"), ("cone_slope=1e9", "bounds"),
        ("shape=cone&shape=cone", "twice"), ("q_c=" + 9000 * "1", "too long"),
        ("held.scenes=a b c d e", "more than 4"), ("drive=path&path.pattern=own", "path.pattern|vertices"),
    ],
)  # fmt: skip
def test_a_link_is_refused_for_what_is_wrong(query, says):
    with pytest.raises(ValueError, match=says):
        link.read(query)


def test_what_others_append_to_a_link_is_left_out_and_other_names_are_told():
    query = (
        "utm_source=teams&max_depth=5e-09&fbclid=IwAR"
        + 9000 * "0"
        + "&utm_source=a&foo=1&held.scenes=bar%3D2"
    )
    state = link.read(query)
    assert (state.max_depth, link.write(state.replace(**{"held.scenes": ()}))) == (5e-9, "max_depth=5e-09")
    assert link.unknown(query) == ["foo"]
    appended = "UTM_SOURCE=a&mkt_tok=b&mibextid=c&si=d&vero_id=e&ref=f&FBCLID=g"
    assert link.unknown(appended) == []
    assert link.read(appended) == preset_state()
    # Names that only begin like these, or like a number of the page, are told.
    assert link.unknown("size=1&refer=2&MAX_DEPTH=3") == ["size", "refer", "MAX_DEPTH"]
    state = preset_state(DROP).replace(at=0.5, tiles=("sweep",), dark=True)
    state = state.replace(**{"held.scenes": ("at=1",)})
    assert link.unknown(link.write(state)) == []


@pytest.mark.parametrize(
    ("query", "says"),
    [
        ("preset=none", "preset = “none”"), ("E_1=1&E_2=1&nu_1=0&nu_2=0", "bounds"),
        ("elasticity=bodies&E_1=1e14&E_2=1e14&nu_1=-0.99&nu_2=-0.99&tiles=sweep", "bounds"),
        ("plasticity=hardness&hardness=1e14&hardness_radius=100", "bounds"),
    ],
)  # fmt: skip
def test_a_link_that_cannot_be_opened_is_a_notice_on_the_opening_scene(query, says, notices):
    page = Page(query)
    assert says in notices[0]
    assert page.state == preset_state()


def test_a_scene_without_a_link_leaves_the_address(page):
    r = np.linspace(0, 500, 60)
    rows = "\n".join(f"{each:.6f},{each**2 / 1234.567:.6f}" for each in r)
    page.apply(lambda state: changes.take_tip(state, *read_tip(f"r (nm), z (nm)\n{rows}", "tip.csv")))
    for _ in range(3):
        press(page, "Compare")
        put(page, "max_depth", 0.9 * page.state.max_depth)
        page._input_rests()
    query, why = page.query()
    assert query == ""
    assert why
    assert page.messages.address == ""


def test_a_link_is_opened_as_far_as_it_is_known_or_refused_in_words(explorer):
    """Also where Panel cannot read it; a refused link stays in the address until something is changed."""
    page, start = explorer.page, explorer.page.url.split("?")[0]
    told = page.locator(".notyf__message")

    def opened(query):
        page.goto(f"{start}?{query}")
        explorer.wait("window.explorer?.idle()")
        return explorer.readout("depth")

    assert opened("max_depth=5e-9&utm_source=teams&fbclid=I&foo=²") == "5.000 nm"
    told.first.wait_for()
    (notice,) = told.all_inner_texts()
    assert notice.endswith(": foo")
    assert explorer.link("max_depth=5e-09") == {"max_depth": "5e-09"}
    for query in ("preset=<img src=x>", "fit_note=<img src=x>"):
        opened(query)
        told.first.wait_for()
        assert page.locator("img[src=x]").count() == 0
    query = f"q_c={5000 * '1'}"
    assert opened(query) == "8.978 nm"
    told.filter(has_text="q_c").wait_for()
    assert page.url == f"{start}?{query}"
    explorer.change(explorer.type, "d_max", "7 nm")
    assert explorer.link("max_depth=") == {"max_depth": "7e-09"}
    # The opening scene has an address without a query.
    explorer.change(explorer.press, "Undo")
    explorer.wait("!location.href.includes('?')")
