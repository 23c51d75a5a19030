"""A million impacts in one call: parameters that broadcast, and the same numbers as one by one."""

from dataclasses import fields

import numpy as np
import pytest

import mdr_core as mdr

from .shapes import SHAPES, name

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
COUNT = 6


def spread(value, seed):
    """An array of values around one."""
    return value * np.random.default_rng(seed).uniform(0.8, 1.25, COUNT)


def many(shape):
    """Indenters around one, media and bodies: dry, elastic and viscous ones."""
    values = [spread(getattr(shape, field.name), i) for i, field in enumerate(fields(shape))]
    medium = mdr.Medium(
        spread(1e9, 7), np.array([np.inf, 10.0, 1.0, 10.0, np.inf, 3.0]), [0.0, 0.0, 0.0, 1.0, 1.0, 50.0]
    )
    return type(shape)(*values), medium, spread(1e-9, 8), spread(0.1, 9)


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_parameters_broadcast(shape):
    """Every parameter an array: the impacts of the entries, one by one."""
    indenters, media, mass, speed = many(shape)
    hits = mdr.impact(indenters, media, mass, speed)
    for i in range(COUNT):
        one = mdr.impact(indenters.entries(i), media.entries(i), mass[i], speed[i])
        for quantity in QUANTITIES:
            # Shapes with lengths of their own are solved in these, by steps that round otherwise.
            expected = pytest.approx(getattr(one, quantity), rel=1e-10, abs=0.0)
            assert getattr(hits, quantity)[i] == expected, quantity
            assert getattr(hits[i], quantity) == expected, quantity


@pytest.mark.parametrize("eta", [0.0, 3.0])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_neighbours_do_not_matter(shape, eta):
    """The same digits in any order, and alone but for the last."""
    speed = np.geomspace(1e-3, 0.3, 40)
    medium = mdr.Medium(1e9, 10.0, eta)
    together = mdr.impact(shape, medium, 1e-9, speed)
    order = np.random.default_rng(1).permutation(speed.size)
    shuffled = mdr.impact(shape, medium, 1e-9, speed[order])
    alone = mdr.impact(shape, medium, 1e-9, speed[17])
    for quantity in QUANTITIES:
        values = getattr(together, quantity)
        np.testing.assert_array_equal(getattr(shuffled, quantity), values[order], err_msg=quantity)
        # One row is summed in another order than many.
        assert getattr(alone, quantity) == pytest.approx(values[17], rel=2e-14), quantity


def test_shapes_of_results():
    grid = mdr.impact(
        mdr.Cone([[0.1], [0.3]]), mdr.Medium([1e9, 2e9, 3e9], 10.0), 1e-9, np.full((4, 1, 1), 0.1)
    )
    assert all(np.shape(getattr(grid, quantity)) == (4, 2, 3) for quantity in QUANTITIES)
    assert grid[0, 1, 2].profile.slope == 0.3
    assert grid[0, 1, 2].medium.E_star == 3e9
    assert grid[0].restitution.shape == (2, 3)
    one = mdr.impact(mdr.Cone(0.3), mdr.Medium(1e9, 10.0, 1.0), 1e-9, 0.1)
    assert all(isinstance(getattr(one, quantity), float) for quantity in QUANTITIES)
    none = mdr.impact(mdr.Cone(0.3), mdr.Medium(1e9, 10.0), 1e-9, np.empty(0))
    assert none.contact_time.shape == none.restitution.shape == (0,)


@pytest.mark.parametrize(
    "shape", [mdr.FlatPunch(1e-6), mdr.Cone(0.3), mdr.Paraboloid(1e-5), mdr.PowerLaw(1e11, 3.0)], ids=name
)
def test_dimensional_analysis_agrees_with_the_equation_of_motion(shape):
    """A thousand elastic impacts are read off series in τ v₀/d₀, few are solved one by one."""
    generator = np.random.default_rng(3)
    speed, eta = 10.0 ** generator.uniform(-2, 0, 1000), 10.0 ** generator.uniform(-6, 8, 1000)
    # Where a medium yields, only what does not reach the critical depth is elastic.
    medium = mdr.Medium(1e9, np.where(generator.random(1000) < 0.5, np.inf, 3.0), eta)
    hits = mdr.impact(shape, medium, 1e-9, speed)
    some = slice(0, 1000, 25)
    one_by_one = mdr.impact(shape, medium.entries(some), 1e-9, speed[some])
    for quantity in QUANTITIES:
        # Chebyshev series of degree 15 on panels of a factor e.
        expected = getattr(one_by_one, quantity)
        np.testing.assert_allclose(getattr(hits, quantity)[some], expected, rtol=1e-8, err_msg=quantity)


