"""Standard errors of linear problems whose covariance is known in closed form."""

import numpy as np

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
