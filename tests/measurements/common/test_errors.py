"""Standard errors of linear problems whose covariance is known in closed form."""

import numpy as np
import pytest

from mdr_core.measurements.common.errors import block_factors, covariances

from ...approx import approx


def test_a_parameter_on_which_nothing_depends_leaves_the_others_their_errors():
    """Covariance s² (JᵀJ)⁻¹ of the two that are determined, as without the third."""
    two = np.array([[1.0, 0.0], [0.0, 2.0], [1.0, 1.0], [0.5, -1.0]])
    three = np.insert(two, 2, 0.0, axis=1)
    expected = 0.25 * np.linalg.inv(two.T @ two)
    (found,) = covariances(three[None], np.array([0.25]))
    # A condition number of some units, in double precision.
    np.testing.assert_allclose(found[:2, :2], expected, rtol=1e-13)
    assert found[2, 2] == np.inf
    assert np.all(found[2, :2] == 0)


def test_a_sum_of_parameters_alone_determines_neither():
    """Columns that are the same: only the sum of both is known; a third one keeps its error."""
    jacobian = np.array([[1.0, 1.0, 0.0], [2.0, 2.0, 0.0], [0.0, 0.0, 3.0], [0.0, 0.0, 1.0]])
    (found,) = covariances(jacobian[None], np.array([1.0]))
    assert np.all(np.diag(found)[:2] == np.inf)
    assert found[2, 2] == approx(1 / 10)


def test_errors_with_correlated_residuals_are_those_without_a_parameter_that_does_nothing():
    """Residuals that come in runs of ten: a mean is then known √10 times worse, about."""
    residual = np.repeat(np.random.default_rng(1).standard_normal(60), 10)
    one = np.ones((residual.size, 1))
    (factor,) = block_factors(residual, one, 20)
    # Of 60 runs, whose variance is known to a fifth, by blocks of twice their length.
    assert factor == approx(np.sqrt(10), rel=0.2)
    assert block_factors(residual, np.insert(one, 1, 0.0, axis=1), 20)[0] == approx(factor, rel=1e-12)


@pytest.mark.parametrize("length", [2, 7, 20])
@pytest.mark.parametrize("place", [0, 3])
def test_the_factor_is_that_of_the_sums_over_all_pairs_of_samples(length, place):
    """Both estimates of the docstring as double sums; the influences are rows of the pseudo-inverse."""
    t = np.arange(30.0)
    residual = np.convolve(np.random.default_rng(place).standard_normal(34), np.ones(5), "valid")
    jacobian = np.column_stack([np.ones(30), t, np.exp(-((t - place) ** 2) / 8)])
    psi = np.linalg.pinv(jacobian)
    apart = np.abs(np.subtract.outer(t, t)).astype(int)
    weight = np.maximum(1 - apart / length, 0)
    lagged = np.array([residual[k:] @ residual[: 30 - k] for k in range(30)])
    pairs = np.outer(residual, residual) / np.mean(residual**2), lagged[apart] / lagged[0]
    larger = np.max([np.einsum("pi,pj,ij->p", psi, psi, weight * each) for each in pairs], axis=0)
    expected = np.sqrt(np.maximum(1.0, larger / np.sum(psi**2, axis=1)))
    np.testing.assert_allclose(block_factors(residual, jacobian, length), expected, rtol=1e-10)
