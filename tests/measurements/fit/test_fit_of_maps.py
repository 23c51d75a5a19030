"""Fits of maps, in which single curves cannot be fitted, and what is saved of them."""

import io
import warnings

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx

BALL, COUNT = mdr.Paraboloid(1e-5), 12
MODULI = 1e4 * (1 + np.arange(COUNT))
PATH = np.append(np.linspace(-1e-6, 1e-6, 125), np.linspace(1e-6, -1e-6, 125))
ELASTIC = {"q_c": np.inf, "baseline": None}
#: What is done to the depths and forces of a curve, and the words of its reason.
DEAD = {
    2: (lambda z, F: (z, F * np.nan), "no sample has finite values"),
    3: (lambda z, F: (z, 0 * F), "no contact"),
    4: (lambda z, F: (0 * z, F), "the indenter does not move"),
    6: (lambda z, F: (z, np.where(z > 9e-7, np.inf, F)), "must be finite"),
    9: (lambda z, F: (np.where(np.arange(z.size) < 2, z, np.nan), F), "2 samples do not determine"),
}
ALIVE = [i for i in range(COUNT) if i not in DEAD]


def a_map(dead=DEAD):
    """Depths (m) and forces (N), arrays (R, N), with 0.2 % noise."""
    depth = np.tile(PATH, (COUNT, 1))
    force = mdr.indent(BALL, mdr.Medium(MODULI[:, None]), depth).force
    force = force * (1 + 2e-3 * np.random.default_rng(3).normal(size=force.shape))
    for i, (change, _) in dead.items():
        depth[i], force[i] = change(depth[i], force[i])
    return depth, force


class TestInvalidCurves:
    def test_the_first_one_stops_all_unless_asked(self):
        with pytest.raises(ValueError, match=r"force\[6, \d+\] = inf N must be finite"):
            mdr.fit_indentation(BALL, *a_map(), **ELASTIC)
        with pytest.raises(ValueError, match="invalid = 'drop' must be one of 'raise', 'nan'"):
            mdr.fit_indentation(BALL, *a_map({}), **ELASTIC, invalid="drop")

    def test_others_are_fitted_as_without_them(self):
        """In other groups, whose sums differ by rounding: 10⁻⁹ is a millionth of the errors."""
        depth, force = a_map()
        fit = mdr.fit_indentation(BALL, depth, force, **ELASTIC, invalid="nan")
        only = mdr.fit_indentation(BALL, depth[ALIVE], force[ALIVE], **ELASTIC)
        for name, values in only.to_dict().items():
            assert fit.to_dict()[name][ALIVE] == approx(values, rel=1e-9, abs=1e-20)
        assert fit.medium.E_star[ALIVE] == approx(MODULI[ALIVE], rel=0.01)
        assert type(fit[ALIVE].medium) is mdr.Medium
        assert fit.path.force[ALIVE] == approx(only.path.force, rel=1e-9, abs=1e-18)

    def test_each_has_nan_and_its_reason(self):
        fit = mdr.fit_indentation(BALL, *a_map(), **ELASTIC, invalid="nan")
        assert fit.invalid.keys() == DEAD.keys()
        for i, (_, words) in DEAD.items():
            assert words in fit.invalid[i]
            assert fit[i].remarks == (fit.invalid[i],)
            assert fit.invalid[i] in repr(fit[i])
        fitted = fit.to_dict() | {"residuals": fit.residuals, "covariance": fit.covariance}
        for name in ("E_star", "E_star_error", "contact_point", "residuals", "covariance"):
            assert np.isnan(fitted[name][list(DEAD)]).all(), name
            assert np.isfinite(fitted[name][ALIVE]).all(), name
        # What was held for all curves is held for these.
        assert np.all(np.isinf(fit.medium.q_c))
        assert "curve 2 (5 of 12 curves): not fitted" in repr(fit)

    def test_a_report_has_the_numbers_of_the_others(self):
        fit = mdr.fit_indentation(BALL, *a_map(), **ELASTIC, invalid="nan")
        assert "nan" not in repr(fit)
        assert repr(fit).splitlines()[2].startswith("  effective modulus E*     10.0")

    @pytest.mark.parametrize(
        "given",
        [
            {},
            {"hardness": None},
            {"q_c": np.inf, "depth_noise": 1e-9},
            {"q_c": np.inf, "force_noise": 1e-9},
            {"q_c": np.inf, "contact_point": np.zeros(COUNT)},
            {"q_c": np.inf, "work_of_adhesion": None},
        ],
        ids=lambda given: " ".join(given),
    )
    def test_of_every_kind_of_fit(self, given):
        dead = {i: DEAD[i] for i in (2, 4, 6)}
        fit = mdr.fit_indentation(BALL, *a_map(dead), **given, invalid="nan")
        assert fit.invalid.keys() == dead.keys()
        others = [i for i in range(COUNT) if i not in dead]
        assert fit.medium.E_star[others] == approx(MODULI[others], rel=0.05)

    def test_of_times_that_do_not_ascend(self):
        depth, force = a_map({})
        time = np.tile(np.linspace(0, 1, PATH.size), (COUNT, 1))
        time[5, 100] = 0
        fit = mdr.fit_indentation(BALL, depth, force, time=time, **ELASTIC, drag=None, invalid="nan")
        assert list(fit.invalid) == [5]
        assert "does not increase" in fit.invalid[5]
        # Without a parameter in time the order of the times does not matter.
        assert not mdr.fit_indentation(BALL, depth, force, time=time, **ELASTIC, invalid="nan").invalid

    def test_of_different_lengths(self):
        depth, force = (list(values) for values in a_map())
        depth[0], force[0] = depth[0][:200], force[0][:200]
        depth[7] = depth[7][:-1]
        fit = mdr.fit_indentation(BALL, depth, force, **ELASTIC, invalid="nan")
        assert fit.invalid.keys() == DEAD.keys() | {7}
        assert "depth (249,), force (250,) must have the same shape" in fit.invalid[7]
        assert fit[0].depth.size == 200

    def test_a_curve_without_a_solution_is_one(self):
        """Under a tip of facets the rim of an adhesive contact jumps, which is found in the search."""
        radii = np.linspace(0, 1e-6, 50)
        tip, path = mdr.Sampled(radii, radii**2 / 2e-6), 0.1 * PATH
        medium = mdr.Medium(1e6, work_of_adhesion=1e-4)
        force = np.tile(mdr.indent(mdr.Paraboloid(1e-6), medium, path).force, (3, 1))
        given = {"q_c": np.inf, "work_of_adhesion": np.array([1.0, 1e-4, 1.0])}
        with pytest.raises(ValueError, match="jumps between several ranges"):
            mdr.fit_indentation(tip, np.tile(path, (3, 1)), force, **given)
        fit = mdr.fit_indentation(tip, np.tile(path, (3, 1)), force, **given, invalid="nan")
        assert list(fit.invalid) == [1]
        assert "jumps between several ranges" in fit.invalid[1]
        assert np.isfinite(fit.medium.E_star).tolist() == [True, False, True]

    def test_where_none_can_be_fitted_the_reason_is_raised(self):
        with pytest.raises(ValueError, match=r"none of 12 curves .* curve 0: .* no contact"):
            mdr.fit_indentation(BALL, np.tile(PATH, (COUNT, 1)), np.zeros((COUNT, 250)), invalid="nan")
        with pytest.raises(ValueError, match="no contact"):
            mdr.fit_indentation(BALL, PATH, 0 * PATH, invalid="nan")

    def test_what_needs_all_curves_says_which_is_missing(self):
        fit = mdr.fit_indentation(BALL, *a_map(), invalid="nan")
        with pytest.raises(ValueError, match=r"classes: curve 2 was not fitted: .* as in fit\[numbers\]"):
            _ = fit.classes
        with pytest.raises(ValueError, match="plot: curve 0 was not fitted"):
            fit[2].plot()


