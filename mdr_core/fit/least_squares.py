"""Least squares for many small problems at once, their errors, and how fits are shown."""

from itertools import combinations
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ..quantities import QUANTITIES, Quantity, described, engineering, prefixed
from ..report import Report
from ..results import Model

if TYPE_CHECKING:
    from numpy.typing import NDArray

LEAST_SQUARES = Model("least squares", "the medium whose model is nearest to what was measured")

#: Singular values below this share of the largest one tell nothing of what they combine.
_SINGULAR = 1e-11
#: Errors of a logarithm, or in units of the whole measurement, beyond which a parameter is not told.
_UNKNOWN = 30.0
#: Third differences of noise of unit size: the median of their absolute values.
_THIRD = 0.6745 * np.sqrt(20.0)
#: Correlations that are shown are larger.
_CORRELATED = 0.9

#: What fits have beside quantities of results.
_OTHERS = {
    "contact_point": Quantity("z₀", "m", "contact point"),
    "baseline": Quantity("F₀", "N", "baseline"),
    "frame_compliance": Quantity("C", "m/N", "frame compliance"),
}


def least_squares(function, start, low, high, *, most=80, close=1e-11):
    """Parameters with the least sum of squares, by Levenberg and Marquardt's method; one problem a row.

    SciPy solves one problem a call; here a thousand curves share every step.

    Parameters
    ----------
    function : callable
        `function(x, rows)` has residuals (R, N) and their derivatives (R, N, P) for parameters x (R, P) of
        the problems `rows`. Parameters are scaled: logarithms, or shares of the measured range.
    start, low, high : ndarray, shape (R, P)
        Where to begin, and bounds.

    Returns
    -------
    x, residual, jacobian : ndarray
    """
    x = np.clip(start, low, high)
    rows, damping = np.arange(len(x)), np.full(len(x), 1e-4)
    residual, jacobian = function(x, rows)
    cost = np.sum(residual**2, axis=1)
    for _ in range(most if x.shape[1] else 0):
        slopes = jacobian[rows]
        # At a bound what would go beyond stays.
        down = np.einsum("rn,rnp->rp", residual[rows], slopes)
        stays = ((x[rows] <= low[rows]) & (down > 0)) | ((x[rows] >= high[rows]) & (down < 0))
        step = _step(residual[rows], np.where(stays[:, None, :], 0.0, slopes), damping[rows])
        new = np.clip(x[rows] + np.clip(step, -1.5, 1.5), low[rows], high[rows])
        size = np.abs(new - x[rows]).max(axis=1)
        trial, slopes = function(new, rows)
        least = np.sum(trial**2, axis=1)
        better = least < cost[rows]
        kept = rows[better]
        x[kept], residual[kept], jacobian[kept] = new[better], trial[better], slopes[better]
        cost[kept] = least[better]
        damping[rows] *= np.where(better, 0.03, 10.0)
        # Where nothing is gained by whatever short a step rounding has the last word.
        rows = rows[(size > close) & (damping[rows] < 1e9)]
        if not rows.size:
            break
    return x, residual, jacobian


def _step(residual, jacobian, damping):
    u, s, vt = np.linalg.svd(jacobian, full_matrices=False)
    share = s / (s**2 + damping[:, None] * s[:, :1] ** 2 + 1e-300)
    along = np.einsum("rnk,rn->rk", u, residual) * np.where(s > 1e-14 * s[:, :1], share, 0.0)
    return -np.einsum("rk,rkp->rp", along, vt)


def covariances(jacobian, variance):
    """Covariance of scaled parameters (R, P, P); of what is not told infinite variances, and 0 else."""
    _, s, vt = np.linalg.svd(jacobian, full_matrices=False)
    top = np.maximum(s[:, :1], 1e-150)
    blind = s <= _SINGULAR * top
    root = vt / np.maximum(s, 1e-14 * top)[..., None]
    told = np.where(blind[..., None], 0.0, root)
    covariance = np.einsum("rkp,rkq->rpq", told, told) * np.reshape(variance, (-1, 1, 1))
    wide = np.einsum("rpp->rp", covariance) > _UNKNOWN**2
    unknown = wide | np.any(blind[..., None] & (np.abs(vt) > 1e-3), axis=1)
    covariance[unknown[:, :, None] | unknown[:, None, :]] = 0.0
    np.einsum("rpp->rp", covariance)[unknown] = np.inf
    return covariance


