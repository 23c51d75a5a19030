"""Modulus to quote from a fit, and results of Oliver and Pharr for the fitted curve."""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from ...base.errors import MDRError
from ...base.remark import Remark, Remedy
from ...show.report import with_error
from ..common.errors import SIGNIFICANT, autocorrelation, roughness
from ..common.sample import SampleModulus, sample_modulus
from ..unloading.creep import COUNTS
from ..unloading.oliver_pharr import oliver_pharr
from ..unloading.oliver_pharr_result import OliverPharr
from .noise import EXACT
from .remarks import DOUBTS

#: Kinds of remarks that show that an elastic model does not describe the curve, or that E* is undetermined.
NOT_COMPARABLE = DOUBTS | {"unloading", "outliers"}
#: Kinds of remarks that show that the force is not that of the contact, for any medium.
OF_THE_FORCE = {"units", "no contact", "tilt", "drag", "drift"}
#: Largest depth and force of the first sample at first contact, as shares of the largest depth and force.
_SMALL = 1e-3
#: Largest residuals over the noise of neighbours, and largest correlation, if a model describes a curve.
_NOISE, _CORRELATED = 1.5, 0.3
#: Misfit of the best class of hardness above which the curve is not that of a contact.
_NO_CLASS = 0.05
#: Words for the sources of a number.
_SOURCES = {"fit": "by the fit", "unloading": "by Oliver and Pharr"}


@dataclass(frozen=True, repr=False)
class Quoted:
    """Modulus of one curve for comparison with tables and other instruments: `fit.quoted`.

    If the medium is elastic, or the model describes the curve to its noise, the modulus comes from the fit.
    If not, it comes from the unloading (Oliver and Pharr). Without either, `value`, `standard_error` and
    `source` are None. `reason` then has the cause, and `kind` and `remedy` are those of a `Remark`.

    Examples
    --------
    >>> import numpy as np
    >>> from mdr_core import Cone, Medium, fit_indentation, indent
    >>> d = np.linspace(-20e-9, 60e-9, 100)
    >>> F = indent(Cone(slope=0.3), Medium(E_star=10e9), d).force
    >>> fit_indentation(Cone(slope=0.3), d, F, q_c=np.inf).quoted
    E* 10 GPa by the fit: the medium is elastic
    """

    #: Name of the quantity, as in the parameters of a fit.
    quantity: str
    #: Value and standard error (Pa).
    value: float | None
    standard_error: float | None
    #: Source of the value: the fit, or the unloading alone.
    source: Literal["fit", "unloading"] | None
    #: Reason for this source, or for the missing value.
    reason: str
    #: Kind of the remark on a missing value, and remedies.
    kind: str | None = None
    remedy: tuple[Remedy, ...] = ()

    def sample_modulus(self, nu: float, tip: tuple[float, float] | None = None) -> SampleModulus:
        """Compute Young's modulus of the sample and its error (Pa), see `OliverPharr.sample_modulus`."""
        if self.value is None:
            raise MDRError(f"there is no E* to quote: {self.reason}")
        return sample_modulus(self.value, self.standard_error, nu, tip)

    def __repr__(self) -> str:
        if self.source is None:
            return f"no E*: {self.reason}"
        value = with_error(self.value, self.standard_error, "Pa")
        return f"E* {value} {_SOURCES[self.source]}: {self.reason}"


def quoted(fit):
    """Return the `Quoted` of one curve."""
    for kind in ("invalid", "deflection"):
        if doubt := _doubt(fit, {kind}):
            return _none(doubt)
    if fit.medium.q_c == np.inf:
        return _of_the_fit(fit, "the medium is elastic")
    if _describes(fit) and not _doubt(fit, NOT_COMPARABLE):
        found = _of_the_fit(fit, "the model describes the curve to its noise")
        if found.source:
            return found
    result, contact = fit.unloading
    if result is None:
        return _none(contact)
    if doubt := next((each for each in result.remarks if each.kind == "misfit"), None):
        return _none(doubt)
    if fit.classes and min(float(each.misfit) for each in fit.classes.values()) > _NO_CLASS:
        return _none(
            _doubt(fit, {"misfit"}) or Remark("no class of hardness describes the curve", "misfit")
        )
    reason = f"the medium yields; first contact {contact.text}"
    value, error = float(result.E_star), float(result.standard_errors["E_star"])
    return Quoted("E_star", value, error, "unloading", reason)


def _none(doubt):
    """Return a `Quoted` without a value, because of a doubt, a `Remark`."""
    return Quoted("E_star", None, None, None, doubt.text, doubt.kind, doubt.remedy)


