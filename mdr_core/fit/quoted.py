"""The number of a fit that is to be quoted, and the results of Oliver and Pharr beside a fit."""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from .oliver_pharr import OliverPharr, oliver_pharr
from .remarks import DOUBTS
from .report import with_error

#: Words for the sources of a number.
_SOURCES = {"fit": "by the fit", "unloading": "by Oliver and Pharr"}


@dataclass(frozen=True, repr=False)
class Quoted:
    """The modulus of one curve that is comparable with tables and other instruments: `fit.quoted`.

    Of a medium that yields it is that of its unloading by Oliver and Pharr, of an elastic one that of the
    fit. Where neither holds `value`, `standard_error` and `source` are None, and `reason` says why.

    Examples
    --------
    >>> import numpy as np
    >>> from mdr_core import Cone, Medium, fit_indentation, indent
    >>> d = np.linspace(-20e-9, 60e-9, 100)
    >>> F = indent(Cone(slope=0.3), Medium(E_star=10e9), d).force
    >>> fit_indentation(Cone(slope=0.3), d, F, q_c=np.inf).quoted
    E* 10 GPa by the fit: the medium is elastic
    """

    #: Name of the quantity, as among the parameters of a fit.
    quantity: str
    #: Value and standard error (Pa).
    value: float | None
    standard_error: float | None
    #: Whether it is a parameter of the fit, or of the unloading alone.
    source: Literal["fit", "unloading"] | None
    #: Why it is this one, or why there is none.
    reason: str

    def __repr__(self) -> str:
        if self.source is None:
            return f"no E*: {self.reason}"
        value = with_error(self.value, self.standard_error, "Pa")
        return f"E* {value} {_SOURCES[self.source]}: {self.reason}"


def quoted(fit):
    """`Quoted` of one curve."""
    if fit.invalid:
        return Quoted("E_star", None, None, None, fit.invalid[0])
    if fit.medium.q_c == np.inf:
        return _of_the_fit(fit)
    result, reason = unloading(fit)
    if result is None:
        return Quoted("E_star", None, None, None, reason)
    value, error = float(result.E_star), float(result.standard_errors["E_star"])
    reason = "the medium yields, and the unloading does not depend on how"
    return Quoted("E_star", value, error, "unloading", reason)


def _of_the_fit(fit):
    """`Quoted` of a medium that is elastic."""
    if doubts := _doubts(fit):
        return Quoted("E_star", None, None, None, f"the model does not fit: {doubts[0]}")
    if "E_star" not in fit.standard_errors:
        return Quoted("E_star", None, None, None, "E_star is held")
    value, error = float(fit.medium.E_star), float(fit.standard_errors["E_star"])
    if not error < np.inf:
        return Quoted("E_star", None, None, None, "the data do not determine E*")
    return Quoted("E_star", value, error, "fit", "the medium is elastic")


def _doubts(fit):
    """Remarks that say that the model does not fit."""
    return [text for kind, text in fit._remarks[0].items() if kind in DOUBTS]


def unloading(fit) -> tuple[OliverPharr | None, str]:
    """Results of Oliver and Pharr for one fitted curve, and why there are none.

    Depth counts from the contact point of the fit, whose error is in those of the results.
    """
    for name, text in (("eta", "viscous"), ("work_of_adhesion", "adhesive")):
        if name in fit.standard_errors or getattr(fit.medium, name) > 0:
            return None, f"the medium is {text}: its unloading is no power law of the depth"
    if doubts := _doubts(fit):
        return None, f"the model does not fit, so that its contact point is none: {doubts[0]}"
    # Without background the measured force is that of the contact plus the residual.
    force, shift = fit.path.force + fit.residuals, fit.standard_errors.get("contact_point", 0.0)
    try:
        result = oliver_pharr(fit.profile, fit.path.depth, force)
        shifted = oliver_pharr(fit.profile, fit.path.depth + shift, force)
    except ValueError as error:
        return None, str(error)
    errors = {
        name: np.hypot(error, getattr(shifted, name) - getattr(result, name))
        for name, error in result.standard_errors.items()
    }
    return replace(result, standard_errors=errors), ""
