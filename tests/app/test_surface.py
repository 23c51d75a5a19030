"""The section of the deformed surface, as arrays: closed forms, the tip above it, and the imprint below."""

import numpy as np
import pytest

from app import surface
from app.explorer import Explorer
from app.plots import PLOTS
from app.presets import PRESETS
from app.quantities import SHAPES

from .test_columns import seen


def test_beside_an_elastic_paraboloid_the_surface_is_that_of_hertz():
    explorer = Explorer()
    explorer.choose("shape", "paraboloid")
    explorer.choose("plasticity", "none")
    view = seen(explorer)
    state, radius = view.way.state, explorer.profile().radius
    r, z = surface.moving(view, view.way.now)["deformed surface"]
    a = float(state.contact_radius)
    r, z = (part[r > a] for part in (r, z))
    # Johnson, Contact Mechanics (1985), Eq. (3.42a), with d = a²/R.
    expected = ((2 * a**2 - r**2) * np.arcsin(a / r) + a * np.sqrt(r**2 - a**2)) / (np.pi * radius)
    np.testing.assert_allclose(z, -expected, rtol=1e-10)
    assert np.isnan(surface.moving(view, view.way.now)["residual imprint"][0]).all()


@pytest.mark.parametrize("shape", [shape for shape in SHAPES if shape != "sampled"])
def test_the_surface_lies_on_the_tip_in_contact_and_below_it_beside(shape):
    explorer = Explorer()
    explorer.choose("shape", shape)
    view = seen(explorer, 1.4)
    state, profile = view.way.state, explorer.profile()
    r, z = surface.moving(view, view.way.now)["deformed surface"]
    gap = profile.height(np.minimum(np.abs(r), profile.known_radius)) - state.depth - z
    inside, scale = np.abs(r) <= state.contact_radius, view.end["section z"]
    assert inside.sum() > 10
    # To the rounding of a depth.
    assert np.max(np.abs(gap[inside])) < 1e-14 * scale
    assert np.all(gap[~inside] > -1e-12 * scale)


def test_what_stays_when_the_load_is_gone_is_the_imprint():
    view = seen(Explorer(), 2.2)
    rows = surface.moving(view, view.way.now)
    np.testing.assert_array_equal(rows["deformed surface"], rows["residual imprint"])
    # Of a cone pressed to d_p without yield the centre is d_p deep.
    depth = float(view.way.state.plastic_depth)
    assert rows["residual imprint"][1].min() == pytest.approx(-depth, rel=1e-12)
    assert -depth < rows["tip z(r)"][1].min()


@pytest.mark.parametrize("label", PRESETS)
def test_heights_are_to_scale_when_asked_for(label):
    plot, view = PLOTS["surface"], seen(Explorer(label), heights="to_scale")
    r, z = view.axes_of(plot)
    assert (r.unit, r.factor) == (z.unit, z.factor)
    assert z.title == "z, height to scale"
    assert z.start <= -float(view.way.deepest.depth)
    assert plot.to_scale(view)
    assert not plot.to_scale(seen(Explorer(label)))
