"""The modulus to quote from a fit, and the results of Oliver and Pharr for the fitted curve."""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from .creep import COUNTS
from .errors import SIGNIFICANT, roughness
from .oliver_pharr import oliver_pharr
from .oliver_pharr_result import OliverPharr
from .remarks import DOUBTS
from .report import with_error

#: Remarks that say that a model which is elastic does not describe the curve, or that E* is not determined.
NOT_COMPARABLE = DOUBTS | {"unloading", "outliers", "second minimum", "bound", "undetermined"}
#: Remarks that say that the force is not that of the contact, whatever the medium.
OF_THE_FORCE = {"units", "no contact", "tilt", "drag", "drift"}
#: Share of the largest depth and force, below which those of the first sample are those of first contact.
_SMALL = 1e-3
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


def quoted(fit, remarks):
    """`Quoted` of one curve, with its remarks by their kinds."""
    if fit.invalid:
        return _none(fit.invalid[0])
    if fit.medium.q_c == np.inf:
        return _of_the_fit(fit, remarks)
    result, contact = unloading(fit, remarks)
    if result is None:
        return _none(contact)
    reason = f"the medium yields; first contact {contact}"
    value, error = float(result.E_star), float(result.standard_errors["E_star"])
    return Quoted("E_star", value, error, "unloading", reason)


def _none(reason):
    return Quoted("E_star", None, None, None, reason)


def _of_the_fit(fit, remarks):
    """`Quoted` of a medium that is elastic."""
    if doubts := _doubts(remarks, NOT_COMPARABLE):
        return _none(f"the elastic model does not fit: {doubts[0]}")
    if "E_star" not in fit.standard_errors:
        return _none("E_star is held")
    value, error = float(fit.medium.E_star), float(fit.standard_errors["E_star"])
    if not error < np.inf:
        return _none("the data do not determine E*")
    return Quoted("E_star", value, error, "fit", "the medium is elastic")


def _doubts(remarks, kinds):
    """Remarks of some kinds."""
    return [text for kind, text in remarks.items() if kind.partition(":")[0] in kinds]


def unloading(fit, remarks) -> tuple[OliverPharr | None, str]:
    """Results of Oliver and Pharr for one fitted curve, and what first contact is; or None, and why.

    First contact is that of the record where it begins in the air, or at its own zero; else that of the
    fit, with its error, unless the model does not fit, of which its remarks by their kinds tell.
    """
    for name, text in (("eta", "viscous"), ("work_of_adhesion", "adhesive")):
        if name in fit.standard_errors or getattr(fit.medium, name) > 0:
            return None, f"the medium is {text}: its unloading does not follow a power law"
    # Beside a law of hardness that does not fit, these are of the law, not of the force.
    if not _doubts(remarks, {"misfit"}) and (doubts := _doubts(remarks, OF_THE_FORCE)):
        return None, f"the force of the contact is not known: {doubts[0]}"
    # Without background the measured force is that of the contact plus the residual.
    force = fit.path.force + fit.residuals
    try:
        result = _evaluated(fit, fit.path.depth, force)
        if "contact_point" in result.standard_errors:
            return result, "is taken from the record, which begins in the air"
        if "contact_point" not in fit.standard_errors:
            return result, "is held"
        if _begins_at_contact(fit.depth, force):
            return _evaluated(fit, fit.depth, force), "is at depth 0"
        if doubts := _doubts(remarks, DOUBTS):
            return (
                None,
                f"the model does not fit, so that its contact point is not first contact: {doubts[0]}",
            )
        shift = fit.standard_errors["contact_point"]
        shifted = _evaluated(fit, fit.path.depth + shift, force)
    except ValueError as error:
        return None, str(error)
    errors = {
        name: np.hypot(error, getattr(shifted, name) - getattr(result, name))
        for name, error in result.standard_errors.items()
    }
    return replace(result, standard_errors=errors), "is taken from the fit"


def _evaluated(fit, depth, force):
    """Results of Oliver and Pharr, corrected for creep where times are given and it is not small."""
    increases = fit.time is not None and not np.any(np.diff(fit.time[np.isfinite(fit.time)]) < 0)
    result = oliver_pharr(fit.profile, depth, force, time=fit.time if increases else None)
    if increases and abs(result.stiffness / result.uncorrected.stiffness - 1) <= COUNTS:
        return result.uncorrected
    return result


def _begins_at_contact(depth, force):
    """Whether the first sample has no depth and no force within the noise, which is small."""
    used = np.isfinite(depth) & np.isfinite(force)
    depth, force = depth[used], force[used]
    noise = SIGNIFICANT * roughness(force[None])[0, 0]
    small = noise < _SMALL * force.max()
    return small and abs(depth[0]) < _SMALL * np.ptp(depth) and abs(force[0]) <= _SMALL * force.max()
