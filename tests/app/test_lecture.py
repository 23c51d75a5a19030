"""What a lecturer shows: the classes of hardness, the state in words, and where what yields is drawn."""

import re

import numpy as np
import pytest

from app.common.host import last
from app.explorer import changes
from app.explorer.drives import follow
from app.explorer.extras import hardness, labels, oblique, sweep
from app.explorer.extras.guide import TOURS, step_state, step_text
from app.explorer.extras.notes import limits
from app.explorer.plots import PLOTS, D, X
from app.explorer.state import medium, preset_state

from ..approx import approx
from .conftest import DROP, ELASTIC, GOLD, PUNCH
from .states import numbers, solved, state_with, view_of
from .test_hardness import SILICA, STEEL

KINDS = TOURS["Which kind of medium is it?"]


def slope(x, y):
    """Log–log slope of a curve at its end."""
    return float(np.log(y[-1] / y[-2]) / np.log(x[-1] / x[-2]))


def powers(step):
    """Powers of the curves of a sweep at the present value, as its note has them: own, and by class."""
    state = step_state(step, preset_state())
    found = last(sweep.found(follow(state), sweep.asked(state)))
    note = re.sub("</?(sub|i)>", "", found.note).replace("−", "-")
    told = [float(text) for text in re.findall(r"<sup>(-?[\d.]+)</sup>", note)]
    return dict(zip(["own", *re.findall(r"\(([abc])\) \w", note)], told, strict=True))


def test_a_cone_tells_the_classes_by_volume_area_and_depth():
    """d_p ∝ W^(1/3), and so c; A ∝ W; d_p ∝ W. Class (a) exactly, the others to what is missing of deep."""
    a, b, c = KINDS[:3]
    assert powers(a)["own"] == approx(1 / 3, abs=5e-4)
    # The imprint is a cone of one shape: its volume is as c² d_p.
    states = [step_state(a, preset_state()).replace(speed=speed) for speed in (1.0, 2.0)]
    slow, fast = (follow(state).hit for state in states)
    volumes = [hit.plastic_radius**2 * hit.plastic_depth for hit in (slow, fast)]
    assert volumes[1] / volumes[0] == approx(4, rel=1e-9)
    assert slow.restitution == approx(fast.restitution, rel=1e-9)
    assert powers(b)["own"] == approx(1, abs=0.02)
    assert powers(b)["a"] == approx(2 / 3, abs=2e-3)
    assert powers(c)["own"] == approx(1, abs=0.02)
    course = follow(step_state(c, preset_state()))
    most = np.pi * 300
    assert 0.999 * most < float(course.hit.max_force) < most
    assert "π f_c = 942 N" in c["says"]
    assert round(most) == 942


@pytest.mark.parametrize("step", KINDS)
def test_scenes_on_the_classes_are_within_the_assumptions(step):
    state = step_state(step, preset_state())
    assert state.density == 1900
    assert [sentence for level, sentence in limits(follow(state), state) if level == "beyond"] == []


def test_a_step_sets_what_is_the_default_too():
    """After another result has been swept, a step on the damaged area, the first option, shows that."""
    steps = [step for steps in TOURS.values() for step in steps]
    step = next(each for each in steps if each["set"].get("sweep.against") == "damaged_area")
    before = preset_state().replace(**{"sweep.against": "max_depth", "section.stress": "von_mises"})
    state = step_state(step, before)
    assert state["sweep.against"] == "damaged_area"
    # What it does not set stays.
    assert state["section.stress"] == "von_mises"


def test_a_round_nose_tells_them_by_restitution_and_area():
    a, b = KINDS[3:5]
    assert powers(a)["own"] == approx(-1 / 4, abs=2e-3)
    assert powers(a)["b"] == approx(-2 / 3, abs=5e-3)
    assert powers(b)["own"] == approx(2 / 3, abs=0.01)
    assert powers(b)["a"] == approx(1 / 2, abs=0.01)


@pytest.mark.parametrize(("step", "power"), [*zip(KINDS[5:], (0, -1, -2), strict=True)])
def test_the_mean_pressure_over_the_radius_is_drawn_as_the_text_says(step, power):
    """It is the hardness less what the elastic ring lacks: within 2 % of σ_c, 0.02 of the slope."""
    state = step_state(step, preset_state())
    assert (state.tiles, state["hardness.axes"]) == (("hardness",), "log")
    course = follow(state)
    found = hardness.found(course, ("log",))
    assert all(axis.log for axis in found.axes)
    a, p = (column[np.isfinite(column)] for column in found.rows["yielding"])
    assert slope(a, p) == approx(power, abs=0.02)
    r, sigma = found.rows["hardness"]
    assert slope(r, sigma) == approx(power, abs=1e-9)
    assert p[-1] == approx(np.interp(a[-1], r, sigma), rel=0.02)
    if power == 0:
        a, p = (column[np.isfinite(column) & (column > 0)] for column in found.rows["elastic"])
        assert slope(a, p) == approx(1, rel=1e-6)
    said = step_text(step, course)
    share = float(re.search("is ([\\d.]+) of", found.note)[1])
    assert share == approx(
        course.state.mean_pressure / medium(state).hardness_at(course.state.contact_radius), rel=1e-3
    )
    assert f"p_m = {float(course.state.mean_pressure) / 1e6:#.3g} MPa" in said


