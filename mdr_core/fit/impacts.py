"""The medium from impacts: restitution over speed, and contact times."""

from dataclasses import dataclass, replace

import numpy as np

from .. import _check
from .._check import Array, ArrayLike
from ..abel import kappa
from ..dynamics.impact import impact
from ..medium import Medium, check_pair
from ..shapes.power import FlatPunch, PowerLaw
from ..shapes.profile import Profile
from .least_squares import Fit, autocorrelation, covariances, in_units, least_squares

_NAMES = ("E_star", "q_c", "eta")
_UNITS = {"E_star": "Pa", "q_c": "N/m", "eta": "Pa·s"}
#: Steps of logarithms for differences: errors of viscous impacts, 10⁻⁹, stay 10⁻⁵ of them.
_STEP = 1e-4
#: Shares of the noise in restitution and in ln T, until residuals tell them.
_NOISE = (0.01, 0.02)
#: Standard errors of a logarithm beyond which a remark says so.
_VAGUE = 0.3


@_check.keywords_explained
def fit_impacts(
    profile: Profile,
    mass: ArrayLike,
    speed: ArrayLike,
    restitution: ArrayLike,
    *,
    contact_time: ArrayLike | None = None,
    E_star: float | None = None,
    q_c: float | None = None,
    eta: float | None = 0.0,
) -> "ImpactFit":
    """The medium whose impacts are nearest to measured ones, by least squares: the inverse of `impact`.

    Parameters that are None are free, numbers are held. Restitution tells one combination of E* and q_c,
    with viscosity two of three: give E_star, or contact times, which tell E*.

    Parameters
    ----------
    profile : Profile
        The indenter.
    mass, speed : float or array_like
        Masses (kg) and speeds (m/s) at first contact, each impact on a virgin medium.
    restitution : array_like
        Measured coefficients of restitution, 0 < e ≤ 1; noise may take some above 1.
    contact_time : array_like, optional
        Measured contact times (s).
    E_star, q_c : float, optional
        Effective modulus (Pa) and yield constant (N/m).
    eta : float, optional
        Viscosity (Pa·s); 0 by default, None fits it.

    Returns
    -------
    ImpactFit

        Restitutions have one absolute error, contact times one relative one, estimated from the residuals.

    Raises
    ------
    ValueError
        If more is free than the data tell, or they are not as above.

    Examples
    --------
    >>> import numpy as np
    >>> from mdr_core import Cone, Medium, impact
    >>> hit = impact(Cone(slope=0.3), Medium(E_star=1e9, q_c=10.0), 1e-9, np.geomspace(0.01, 1.0, 8))
    >>> fit = fit_impacts(Cone(slope=0.3), 1e-9, hit.speed, hit.restitution, contact_time=hit.contact_time)
    >>> print(f"{fit.medium.E_star:.6g} {fit.medium.q_c:.6g}")
    1e+09 10
    """
    check_pair(profile, Medium(1.0), "a fit")
    data = _Data.of(profile, mass, speed, restitution, contact_time)
    held = {
        name: value for name, value in zip(_NAMES, (E_star, q_c, eta), strict=True) if value is not None
    }
    for name, value in held.items():
        kind = {"infinite": name == "q_c", "zero": name == "eta"}
        held[name] = _check.positive_number(name, value, unit=_UNITS[name], **kind)
    free = [name for name in _NAMES if name not in held]
    _refuse_untold(data, held, free)
    x, residual, jacobian, groups = _fitted(data, held, free)
    chi = float(residual @ residual) / max(residual.size - len(free), 1)
    covariance = covariances(jacobian[None], np.array([1.0]))
    values = {**held, **{name: float(np.exp(value)) for name, value in zip(free, x, strict=True)}}
    shares = dict(zip(free, np.sqrt(np.diag(covariance[0])).tolist(), strict=True))
    covariance = in_units(covariance, np.array([values[name] for name in free])[None])[0]
    errors = {name: values[name] * share for name, share in shares.items()}
    said = _remarks(data, free, shares, jacobian, residual, groups)
    if errors.get("q_c") == np.inf and not np.any(jacobian[:, free.index("q_c")]):
        values["q_c"] = np.inf
        said = (
            "nothing has yielded: q_c = ∞ stands for more than these impacts tell; hit harder",
            *said[1:],
        )
    medium = Medium(**values)
    residual = residual * data.each(groups)
    return ImpactFit(profile, medium, errors, _check.frozen(covariance), _check.frozen(residual), chi, said)


