"""Modulus and hardness from unloadings, by the method of Oliver and Pharr."""

from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from .. import _check
from .._check import ArrayLike
from ..medium import Medium, check_pair
from ..numerics.roots import increasing_root
from ..profiles.profile import Profile
from ..results.quantities import QUANTITIES, Quantity, described
from ..results.report import Report
from .errors import roughness
from .least_squares import least_squares
from .materials import doubts
from .report import with_error

#: Quantities of the results, and others.
OLIVER_PHARR = QUANTITIES | {
    "contact_depth": Quantity("h_c", "m", "contact depth"),
    "hardness": Quantity("H", "Pa", "hardness"),
    "exponent": Quantity("m", "", "exponent"),
}
#: Bounds of force and stiffness, in units of those of the samples, and of the exponent.
_LOWER, _UPPER = np.array([[0.1, 1e-3, 0.5]]), np.array([[10.0, 1e3, 50.0]])
#: Shares of the largest force from and to which the unloading is fitted: those of the result, and others.
_SHARES = (0.99, 0.5), (0.99, 0.4), (0.99, 0.3), (0.95, 0.5), (0.95, 0.4), (0.95, 0.3)


#: Least fall and rise of the force, as shares of the peak before, that part one unloading from the next;
#: least peak, as a share of the largest force; standard deviations of noise that they exceed.
_FALL, _PEAK, _NOISE = 0.1, 0.01, 6.0


@_check.keywords_explained
def oliver_pharr(
    profile: Profile,
    depth: ArrayLike,
    force: ArrayLike,
    *,
    epsilon: float = 0.75,
    beta: float = 1.0,
    cycles: bool = False,
) -> "OliverPharr":
    """Modulus and hardness from the unloadings of one force–depth curve: Oliver and Pharr (1992).

    F = α (h − h_f)^m is fitted to the upper half of the unloading: samples after the largest depth, from
    the last one with 99 % of the force, so that a hold is left out, to the first one below half of it. F
    and its slope S at the largest depth h give the contact depth h_c = h − ε F/S. With the radius a of the
    profile at that height, z(a) = h_c, and A = π a², E* = S √π/(2β √A) and H = F/A.

    Parameters
    ----------
    profile : Profile
        The indenter.
    depth, force : array_like
        Depths (m) from first contact on and forces (N) above the baseline, (N,), in the order of time.
        Samples with NaN are left out.
    epsilon : float, optional
        Constant ε: 1 for a flat punch, 3/4 for a paraboloid, 2 − 4/π for a cone.
    beta : float, optional
        Correction β of the stiffness, 1 for axisymmetric indenters.
    cycles : bool, optional
        Whether each unloading has an entry, in the order of time: where the force falls by a tenth of a
        peak and more, before it rises again by as much. Those that follow no power law are left out, with
        a remark. Otherwise the unloading after the largest depth is taken.

    Returns
    -------
    OliverPharr

    Raises
    ------
    ValueError
        If there are no five samples of the upper half of an unloading, or they follow no power law; if the
        contact depth is not positive, or the profile is not known to it.

    Notes
    -----
    For an elastic contact and the ε of its shape E* is exact. A yielded cone in a medium of this package
    has z(a) = 2d/π, and here z(a) → d: E* is up to π/2 times smaller than the medium's, H (π/2)² times.

    Examples
    --------
    >>> import numpy as np
    >>> from mdr_core import Cone, Medium, indent
    >>> d = np.append(np.linspace(0, 60e-9, 100), np.linspace(60e-9, 0, 100))
    >>> F = indent(Cone(slope=0.3), Medium(E_star=10e9), d).force
    >>> result = oliver_pharr(Cone(slope=0.3), d, F, epsilon=2 - 4 / np.pi)
    >>> print(f"{result.E_star:.6g} {result.hardness:.6g} {result.exponent:.6g}")  # H = E* s/2
    1e+10 1.5e+09 2

    Two cycles, a table over contact depth by ``.to_pandas()``:

    >>> d, F = np.append(0.5 * d, d), np.append(0.25 * F, F)
    >>> table = oliver_pharr(Cone(slope=0.3), d, F, epsilon=2 - 4 / np.pi, cycles=True)
    >>> print((1e9 * table.contact_depth).round(3), (1e-9 * table.E_star).round(6))
    [19.099 38.197] [10. 10.]
    """
    check_pair(profile, Medium(1.0), "an unloading")
    depth = _check.finite_array("depth", depth, unit="m", most=_check.LONGEST, missing=True)
    force = _check.finite_array("force", force, unit="N", most=_check.LONGEST, missing=True)
    if depth.shape != force.shape or depth.ndim != 1:
        raise ValueError(f"depth {depth.shape} and force {force.shape} must be of one curve, (N,) both")
    used = np.isfinite(depth) & np.isfinite(force)
    depth, force = depth[used], force[used]
    if not depth.size:
        raise ValueError("depth and force have no samples: five or more of an unloading are needed")
    constants = _check.positive_number("epsilon", epsilon, zero=True), _check.positive_number("beta", beta)
    parts, results, remarks = _unloadings(force), [], []
    for number, part in enumerate(parts if cycles and parts else [slice(None)], 1):
        try:
            results.append(_values_and_errors(profile, depth[part], force[part], *constants))
        except ValueError as error:
            if not cycles or len(parts) < 2:
                raise
            remarks.append(f"unloading {number} of {len(parts)} is left out: {error}")
    if not results:
        raise ValueError(remarks[0])
    if len(parts) > 1 and not cycles:
        number = sum(part.start <= _deepest(depth) for part in parts)
        taken = f"unloading {number} of {len(parts)} was taken, the one after the largest depth"
        remarks.append(f"{taken}; each of them can be evaluated")
    columns = np.array(results) if cycles else np.array(results[0])
    values, errors = (
        dict(zip(OliverPharr._quantities, map(_check.frozen, each.T), strict=True))
        for each in (columns[..., 0, :], columns[..., 1, :])
    )
    remarks += [*doubts(values["E_star"], values["hardness"]), *profile.remarks]
    return OliverPharr(profile, **values, standard_errors=errors, remarks=tuple(remarks))


