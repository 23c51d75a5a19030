"""The medium from curves of force over depth."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from importlib.util import find_spec
from itertools import chain
from typing import Any

import numpy as np

from .. import _check
from .._check import Array, ArrayLike
from ..indentation import Indentation, indent
from ..medium import Medium, check_pair
from ..report import engineering
from ..shapes.profile import Profile
from ..superposition import tabulated
from ..yielding import LiveInterval
from .curve import NAMES
from .least_squares import Fit, covariances, in_units
from .remarks import remarks_of
from .solution import grouped, solved

#: So many curves that progress is shown.
_LONG = 256
#: Arrays of a result that say how good it is.
_QUALITY = ("covariance", "residuals", "reduced_chi_square", "force_noise")


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
    """The medium whose curve is nearest to a measured one, by least squares: the inverse of `indent`.

    A parameter that is None is free, a number is held. The curve should have an unloading: it is what tells
    E*, while the loading tells q_c.

    Parameters
    ----------
    profile : Profile
        The indenter, one for all curves.
    depth, force : array_like
        Measured depths (m) and forces (N) in the order of time, of one shape: one curve (N,), or many
        (R, N) of one tip, each on a virgin medium. Depths count from anywhere (`contact_point`).
    E_star, q_c : float, optional
        Effective modulus (Pa) and yield constant (N/m); `q_c=inf` holds the medium elastic.
    contact_point : float, optional
        Measured depth z₀ (m) at first contact.
    baseline : float, optional
        Force F₀ (N) that is shown without contact; 0 by default.
    frame_compliance : float, optional
        Compliance C (m/N) of what holds the indenter: the depth is z₀ + d + C (F − F₀). 0 by default.
    depth_noise : float, optional
        Standard deviation (m) of the measured depth. Give it where there is some: without it each jitter
        counts as depth once reached, and E* comes out too small.
    force_noise : float, optional
        Standard deviation (N) of the measured force. None estimates it: from the residuals, or with
        `depth_noise` from third differences of the force, which then must be sampled more finely than it
        bends.

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
    Standard errors come from the Jacobian at the solution, with the variance σ_F² + (S σ_d)². In simulated
    curves (400 samples, 0.4 % force noise, cone, paraboloid, sphere) deviations over errors have
    standard deviations of 0.9 to 1.2, with depth noise up to 1/15 of the depth too as long as it is less
    than the critical depth; where it is more, 1.5 to 3, and E* is off by a sixth. They are errors of the
    noise alone: where `remarks` says that residuals are none, the model or the tip is off by more.

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
    held = dict(zip(NAMES, (E_star, q_c, contact_point, baseline, frame_compliance), strict=True))
    fixed = {name: _held(name, value, len(depth)) for name, value in held.items() if value is not None}
    noise = _check.positive_number("depth_noise", depth_noise, unit="m") if depth_noise else 0.0
    sigma = None
    if force_noise is not None:
        sigma = _check.positive_number("force_noise", force_noise, unit="N")
    _refuse_empty(depth, force, fixed)
    tip = tabulated(profile, _reach(profile, depth, fixed))
    jobs = grouped(depth, force, noise)
    parts = [solved(tip, depth, force, fixed, noise, sigma, *job) for job in _progress(jobs, len(depth))]
    fit = _collected(profile, parts, len(depth), noise)
    return fit[0] if single else fit


def _data(depth, force):
    """Depth and force as rows of curves, and whether it is one."""
    depth = _check.finite_array("depth", depth, unit="m", most=_check.LARGEST)
    force = _check.finite_array("force", force, unit="N", most=_check.LARGEST)
    if depth.shape != force.shape or not 1 <= depth.ndim <= 2 or not depth.shape[-1]:
        raise ValueError(
            f"depth {depth.shape} and force {force.shape} must be of one shape, (N,) for a curve or (R, N) "
            "for many"
        )
    return np.atleast_2d(depth), np.atleast_2d(force), depth.ndim == 1


