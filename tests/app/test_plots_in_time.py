"""Plots over time: what a band, a mark and a colour stand for."""

import numpy as np
import pytest
from scipy.integrate import trapezoid

from app.explorer.plot import View, rows_of
from app.explorer.plots import PLOTS

from ..approx import approx
from .states import solved, view_of, viscous
from .test_drives import oblique_state


@pytest.fixture(scope="module")
def oblique():
    state = oblique_state()
    return View(state, solved(state))


def test_a_band_of_the_energy_is_as_high_as_what_it_is_named_after(oblique):
    """With dashpots, and with friction, of which some is left at the end."""
    names = {
        "friction": "friction_work", "plastic": "plastic_work", "viscous": "viscous_work",
        "stored": "stored_energy", "kinetic": "kinetic_energy",
    }  # fmt: skip
    for view, lost in ((view_of(viscous()), {"plastic", "viscous"}), (oblique, {"friction"})):
        rows, motion = view.places(PLOTS["energy"], view.course.now), view.course.motion
        seen = {name for name in names if np.isfinite(rows[name][0]).any()}
        assert seen == lost | {"stored", "kinetic"}
        for name in seen:
            upper, lower = np.split(rows[name][1], 2)
            # To the rounding of a sum of them.
            expected = getattr(motion, names[name])
            np.testing.assert_allclose(upper - lower[::-1], expected, atol=1e-12 * upper.max())
            assert (expected[-1] > 0.01 * upper.max()) == (name in lost | {"kinetic"})


def test_marks_of_the_present_time_are_on_the_curves_that_they_are_of(oblique):
    for name, curves in (
        ("motion", {"now": "depth d", "F now": "force F"}),
        ("forces", {"now": "tangential force Fₓ", "F now": "normal force F"}),
    ):
        i = len(oblique.course) // 3
        rows = oblique.places(PLOTS[name], i)
        axes = {row.name: row.axis for row in rows_of(PLOTS[name])}
        for mark, curve in curves.items():
            assert axes[mark] == axes[curve]
            assert [part[0] for part in rows[mark]] == [part[i] for part in rows[curve]]


def test_the_drawn_force_of_friction_takes_the_speed_that_is_lost(oblique):
    """∫ Fₓ dt = m_t Δv, and nowhere is it more than μF."""
    time, force = oblique.places(PLOTS["forces"], 0)["tangential force Fₓ"]
    drive = oblique.course.scene.drive
    lost = drive.tangential_speed - oblique.course.rebound.contact_velocity
    # By the trapezoidal rule over 120 instants.
    assert trapezoid(force, time) == approx(drive.tangential_mass * lost, rel=2e-3)
    assert np.all(np.abs(force) <= drive.friction * oblique.course.states.force * (1 + 1e-9))


def test_one_thing_has_one_colour_on_all_plots():
    """Orange is what has yielded, as the form says; stick and slip are told apart by theirs."""
    colours = {
        "yielded": {
            "yielded", "yielding", "plastic", "plastic work Wₚ", "plastic zone r < c", "residual imprint",
            "at c",
        },
        "elastic": {"elastic", "unloading", "stored", "given back"},
        "stick": {"sticks", "tangential force Fₓ"},
        "slip": {"slips", "friction", "largest friction ±μF"},
    }  # fmt: skip
    rows = [row for plot in PLOTS.values() for row in rows_of(plot)]
    for role, names in colours.items():
        assert {row.name for row in rows} >= names
        assert {row.role for row in rows if row.name in names} == {role}