def _unloadings(force):
    """Parts of a curve that end with an unloading, from the end of the one before on, as slices."""
    least = max(_PEAK * force.max(), _NOISE * roughness(force[None])[0, 0])
    parts, begin, peak, lowest = [], 0, 0, None
    for i, value in enumerate(force):
        step = max(_FALL * force[peak], least)
        if lowest is None:
            if value >= force[peak]:
                peak = i
            elif force[peak] > least and value < force[peak] - step:
                lowest = i
        elif value <= force[lowest]:
            lowest = i
        elif value > force[lowest] + step:
            parts.append(slice(begin, lowest + 1))
            begin, peak, lowest = lowest, i, None
    return parts if lowest is None else [*parts, slice(begin, force.size)]


def _deepest(depth):
    """Index of the last sample of the largest depth."""
    return int(np.flatnonzero(depth == depth.max())[-1])


def _values_and_errors(profile, depth, force, epsilon, beta):
    """Results of one unloading and their standard errors, arrays in the order of `OliverPharr`."""

    def results(F, S, m):
        contact_depth = depth.max() - epsilon * F / S
        a = _radius_at_height(profile, contact_depth)
        with np.errstate(all="ignore"):
            return np.stack([S, contact_depth, S / (2 * beta * a), F / (np.pi * a**2), m]).T

    solution, deviations = _power_law(*_part(depth, force, *_SHARES[0]))
    values, *others = results(*np.column_stack([solution, solution[:, None] + deviations]))
    # A contact radius of 0 or ∞ makes the modulus or the hardness so.
    if not np.all((values[2:] > 0) & (values[2:] < np.inf)):
        raise ValueError(
            f"the contact depth h − ε F/S = {values[1]:g} m must be positive and within the profile: depth "
            "counts from first contact, force from the baseline"
        )
    choices = [values]
    for shares in _SHARES[1:]:
        with suppress(ValueError):
            choices.append(results(*_power_law(*_part(depth, force, *shares))[0]))
    spread = np.ptp([choice for choice in choices if np.isfinite(choice).all()], axis=0) / 2
    return values, np.maximum(np.linalg.norm(np.array(others) - values, axis=0), spread)


