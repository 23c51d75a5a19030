"""The medium from impacts: restitution at several speeds, and contact times."""

from dataclasses import dataclass, replace

import numpy as np

from .. import _check
from .._check import ArrayLike
from ..abel import kappa
from ..dynamics.impact import impact
from ..medium import Medium, check_pair, yield_constant
from ..results.quantities import QUANTITIES
from ..shapes.power import FlatPunch, PowerLaw
from ..shapes.profile import Profile
from .least_squares import SINGULAR, Fit, autocorrelation, covariances, least_squares

_PARAMETERS = ("E_star", "q_c", "eta")
#: Steps of the logarithms for differences: the error of viscous impacts, 10⁻⁹, becomes 10⁻⁵ of them.
_STEP = 1e-4
#: Initial standard deviations of the restitution and of ln T, later estimated from residuals.
_NOISE = (0.01, 0.02)


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
    """Fit a medium to measured impacts by least squares: the inverse of `impact`.

    Parameters that are None are free, numbers are held. Restitution determines one combination of E* and
    q_c, with viscosity two of three parameters: hold E_star, or give contact times, which determine E*.

    Parameters
    ----------
    profile : Profile
        The indenter.
    mass, speed : float or array_like
        Masses (kg) and speeds (m/s) at first contact, each impact on a virgin medium.
    restitution : array_like
        Measured coefficients of restitution, 0 < e ≤ 1; noisy values may exceed 1.
    contact_time : array_like, optional
        Measured contact times (s).
    E_star, q_c : float, optional
        Effective modulus (Pa) and yield constant (N/m).
    eta : float, optional
        Viscosity (Pa·s); 0 by default, None fits it.

    Returns
    -------
    ImpactFit
        Restitutions have one absolute error, contact times one relative error, estimated from residuals.

    Raises
    ------
    ValueError
        If more parameters are free than the data determine, or the data are invalid.

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
    data = ImpactData.of(profile, mass, speed, restitution, contact_time)
    fixed = _fixed(dict(zip(_PARAMETERS, (E_star, q_c, eta), strict=True)))
    free = [name for name in _PARAMETERS if name not in fixed]
    _refuse_undetermined(data, fixed, free)
    x, residual, jacobian, noise = _solved(data, fixed, free)
    (covariance,) = covariances(jacobian[None], 1.0)
    errors = dict(zip(free, np.sqrt(np.diag(covariance)).tolist(), strict=True))
    remarks = list(_remarks(data, errors, jacobian, residual, noise))
    scale = np.exp(x)
    values = fixed | dict(zip(free, scale.tolist(), strict=True))
    errors = {name: values[name] * error for name, error in errors.items()}
    if errors.get("q_c") == np.inf and not np.any(jacobian[:, free.index("q_c")]):
        values["q_c"] = np.inf
        remarks[0] = "nothing has yielded: q_c = ∞ stands for more than these impacts determine; hit harder"
    covariance = _check.frozen(covariance * np.outer(scale, scale))
    residual = _check.frozen(residual * data.per_measurement(noise))
    return ImpactFit(profile, Medium(**values), errors, covariance, residual, tuple(remarks))


def _fixed(values):
    """Checked values of the parameters that are not None, by name."""
    checked = {}
    for name, value in values.items():
        if value is not None:
            allowed = {"infinite": name == "q_c", "zero": name == "eta"}
            checked[name] = _check.positive_number(name, value, unit=QUANTITIES[name].unit, **allowed)
    return checked


@dataclass(frozen=True)
class ImpactData:
    """Measured impacts, arrays of one length; `time` is None where it was not measured."""

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
        _check.refuse("restitution", e, e > 1.5, "must lie between 0 and 1", remedy="check the speeds")
        given = {"mass": mass, "speed": speed, "restitution": e}
        if time is not None:
            given["contact_time"] = _check.positive("contact_time", time, unit="s")
        shape = _check.common_shape("fit_impacts", **given)
        given = {name: np.broadcast_to(values, shape).ravel() for name, values in given.items()}
        return cls(profile, time=given.pop("contact_time", None), **given)

    @property
    def count(self):
        return self.restitution.size

    def per_measurement(self, pair):
        """A pair of values for restitutions and contact times, repeated for each measurement."""
        return np.repeat(pair[:1] if self.time is None else pair, self.count)

    def thinned(self, count):
        """A subset of impacts in the order of energy."""
        subset = np.unique(np.linspace(0, self.count - 1, min(count, self.count)).astype(int))
        subset = np.argsort(self.mass * self.speed**2)[subset]
        e, time = self.restitution[subset], None if self.time is None else self.time[subset]
        return ImpactData(self.profile, self.mass[subset], self.speed[subset], e, time)

    def residuals(self, values):
        """Measured minus model for M media: restitution, and ln T where given (M, N or 2N)."""
        values = {name: np.reshape(value, (-1, 1)) for name, value in values.items()}
        hit = impact(self.profile, Medium(**values), self.mass, self.speed)
        residual = np.atleast_2d(self.restitution - hit.restitution)
        if self.time is None:
            return residual
        return np.hstack([residual, np.atleast_2d(np.log(self.time) - np.log(hit.contact_time))])

    def costs(self, values):
        """Sums of squares in units of the initial noise for M media, infinite above the known depth."""
        try:
            return np.sum((self.residuals(values) / self.per_measurement(_NOISE)) ** 2, axis=1)
        except ValueError:
            count = len(values["eta"])
            media = [{name: value[[i]] for name, value in values.items()} for i in range(count)]
            return np.array([np.inf]) if count == 1 else np.concatenate([*map(self.costs, media)])


def _refuse_undetermined(data, fixed, free):
    """Refuses parameters that no such data determine."""
    size = data.per_measurement(_NOISE).size
    if size <= len(free):
        raise ValueError(
            f"{size} measurements do not determine {', '.join(free)}: hold some of these, or give more"
        )
    determined = (fixed.get("eta") != 0) + (fixed.get("q_c") != np.inf)
    if data.time is None and len(free) > determined:
        count = ("nothing without yield and viscosity", "one combination", "two combinations")[determined]
        raise ValueError(
            f"restitution determines {count} of {', '.join(free)}: hold E_star or another of them, or give "
            "contact_time"
        )


def _solved(data, fixed, free):
    """Logarithms of the free parameters, residuals over their noise, derivatives, and both noises."""
    noise = np.array(_NOISE)
    x = _start(data, fixed, free)
    for _ in range(4):
        units = data.per_measurement(noise)

        def function(x, rows, units=units):
            value, slopes = _differences(data, fixed, free, x[0])
            return value[None] / units, slopes[None] / units[:, None]

        start = x[None]
        solution = least_squares(function, start, start - 14, start + 14, steps=40, tolerance=1e-9)
        x, residual, jacobian = (values[0] for values in solution)
        before, noise = noise, _noises(residual, noise, data, jacobian)
        if np.all(np.abs(noise / before - 1) < 0.01):
            break
    ratio = data.per_measurement(before / noise)
    return x, residual * ratio, jacobian * ratio[:, None], noise


def _noises(residual, noise, data, jacobian):
    """Standard deviations of restitution and ln T, each with its share of the degrees of freedom."""
    basis, s, _ = np.linalg.svd(jacobian, full_matrices=False)
    leverage = np.sum(basis[:, s > SINGULAR * s[:1]] ** 2, axis=1)
    noise = noise.copy()
    for k, rows in enumerate(np.split(np.arange(residual.size), [data.count])):
        if rows.size:
            freedom = max(rows.size - leverage[rows].sum(), 0.5)
            noise[k] = max(noise[k] * np.sqrt(np.sum(residual[rows] ** 2) / freedom), 1e-12)
    return noise


def _differences(data, fixed, free, x):
    """Residuals at x, and their derivatives by forward differences, from one ensemble of impacts."""
    points = x + _STEP * np.vstack([np.zeros(len(free)), np.eye(len(free))])
    values = {name: np.full(len(points), value) for name, value in fixed.items()}
    values |= {name: np.exp(points[:, i]) for i, name in enumerate(free)}
    try:
        residuals = data.residuals(values)
    except ValueError:
        # The known depth of the profile is exceeded: large residuals reject the step.
        large = data.per_measurement((1e3, 1e3))
        return large, np.zeros((large.size, len(free)))
    return residuals[0], ((residuals[1:] - residuals[0]) / _STEP).T


def _start(data, fixed, free):
    """Logarithms of the best parameters of two grids, the first without viscosity."""
    subset = data.thinned(8)
    energy, speed = np.median(subset.mass * subset.speed**2 / 2), np.median(subset.speed)
    trials = []
    for E in [fixed["E_star"]] if "E_star" in fixed else _moduli(subset, energy, speed):
        elastic = _elastic_impact(subset, E, energy, speed)
        if elastic is None:
            continue
        depth = float(elastic.max_depth)
        grid = yield_constant(E, depth) * np.geomspace(1e-5, 2.0, 24)
        q_c = np.array([fixed["q_c"]]) if "q_c" in fixed else grid
        similar = replace(subset, profile=_power_law(subset.profile, depth))
        costs = similar.costs({"E_star": np.full(q_c.size, E), "q_c": q_c, "eta": np.zeros(q_c.size)})
        trials.append((costs.min(), E, q_c[costs.argmin()]))
    if not trials:
        raise ValueError("these impacts exceed the known depth of the profile for any modulus")
    (_, E, q_c), eta = min(trials), fixed.get("eta")
    if eta != 0:
        time = float(_elastic_impact(subset, E, energy, speed).contact_time)
        eta = E / 4 * time * np.array([0.003, 0.02, 0.1, 0.4]) if eta is None else np.array([eta])
        yield_factor = np.array([1.0, 2.0, 6.0, 40.0]) if "q_c" not in fixed else np.ones(1)
        modulus_factor = np.array([1.0, 0.6]) if "E_star" not in fixed else np.ones(1)
        grid = np.meshgrid(yield_factor, eta, modulus_factor)
        yield_factor, eta, modulus_factor = map(np.ravel, grid)
        media = {"E_star": E * modulus_factor, "q_c": q_c * yield_factor, "eta": eta}
        best = int(np.argmin(data.thinned(5).costs(media)))
        E, q_c, eta = (float(values[best]) for values in media.values())
    values = {"E_star": E, "q_c": q_c, "eta": eta}
    return np.log(np.array([values[name] for name in free]))


def _power_law(profile, depth):
    """The power law with the same radius and slope at the edge of the contact at a depth (m)."""
    a = float(profile._radius(np.array(depth)))
    g, slope = float(profile._reduced(np.array(a))), float(profile._reduced_slope(np.array(a)))
    if a >= profile.wall or not 0 < slope < np.inf or g <= 0:
        return FlatPunch(a)
    n = float(np.clip(a * slope / g, 0.05, 100.0))
    # Just outside a flat face a^n may underflow.
    return PowerLaw(depth / kappa(n) / a**n, n) if a**n > 1e-300 else FlatPunch(a)


def _moduli(subset, energy, speed):
    """Trial moduli (Pa): around that of an elastic impact of the measured duration, or over all decades."""
    if subset.time is None:
        return np.geomspace(1e2, 1e14, 37)
    low, high = 1.0, 1e16
    for _ in range(12):
        middle = np.sqrt(low * high)
        elastic = _elastic_impact(subset, middle, energy, speed)
        longer = elastic is None or not elastic.contact_time < np.median(subset.time)
        low, high = (middle, high) if longer else (low, middle)
    return middle * np.geomspace(0.05, 10, 16)


def _elastic_impact(subset, E, energy, speed):
    """An impact with an energy (J) and speed (m/s), None if it exceeds the known depth of the profile."""
    try:
        return impact(subset.profile, Medium(E), 2 * energy / speed**2, speed)
    except ValueError:
        return None


def _remarks(data, errors, jacobian, residual, noise):
    """Parameters that the impacts do not determine, and residuals that are not noise."""
    # Errors are those of logarithms.
    vague = [name for name, error in errors.items() if not error < 0.3]
    if vague:
        _, s, vt = np.linalg.svd(jacobian, full_matrices=False)
        powers = zip(errors, vt[-1], strict=True)
        combination = ", ".join(f"{name}^{power:+.2g}" for name, power in powers if abs(power) > 0.1)
        remedy = "give contact_time" if data.time is None else "measure impacts at more speeds"
        yield (
            f"the data hardly determine {', '.join(vague)} (singular values over the noise: {s[0]:.2g} to "
            f"{s[-1]:.2g}, the last for {combination}): hold one of them, or {remedy}"
        )
    names = "restitution", "contact time"
    for name, values, size in zip(names, np.split(residual, [data.count]), noise, strict=True):
        limit = max(0.5, 3 / np.sqrt(max(values.size, 1)))
        if values.size > 5 and autocorrelation(values) > limit and size > 1e-6:
            yield f"residuals of the {name} are correlated, not noise: not this medium or profile"


@dataclass(frozen=True, eq=False, repr=False)
class ImpactFit(Fit):
    """A medium fitted to impacts, a `Fit` returned by `fit_impacts`.

    Residuals are those of the restitution, followed by relative ones of contact times (ln T) where given.
    """

    standard_errors: dict[str, float]
    remarks: tuple[str, ...]

    _medium_parameters = _PARAMETERS
