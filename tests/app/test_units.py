"""Numbers that are typed into a field, and values as text for a field."""

from math import pi, radians, tan

import pytest

from app.common.units import entry, read
from mdr_core.show.units import UNITS, fitting

from ..approx import approx

TYPED = [
    ("25", "length", 25e-9), ("2,5", "length", 2.5e-9), ("1e1", "length", 1e-8), ("1e-6 m", "length", 1e-6),
    ("5 Å", "length", 5e-10),
    ("0.012 µm", "length", 12e-9), ("3e-3um", "length", 3e-9), ("10 000 nm", "length", 1e-5),
    ("10\u202f000 nm", "length", 1e-5), ("70.3°", "slope", 1 / tan(radians(70.3))), ("0.36", "slope", 0.36),
    ("90", "angle", pi / 2), ("0,125", "length", 0.125e-9), ("1234,567 nm", "length", 1234.567e-9),
]  # fmt: skip


@pytest.mark.parametrize(("text", "kind", "value"), TYPED)
def test_typed_numbers(text, kind, value):
    shown = fitting(9e-9 if kind == "length" else 0.3, kind)
    assert read(text, kind, shown)[0] == approx(value, rel=1e-14)


@pytest.mark.parametrize("text", ["1,500 nm", "-12,345", "−999,000 nm"])
def test_a_comma_that_may_separate_thousands_is_refused_with_both_readings(text):
    whole, part = (text.replace(",", instead).replace("−", "-") for instead in ("", "."))
    with pytest.raises(ValueError, match=f"“{text}” can be {whole} or {part}: type one of these"):
        read(text, "length", fitting(9e-9, "length"))


def test_a_zero_has_the_unit_of_its_column():
    """A bare 5 typed over it is 5 nm, not 5 m."""
    unit = fitting(0.0, "length", 9e-9)
    assert entry(0.0, unit) == "0 nm"
    assert read("5", "length", unit) == (5e-9, unit)


@pytest.mark.parametrize("text", ["", "abc", "1e999", "nan", "3 MPa", "1,5,2", "1.000,5", "<b>", "5°"])
def test_what_is_no_number_is_refused(text):
    with pytest.raises(ValueError, match=r"is not a number|too large"):
        read(text, "length", fitting(9e-9, "length"))


@pytest.mark.parametrize("kind", UNITS)
def test_what_is_written_is_read_again(kind):
    for unit in UNITS[kind]:
        value = 12.345 * unit.factor
        again, found = read(entry(value, unit), kind, unit)
        assert again == approx(value, rel=1e-12)
        assert found == unit
