"""The error of a refused argument carries its name, the value, the bound, the unit and what to do."""

import pickle
from types import SimpleNamespace

import numpy as np
import pytest

import mdr_core as mdr

CONE, MEDIUM = mdr.Cone(0.3), mdr.Medium(1e9, q_c=10.0)
NAMED = SimpleNamespace(dims=("speed",), coords={})


class Lazy:
    __dask_graph__ = None


class Kilogram:
    """A quantity of mass 2 kg that cannot be converted."""

    units = "kg"

    def to(self, unit):
        raise TypeError

    def __str__(self):
        return "2 kg"


KILOGRAM, LAZY = Kilogram(), Lazy()
BETWEEN = "must lie between 1e-60 and 1e+60"
# A call; argument, value, bound, unit and advice of its error.
REFUSALS = {
    "no number": (lambda: mdr.Medium("soft"), ("E_star", "soft", "must be one real number", "Pa", "")),
    "no numbers": (
        lambda: mdr.indent(CONE, MEDIUM, [1e-9, "deep"]),
        ("depth", [1e-9, "deep"], "must be real numbers", "m", ""),
    ),
    "many numbers": (
        lambda: mdr.chain_impact(CONE, MEDIUM, [1.0, 2.0], 1.0),
        ("mass", [1.0, 2.0], "must be one real number", "kg", ""),
    ),
    "not positive": (
        lambda: mdr.Sphere(-1.0),
        ("radius", -1.0, "must be finite and positive", "m", "give it in SI units (m)"),
    ),
    "the second of an array": (
        lambda: mdr.impact(CONE, MEDIUM, 1.0, [1.0, -2.0, 0.0]),
        ("speed", -2.0, "must be finite and positive", "m/s", "give it in SI units (m/s)"),
    ),
    "no unit": (lambda: mdr.Cone(-0.3), ("slope", -0.3, "must be finite and positive", "", "check it")),
    "out of bounds": (
        lambda: mdr.impact(CONE, MEDIUM, 1e70, 1.0),
        ("mass", 1e70, BETWEEN, "kg", "give it in SI units (kg)"),
    ),
    "not finite": (
        lambda: mdr.indent(CONE, MEDIUM, np.inf),
        ("depth", np.inf, "must be finite", "m", "leave it out, or correct the data it comes from"),
    ),
    "negative force": (
        lambda: mdr.indent_to_force(CONE, MEDIUM, -2.0),
        ("force", -2.0, "is negative", "N", "a tension needs work_of_adhesion > 0"),
    ),
    "beyond the tip": (
        lambda: mdr.Sampled([0.0, 1.0], [0.0, 1.0]).height(2.0),
        ("r", 2.0, "must not exceed the known radius of the shape, 1 m", "m", "give a smaller radius"),
    ),
    "no known name": (
        lambda: mdr.indent(CONE, MEDIUM, 1e-9).stress_peak("tension"),
        ("quantity", "tension", "must be one of 'max_shear', 'von_mises'", "", ""),
    ),
    "another unit": (
        lambda: mdr.impact(CONE, MEDIUM, 1.0, KILOGRAM),
        ("speed", KILOGRAM, "cannot be converted to m/s (TypeError)", "m/s", ""),
    ),
    "named dimensions": (
        lambda: mdr.impact(CONE, MEDIUM, 1.0, NAMED),
        (
            "speed",
            NAMED,
            "has named dimensions, ('speed',), which would be lost: arrays broadcast by the "
            "order of their axes",
            "m/s",
            "give its .values, transposed as needed",
        ),
    ),
    "a lazy array": (
        lambda: mdr.Medium(LAZY),
        (
            "E_star",
            LAZY,
            "is a lazy array, which would be loaded into memory as a whole",
            "Pa",
            ".compute() it, or give it to mdr_core.sweep, which keeps it lazy",
        ),
    ),
}


def refusal(make):
    """The error of a call that is refused."""
    with pytest.raises(ValueError) as caught:  # noqa: PT011 - its words are a part of what is compared
        make()
    # Who catches `MDRError` catches all.
    assert isinstance(caught.value, mdr.MDRError)
    return caught.value


@pytest.mark.parametrize("kind", REFUSALS)
def test_what_an_error_carries(kind):
    make, expected = REFUSALS[kind]
    error = refusal(make)
    assert (error.argument, error.value, error.bound, error.unit, error.advice) == expected
    # The message says the same.
    said = str(error)
    assert said.startswith(error.quantity)
    assert error.bound in said
    assert said.endswith(error.advice)


@pytest.mark.parametrize(
    ("make", "argument"),
    [
        (lambda: mdr.Cone.from_half_angle(99.0), "degrees"),
        (lambda: mdr.Medium.from_hardness(1e9, 1e9, -1.0), "radius"),
        (lambda: mdr.Medium.from_critical_depth(1e9, -1.0), "critical_depth"),
        (lambda: mdr.Medium.from_bodies(1e9, 0.6), "nu1"),
        (lambda: mdr.Medium(1e9, work_of_adhesion=-1.0), "work_of_adhesion"),
        (lambda: mdr.ScalingLaw("d", 1.0), "hardness_class"),
        (lambda: mdr.Sampled.from_area_function([24.5, np.nan], 1e-6), "coefficients"),
        (lambda: mdr.Sampled.from_area_function([-24.5], 1e-6), "coefficients"),
        (lambda: mdr.abel.stress_from_line_load([0.0, np.inf], [1.0, 0.0], 0.5), "x"),
        (lambda: mdr.abel.stress_from_line_load([0.0, 1.0], [np.inf, 0.0], 0.5), "q"),
        (lambda: mdr.indent(CONE, MEDIUM, 1e-9).line_load(np.inf), "x"),
        (lambda: mdr.indent(CONE, MEDIUM, 1e-9).pressure(np.inf), "r"),
        (lambda: mdr.fit_indentation(CONE, [[0.0, 1e-9], [0.0, "deep"]], [[0.0, 1e-9]] * 2), "depth"),
    ],
)
def test_the_argument_has_the_name_that_the_caller_gave(make, argument):
    """Also where the message says it in words that do not end with the name."""
    assert refusal(make).argument == argument


@pytest.mark.parametrize("kind", ["no number", "the second of an array", "no known name"])
def test_an_error_comes_whole_from_another_process(kind):
    error = refusal(REFUSALS[kind][0])
    copy = pickle.loads(pickle.dumps(error))
    assert str(copy) == str(error)
    assert (copy.argument, copy.value) == (error.argument, error.value)
