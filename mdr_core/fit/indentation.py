"""The medium from measured force–depth curves."""

from dataclasses import dataclass, replace
from itertools import chain
from typing import Any

import numpy as np

from .. import _check
from .._check import Array, ArrayLike
from ..indentation import Indentation
from ..medium import Medium, check_pair
from ..results.quantities import engineering
from ..shapes.profile import Profile
from ..superposition import tabulated
from ..yielding import LiveInterval
from .curve import PARAMETERS, REACH
from .least_squares import FITTED_QUANTITIES, Fit
from .remarks import remarks_of
from .solution import grouped, solved

#: Parameters besides those of the medium; arrays of a fit with one entry per curve.
_FURTHER = ("contact_point", "baseline", "frame_compliance")
_ARRAYS = (*_FURTHER, "covariance", "residuals", "reduced_chi_square", "force_noise")


@_check.keywords_explained
def fit_indentation(
    profile: Profile,
    depth: ArrayLike,
    force: ArrayLike,
    *,
    E_star: ArrayLike | None = None,
    q_c: ArrayLike | None = None,
    contact_point: ArrayLike | None = None,
    baseline: ArrayLike | None = 0.0,
    frame_compliance: ArrayLike | None = 0.0,
    depth_noise: float = 0.0,
    force_noise: float | None = None,
) -> "IndentationFit":
    """Fit a medium to a measured force–depth curve by least squares: the inverse of `indent`.

    Parameters that are None are free, numbers are held. The curve should have an unloading: it determines
    E*, the loading q_c.

    Parameters
    ----------
    profile : Profile
        The indenter, one for all curves.
    depth, force : array_like
        Measured depths (m) and forces (N) in the order of time, of one shape: one curve (N,), or many
        (R, N) with one indenter, each on a virgin medium. With `q_c=inf` the order does not matter.
    E_star, q_c : float, optional
        Effective modulus (Pa) and yield constant (N/m); `q_c=inf` holds the medium elastic.
    contact_point : float, optional
        Measured depth z₀ (m) at first contact, searched over the record and 30 of its ranges below.
    baseline : float, optional
        Measured force F₀ (N) without contact; 0 by default.
    frame_compliance : float, optional
        Compliance C (m/N) of the frame: the measured depth is z₀ + d + C (F − F₀). 0 by default.
    depth_noise : float, optional
        Standard deviation (m) of the measured depth. Without it noise counts as a new largest depth, and
        E* is too small.
    force_noise : float, optional
        Standard deviation (N) of the measured force. None estimates it from the residuals, or with
        `depth_noise` from third differences of the force, which requires fine sampling.

    Returns
    -------
    IndentationFit

    Raises
    ------
    ValueError
        If the data are not finite, of different shapes, have no force above the baseline, or fewer samples
        than free parameters.

    Notes
    -----
    Standard errors come from the Jacobian at the solution, with the variance σ_F² + (S σ_d)², S the slope.
    In simulated curves deviations over errors have standard deviations of 0.9 to 1.2; with depth noise
    above 1/15 of the depth or above the critical depth 1.5 to 3, and E* is wrong by a sixth. The errors are
    those of the noise alone: where `remarks` names correlated residuals, others are larger.

    Examples
    --------
    >>> import numpy as np
    >>> from mdr_core import Cone, Medium, indent
    >>> d = np.append(np.linspace(-5e-9, 60e-9, 100), np.linspace(60e-9, 30e-9, 50))
    >>> F = indent(Cone(slope=0.3), Medium(E_star=10e9, q_c=100.0), d).force
    >>> fit = fit_indentation(Cone(slope=0.3), d + 3e-9, F)
    >>> print(f"{fit.medium.E_star:.6g} {fit.medium.q_c:.6g} {fit.contact_point:.6g}")
    1e+10 100 3e-09
    """
    check_pair(profile, Medium(1.0), "a fit")
    depth, force, single = _data(depth, force)
    values = dict(zip(PARAMETERS, (E_star, q_c, contact_point, baseline, frame_compliance), strict=True))
    fixed = {name: _fixed(name, value, len(depth)) for name, value in values.items() if value is not None}
    noise = _check.positive_number("depth_noise", depth_noise, unit="m") if depth_noise else 0.0
    if force_noise is not None:
        force_noise = _check.positive_number("force_noise", force_noise, unit="N")
    _refuse_empty(depth, force, fixed)
    data = tabulated(profile, _table_depth(profile, depth, fixed)), depth, force, fixed, noise, force_noise
    fit = _collected(profile, [solved(*data, *group) for group in grouped(depth, force, fixed, noise)])
    return fit[0] if single else fit


