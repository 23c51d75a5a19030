"""How results show themselves, count, and become dicts, tables and datasets."""

import sys

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.show.quantities import QUANTITIES, engineering

GOLD = mdr.Medium.from_bodies(E1=78e9, nu1=0.42, q_c=100.0)
POLYMER = mdr.Medium(E_star=4e6, q_c=200.0, eta=30.0)
PATH = mdr.indent(mdr.Sphere(200e-9), GOLD, np.linspace(0.0, 10e-9, 300))
HIT = mdr.impact(mdr.Paraboloid(2e-3), POLYMER, 1e-4, 0.5)
MANY = mdr.impact(mdr.Cone([[0.1], [0.3]]), GOLD, 1e-12, [0.01, 0.1, 1.0])
RAMP = mdr.indent_in_time(mdr.Cone(0.3), POLYMER, [0.0, 2e-4, 2e-4], [0.0, 1e-4, 2e-4], tolerance=1e-3)
CHAIN = mdr.chain_impact(mdr.Paraboloid(2e-3), POLYMER, 1e-4, 0.5, tolerance=1e-3)
OBLIQUE = mdr.oblique_impact(mdr.Paraboloid(2e-3), POLYMER, 1e-4, 0.5, 0.2, 0.3, tolerance=1e-3)
RESULTS = {
    "path": PATH,
    "state": PATH[-1],
    "paths": mdr.indent(mdr.Cone(0.3), GOLD, [[1e-9, 2e-9], [3e-9, 1e-9]]),
    "none": mdr.indent(mdr.Cone(0.3), GOLD, []),
    "impact": HIT,
    "impacts": MANY,
    "motion": HIT.motion(20),
    "ramp": RAMP,
    "chain": CHAIN,
    "motion of the chain": CHAIN.motion(20),
    "fast limit": MANY.fast_limit,
    "oblique impact": OBLIQUE,
    "motion of the oblique impact": OBLIQUE.motion(20),
}
every_result = pytest.mark.parametrize("result", RESULTS.values(), ids=RESULTS)


@pytest.mark.parametrize(
    ("result", "size"),
    [
        (PATH[0], "one state"),
        (PATH[:1], "1 state"),
        (PATH[:2], "2 states"),
        (PATH[:0], "0 states"),
        (MANY, "2 × 3 impacts"),
        (MANY[:1, :1], "1 × 1 impact"),
    ],
)
def test_the_title_counts_in_the_singular_or_the_plural(result, size):
    title = repr(result).splitlines()[0]
    assert title.split(": ")[1].split(",")[0] == size


@every_result
def test_repr_is_short_and_says_what_it_is(result):
    lines = repr(result).splitlines()
    # An impact by any solver is an Impact.
    assert lines[0].split(":")[0] in {kind.__name__ for kind in type(result).__mro__}
    assert 4 <= len(lines) <= 12
    assert max(map(len, lines)) < 260
    assert f"<caption>{lines[0]}" in result._repr_html_()


def test_repr_has_the_numbers_that_are_looked_for():
    """With their symbols, in units that fit them."""
    text = repr(PATH)
    for part in ("300 states", "closed form", "R 200 nm", "E* 94.71 GPa", "q_c 100 N/m", "0 … 10 nm"):
        assert part in text
    for name in ("force F", "contact radius a", "plastic radius c", "plastic depth d_p"):
        assert name in text
    assert engineering(PATH.force, "N") in text
    hit = repr(HIT)
    numbers = (HIT.restitution, ""), (HIT.max_depth, "m"), (HIT.contact_time, "s")
    for part in ("scalar ODE", "plastic work W_p", "viscous work W_v", *(engineering(*x) for x in numbers)):
        assert part in hit
    sticky = mdr.Medium(1e9, work_of_adhesion=0.05)
    assert "adhesive work W_a" in repr(mdr.impact(mdr.Paraboloid(1e-6), sticky, 1e-14, 1.0))


