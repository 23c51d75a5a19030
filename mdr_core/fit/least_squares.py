"""Least squares for many small problems at once, standard errors, and the base class of fits."""

from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from .._check import Array
from ..medium import Medium
from ..results.base import Model
from ..results.quantities import QUANTITIES, Quantity, described, engineering, prefixed
from ..results.report import Report
from ..shapes.profile import Profile

if TYPE_CHECKING:
    from numpy.typing import NDArray

LEAST_SQUARES = Model("least squares", "the medium whose model has the least squares of residuals")

#: Singular values below this share of the largest one leave their combination of parameters undetermined.
SINGULAR = 1e-11
#: Number of standard errors above which a trend or a correlation is significant.
SIGNIFICANT = 4.0
#: Quantities of results, and further parameters of fits.
FITTED_QUANTITIES = QUANTITIES | {
    "contact_point": Quantity("z₀", "m", "contact point"),
    "baseline": Quantity("F₀", "N", "baseline"),
    "tilt": Quantity("F₁", "N/m", "tilt of the baseline"),
    "drag": Quantity("ζ", "N·s/m", "drag"),
    "contact_depth": Quantity("h_c", "m", "contact depth"),
    "hardness": Quantity("H", "Pa", "hardness"),
    "exponent": Quantity("m", "", "exponent"),
}


def least_squares(function, start, lower, upper, *, steps=200, tolerance=1e-11):
    """Least squares by the Levenberg–Marquardt method, one problem a row: x, residual, jacobian.

    `function(x, rows)` returns residuals (R, N) and derivatives (R, N, P) at scaled parameters x (R, P),
    about 1, of the problems `rows`. SciPy solves one problem a call; here many curves share every step.
    """
    x = np.clip(start, lower, upper)
    rows, damping = np.arange(len(x)), np.full(len(x), 1e-4)
    residual, jacobian = function(x, rows)
    cost = np.sum(residual**2, axis=1)
    for _ in range(steps if x.shape[1] else 0):
        derivatives, low, high = jacobian[rows], lower[rows], upper[rows]
        # A parameter at a bound does not move across it.
        gradient = np.einsum("rn,rnp->rp", residual[rows], derivatives)
        blocked = ((x[rows] <= low) & (gradient > 0)) | ((x[rows] >= high) & (gradient < 0))
        step = _step(residual[rows], np.where(blocked[:, None, :], 0.0, derivatives), damping[rows])
        trial = np.clip(x[rows] + np.clip(step, -1.5, 1.5), low, high)
        size = np.abs(trial - x[rows]).max(axis=1)
        trial_residual, trial_jacobian = function(trial, rows)
        trial_cost = np.sum(trial_residual**2, axis=1)
        better = trial_cost < cost[rows]
        improved = rows[better]
        x[improved], cost[improved] = trial[better], trial_cost[better]
        residual[improved], jacobian[improved] = trial_residual[better], trial_jacobian[better]
        damping[rows] *= np.where(better, 0.03, 10.0)
        # Where no step, however short, improves the sum of squares, rounding is larger than the step.
        rows = rows[(size > tolerance) & (damping[rows] < 1e9)]
        if not rows.size:
            break
    return x, residual, jacobian


def _step(residual, jacobian, damping):
    u, s, vt = np.linalg.svd(jacobian, full_matrices=False)
    inverse = s / (s**2 + damping[:, None] * s[:, :1] ** 2 + 1e-300)
    coordinates = np.einsum("rnk,rn->rk", u, residual) * np.where(s > 1e-14 * s[:, :1], inverse, 0.0)
    return -np.einsum("rk,rkp->rp", coordinates, vt)