def _data(depth, force):
    """Depth and force with one curve a row, and whether a single curve was given."""
    for name, values in (("depth", depth), ("force", force)):
        if np.ma.is_masked(values):
            raise ValueError(f"{name} has masked samples: leave them out of depth and force")
    depth = _check.finite_array("depth", depth, unit="m", most=_check.LARGEST)
    force = _check.finite_array("force", force, unit="N", most=_check.LARGEST)
    if depth.shape != force.shape or not 1 <= depth.ndim <= 2:
        raise ValueError(
            f"depth {depth.shape} and force {force.shape} must be of one shape, (N,) for a curve or (R, N) "
            "for many"
        )
    if not depth.size:
        raise ValueError("depth and force are empty: a curve needs more samples than free parameters")
    return np.atleast_2d(depth), np.atleast_2d(force), depth.ndim == 1


def _fixed(name, value, count):
    """A fixed parameter, one number a curve."""
    unit = FITTED_QUANTITIES[name].unit
    if isinstance(value, str):
        raise ValueError(
            f"{name} = {value!r} must be a number, which holds it, or None, which makes it free"
        )
    if name in ("contact_point", "baseline"):
        value = _check.finite_array(name, value, unit=unit)
    else:
        allowed = {"infinite": name == "q_c", "zero": name == "frame_compliance"}
        value = _check.positive(name, value, unit=unit, **allowed)
    _check.common_shape("fit_indentation", **{name: value, "curves": np.empty(count)})
    return np.broadcast_to(value, (count,)).astype(float)


def _refuse_empty(depth, force, fixed):
    free = [name for name in PARAMETERS if name not in fixed]
    count, names = depth.shape[1], ", ".join(free)
    if count <= len(free):
        raise ValueError(f"{count} samples do not determine {names}: hold some of these, or give more")
    width, height = np.ptp(depth, axis=1), np.ptp(force, axis=1)
    _check.refuse("range of depth", width, width == 0, "m: the indenter does not move", remedy="check it")
    rise = force.max(axis=1) - fixed.get("baseline", force.min(axis=1))
    bound, remedy = "above the baseline: no contact", "forces are positive in compression; or free baseline"
    _check.refuse("largest force", rise, rise <= 0, bound, unit="N", remedy=remedy)
    _check.refuse("range of force", height, height == 0, "N: it is constant", remedy="check it")


def _table_depth(profile, depth, fixed):
    """Depth (m) to which the profile is tabulated: that of the farthest contact point."""
    limit = (1 + REACH) * float(np.ptp(depth, axis=1).max())
    if "contact_point" in fixed:
        largest = depth.max(axis=1) - fixed["contact_point"]
        limit = max(limit, 1.01 * float(largest.max()))
        if fixed.get("frame_compliance", np.ones(1)).max() == 0:
            profile._known(largest)
    return min(limit, profile.known_depth)