@dataclass(frozen=True)
class _Data:
    """Impacts, arrays of one length; `time` has none where it was not measured."""

    profile: Profile
    mass: np.ndarray
    speed: np.ndarray
    restitution: np.ndarray
    time: np.ndarray | None

    @classmethod
    def of(cls, profile, mass, speed, restitution, time):
        mass = _check.positive("mass", mass, unit="kg")
        speed = _check.positive("speed", speed, unit="m/s")
        e = np.asarray(_check.positive("restitution", restitution, zero=True))
        _check.refuse(
            "restitution", e, e > 1.5, "must lie between 0 and 1", remedy="it is v after over v before"
        )
        parts = {"mass": mass, "speed": speed, "restitution": e}
        if time is not None:
            parts["contact_time"] = _check.positive("contact_time", time, unit="s")
        shape = _check.common_shape("fit_impacts", **parts)
        mass, speed, e, *rest = (np.broadcast_to(part, shape).ravel() for part in parts.values())
        return cls(profile, mass, speed, e, rest[0] if rest else None)

    @property
    def count(self):
        return self.restitution.size

    @property
    def size(self):
        """Number of measurements: restitutions, and times where there are some."""
        return self.count * (1 if self.time is None else 2)

    def each(self, pair):
        """Of something that restitutions and times have, that of each measurement."""
        return np.repeat(pair, self.count)[: self.size]

    def thinned(self, count):
        some = np.unique(np.linspace(0, self.count - 1, min(count, self.count)).astype(int))
        some = np.argsort(self.mass * self.speed**2)[some]
        time = None if self.time is None else self.time[some]
        return _Data(self.profile, self.mass[some], self.speed[some], self.restitution[some], time)

    def misses(self, values):
        """Measured less model for media (M,): restitution, and ln T where there are times (M, N or 2N)."""
        values = {name: np.reshape(value, (-1, 1)) for name, value in values.items()}
        hit = impact(self.profile, Medium(**values), self.mass, self.speed)
        parts = [self.restitution - hit.restitution]
        if self.time is not None:
            parts.append(np.log(self.time) - np.log(hit.contact_time))
        return np.hstack([np.atleast_2d(part) for part in parts])

    def costs(self, values):
        """Sums of squares in units of a usual noise for media (M,), infinite where the shape ends."""
        try:
            return np.sum((self.misses(values) / self.each(_NOISE)) ** 2, axis=1)
        except ValueError:
            if len(values["eta"]) == 1:
                return np.array([np.inf])
            ones = ({name: value[[i]] for name, value in values.items()} for i in range(len(values["eta"])))
            return np.concatenate([self.costs(one) for one in ones])


def _refuse_untold(data, held, free):
    """Refuses what no impact tells, before it is looked for."""
    if data.size <= len(free):
        raise ValueError(f"{data.size} measurements do not tell {', '.join(free)}: hold some or give more")
    wet, never = held.get("eta") != 0, held.get("q_c") == np.inf
    told = (wet + (not never)) if data.time is None else 3
    if data.time is None and len(free) > told:
        what = ("nothing where nothing yields or flows", "one combination", "two combinations")[told]
        raise ValueError(
            f"restitution over speed tells {what} of {', '.join(free)}: hold E_star or "
            "another of them, or give contact_time"
        )


def _fitted(data, held, free):
    """Logarithms of the free parameters, residuals in units of their noise, derivatives, and the noises."""
    noise = np.array(_NOISE)
    x = _start(data, held, free)
    for _ in range(4):
        units = data.each(noise)

        def function(x, rows, units=units):
            value, slopes = _differences(data, held, free, x[0])
            return value[None] / units, slopes[None] / units[:, None]

        start = x[None]
        found = least_squares(function, start, start - 14, start + 14, most=40, close=1e-9)
        x, residual, jacobian = (part[0] for part in found)
        before, noise = noise, _noises(residual, noise, data, jacobian)
        if np.all(np.abs(noise / before - 1) < 0.01):
            break
    rescale = data.each(before / noise)
    return x, residual * rescale, jacobian * rescale[:, None], noise


def _noises(residual, noise, data, jacobian):
    """Standard deviations of restitution and of ln T, each with its share of the degrees of freedom."""
    basis, s, _ = np.linalg.svd(jacobian, full_matrices=False)
    used = np.sum(basis[:, s > 1e-11 * s[:1]] ** 2, axis=1)
    noise = noise.copy()
    for k, part in enumerate(np.split(np.arange(residual.size), [data.count])):
        if part.size:
            freedom = max(part.size - used[part].sum(), 0.5)
            noise[k] = max(noise[k] * np.sqrt(np.sum(residual[part] ** 2) / freedom), 1e-12)
    return noise


def _differences(data, held, free, x):
    """What is missed at x, and its derivatives by forward differences, in one ensemble of impacts."""
    points = x + _STEP * np.vstack([np.zeros(len(free)), np.eye(len(free))])
    values = {name: np.full(len(points), value) for name, value in held.items()}
    values |= {name: np.exp(points[:, i]) for i, name in enumerate(free)}
    try:
        misses = data.misses(values)
    except ValueError:
        # Deeper than the shape is known: no medium to go to.
        return np.full(data.size, 1e3), np.zeros((data.size, len(free)))
    return misses[0], ((misses[1:] - misses[0]) / _STEP).T