def covariances(jacobian, variance):
    """Covariance of scaled parameters (R, P, P); undetermined ones have infinite variance, covariance 0."""
    _, s, vt = np.linalg.svd(jacobian, full_matrices=False)
    largest = np.maximum(s[:, :1], 1e-150)
    singular = s <= SINGULAR * largest
    root = vt / np.maximum(s, 1e-14 * largest)[..., None]
    root = np.where(singular[..., None], 0.0, root)
    covariance = np.einsum("rkp,rkq->rpq", root, root) * np.reshape(variance, (-1, 1, 1))
    # Scaled parameters are about 1.
    wide = np.einsum("rpp->rp", covariance) > 30.0**2
    undetermined = wide | np.any(singular[..., None] & (np.abs(vt) > 1e-3), axis=1)
    covariance[undetermined[:, :, None] | undetermined[:, None, :]] = 0.0
    np.einsum("rpp->rp", covariance)[undetermined] = np.inf
    return covariance


def roughness(values):
    """Standard deviation of the noise of smooth rows (R, 1) from third differences, 0 for few samples."""
    if values.shape[1] < 8:
        return np.zeros((len(values), 1))
    # The median of absolute normal deviations is 0.6745, the variance of third differences 20.
    differences = np.median(np.abs(np.diff(values, 3, axis=1)), axis=1, keepdims=True)
    return differences / (0.6745 * np.sqrt(20.0))


def autocorrelation(residual):
    """Correlation of residuals with their neighbours along the last axis, 0 for noise."""
    power = np.sum(residual**2, axis=-1)
    return np.sum(residual[..., 1:] * residual[..., :-1], axis=-1) / np.maximum(power, 1e-300)


def autocorrelations(residual):
    """Correlation of residuals (N,) with those 0 to N − 1 samples later."""
    count = residual.size
    products = np.fft.irfft(np.abs(np.fft.rfft(residual, 2 * count)) ** 2, 2 * count)[:count]
    return products / max(products[0], 1e-300)