def _held(name, value, rows):
    """A held parameter, one number a curve."""
    unit = dict(zip(NAMES, ("Pa", "N/m", "m", "N", "m/N"), strict=True))[name]
    if name in ("E_star", "q_c"):
        value = _check.positive(name, value, unit=unit, infinite=name == "q_c")
    elif name == "frame_compliance":
        value = _check.positive(name, value, unit=unit, zero=True)
    else:
        value = _check.finite_array(name, value, unit=unit)
    _check.common_shape("fit_indentation", **{name: value, "curves": np.empty(rows)})
    return np.broadcast_to(value, (rows,)).astype(float)


def _refuse_empty(depth, force, fixed):
    free = [name for name in NAMES if name not in fixed]
    if depth.shape[1] <= len(free):
        raise ValueError(f"{depth.shape[1]} samples do not tell {', '.join(free)}: hold some or give more")
    still = np.ptp(depth, axis=1)
    _check.refuse("range of depth", still, still == 0, "m: the indenter does not move", remedy="check it")
    rise = force.max(axis=1) - fixed.get("baseline", force.min(axis=1))
    bound = "above the baseline: there is no contact in it"
    remedy = "forces count positive in compression; or give baseline=None"
    _check.refuse("largest force", rise, rise <= 0, bound, unit="N", remedy=remedy)
    flat = np.ptp(force, axis=1)
    _check.refuse("range of force", flat, flat == 0, "N: it tells nothing", remedy="check it")


def _reach(profile, depth, fixed):
    """Depth (m) to which the tip is tabulated: one whole range of the depth more than was measured."""
    reach = 2 * float(np.ptp(depth, axis=1).max())
    if "contact_point" in fixed:
        reach = max(reach, 1.01 * float((depth.max(axis=1) - fixed["contact_point"]).max()))
        deep = depth.max(axis=1) - fixed["contact_point"]
        if fixed.get("frame_compliance", np.ones(1)).max() == 0:
            profile._known(deep)
    return min(reach, profile.known_depth)


def _progress(jobs, count) -> "Iterator[Any]":
    """The jobs, with a bar if they are many and tqdm is there."""
    if count < _LONG or find_spec("tqdm") is None:
        yield from jobs
        return
    from tqdm import tqdm

    with tqdm(total=count, desc="fit_indentation", unit="curve") as bar:
        for job in jobs:
            yield job
            bar.update(len(job[0]))


def _collected(profile, parts, count, noise):
    """One result of all parts, in the order of the curves."""
    order = np.argsort(np.concatenate([rows for rows, *_ in parts]))
    pieces, remarks = zip(*(_piece(*part) for part in parts), strict=True)
    joined = {name: np.concatenate([piece[name] for piece in pieces])[order] for name in pieces[0]}
    said = list(chain.from_iterable(remarks))
    said = tuple(said[i] for i in order)
    free = parts[0][1].free
    errors = np.sqrt(np.einsum("rpp->rp", joined["covariance"]))
    medium = Medium(joined["E_star"], joined["q_c"])
    column = Medium(joined["E_star"][:, None], joined["q_c"][:, None])
    if noise:
        interval = LiveInterval(joined["lower"], joined["upper"], joined["length"])
        path = Indentation(profile, column, joined["depth"], interval)
    else:
        path = indent(profile, column, joined["depth"])
    return IndentationFit(
        profile, medium, *(_check.frozen(joined[name]) for name in NAMES[2:]),
        {name: _check.frozen(errors[:, i]) for i, name in enumerate(free)},
        *(_check.frozen(joined[name]) for name in _QUALITY),
        path, said,
    )  # fmt: skip