def _start(data, held, free):
    """The best of a grid: dry impacts of a power law like the tip, then viscosities."""
    few = data.thinned(8)
    energy, speed = np.median(few.mass * few.speed**2 / 2), np.median(few.speed)
    found = []
    for E in [held["E_star"]] if "E_star" in held else _moduli(few, energy, speed):
        try:
            depth = float(impact(few.profile, Medium(E), 2 * energy / speed**2, speed).max_depth)
        except ValueError:
            continue
        q_c = 2 / np.pi * E * depth * np.geomspace(1e-5, 2.0, 24)
        q_c = np.array([held["q_c"]]) if "q_c" in held else q_c
        like = replace(few, profile=_power_law(few.profile, depth))
        costs = like.costs({"E_star": np.full(q_c.size, E), "q_c": q_c, "eta": np.zeros(q_c.size)})
        found.append((costs.min(), E, q_c[costs.argmin()]))
    if not found:
        raise ValueError("these impacts press deeper than the shape is known, for any modulus")
    (_, E, q_c), eta = min(found), held.get("eta")
    if eta != 0:
        time = _duration(few, E, energy, speed)
        eta = E / 4 * time * np.array([0.003, 0.02, 0.1, 0.4]) if eta is None else np.array([eta])
        share = np.array([1.0, 2.0, 6.0, 40.0]) if "q_c" not in held else np.ones(1)
        stiff = np.array([1.0, 0.6]) if "E_star" not in held else np.ones(1)
        share, eta, stiff = (part.ravel() for part in np.meshgrid(share, eta, stiff))
        trials = {"E_star": E * stiff, "q_c": q_c * share, "eta": eta}
        best = int(np.argmin(data.thinned(5).costs(trials)))
        E, q_c, eta = (float(part[best]) for part in trials.values())
    values = {"E_star": E, "q_c": q_c, "eta": eta}
    return np.log([values[name] for name in free]) if free else np.zeros(0)


def _power_law(profile, depth):
    """A power law that is as steep as the shape where a depth (m) brings the edge of its contact."""
    a = float(profile._radius(np.array(depth)))
    g, slope = float(profile._reduced(np.array(a))), float(profile._reduced_slope(np.array(a)))
    if a >= profile.wall or not 0 < slope < np.inf or g <= 0:
        return FlatPunch(a)
    n = float(np.clip(a * slope / g, 0.05, 100.0))
    return PowerLaw(depth / kappa(n) / a**n, n)


def _moduli(few, energy, speed):
    """Moduli to try: about that of an elastic impact of the measured duration, or of any."""
    if few.time is None:
        return np.geomspace(1e2, 1e14, 37)
    low, high = 1.0, 1e16
    for _ in range(12):
        middle = np.sqrt(low * high)
        # What is too soft leaves the shape, or stays too long.
        longer = not _duration(few, middle, energy, speed) < np.median(few.time)
        low, high = (middle, high) if longer else (low, middle)
    return middle * np.geomspace(0.05, 10, 16)


def _duration(few, E, energy, speed):
    try:
        return float(impact(few.profile, Medium(E), 2 * energy / speed**2, speed).contact_time)
    except ValueError:
        return np.nan


def _remarks(data, free, shares, jacobian, residual, noise):
    """What the impacts do not tell, by the singular values of the scaled derivatives."""
    found = []
    vague = [name for name in free if not shares[name] < _VAGUE]
    if vague:
        _, s, vt = np.linalg.svd(jacobian, full_matrices=False)
        along = ", ".join(
            f"{name}^{power:+.2g}" for name, power in zip(free, vt[-1], strict=True) if abs(power) > 0.1
        )
        remedy = "give contact_time" if data.time is None else "impacts over more speeds"
        found.append(
            f"the data hardly tell {', '.join(vague)} (singular values from {s[0]:.2g} to {s[-1]:.2g} in "
            f"units of the noise; the least told is {along}): hold one of them, or {remedy}"
        )
    parts = np.split(residual, [data.count])
    for what, part, size in zip(("restitution", "contact time"), parts, noise, strict=True):
        if part.size > 5 and autocorrelation(part) > max(0.5, 3 / np.sqrt(part.size)) and size > 1e-6:
            found.append(
                f"residuals of the {what} are no noise, neighbours go together: not this medium or tip"
            )
    return tuple(found)


@dataclass(frozen=True, eq=False, repr=False)
class ImpactFit(Fit):
    """A medium fitted to impacts; made by `fit_impacts`.

    Attributes
    ----------
    medium : Medium
        With fitted and held parameters.
    standard_errors : dict
        Of the free parameters by name, in their units; infinite where the data do not tell.
    covariance : ndarray
        Of the free parameters, in that order.
    residuals : ndarray
        Measured less fitted restitution, followed by relative contact times (ln T) where they were given.
    reduced_chi_square : float
        Sum of squares in units of the noise over the degrees of freedom: about 1, for the noise was
        estimated.
    remarks : tuple of str
        What the data do not tell, and what to hold.
    """

    profile: Profile
    medium: Medium
    standard_errors: dict[str, float]
    covariance: Array
    residuals: Array
    reduced_chi_square: float
    remarks: tuple[str, ...]

    _parameters_of_fit = _NAMES

    def _quality(self):
        yield "reduced χ²", f"{self.reduced_chi_square:.4g}"
