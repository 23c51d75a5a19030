"""A million impacts in one call: parameters that broadcast, and the same numbers as one by one."""

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx
from ...shapes import SHAPES, name

QUANTITIES = (
    "max_depth",
    "max_force",
    "contact_radius",
    "plastic_radius",
    "plastic_depth",
    "damaged_area",
    "restitution",
    "rebound_speed",
    "contact_time",
    "stored_energy",
    "plastic_work",
    "viscous_work",
)


@pytest.mark.parametrize("eta", [0.0, 3.0])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_neighbours_do_not_matter(shape, eta):
    """The same numbers in any order, and alone."""
    speed = np.geomspace(1e-3, 0.3, 40)
    medium = mdr.Medium(1e9, q_c=10.0, eta=eta)
    together = mdr.impact(shape, medium, 1e-9, speed)
    order = np.random.default_rng(1).permutation(speed.size)
    shuffled = mdr.impact(shape, medium, 1e-9, speed[order])
    alone = mdr.impact(shape, medium, 1e-9, speed[17])
    for quantity in QUANTITIES:
        values = getattr(together, quantity)
        # Arrays of another length or order are summed in another order: some units of rounding.
        np.testing.assert_allclose(getattr(shuffled, quantity), values[order], rtol=1e-13, err_msg=quantity)
        assert getattr(alone, quantity) == approx(values[17], rel=1e-11), quantity


TIP = mdr.Sampled(1e-6 * np.arange(61), 1e-7 * np.arange(61) + 2e-9 * np.arange(61.0) ** 2)


@pytest.mark.parametrize("before", [0.0, 2e-8])
@pytest.mark.parametrize("shape", [*SHAPES, TIP], ids=name)
def test_thousands_are_as_exact_as_one(shape, before):
    """From elastic impacts to thousands of critical depths, by tables of a tip, and one by one."""
    random = np.random.default_rng(3)
    media = mdr.Medium(1e9 * random.uniform(0.5, 2, 5000), q_c=10.0 ** random.uniform(-1, 3, 5000))
    speed = 10.0 ** random.uniform(-4, -2, 5000)
    hits = mdr.impact(shape, media, 1e-9, speed, plastic_depth=before)
    for i in range(0, 5000, 250):
        one = mdr.impact(shape, media.entries(i), 1e-9, speed[i], plastic_depth=before)
        for quantity in ("max_depth", "max_force", "restitution", "damaged_area", "stored_energy"):
            # Roundings of the energy, and of powers of the depth.
            expected = approx(getattr(one, quantity), rel=1e-12, abs=0.0)
            assert getattr(hits, quantity)[i] == expected, (quantity, i)
    balance = (hits.stored_energy + hits.plastic_work) / (1e-9 * speed**2 / 2)
    np.testing.assert_allclose(balance, 1.0, rtol=1e-12)


def test_shapes_of_results():
    grid = mdr.impact(
        mdr.Cone([[0.1], [0.3]]), mdr.Medium([1e9, 2e9, 3e9], q_c=10.0), 1e-9, np.full((4, 1, 1), 0.1)
    )
    assert all(np.shape(getattr(grid, quantity)) == (4, 2, 3) for quantity in QUANTITIES)
    assert grid[0, 1, 2].profile.slope == 0.3
    assert grid[0, 1, 2].medium.E_star == 3e9
    assert grid[0].restitution.shape == (2, 3)
    one = mdr.impact(mdr.Cone(0.3), mdr.Medium(1e9, q_c=10.0, eta=1.0), 1e-9, 0.1)
    assert all(isinstance(getattr(one, quantity), float) for quantity in QUANTITIES)
    none = mdr.impact(mdr.Cone(0.3), mdr.Medium(1e9, q_c=10.0), 1e-9, np.empty(0))
    assert none.contact_time.shape == none.restitution.shape == (0,)


def test_a_thousand_exponents_are_solved_each_on_its_own():
    """Exponents may differ from body to body as well."""
    exponents = np.linspace(0.6, 4.0, 1000)
    medium = mdr.Medium(1e9, q_c=10.0, eta=3.0)
    hits = mdr.impact(mdr.PowerLaw(1e-6 ** (1 - exponents), exponents), medium, 1e-9, 0.05)
    one = mdr.impact(hits[321].profile, medium, 1e-9, 0.05)
    for quantity in QUANTITIES:
        # The same steps, summed in another order.
        assert getattr(hits, quantity)[321] == approx(getattr(one, quantity), rel=1e-10), quantity


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ((mdr.Cone([0.1, 0.2]), mdr.Medium(1e9), 1.0, [1.0, 1.0, 1.0]), r"speed \(3,\), profile \(2,\)"),
        ((mdr.Cone(0.1), mdr.Medium(1e9), [1.0, -1.0, 0.0], 1.0), r"mass\[1\] = -1 kg .*\(and 1 more of 3"),
        ((mdr.Cone(0.1), mdr.Medium(1e9), 1.0, 1.0, -1.0), "plastic_depth = -1 m must be .*not negative"),
        ((mdr.Sphere([1.0, 1e-9]), mdr.Medium(1.0), 1.0, 1.0), r"speed\[1\] = 1 m/s presses deeper"),
    ],
)
def test_bad_entries_are_named(arguments, says):
    *arguments, before = (*arguments, 0.0)[:5]
    with pytest.raises(ValueError, match=says):
        mdr.impact(*arguments, plastic_depth=before)


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: mdr.Cone([0.1, -0.2]), r"Cone slope\[1\] = -0.2 must be finite and positive"),
        (lambda: mdr.Sphere(np.array([1.0, 1e200])), r"Sphere radius\[1\] = 1e\+200 m .* 1e-25 and 1e\+25"),
        (lambda: mdr.PowerLaw(1.0, [2.0, 2000.0]), r"exponent\[1\] = 2000 must lie between"),
        (lambda: mdr.Hyperboloid([1.0, 2.0], [1.0, 2.0, 3.0]), "Hyperboloid: arrays of shapes"),
        (
            lambda: mdr.indent(mdr.Cone([0.1, 0.2]), mdr.Medium(1e9), 1e-6),
            ("a single indenter and a single medium"),
        ),
    ],
)
def test_bad_arrays_of_parameters_are_refused(make, says):
    with pytest.raises(ValueError, match=says):
        make()


def test_many_shallow_impacts_of_a_flat_face():
    """Many impacts are solved with a table; on a face it has to hold a fractional power of a tiny depth."""
    tip = mdr.Sampled([0.0, 1e-6, 2e-6, 9e-6], [0.0, 0.0, 3e-7, 3e-6])
    medium, depth = mdr.Medium(1e12, q_c=2000.0), np.geomspace(1e-16, 1e-6, 60)
    states = mdr.indent(tip, medium, depth[:, None])
    energy = (states.stored_energy + states.plastic_work)[:, 0]
    hits = mdr.impact(tip, medium, 1e-9, np.sqrt(2 * energy / 1e-9))
    np.testing.assert_allclose(hits.max_depth, depth, rtol=1e-14)