def _piece(rows, curves, solution, elastic, known):
    """What results keep, by name, of curves solved together, and what is to be said of each."""
    x, residual, jacobian = solution
    values, _, state = curves.states(x)
    values["q_c"] = np.where(elastic[:, None] == 2, np.inf, values["q_c"])
    free, freedom = len(curves.free), max(residual.shape[1] - x.shape[1], 1)
    chi = np.sum(residual**2, axis=1) / freedom
    covariance = covariances(jacobian, np.ones_like(chi) if known else chi)[:, :free, :free]
    scale = curves.scale[:, :free].copy()
    for i, name in enumerate(curves.free):
        if name in ("E_star", "q_c"):
            scale[:, i] = np.where(np.isfinite(values[name][:, 0]), values[name][:, 0], 1.0)
    said = remarks_of(curves, state, values, residual, jacobian, covariance, elastic, known)
    sigma = curves.sigma[:, 0]
    return {
        **{name: np.broadcast_to(values[name], (len(x), 1))[:, 0] for name in NAMES},
        "covariance": in_units(covariance, scale),
        "residuals": residual * curves.noise(state.slope),
        "reduced_chi_square": chi if known else np.ones_like(chi),
        "force_noise": sigma if known else sigma * np.sqrt(chi),
        "depth": state.depth, "lower": state.live_interval.lower, "upper": state.live_interval.upper,
        "length": state.live_interval.length,
    }, said  # fmt: skip


@dataclass(frozen=True, eq=False, repr=False)
class IndentationFit(Fit):
    """A medium fitted to a curve, or many to many; made by `fit_indentation`. `fit[i]` picks a curve.

    Attributes
    ----------
    medium : Medium
        With the fitted E* and q_c, arrays (R,) of many curves; q_c is infinite where nothing has yielded.
    contact_point, baseline, frame_compliance : float or ndarray
        Fitted or held (m, N, m/N).
    standard_errors : dict
        Of the free parameters by name, in their units; infinite where the data do not tell.
    covariance : ndarray
        Of the free parameters in the order of `standard_errors` (P, P), or (R, P, P).
    residuals : ndarray
        Measured force less that of the model at the measured depth (N).
    reduced_chi_square : float or ndarray
        Sum of squares in units of the noise over the degrees of freedom; 1 where the noise was estimated
        from the residuals.
    force_noise : float or ndarray
        Standard deviation of the force (N), given or estimated.
    indentation : Indentation
        The fitted model's states at all samples, at the depths that are most probable where they have
        noise.
    remarks : tuple of str
        What the data do not tell, and where they are not as the model has it.
    """

    profile: Profile
    medium: Medium
    contact_point: Array
    baseline: Array
    frame_compliance: Array
    standard_errors: dict[str, Array]
    covariance: Array
    residuals: Array
    reduced_chi_square: Array
    force_noise: Array
    indentation: Indentation
    _said: tuple[tuple[tuple[str, str], ...], ...] = field(default=(), repr=False)

    _parameters_of_fit = NAMES
    _dimensions = ("curve",)

    def __getitem__(self, index: Any) -> "IndentationFit":
        said = self._said[index] if isinstance(index, slice) else (self._said[index],)
        names = ("contact_point", "baseline", "frame_compliance")
        return IndentationFit(
            self.profile, self.medium.entries(index), *(getattr(self, name)[index] for name in names),
            {name: error[index] for name, error in self.standard_errors.items()},
            *(getattr(self, name)[index] for name in _QUALITY), self.indentation[index], said,
        )  # fmt: skip

    @property
    def remarks(self) -> tuple[str, ...]:
        """Remarks in words; of many curves each kind once, with how many it is about."""
        if not self.shape:
            return tuple(text for _, text in self._said[0])
        found: dict[str, list[tuple[int, str]]] = {}
        for i, said in enumerate(self._said):
            for kind, text in said:
                found.setdefault(kind, []).append((i, text))
        count = len(self._said)
        return tuple(f"curve {x[0][0]} ({len(x)} of {count} curves): {x[0][1]}" for x in found.values())

    def _quality(self):
        yield "force noise σ_F", engineering(self.force_noise, "N")
        yield "reduced χ²", engineering(self.reduced_chi_square, "")
