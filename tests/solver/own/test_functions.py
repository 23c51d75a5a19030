"""Functions that a user writes give double precision for arrays of radii, or an error says what to do."""

import math
from dataclasses import dataclass

import numpy as np
import pytest

import mdr_core as mdr

from ...laws import NixGao
from .test_own_shape import Pencil

#: What is done to the values of a function at radii, and a word of the remedy.
FAULTS = {
    "single precision": (lambda a, value: value.astype(np.float32), "float64"),
    "a scalar alone": (lambda a, value: value * math.exp(0 * a), "NumPy's functions"),
    "a branch": (lambda a, value: value if a < 1 else 0, "NumPy's functions"),
    "text": (lambda a, value: "0.3", "plain numbers"),
    "complex": (lambda a, value: value + 0j, "plain numbers"),
}


def law_with(change):
    @dataclass(frozen=True)
    class Law(NixGao):
        def at(self, a):
            return change(a, NixGao.at(self, a))

        def rate(self, a):
            return -(self.H0**2) * self.a_star / (2 * a**2 * NixGao.at(self, a))

    return Law(1e9, 1e-6)


def shape_with(change):
    class Shape(Pencil):
        def reduced_at(self, x):
            return change(x, Pencil.reduced_at(self, x))

    return Shape(0.3, 1e-6)


MAKE = {
    "law": lambda change: (mdr.Cone(0.3), mdr.Medium(70e9, hardness=law_with(change))),
    "slope": lambda change: (mdr.Smooth(lambda r: change(r, 0.3 + r)), mdr.Medium(70e9, q_c=100.0)),
    "shape": lambda change: (shape_with(change), mdr.Medium(70e9, q_c=100.0)),
}


@pytest.mark.parametrize("fault", FAULTS)
@pytest.mark.parametrize("kind", MAKE)
def test_what_a_function_gives_is_named_with_what_to_do(kind, fault):
    """Of single precision the rate was blamed, and NumPy's TypeErrors of scalars came through."""
    change, remedy = FAULTS[fault]
    with pytest.raises(ValueError, match=remedy):
        mdr.indent(*MAKE[kind](change), 1e-7)


@pytest.mark.parametrize("kind", MAKE)
def test_a_function_of_double_precision_is_taken(kind):
    assert mdr.indent(*MAKE[kind](lambda a, value: value), 1e-7).force > 0