def block_length(residual):
    """Number of samples over which residuals (N,) are correlated, 1 for noise.

    The first lag at which the autocorrelation is not positive, at most a fifth of the samples.
    """
    correlation = autocorrelations(residual)
    if not np.any(correlation[1:2] > SIGNIFICANT / np.sqrt(residual.size)):
        return 1
    return min(int(np.argmax(correlation <= 0)) or residual.size, max(residual.size // 5, 1))


def block_factors(residual, jacobian, length):
    """Standard errors with correlated residuals over those with independent ones, at least 1 (P,).

    The variance of a parameter is the sum of (1 − k/length) ψ_i ψ_j r_i r_j over all pairs of samples that
    are k = |i − j| < `length` apart, ψ the influence of a residual r on it (Newey & West, Econometrica 55,
    1987, 703): the mean square of sums over overlapping blocks. Where few blocks determine a parameter
    this is too small. With the mean of r_i r_j over all pairs instead it is not; the larger one counts.
    """
    u, s, vt = np.linalg.svd(jacobian, full_matrices=False)
    influence = (u * np.where(s > SINGULAR * s[0], 1 / np.maximum(s, 1e-300), 0.0)) @ vt
    single = np.maximum(np.sum(influence**2, axis=0), 1e-300)
    sums = np.cumsum(np.pad(influence * residual[:, None], ((length, length), (0, 0))), axis=0)
    blocks = np.sum((sums[length:] - sums[:-length]) ** 2, axis=0) / length / np.mean(residual**2)
    products = np.fft.irfft(np.abs(np.fft.rfft(influence, 2 * len(u), axis=0)) ** 2, 2 * len(u), axis=0)
    weights = (2 - 2 * np.arange(length) / length) * autocorrelations(residual)[:length]
    weights[0] = 1.0
    return np.sqrt(np.maximum(1.0, np.maximum(blocks, weights @ products[:length]) / single))


def with_error(value, error, unit):
    """A number and its standard error as text, with one prefix and two digits of the error.

    An error below 10⁻⁶ of the number is that of the arithmetic, and left out.
    """
    if value == np.inf:
        return "∞"
    if error == np.inf:
        number, _, unit = engineering(value, unit).partition(" ")
        return f"{number} ± ∞ {unit}".rstrip()
    factor, unit = prefixed(max(abs(value), error), unit)
    value, error = value / factor, error / factor
    if error <= 1e-6 * abs(value):
        return f"{value:.6g} {unit}".rstrip()
    digits = max(0, 1 - int(np.floor(np.log10(error))))
    return f"{value:.{digits}f} ± {error:.{digits}f} {unit}".rstrip()


@dataclass(frozen=True, eq=False, repr=False)
class Fit(Report):
    """Base class of fits: values and standard errors of the parameters by name, and their report.

    Attributes
    ----------
    profile, medium
        The indenter, and the medium with fitted and held parameters.
    standard_errors : dict
        Standard errors of the free parameters by name, in their units; infinite where undetermined.
    covariance : ndarray
        Covariance of the free parameters, in that order.
    residuals : ndarray
        Measured minus fitted values.
    remarks : tuple of str
        Parameters that the data do not determine, and deviations from the model.
    """

    profile: Profile
    medium: Medium
    standard_errors: dict[str, Any]
    covariance: Array
    residuals: Array

    model = LEAST_SQUARES
    _shown = ("medium",)
    _dimensions = ("fit",)
    #: Names of all parameters, free or fixed: attributes of the medium, and of the fit itself.
    _medium_parameters: ClassVar[tuple[str, ...]] = ("E_star", "q_c")
    _further_parameters: ClassVar[tuple[str, ...]] = ()
    #: Parameters that are not shown where they are held at 0.
    _zero_unless_asked: ClassVar[tuple[str, ...]] = ()

    def _values(self):
        """Values of all parameters by name."""
        values = {name: getattr(self.medium, name) for name in self._medium_parameters}
        return values | {name: getattr(self, name) for name in self._further_parameters}

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the fitted medium: () for one fit."""
        return self.medium.shape

    def to_dict(self) -> "dict[str, float | NDArray[np.float64]]":
        """Values of all parameters by name, in SI units, and the standard errors of the free ones.

        The name of an error ends in `_error`.
        """
        errors = {f"{name}_error": error for name, error in self.standard_errors.items()}
        return {name: v if np.ndim(v) else float(v) for name, v in (self._values() | errors).items()}

    @property
    def correlations(self) -> dict[tuple[str, str], float]:
        """Correlations above 0.9 of two parameters of one fit, by their names."""
        if self.shape:
            raise TypeError("correlations are those of one fit: pick it, as in fit[0].correlations")
        sigma, correlations = np.sqrt(np.diag(self.covariance)), {}
        for (i, first), (j, second) in combinations(enumerate(self.standard_errors), 2):
            if 0 < sigma[i] * sigma[j] < np.inf:
                value = float(self.covariance[i, j] / sigma[i] / sigma[j])
                correlations |= {(first, second): value} if abs(value) > 0.9 else {}
        return correlations

    def _rows(self):
        yield "indenter", described(self.profile)
        for name, value in self._values().items():
            quantity, error = FITTED_QUANTITIES[name], self.standard_errors.get(name)
            unit = quantity.unit
            if error is None and name in self._zero_unless_asked and not np.any(value):
                continue
            if error is None:
                text = f"{engineering(value, unit)} (held)"
            elif np.ndim(value):
                text = engineering(value, unit)
                text += f", ± {engineering(np.median(error), unit)}" if np.size(value) else ""
            else:
                text = with_error(value, error, unit)
            yield f"{quantity.long_name} {quantity.symbol}", text
        yield from self._quality()
        if not self.shape:
            for (first, second), value in self.correlations.items():
                yield "correlation", f"{first}, {second}: {value:+.3f}"

    def _quality(self):
        yield from ()

    def _limit_rows(self, most):
        yield from (("remark", remark) for remark in self.remarks)
        yield from super()._limit_rows(most)