def test_repr_has_no_more_lines_however_many_limits_are_exceeded():
    medium = mdr.Medium(4e6, q_c=2e4, eta=30.0, poisson=0.3)
    hit = mdr.impact(mdr.Sphere(2e-3), medium, 1e-3, 5.0)
    assert sum(limit.exceeded for limit in hit.limits) >= 3
    lines = repr(hit).splitlines()
    assert len(lines) == 12
    assert "see .limits" in lines[-1]
    assert hit._repr_html_().count("<tr>") == 10 + 3


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (0.0, "N", "0 N"),
        (999.96e-9, "m", "1 µm"),
        (-3.2e-3, "m/s", "-3.2 mm/s"),
        ([1e-9, 2e-6], "m", "0.001 … 2 µm"),
        (2.5e4, "", "25000"),
        (np.inf, "N/m", "inf N/m"),
        (1e-25, "J", "0.1 yJ"),
        (0.7853981633974483, "rad", "45°"),
        (5.0, "m^(1-n)", "5 m^(1-n)"),
        (4e-7, "m²", "0.4 mm²"),
        (3e-3, "kg", "3 g"),
        ([], "m", "none"),
    ],
)
def test_engineering_units(value, unit, text):
    assert engineering(value, unit) == text


@every_result
def test_quantities_are_of_one_shape(result):
    for name, value in result.to_dict().items():
        assert np.shape(value) == result.shape, name
        assert QUANTITIES[name].long_name
    assert bool(result) == (0 not in result.shape)


@every_result
def test_length_and_iteration_agree_or_are_refused(result):
    if result.shape:
        assert len(result) == result.shape[0] == len(list(result))
    else:
        with pytest.raises(TypeError, match="is a single result"):
            len(result)
        with pytest.raises(TypeError, match="is a single result"):
            iter(result)


@every_result
def test_a_result_is_not_one_array(result):
    with pytest.raises(TypeError, match="not one array: take one, as in result"):
        np.asarray(result)


def test_states_of_an_iteration_are_those_of_the_path():
    assert [state.force for state in PATH[:3]] == PATH.force[:3].tolist()
    instants = HIT.motion(9)
    assert [instant.force for instant in instants] == instants.force.tolist()
    assert instants[instants.turning_index].velocity == 0.0


@every_result
def test_pandas_has_names_units_and_one_row_each(result):
    pytest.importorskip("pandas")
    table = result.to_pandas()
    assert len(table) == np.prod(result.shape, dtype=int)
    for name, value in result.to_dict().items():
        if name not in table:
            # Left out is what medium and structure lack: its work and its motion.
            assert not np.any(value)
            continue
        np.testing.assert_array_equal(table[name].to_numpy(), np.ravel(value))
        assert table.attrs["units"][name] == QUANTITIES[name].unit
        assert table.attrs["long_names"][name] == QUANTITIES[name].long_name


@every_result
def test_xarray_has_units_and_long_names_as_attributes(result):
    pytest.importorskip("xarray")
    dataset = result.to_xarray()
    for name, value in result.to_dict().items():
        np.testing.assert_array_equal(dataset[name].to_numpy(), value)
        assert dataset[name].attrs["units"] == (QUANTITIES[name].unit or "1")
        assert dataset[name].attrs["long_name"] == QUANTITIES[name].long_name
    # As netCDF takes them.
    assert all(isinstance(value, str) for value in dataset.attrs.values())


def test_parameters_of_many_are_coordinates():
    pytest.importorskip("xarray")
    dataset = MANY.to_xarray()
    assert dict(dataset.sizes) == {"impact_0": 2, "impact_1": 3}
    assert {"slope", "speed", "mass"} <= set(dataset.coords)
    assert dataset["slope"].to_numpy().tolist() == [[0.1] * 3, [0.3] * 3]
    table = MANY.to_pandas()
    assert table.index.names == ["impact_0", "impact_1"]
    assert table["slope"].tolist() == [0.1] * 3 + [0.3] * 3


@pytest.mark.parametrize(("method", "package"), [("to_pandas", "pandas"), ("to_xarray", "xarray")])
def test_what_is_missing_is_said(method, package, monkeypatch):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(ImportError, match=rf"{method}\(\) needs {package}, .* pip install {package}"):
        getattr(PATH, method)()


def test_repr_of_a_foundation_is_short():
    row = mdr.Foundation(mdr.Cone(0.3), GOLD, 200, 1e-7, nodes=np.linspace(1e-9, 9e-8, 50)).advance(10e-9)
    lines = repr(row).splitlines()
    assert lines[0].startswith("Foundation: 200 elements to ±100 nm")
    assert len(lines) == 5
    assert lines[-1].split() == ["force", "F", *engineering(row.force, "N").split()]
