"""Curves to compare force and depth with: Hertz's, and the powers that the classes of hardness have."""

import numpy as np
import pytest

from app import columns, references
from app.explorer import Explorer

from .test_columns import seen


def test_the_elastic_curve_of_a_paraboloid_is_that_of_hertz():
    explorer = Explorer()
    explorer.choose("shape", "paraboloid")
    d, F = references.curves(seen(explorer, references="elastic"))["elastic throughout"]
    expected = 4 / 3 * explorer.medium().E_star * np.sqrt(explorer.profile().radius) * d**1.5
    np.testing.assert_allclose(F, expected, rtol=1e-12)


@pytest.mark.parametrize(("shape", "power"), [("cone", 2), ("paraboloid", 1), ("flat_punch", 0)])
def test_classes_share_the_hardness_of_the_deepest_state_and_differ_in_its_power(shape, power):
    """F ∝ a², a⁰ and z ∝ rⁿ: powers 2/n and 0 of the depth."""
    explorer = Explorer()
    explorer.choose("shape", shape)
    for progress in (0.3, 1.0, 1.6):
        view = seen(explorer, progress, references="classes")
        rows, deepest = references.curves(view), view.way.deepest
        d, constant_hardness = rows["class (a), F ∝ a²"]
        d, constant_force = (part[1:] for part in rows["class (c), F constant"])
        share = (d / deepest.depth) ** power
        np.testing.assert_allclose(constant_hardness[1:], deepest.force * share, rtol=1e-9)
        np.testing.assert_allclose(constant_force, deepest.force, rtol=1e-12)


def test_nothing_is_said_to_have_a_hardness_that_has_not_yielded():
    explorer = Explorer("Steel ball 16 mm on epoxy, elastic")
    view = seen(explorer, references="all")
    assert references.curves(view).keys() == {"elastic throughout"}
    assert "Nothing has yielded" in references.note(view)
    np.testing.assert_allclose(view.way.force[view.way.peak], np.interp(
        view.way.deepest.depth, *references.curves(view)["elastic throughout"]), rtol=1e-3)  # fmt: skip


def test_none_is_drawn_unless_it_is_chosen():
    view = seen(Explorer())
    assert not columns.force_still(view).keys() & {row.name for row in references.ROWS}
    assert references.note(view) == ""