def test_a_thousand_exponents_are_solved_each_on_its_own():
    """Series hold for one exponent; an ensemble of many is none the worse, in any memory."""
    exponents = np.linspace(0.6, 4.0, 1000)
    medium = mdr.Medium(1e9, 10.0, 3.0)
    hits = mdr.impact(mdr.PowerLaw(1e-6 ** (1 - exponents), exponents), medium, 1e-9, 0.05)
    one = mdr.impact(hits[321].profile, medium, 1e-9, 0.05)
    for quantity in QUANTITIES:
        # The same steps, summed in another order.
        assert getattr(hits, quantity)[321] == pytest.approx(getattr(one, quantity), rel=1e-10), quantity


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ((mdr.Cone([0.1, 0.2]), mdr.Medium(1e9), 1.0, [1.0, 1.0, 1.0]), r"speed \(3,\), profile \(2,\)"),
        ((mdr.Cone(0.1), mdr.Medium(1e9), [1.0, -1.0, 0.0], 1.0), r"mass\[1\] = -1 kg .*\(and 1 more of 3"),
        ((mdr.Cone(0.1), mdr.Medium(1e9), 1.0, [[1.0, np.nan]]), r"speed\[0, 1\] = nan m/s"),
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
        (lambda: mdr.Sphere(np.array([1.0, 1e200])), r"Sphere radius\[1\] = 1e\+200 m must lie between"),
        (lambda: mdr.PowerLaw(1.0, [2.0, 2000.0]), r"exponent\[1\] = 2000 must lie in"),
        (lambda: mdr.Hyperboloid([1.0, 2.0], [1.0, 2.0, 3.0]), "Hyperboloid: arrays of shapes"),
        (lambda: mdr.indent(mdr.Cone([0.1, 0.2]), mdr.Medium(1e9), 1e-6), "one indenter on one medium"),
    ],
)
def test_bad_arrays_of_parameters_are_refused(make, says):
    with pytest.raises(ValueError, match=says):
        make()


class TestRepeatedImpacts:
    """The plastic depth carries over from one impact to the next on the same spot."""

    @pytest.mark.parametrize("shape", SHAPES, ids=name)
    def test_tend_to_elastic(self, shape):
        """Every impact widens the contact that the next one finds, until all of it is elastic."""
        medium, depth, restitution = mdr.Medium(1e9, 10.0), 0.0, []
        state = mdr.indent(shape, medium, 2 * medium.critical_depth)
        speed = np.sqrt(2 * (state.stored_energy + state.plastic_work) / 1e-9)
        for _ in range(60):
            hit = mdr.impact(shape, medium, 1e-9, speed, plastic_depth=depth)
            restitution.append(hit.restitution)
            assert hit.plastic_depth >= depth
            depth = hit.plastic_depth
        assert np.all(np.diff(restitution) >= -1e-15)
        # The face of a punch does not grow, and one that is flat in the middle grows slowly.
        share = 1.0 if shape.contact_radius(0.0) > 0 else 0.25
        assert 1 - restitution[-1] <= share * (1 - restitution[0])

    @pytest.mark.parametrize("shape", SHAPES, ids=name)
    def test_energy_and_state(self, shape):
        """The second impact ends where pressing the first's imprint to its depth ends."""
        medium = mdr.Medium(1e9, 10.0)
        first = mdr.impact(shape, medium, 1e-9, 0.05)
        second = mdr.impact(shape, medium, 1e-9, 0.1, plastic_depth=first.plastic_depth)
        path = mdr.indent(shape, medium, [first.max_depth, 0.0, second.max_depth])
        assert second.max_force == pytest.approx(path.force[-1], rel=1e-11)
        assert second.plastic_depth == pytest.approx(path.plastic_depth[-1], rel=1e-12)
        assert second.plastic_work == pytest.approx(path.plastic_work[-1] - path.plastic_work[0], rel=1e-9)
        work = second.stored_energy + second.plastic_work
        assert work == pytest.approx(1e-9 * 0.1**2 / 2, rel=1e-12)
        # The same from the equation of motion.
        assert second.motion(2).time[-1] == pytest.approx(second.contact_time, rel=1e-9)

    def test_a_softer_impact_is_elastic(self):
        medium, cone = mdr.Medium(1e9, 10.0), mdr.Cone(0.3)
        first = mdr.impact(cone, medium, 1e-9, 0.1)
        second = mdr.impact(
            cone, medium, 1e-9, first.rebound_speed * 0.999, plastic_depth=first.plastic_depth
        )
        assert second.restitution == 1.0
        assert second.plastic_work == 0.0
        assert second.plastic_depth == first.plastic_depth
