"""Numbers as text in the unit that fits them."""

import pytest

from mdr_core.show.units import KINDS, UNITS, format_quantity


def test_units_ascend_and_every_kind_with_an_SI_unit_is_found_by_it():
    for kind, units in UNITS.items():
        sizes = [unit.factor for unit in units]
        assert sizes == sorted(set(sizes)), kind
        assert {KINDS[unit.name] for unit in units if unit.factor == 1} <= {kind, "number"}


@pytest.mark.parametrize(
    ("value", "kind", "text"),
    [
        (4.5136e-6, "force", "4.514 µN"), (1e-3, "length", "1.000 mm"), (9e3, "mass", "9.000 t"),
        (4e-7, "area", "0.4000 mm²"), (2e-30, "force", "2.000 × 10⁻¹⁵ fN"), (-3e-9, "length", "−3.000 nm"),
        (float("inf"), "length", "∞"),
    ],
)  # fmt: skip
def test_a_number_has_four_digits_and_a_fitting_unit(value, kind, text):
    assert format_quantity(value, kind) == text
