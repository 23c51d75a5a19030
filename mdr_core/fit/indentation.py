"""The medium from curves of force over depth."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from importlib.util import find_spec
from typing import Any, ClassVar

import numpy as np

from .. import _check
from .._check import Array, ArrayLike
from .._numeric import chunks
from ..indentation import Indentation, indent
from ..medium import Medium, check_pair
from ..report import engineering
from ..shapes.profile import Profile
from ..shapes.tabulated import tabulated
from ..yielding import LiveInterval
from .curve import NAMES, Curves, first_guess, turning_points
from .least_squares import Fit, covariances, in_units, least_squares
from .remarks import remarks_of

#: Curves that share their steps, and so many that progress is shown.
_TOGETHER, _LONG = 64, 256
#: How often turning points are found anew.
_ROUNDS = 5
#: Third differences of noise of unit size: the median of their absolute values.
_THIRD = 0.6745 * np.sqrt(20.0)
#: Stands for the logarithm of an infinite q_c.
_LOG_OF_INFINITE = 300.0


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
        `depth_noise` from third differences of the force, which then must be sampled more finely than it bends.

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
    curves (200 to 450 samples, 0.4 % force noise, cone, paraboloid, sphere) deviations over errors have
    standard deviations of 0.9 to 1.1, with depth noise up to 1/15 of the depth too. They are those of the noise alone:
    where `remarks` says that residuals are none, the model or the tip is off by more.

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
    jobs = _grouped(depth, force, noise)
    parts = [_solved(tip, depth, force, fixed, noise, sigma, *job) for job in _progress(jobs, len(depth))]
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
    return min(reach, profile.deepest)


def _grouped(depth, force, noise):
    """Curves that are solved together: rows, turning points, places to set out from.

    Depth and force turn at once: they are added in units in which the quieter of them weighs more.
    """
    path, variance, least = 0.0, 0.0, 0.0
    for values, sigma in ((depth, noise), (force, _rough(force))):
        size = np.ptp(values, axis=1, keepdims=True)
        weight = 1 / (0.005 + sigma / size)
        path, least = path + weight * values / size, least + 0.02 * weight
        variance = variance + (weight * sigma / size) ** 2
    least = np.maximum(least, 6 * np.sqrt(variance))[:, 0]
    found = [turning_points(row.tolist(), limit) for row, limit in zip(path, least.tolist(), strict=True)]
    kinds = [(len(turns), len(lows)) for turns, lows in found]
    for kind in sorted(set(kinds)):
        rows = np.array([i for i, each in enumerate(kinds) if each == kind])
        for part in chunks(rows.size, _TOGETHER):
            some = rows[part]
            places = (np.array([found[i][j] for i in some], int) for j in (0, 1))
            yield some, *(each.reshape(len(some), count) for each, count in zip(places, kind, strict=True))


def _rough(values):
    """Standard deviation of the noise of smooth rows (R, 1), from third differences."""
    if values.shape[1] < 8:
        return np.zeros((len(values), 1))
    return np.median(np.abs(np.diff(values, 3, axis=1)), axis=1, keepdims=True) / _THIRD


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


def _solved(tip, depth, force, fixed, noise, force_noise, rows, turns, lows):
    """Rows, curves, solution, covariance and its scale of some curves with as many turning points."""
    depth, force = depth[rows], force[rows]
    fixed = {name: value[rows] for name, value in fixed.items()}
    sigma = _first_sigma(force, noise, force_noise)
    curves = Curves(tip, depth, force, fixed, noise, sigma, turns, lows)
    x, *_ = solution = _minimum(curves)
    for _ in range(_ROUNDS if noise and turns.size else 0):
        before, curves = curves, curves.relabelled(x)
        if np.array_equal(before.turns, curves.turns):
            break
        x, *_ = solution = _minimum(curves, x)
    known = force_noise is not None or noise > 0
    solution, elastic = _elastic(curves, solution, known)
    return rows, curves, solution, elastic, known


def _first_sigma(force, noise, force_noise):
    """Standard deviation of the force (R, N): the one given, or the estimate; of unknown ones a unit."""
    size = np.ptp(force, axis=1, keepdims=True)
    if force_noise is not None:
        size = np.full_like(size, force_noise)
    elif noise:
        size = np.maximum(_rough(force), 1e-6 * size)
    return np.repeat(size, force.shape[1], axis=1)


def _minimum(curves, start=None):
    start = first_guess(curves) if start is None else start
    low, high = np.full_like(start, -np.inf), np.full_like(start, np.inf)
    for i, name in enumerate(curves.free):
        if name in ("E_star", "q_c"):
            low[:, i], high[:, i] = start[:, i] - 16, start[:, i] + 16
        elif name == "frame_compliance":
            low[:, i] = 0.0
        elif name == "contact_point":
            # As far as the tip is known.
            least = curves.depth.max(axis=1) - curves.tip.deepest
            low[:, i] = np.maximum((least - curves.offset[:, i]) / curves.scale[:, i], -1.0)
            high[:, i] = 1.0
    return least_squares(curves.residuals, start, low, high)


def _elastic(curves, solution, known):
    """The solution, and how near an elastic medium is to the curve: 0 further away, 1 about as near, 2 nearer.

    Where it is nearer the solution becomes the elastic one. Within an elastic medium q_c has no derivative:
    from there the search begins once more, below the largest depth.
    """
    elastic = np.zeros(len(curves.depth), int)
    if "q_c" in curves.fixed:
        return solution, elastic + 2 * np.isinf(curves.fixed["q_c"])
    place, freedom = curves.free.index("q_c"), max(solution[1].shape[1] - solution[0].shape[1], 1)
    share = _yield_share(curves, solution[0])
    rows = np.flatnonzero(share > 0.5)
    if not rows.size:
        return solution, elastic
    some, start = curves.rows(rows), solution[0][rows]
    start[:, place] += np.minimum(np.log(0.85 / share[rows]), 0.0)
    trials = [_minimum(some, start)]
    held = some.holding(q_c=np.full(rows.size, np.inf))
    x, residual, jacobian = _minimum(held, np.delete(solution[0][rows], place, axis=1))
    trials.append(
        (np.insert(x, place, _LOG_OF_INFINITE, axis=1), residual, np.insert(jacobian, place, 0.0, axis=2))
    )
    costs = np.array([np.sum(part[1] ** 2, axis=1) for part in ((None, solution[1][rows]), *trials)])
    noise = np.ones(rows.size) if known else costs.min(axis=0) / freedom
    gain = (costs[2] - costs[:2].min(axis=0)) / np.maximum(noise, 1e-300)
    small = costs[2] <= 1e-24 * solution[1].shape[1]
    nearer = (gain <= 2) | small
    chosen = np.where(nearer, 2, np.argmin(costs[:2], axis=0))
    for k, trial in enumerate(trials, start=1):
        for whole, part in zip(solution, trial, strict=True):
            whole[rows[chosen == k]] = part[chosen == k]
    elastic[rows] = np.where(nearer, 2, gain <= 9)
    return solution, elastic


def _yield_share(curves, x):
    """Critical depth over the largest depth of each curve."""
    values, _, state = curves.states(x)
    return (np.pi / 2 * values["q_c"] / values["E_star"])[:, 0] / state.depth.max(axis=1)


def _collected(profile, parts, count, noise):
    """One result of all parts, in the order of the curves."""
    order = np.argsort(np.concatenate([rows for rows, *_ in parts]))
    pieces = [_piece(*part) for part in parts]
    joined = {
        name: np.concatenate([piece[name] for piece in pieces])[order]
        for name in pieces[0]
        if name != "remarks"
    }
    said = [said for piece in pieces for said in piece["remarks"]]
    said = tuple(said[i] for i in order)
    free = parts[0][1].free
    errors = np.sqrt(np.einsum("rpp->rp", joined["covariance"]))
    medium = Medium(joined["E_star"], joined["q_c"])
    column = Medium(joined["E_star"][:, None], joined["q_c"][:, None])
    if noise:
        live = LiveInterval(joined["lower"], joined["upper"], joined["length"])
        path = Indentation(profile, column, joined["depth"], live)
    else:
        path = indent(profile, column, joined["depth"])
    return IndentationFit(
        profile, medium, *(_check.frozen(joined[name]) for name in NAMES[2:]),
        {name: _check.frozen(errors[:, i]) for i, name in enumerate(free)},
        *(_check.frozen(joined[n]) for n in ("covariance", "residuals", "reduced_chi_square", "force_noise")),
        path, said,
    )  # fmt: skip


def _piece(rows, curves, solution, elastic, known):
    """What results keep, by name, of curves solved together."""
    x, residual, jacobian = solution
    values, _, state = curves.states(x)
    values["q_c"] = np.where(elastic[:, None] == 2, np.inf, values["q_c"])
    noise = np.sqrt(curves.sigma**2 + (state.slope * curves.depth_noise) ** 2)
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
        "residuals": residual * noise,
        "reduced_chi_square": chi if known else np.ones_like(chi),
        "force_noise": sigma if known else sigma * np.sqrt(chi),
        "depth": state.depth, "lower": state.live.lower, "upper": state.live.upper,
        "length": state.live.length, "remarks": said,
    }  # fmt: skip


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
        The fitted model's states at all samples, at the depths that are most probable where they have noise.
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

    _parameters_of_fit: ClassVar[tuple[str, ...]] = NAMES
    _dimensions: ClassVar[tuple[str, ...]] = ("curve",)
    _noun: ClassVar[str] = "curve"
    _shown: ClassVar[tuple[str, ...]] = ("medium",)

    def __getitem__(self, index: Any) -> "IndentationFit":
        said = self._said[index] if isinstance(index, slice) else (self._said[index],)
        names = ("contact_point", "baseline", "frame_compliance")
        rest = ("covariance", "residuals", "reduced_chi_square", "force_noise")
        return IndentationFit(
            self.profile, self.medium.entries(index), *(getattr(self, name)[index] for name in names),
            {name: error[index] for name, error in self.standard_errors.items()},
            *(getattr(self, name)[index] for name in rest), self.indentation[index], said,
        )  # fmt: skip

    @property
    def remarks(self) -> tuple[str, ...]:  # type: ignore[override]
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
