"""Arguments that carry a unit are converted or refused, by the protocols of pint, astropy and unyt."""

from dataclasses import dataclass
from functools import cache
from typing import ClassVar

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.measurements.files.units import COLUMN_UNITS
from mdr_core.show.units import UNITS

from .approx import approx

MEDIUM = mdr.Medium(95e9, q_c=100.0)


class WrongUnit(Exception):
    pass


@dataclass
class Quantity:
    """What quantities of all three have in common, with a few units of pressure and length."""

    value: object
    units: str

    SIZES: ClassVar = {"GPa": ("Pa", 1e9), "Pa": ("Pa", 1), "nm": ("m", 1e-9), "m": ("m", 1), "": ("", 1)}

    def to(self, unit):
        kind, size = self.SIZES[self.units]
        if kind != unit.replace("dimensionless", ""):
            raise WrongUnit
        return Quantity(size * np.asarray(self.value), unit)

    def __array__(self, *_, **__):
        # As pint does, but for a warning.
        return np.asarray(self.value)


@cache
def of(package):
    """A maker of quantities: numbers and a unit."""
    if package == "protocol":
        return Quantity
    module = pytest.importorskip({"astropy": "astropy.units"}.get(package, package))
    if package == "pint":
        return module.UnitRegistry().Quantity
    return module.unyt_array if package == "unyt" else module.Quantity


@pytest.fixture(params=["protocol", "pint", "astropy", "unyt"])
def quantity(request):
    return of(request.param)


def test_units_are_converted(quantity):
    assert mdr.Medium(quantity(95.0, "GPa")) == mdr.Medium(95e9)
    assert mdr.Sphere(quantity(200.0, "nm")).radius == approx(200e-9, rel=4e-16)
    many = mdr.Medium(quantity(np.array([95.0, 2.0]), "GPa")).E_star
    assert many.tolist() == mdr.Medium([quantity(95.0, "GPa"), 2e9]).E_star.tolist() == [95e9, 2e9]
    path = mdr.indent(mdr.Sphere(200e-9), MEDIUM, quantity(np.array([0.0, 10.0]), "nm"))
    np.testing.assert_allclose(
        path.force, mdr.indent(mdr.Sphere(200e-9), MEDIUM, [0.0, 1e-8]).force, rtol=1e-14
    )
    assert path[1].pressure(quantity(2.0, "nm")) == approx(path[1].pressure(2e-9), rel=1e-13)
    assert mdr.Cone(quantity(0.3, "")).slope == 0.3
    assert mdr.Medium.from_bodies(quantity(78.0, "GPa"), 0.42) == mdr.Medium.from_bodies(78e9, 0.42)


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda q: mdr.Medium(q(95.0, "nm")), "E_star = .*95.* cannot be converted to Pa"),
        (lambda q: mdr.Sphere(q(95.0, "GPa")), "Sphere radius = .* cannot be converted to m "),
        (lambda q: mdr.Cone(q(95.0, "nm")), "slope = .* cannot be converted to a number without a unit"),
        (lambda q: mdr.PowerLaw(q(1.0, "m"), 2.0), "coefficient = .* cannot be converted to"),
        (lambda q: mdr.indent(mdr.Cone(0.3), MEDIUM, [1e-9, q(1.0, "Pa")]), "depth = .* converted to m"),
        (lambda q: mdr.impact(mdr.Cone(0.3), MEDIUM, q(1.0, "nm"), 1.0), "mass = .* converted to kg"),
        (lambda q: mdr.scene.FreeImpact(q(1.0, "nm"), 1.0), "FreeImpact mass = .* converted to kg"),
        (lambda q: mdr.indent_in_time(mdr.Cone(0.3), MEDIUM, [0, 1e-9], q([0, 1], "m")), "time = .* to s"),
    ],
)
def test_units_of_another_kind_are_refused(quantity, make, says):
    with pytest.raises(ValueError, match=says):
        make(quantity)


@pytest.mark.parametrize("package", ["pint", "astropy", "unyt"])
def test_compound_units(package):
    make = of(package)
    medium = mdr.Medium(1e9, q_c=make(100.0, "N/m"), eta=make(3.0, "Pa*s"))
    assert (medium.q_c, medium.eta) == (100.0, 3.0)
    assert mdr.Cone.from_half_angle(make(70.3, "deg")) == mdr.Cone.from_half_angle(70.3)
    hit = mdr.impact(
        mdr.Cone(0.3), medium, make(1e-6, "g"), make(3.6, "km/hour" if package != "astropy" else "km/h")
    )
    assert hit.mass == approx(1e-9, rel=4e-16)
    assert hit.speed == approx(1.0, rel=4e-16)
    assert hit.speed_limit(make(1.0, "g/cm**3")).value == approx(1e-3, rel=1e-14)


@dataclass
class Labelled:
    values: list
    dims: tuple
    coords: tuple = ()

    def __array__(self, *_, **__):
        return np.array(self.values)


@pytest.mark.parametrize("kind", ["protocol", "xarray"])
def test_named_dimensions_are_refused(kind):
    make = Labelled if kind == "protocol" else pytest.importorskip("xarray").DataArray
    mass, speed = make([1e-9, 2e-9], dims=("body",)), make([0.1, 0.2], dims=("speed",))
    with pytest.raises(ValueError, match=r"mass has named dimensions, \('body',\)"):
        mdr.impact(mdr.Cone(0.3), MEDIUM, mass, speed)
    with pytest.raises(ValueError, match="depth has named dimensions"):
        mdr.indent(mdr.Cone(0.3), MEDIUM, speed)


def test_lazy_arrays_are_refused():
    lazy = pytest.importorskip("dask.array").ones(3)
    for solve in (
        lambda: mdr.impact(mdr.Cone(0.3), MEDIUM, 1e-9, lazy),
        lambda: mdr.indent(mdr.Cone(0.3), MEDIUM, lazy),
        lambda: mdr.Sphere(lazy),
        lambda: mdr.Medium(lazy),
    ):
        with pytest.raises(ValueError, match=r"is a lazy array, .* mdr_core.sweep, which keeps it lazy"):
            solve()


def test_units_of_the_page_and_of_files_have_the_sizes_of_pint():
    """Pounds of files have eight digits. Grams and pounds of a force are gf and lbf."""
    registry, forces = pytest.importorskip("pint").UnitRegistry(), {"g": "gf", "lb": "lbf"}
    sizes = {
        unit.name: unit.factor for units in UNITS.values() for unit in units if unit.name not in forces
    }
    for name, size in [*sizes.items(), *(each for kind in COLUMN_UNITS.values() for each in kind.items())]:
        known = registry.Quantity(1.0, forces.get(name, name).replace("·", "*"))
        assert known.to_base_units().magnitude == approx(size, rel=1e-8), name
