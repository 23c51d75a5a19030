"""Base class of fits: values and standard errors of their parameters, and the printed report."""

from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ...base.check import Array
from ...base.results import Model, Record
from ...show.quantities import described, engineering
from ...show.report import limit_rows, rows, with_error
from ...solver.medium.medium import Medium
from ...solver.profiles.profile import Profile
from .parameters import CLASSES, MEDIUM, PARAMETERS

if TYPE_CHECKING:
    from numpy.typing import NDArray

LEAST_SQUARES = Model("least squares", "the medium with the smallest sum of squared residuals")


@dataclass(frozen=True, eq=False, repr=False)
class Fit(Record):
    """Base class of fits: values and standard errors of the parameters by name, and their report.

    Attributes
    ----------
    profile, medium
        The indenter, and the medium with fitted and held parameters.
    standard_errors : dict
        Standard errors of the free parameters by name, in their units; infinite if undetermined.
    covariance : ndarray
        Covariance of the free parameters, in the same order.
    residuals : ndarray
        Measured minus fitted values.
    remarks : tuple of Remark
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
    #: Names of all parameters, free or held, and of the parameters to hide if they are held at 0.
    _names: ClassVar[tuple[str, ...]] = ("E_star", *CLASSES.values())
    _zero_unless_asked: ClassVar[tuple[str, ...]] = ()

    def _values(self):
        """Return the values of all parameters by name."""
        return {name: getattr(self.medium if name in MEDIUM else self, name) for name in self._names}

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the fitted medium: () for one fit."""
        return self.medium.shape

    def to_dict(self) -> "dict[str, float | NDArray[np.float64]]":
        """Return all parameters by name, in SI units, and the standard errors of the free parameters.

        The name of an error ends in `_error`.
        """
        errors = {f"{name}_error": error for name, error in self.standard_errors.items()}
        return {name: v if np.ndim(v) else float(v) for name, v in (self._values() | errors).items()}

    @property
    def correlations(self) -> dict[tuple[str, str], float]:
        """Correlations above 0.9 between two parameters of one fit, by their names."""
        if self.shape:
            raise TypeError(
                "correlations are defined for a single fit: select one, as in fit[0].correlations"
            )
        sigma, names, correlations = np.sqrt(np.diag(self.covariance)), list(self.standard_errors), {}
        for i, j in combinations(range(len(names)), 2):
            if 0 < sigma[i] * sigma[j] < np.inf:
                correlations[names[i], names[j]] = float(self.covariance[i, j] / sigma[i] / sigma[j])
        return {pair: value for pair, value in correlations.items() if abs(value) > 0.9}

    def _rows(self):
        yield "indenter", described(self.profile)
        yield from self._comparable()
        for name, value in self._values().items():
            free = name in self.standard_errors
            if free or np.any(value) or name not in self._zero_unless_asked:
                quantity = PARAMETERS[name].quantity
                yield f"{quantity.long_name} {quantity.symbol}", self._text(name, value, quantity.unit)
        yield from self._quality()
        if not self.shape:
            for (first, second), value in self.correlations.items():
                yield "correlation", f"{first}, {second}: {value:+.3f}"

    def _text(self, name, value, unit):
        """Return a value with its standard error as text; for many fits, the range and the median error."""
        if name not in self.standard_errors:
            return f"{engineering(np.extract(~np.isnan(value), value), unit)} (held)"
        return with_error(value, self.standard_errors[name], unit)

    def _comparable(self):
        """Yield rows on values that are comparable with tables."""
        yield from ()

    def _quality(self):
        """Yield rows on the quality of the fit."""
        yield from ()


@rows.register
def _rows_of_fit(fit: Fit):
    return fit._rows()  # noqa: SLF001


@limit_rows.register
def _limit_rows_of_fit(fit: Fit, most):
    yield from (("remark", remark) for remark in fit.remarks)
    yield from limit_rows.dispatch(Record)(fit, most)