class TestDatasets:
    def test_a_map_has_positions_as_coordinates(self):
        pytest.importorskip("xarray")
        x, y = (axis.ravel() for axis in np.meshgrid(1e-6 * np.arange(4), 2e-6 * np.arange(3)))
        fit = mdr.fit_indentation(BALL, *a_map(), **ELASTIC, invalid="nan")
        dataset = fit.to_xarray(position=np.column_stack([x, y]))
        grid = dataset.E_star.set_index(curve=["y", "x"]).unstack("curve")
        assert grid.shape == (3, 4)
        assert grid.values.ravel() == approx(fit.medium.E_star, nan_ok=True)
        assert dataset.x.attrs["units"] == "m"
        assert dataset.attrs["invalid_count"] == 5
        assert dataset.attrs["invalid"].startswith("curve 2: not fitted")
        with pytest.raises(ValueError, match=r"position \(12, 3\)"):
            fit.to_xarray(position=np.zeros((12, 3)))

    @pytest.mark.parametrize("index", [slice(None), 0, 2])
    def test_it_is_saved_as_zarr_without_a_warning(self, index, tmp_path):
        xr = pytest.importorskip("xarray")
        pytest.importorskip("zarr")
        fit = mdr.fit_indentation(BALL, *a_map(), **ELASTIC, invalid="nan")[index]
        dataset = fit.to_xarray(position=np.zeros((*fit.shape, 2)))
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            dataset.to_zarr(tmp_path / "fit.zarr", consolidated=False)
            loaded = xr.open_zarr(tmp_path / "fit.zarr", consolidated=False).load()
        assert not told
        xr.testing.assert_equal(loaded, dataset)
        assert loaded.attrs == dataset.attrs
        assert loaded.covariance.sel(parameter="E_star", other_parameter="E_star").shape == fit.shape

    def test_it_is_saved_as_netcdf(self):
        xr = pytest.importorskip("xarray")
        dataset = mdr.fit_indentation(BALL, *a_map(), **ELASTIC, invalid="nan").to_xarray()
        loaded = xr.open_dataset(io.BytesIO(dataset.to_netcdf(engine="scipy")), engine="scipy").load()
        xr.testing.assert_equal(loaded, dataset)
        assert loaded.attrs == dataset.attrs