def in_units(covariance, scale):
    """Covariance of the parameters, from that of scaled ones and what one unit of these is (R, P)."""
    return covariance * (scale[:, :, None] * scale[:, None, :])


def roughness(values):
    """Standard deviation of the noise of smooth rows (R, 1), from third differences."""
    return np.median(np.abs(np.diff(values, 3, axis=1)), axis=1, keepdims=True) / _THIRD


def autocorrelation(residual):
    """How much a residual is like its neighbour, along the last axis: 0 for noise."""
    power = np.sum(residual**2, axis=-1)
    return np.sum(residual[..., 1:] * residual[..., :-1], axis=-1) / np.maximum(power, 1e-300)


def with_error(value, error, unit):
    """A number and its standard error, with one prefix and as many digits as the error has.

    Examples
    --------
    >>> with_error(95.234e9, 0.31e9, "Pa"), with_error(2.5e-9, 0.0, "m"), with_error(1.0, float("inf"), "N")
    ('95.23 ± 0.31 GPa', '2.5 ± 0 nm', '1 ± ∞ N')
    """
    if not np.isfinite(value) or not np.isfinite(error) or error == 0:
        rest = "∞" if error == np.inf else "0"
        number, _, unit = engineering(value, unit).partition(" ")
        return f"{number} ± {rest} {unit}".rstrip()
    factor, unit = prefixed(max(abs(value), error), unit)
    value, error = value / factor, error / factor
    if error < 1e-9 * abs(value):
        return f"{value:.10g} ± {error:.1e} {unit}".rstrip()
    digits = max(0, 1 - int(np.floor(np.log10(error))))
    return f"{value:.{digits}f} ± {error:.{digits}f} {unit}".rstrip()


class Fit(Report):
    """What fits share: how they are shown, and their values with errors by name."""

    model = LEAST_SQUARES
    _shown = ("medium",)
    _dimensions = ("fit",)
    #: Names of all parameters of the fit, free or held.
    _parameters_of_fit: ClassVar[tuple[str, ...]] = ("E_star", "q_c")

    profile: Any
    medium: Any
    standard_errors: dict[str, Any]
    covariance: Any

    def _value(self, name):
        return getattr(self.medium if hasattr(self.medium, name) else self, name)

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the fitted medium: () for one fit."""
        return self.medium.shape

    def to_dict(self) -> "dict[str, float | NDArray[np.float64]]":
        """Values of all parameters by name, in SI units, and the standard errors of the free ones.

        An error's name ends in `_error`.
        """
        values = {name: self._value(name) for name in self._parameters_of_fit}
        errors = {f"{name}_error": error for name, error in self.standard_errors.items()}
        return {name: v if np.ndim(v) else float(v) for name, v in (values | errors).items()}

    def _parameters(self):
        return {}

    @property
    def correlations(self) -> dict[tuple[str, str], float]:
        """Correlations of two parameters of one fit that are above 0.9, by their names."""
        if self.shape:
            raise TypeError("correlations are those of one fit: pick it, as in fit[0].correlations")
        sigma, found = np.sqrt(np.diag(self.covariance)), {}
        for (i, one), (j, other) in combinations(enumerate(self.standard_errors), 2):
            if 0 < sigma[i] * sigma[j] < np.inf:
                value = float(self.covariance[i, j] / sigma[i] / sigma[j])
                found |= {(one, other): value} if abs(value) > _CORRELATED else {}
        return found

    def _rows(self):
        yield "indenter", described(self.profile)
        for name in self._parameters_of_fit:
            known, value = QUANTITIES.get(name) or _OTHERS[name], self._value(name)
            error = self.standard_errors.get(name)
            if error is None:
                text = f"{engineering(value, known.unit)} (held)"
            elif np.ndim(value):
                text = f"{engineering(value, known.unit)}, ± {engineering(np.median(error), known.unit)}"
            else:
                text = with_error(value, error, known.unit)
            yield f"{known.long_name} {known.symbol}", text
        yield from self._quality()
        if not self.shape:
            for (one, other), value in self.correlations.items():
                yield "correlation", f"{one}, {other}: {value:+.3f}"

    def _quality(self):
        yield from ()

    def _limit_rows(self, most):
        yield from (("remark", remark) for remark in self.remarks)