def _describes(fit):
    """Whether the residuals are noise, or due to rounding."""
    residual = fit.residuals[np.isfinite(fit.residuals)]
    size, noise = np.sqrt(np.mean(residual**2)), roughness(residual[None])[0, 0]
    if size <= EXACT * np.ptp(fit.path.force):
        return True
    return size <= _NOISE * noise and autocorrelation(residual) < _CORRELATED


def _of_the_fit(fit, reason):
    """Return the `Quoted` of an elastic medium, or of a model that describes the curve."""
    if doubt := _doubt(fit, NOT_COMPARABLE):
        model = next((name for _, name in _others(fit)), "elastic")
        return _none(doubt.after(f"the {model} model does not fit: "))
    if "E_star" not in fit.standard_errors:
        return _none(Remark("E* is held", "undetermined", Remedy("free", "E_star")))
    value, error = float(fit.medium.E_star), float(fit.standard_errors["E_star"])
    if not error < np.inf:
        return _none(Remark("the data do not determine E*", "undetermined", Remedy("hold", "E_star")))
    return Quoted("E_star", value, error, "fit", reason)


def _others(fit):
    """Yield names of parameters beyond elasticity and plasticity, with an adjective for the medium."""
    for name, text in (("eta", "viscous"), ("work_of_adhesion", "adhesive")):
        if name in fit.standard_errors or getattr(fit.medium, name) > 0:
            yield name, text


def _doubt(fit, kinds):
    """Return the first remark of some kinds, or None."""
    return next((remark for remark in fit.remarks if remark.kind in kinds), None)


def unloading(fit) -> tuple[OliverPharr | None, Remark]:
    """Return results of Oliver and Pharr for one fitted curve and the source of first contact.

    If there are no results, return None and the reason. First contact comes from the record if it begins in
    the air, or at its zero. Otherwise it comes from the fit, with its error, unless remarks report that the
    model does not fit.
    """
    for name, text in _others(fit):
        text = f"the medium is {text}: its unloading does not follow a power law"
        return None, Remark(text, "no unloading", Remedy("hold", name, 0.0))
    # If the law of hardness does not fit, these remarks concern the law, not the force.
    if not _doubt(fit, {"misfit"}) and (doubt := _doubt(fit, OF_THE_FORCE)):
        return None, doubt.after("the force of the contact is not known: ")
    # Without background, the measured force is the force of the contact plus the residual.
    force = fit.path.force + fit.residuals
    try:
        if "contact_point" in fit.standard_errors and _begins_at_contact(fit.depth, force):
            result = _evaluated(fit, fit.depth, force)
            if "contact_point" not in result.standard_errors:
                return result, _first("is at depth 0")
        result = _evaluated(fit, fit.path.depth, force)
        if "contact_point" in result.standard_errors:
            return result, _first("is taken from the record, which begins in the air")
        if "contact_point" not in fit.standard_errors:
            return result, _first("is held")
        if doubt := _doubt(fit, DOUBTS):
            return None, doubt.after("the model does not fit, so first contact is not known: ")
        shift = fit.standard_errors["contact_point"]
        shifted = _evaluated(fit, fit.path.depth + shift, force)
    except MDRError as error:
        return None, Remark.of(error, error.kind or "no unloading")
    errors = {
        name: np.hypot(error, getattr(shifted, name) - getattr(result, name))
        for name, error in result.standard_errors.items()
    }
    return replace(result, standard_errors=errors), _first("is taken from the fit")


def _first(text):
    return Remark(text, "taken")


def _evaluated(fit, depth, force):
    """Return results of Oliver and Pharr, corrected for creep if times are given and creep is not small."""
    steps = np.zeros(1) if fit.time is None else np.diff(fit.time[np.isfinite(fit.time)])
    increases = np.any(steps) and not np.any(steps < 0)
    result = oliver_pharr(fit.profile, depth, force, time=fit.time if increases else None)
    if increases and abs(result.stiffness / result.uncorrected.stiffness - 1) <= COUNTS:
        return result.uncorrected
    return result


def _begins_at_contact(depth, force):
    """Whether depth and force of the first sample are 0 within a small noise."""
    used = np.isfinite(depth) & np.isfinite(force)
    depth, force = depth[used], force[used]
    noise = SIGNIFICANT * roughness(force[None])[0, 0]
    small = noise < _SMALL * force.max()
    return small and abs(depth[0]) < _SMALL * np.ptp(depth) and abs(force[0]) <= _SMALL * force.max()