def _collected(profile, fits):
    """One result of all `SolvedCurves`, in the order of the curves."""
    order = np.argsort(np.concatenate([fit.rows for fit in fits]))
    arrays = [_arrays(fit) for fit in fits]
    joined = {name: np.concatenate([group[name] for group in arrays])[order] for name in arrays[0]}
    remarks = list(chain.from_iterable(map(remarks_of, fits)))
    errors = np.sqrt(np.einsum("rpp->rp", joined["covariance"]))
    column = Medium(joined["E_star"][:, None], joined["q_c"][:, None])
    interval = LiveInterval(joined["lower"], joined["upper"], joined["length"])
    return IndentationFit(
        profile=profile, medium=Medium(joined["E_star"], joined["q_c"]),
        path=Indentation(profile, column, joined["depth"], interval),
        standard_errors={name: _check.frozen(errors[:, i]) for i, name in enumerate(fits[0].problem.free)},
        **{name: _check.frozen(joined[name]) for name in _ARRAYS},
        _remarks=tuple(remarks[i] for i in order),
    )  # fmt: skip


def _arrays(fit):
    """Arrays of `SolvedCurves` by name, one row a curve."""
    problem, (values, state) = fit.problem, fit.values_and_states
    units = problem.units(values)
    values = {name: np.broadcast_to(values[name], (len(fit.rows), 1))[:, 0] for name in PARAMETERS}
    chi, sigma = fit.reduced_chi_square, problem.sigma[:, 0]
    return values | {
        "covariance": fit.covariance * (units[:, :, None] * units[:, None, :]),
        "residuals": fit.residual * problem.noise(state.slope),
        "reduced_chi_square": chi if fit.noise_known else np.full_like(chi, np.nan),
        "force_noise": sigma if fit.noise_known else sigma * np.sqrt(chi),
        "depth": state.depth, "lower": state.live_interval.lower, "upper": state.live_interval.upper,
        "length": state.live_interval.length,
    }  # fmt: skip


@dataclass(frozen=True, eq=False, repr=False)
class IndentationFit(Fit):
    """Media fitted to one or many curves, a `Fit` returned by `fit_indentation`; `fit[i]` is one curve's.

    Parameters and errors are arrays (R,) for many curves, `covariance` is (R, P, P). q_c is infinite where
    nothing has yielded. Residuals are those of the force (N) at the measured depth.
    """

    #: Fitted or held values (m, N, m/N).
    contact_point: Array
    baseline: Array
    frame_compliance: Array
    standard_errors: dict[str, Array]
    #: Sum of squares in units of the noise over the degrees of freedom, NaN for noise from the residuals.
    reduced_chi_square: Array
    #: Standard deviation of the force (N), given or estimated.
    force_noise: Array
    #: States of the fitted model at all samples, with depth noise at the most probable depths.
    path: Indentation
    #: Remarks on each curve by their kind.
    _remarks: tuple[dict[str, str], ...]

    _further_parameters = _FURTHER
    _dimensions = ("curve",)

    def __getitem__(self, index: Any) -> "IndentationFit":
        if not self.shape:
            return super().__getitem__(index)
        return replace(
            self,
            medium=self.medium.entries(index),
            standard_errors={name: error[index] for name, error in self.standard_errors.items()},
            path=self.path[index],
            _remarks=self._remarks[index] if isinstance(index, slice) else (self._remarks[index],),
            **{name: getattr(self, name)[index] for name in _ARRAYS},
        )

    @property
    def remarks(self) -> tuple[str, ...]:
        """Remarks as sentences; of many curves one of each kind, with the number of such curves."""
        if not self.shape:
            return tuple(self._remarks[0].values())
        kinds: dict[str, dict[int, str]] = {}
        for i, remarks in enumerate(self._remarks):
            for kind, text in remarks.items():
                kinds.setdefault(kind, {})[i] = text
        return tuple(
            f"curve {min(texts)} ({len(texts)} of {len(self)} curves): {texts[min(texts)]}"
            for texts in kinds.values()
        )

    def _quality(self):
        yield "force noise σ_F", engineering(self.force_noise, "N")
        if np.isfinite(self.reduced_chi_square).all():
            yield "reduced χ²", engineering(self.reduced_chi_square, "")