def _part(depth, force, upper, lower):
    """Depths (m) minus the largest one, and forces (N), of the unloading between shares of the force."""
    start = _deepest(depth)
    h, F = depth[start:] - depth[start], force[start:]
    share = F / np.abs(F).max()
    below = np.flatnonzero(share < lower)
    end = below[0] if below.size else np.argmin(F) + 1
    first = np.flatnonzero(share[:end] >= upper)
    h, F = (values[first[-1] if first.size else end : end] for values in (h, F))
    if h.size < 5 or h.min() == 0:
        raise ValueError(
            f"{h.size} samples of the upper half of an unloading, 5 or more are needed: after the largest "
            f"depth, {depth[start]:g} m (sample {start + 1} of {depth.size}), depth and force must fall"
        )
    return h, F


def _power_law(h, force):
    """Force, stiffness and exponent at h = 0 of F (1 + S h/(m F))^m, and their independent deviations."""
    size = np.array([force[0], force[0] / -h.min(), 1.0])
    x, y = h / -h.min(), force / force[0]

    def function(parameters, _):
        F, S, m = parameters.T[:, :, None]
        u = np.maximum(1 + S * x / (m * F), 1e-9)
        power = u ** (m - 1)
        columns = power * (u - S * x / F), power * x, F * power * (u * np.log(u) + 1 - u)
        return F * u * power - y, np.stack(columns, axis=-1)

    start = np.array([[1.0, np.polyfit(x, y, 1)[0], 1.5]])
    minimum = least_squares(function, start, _LOWER, _UPPER)
    if minimum.at_bound.any():
        raise ValueError("the upper half of the unloading is no power law: check the order of the samples")
    _, s, vt = np.linalg.svd(minimum.jacobian[0], full_matrices=False)
    scatter = np.sqrt(minimum.squares[0] / (h.size - 3))
    return minimum.x[0] * size, size[:, None] * vt.T * scatter / s


def _radius_at_height(profile, height):
    """Radius (m) of the profile at heights (m): 0 below its tip, infinite where it is not known."""
    known = np.minimum(profile.wall, profile.known_radius)
    # Without a slope the search is by bisection.
    radius = increasing_root(lambda r: (profile._height(r), np.inf), height, np.abs(height), known)
    return np.maximum(np.minimum(radius, profile.wall), profile.face_radius)


@dataclass(frozen=True, eq=False, repr=False)
class OliverPharr(Report):
    """Results for one unloading, or for each of a curve, returned by `oliver_pharr`.

    The standard errors, by name, are those of the scatter about the power law, and not less than half the
    range of the results for six parts of the unloading: from 99 or 95 % of the largest force down to 50, 40
    or 30 %. With ``cycles=True`` all are arrays (U,), and `result[i]` is one unloading.
    """

    profile: Profile
    #: Stiffness S (N/m), contact depth h_c (m), modulus E* (Pa), hardness H (Pa) and exponent m.
    stiffness: Any
    contact_depth: Any
    E_star: Any
    hardness: Any
    exponent: Any
    standard_errors: dict[str, Any]
    #: Which unloading was taken of several, and which were left out; numbers that are those of no material.
    remarks: tuple[str, ...] = ()

    _dimensions = ("unloading",)
    _quantities = _shown = ("stiffness", "contact_depth", "E_star", "hardness", "exponent")

    def __getitem__(self, index: Any) -> "OliverPharr":
        if not self.shape:
            return super().__getitem__(index)
        errors = {name: error[index] for name, error in self.standard_errors.items()}
        values = {name: getattr(self, name)[index] for name in self._quantities}
        return replace(self, **values, standard_errors=errors)

    def to_dict(self) -> dict[str, Any]:
        """Values by name, in SI units, and their standard errors, whose names end in `_error`."""
        return super().to_dict() | {f"{name}_error": error for name, error in self.standard_errors.items()}

    def _rows(self):
        yield "indenter", described(self.profile)
        for i in range(len(self) if self.shape else 0):
            texts = [f"{OLIVER_PHARR[name].symbol} {text}" for name, text in self[i]._texts()]
            yield f"unloading {i + 1}", ", ".join(texts)
        for name, text in () if self.shape else self._texts():
            yield f"{OLIVER_PHARR[name].long_name} {OLIVER_PHARR[name].symbol}", text
        yield from (("remark", remark) for remark in self.remarks)

    def _texts(self):
        """Names of the quantities of one unloading, and their values with errors."""
        for name, error in self.standard_errors.items():
            yield name, with_error(getattr(self, name), error, OLIVER_PHARR[name].unit)