@pytest.mark.parametrize("key", [GOLD, DROP, PUNCH, ELASTIC, SILICA, STEEL, "microsphere-pdms"])
@pytest.mark.parametrize("scale", ["linear", "log"])
def test_pressures_of_every_preset_are_within_the_axes(key, scale):
    """The curve while yielding, and the state of largest depth with its hardness."""
    course = follow(preset_state(key))
    found = hardness.found(course, (scale,))
    x, y = found.axes
    a, p = float(course.turning_point.contact_radius), float(course.turning_point.mean_pressure)
    assert x.start < a <= x.end
    assert y.start < p <= y.end
    for name, (radii, pressures) in found.rows.items():
        if name == "yielding" and np.isfinite(pressures).any():
            assert np.nanmax(radii) <= x.end
            assert np.nanmax(pressures) <= y.end
    if scale == "log":
        assert y.end / y.start == approx(10**3)


def test_the_state_is_read_in_words():
    """Popov (2015), Eq. (21): the ring of a cone is q_c/(E* s) wide, here 3.193 nm."""
    state = preset_state()
    made = medium(state)
    ring = float(made.q_c / made.E_star / state.cone_slope)
    course = follow(state)
    c = float(course.state.plastic_radius)
    text = f"yielded inside c = {c * 1e9:.1f} nm; elastic ring {ring * 1e9:.2f} nm wide"
    assert labels.sentence(course, course.now) == text
    view = view_of(state)
    assert view.places(PLOTS["springs"], course.now)["reading"][2] == text
    onset = float(made.critical_depth)
    early = f"elastic; the axis yields first, at d = {onset * 1e9:.2f} nm"
    assert {labels.sentence(course, i) for i in np.flatnonzero(course.states.depth[1:20] < onset) + 1} == {
        early
    }
    assert labels.sentence(course, 0) == "no contact"
    assert labels.sentence(course, len(course) - 1) == f"no contact; imprint of radius c = {c * 1e9:.1f} nm"
    punch = follow(preset_state(PUNCH))
    assert "the whole flat face yields first" in labels.sentence(punch, 1)
    assert labels.sentence(punch, punch.peak) == "yielded inside c = 2.00 mm"
    assert labels.sentence(follow(state_with(plasticity="none")), 9) == "elastic; nothing yields"
    # With adhesion the depth of the onset is not that of the springs.
    adhesive = follow(state_with("microsphere-pdms", adhesion="work"))
    assert labels.sentence(adhesive, 0) == "elastic; the axis yields first"


def test_depths_with_a_plastic_zone_are_marked():
    view = view_of(preset_state())
    d, _ = view.places(PLOTS["force"], view.course.now)["plastic zone, on loading"]
    assert (d.min(), d.max()) == (float(view.course.onset.depth), float(view.course.states.depth.max()))
    course = follow(preset_state())
    yielded = course.states.plastic_radius[: course.peak + 1] > 0
    np.testing.assert_array_equal(yielded, course.states.depth[: course.peak + 1] > d.min())
    # An onset that is just ahead is on the axis; nothing is pressed into a zone beyond it.
    view = view_of(preset_state(ELASTIC))
    rows = view.places(PLOTS["force"], view.course.now)
    assert np.max(view.course.states.depth) < float(rows["onset of yield"][0][0]) < view.end(D)
    for state in (
        preset_state(ELASTIC),
        state_with(DROP, damping="eta"),
        preset_state(DROP).replace(plastic_depth=1e-4),
    ):
        view = view_of(state)
        assert np.isnan(view.places(PLOTS["force"], view.course.now)["plastic zone, on loading"]).all()


@pytest.mark.parametrize("share", [10, 30, 100, 1000])
@pytest.mark.parametrize("shape", ["cone", "paraboloid"])
def test_the_elastic_ring_has_a_spring_on_each_side(share, shape):
    """However narrow it is: d/d_y = 1000."""
    state = state_with(DROP, "depth", shape=shape)
    state = state.replace(max_depth=share * float(medium(state).critical_depth))
    view = view_of(state)
    x = view.places(PLOTS["springs"], view.course.now)["elastic"][0].reshape(-1, 9)[:, 0]
    now = view.course.state
    inside = (np.abs(x) > now.plastic_radius) & (np.abs(x) < now.contact_radius)
    assert inside.all()
    assert (x > 0).sum() == (x < 0).sum() >= 1
    assert x.size <= 2 + 2 * (now.contact_radius - now.plastic_radius) / (2 * view.end(X) / 60)


@pytest.mark.parametrize(
    ("angle", "body", "says"),
    [(30, "block", "slips throughout"), (80, "solid", "sticks in part from first contact")],
)
def test_an_oblique_impact_says_whether_it_sticks(angle, body, says):
    """As the core says of the solved impact; at the times in which its elements stick."""
    state = state_with(DROP, "oblique").replace(
        **{"oblique.attack": np.radians(angle), "oblique.body": body}
    )
    course = solved(state)
    assert bool(course.motion.impact.slips_throughout) is (says == "slips throughout")
    text = oblique.forces(view_of(state), 0)["regime"][2]
    assert text.startswith(says)
    if "then slips" in text:
        end = float(course.motion.time[np.flatnonzero(course.motion.stick_radius > 0)[-1]])
        assert float(re.search(r"to ([\d.]+) ms", text)[1]) * 1e-3 == approx(end, rel=0.02)


def test_speed_of_onset_is_a_readout():
    hit = changes.choose(preset_state(), "drive", "impact")
    assert 0 < numbers(follow(hit))["yield_speed"] < hit.speed


def test_quasi_static_pressing_is_said_where_it_is_so():
    """Not of creep that is being computed with viscosity, nor of an impact."""
    pressed = state_with(GOLD, damping="eta")
    creeping = state_with(GOLD, "path", damping="eta", pattern="creep")
    hit = state_with(GOLD, "impact", damping="eta")
    for state, says in ((pressed, True), (creeping, False), (hit, False)):
        sentences = " ".join(text for _, text in limits(follow(state), state))
        assert ("quasi-static here. Dashpots" in sentences) is says
        assert "indent_in_time" not in sentences
