"""Viscous indentation along a path in time: the chain, refined until its force is known to a tolerance."""

from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any

import numpy as np

from .. import _check, abel
from .._check import Array, ArrayLike
from ..medium import Medium, check_pair
from ..results import CHAIN, Limit, Result, contact_limits
from ..shapes.profile import Profile
from . import element
from .element import Elements, Ramp
from .fronts import force_and_radius
from .row import Foundation, cell_edges

#: Elements of the first run, and the most element steps of the last one.
_ELEMENTS = 256
_MOST = 10**8
#: Depths of a path that are given edges of their own; of longer paths those where it turns round.
_LEVELS = 300


def check_times(time, path, quantity):
    """`time` as an array of the shape of a one-dimensional path, if it increases."""
    time = _check.finite_array("time", time, unit="s")
    if path.ndim != 1 or not path.size or time.shape != path.shape:
        raise ValueError(
            f"time of shape {time.shape} must go with a {quantity} path of the same one-dimensional shape, "
            f"got {path.shape}; give one time for each {quantity}"
        )
    back = np.append(False, np.diff(time) <= 0)
    remedy = "drop repeated times, and give a jump a short time"
    return _check.refuse("time", time, back, "does not increase", unit="s", remedy=remedy)


def indent_in_time(
    profile: Profile, medium: Medium, depth: ArrayLike, time: ArrayLike, *, tolerance: float = 1e-6
) -> "TimedIndentation":
    """Press an indenter into a viscous medium along a path of depth in time.

    By the chain, refined until the force no longer changes: an element that has let go relaxes, and may be
    met again while it does.

    Parameters
    ----------
    profile, medium
        The indenter and the medium.
    depth : array_like, shape (N,)
        Indentation depths d (m), straight in between; the first one is reached infinitely slowly.
    time : array_like, shape (N,)
        Increasing times (s).
    tolerance : float, optional
        Error allowed in force and energies, each relative to its largest.

    Returns
    -------
    TimedIndentation
        Quantities of the shape of `time`, with the estimate reached as `error`.

    Raises
    ------
    ValueError
        If a depth is not finite, or deeper than the profile is known, or times do not increase.

    Examples
    --------
    A dashpot beside the springs adds 8ηb ḋ to the force of a flat punch, and nothing once it rests:

    >>> from mdr_core import FlatPunch, Medium
    >>> medium = Medium(E_star=1.0, eta=1.0)
    >>> indent_in_time(FlatPunch(1.0), medium, [0.0, 3.0, 3.0], [0.0, 1.5, 2.0]).force.round(9).tolist()
    [0.0, 22.0, 6.0]
    """
    check_pair(profile, medium, "a path in time")
    depth = profile._known(_check.finite_array("depth", depth, unit="m", most=_check.LARGEST))
    time = check_times(time, depth, "depth")
    tolerance = _check.positive_number("tolerance", tolerance)
    count, last = _ELEMENTS, None
    nodes = _nodes(profile, medium, depth, time)
    while True:
        record = _run(profile, medium, depth, time, count + 4 * len(nodes), nodes)
        # Second order leaves a third of the change; a front of re-contact may come out worse.
        error = np.inf if last is None else _difference(record, last)
        if error <= tolerance or 2 * count * len(depth) > _MOST:
            break
        last, count = record, 2 * count
    plastic_depth = np.maximum.accumulate(np.maximum(depth - medium.critical_depth, 0.0))
    return TimedIndentation(
        profile, medium, time, depth, *record.T, plastic_depth, error, np.arange(len(depth))
    )


def _difference(record, last):
    """Largest change of force and energies, each relative to the largest of its kind."""
    largest = np.max(np.abs(record), axis=0)
    change = np.max(np.abs(record - last), axis=0) / np.where(largest > 0, largest, 1.0)
    # All but the contact radius, which ends between elements while it shrinks.
    return float(np.max(np.delete(change, 1)))


def _nodes(profile, medium, depth, time):
    """Radii (m) at which the line load has a front at one of the times: contact, yield, letting go."""
    if len(depth) > _LEVELS:
        rise = np.sign(np.diff(depth))
        turn = np.flatnonzero(np.concatenate([[True], rise[1:] != rise[:-1], [True]]))
        turn = turn[np.argsort(-depth[turn])[:_LEVELS]]
        turn.sort()
        depth, time = depth[turn], time[turn]
    lag = medium.relaxation_time * np.append(0.0, np.diff(depth) / np.diff(time))
    level = np.concatenate([depth, depth + np.minimum(lag, 0.0), depth - medium.critical_depth])
    level = np.unique(level[level > 0])
    return profile.contact_radius(level) if level.size else np.empty(0)


def _run(profile, medium, depth, time, n, nodes):
    """Force, contact radius and energies at each time, one row each, on about n elements."""
    half_width = float(profile.contact_radius(max(np.max(depth), 0.0)))
    if half_width == 0:
        # A path that never touches has no width of its own.
        half_width = min(1.0, profile.known_radius)
    row = Foundation(profile, medium, n + n % 2, half_width, nodes=nodes).advance(depth[0])
    record = []
    for i in range(len(depth)):
        if i:
            row = row.advance(depth[i], time[i] - time[i - 1])
        energies = row.stored_energy, row.plastic_work, row.viscous_work
        record.append((*force_and_radius(row), *energies))
    return np.array(record)


@dataclass(frozen=True, eq=False, repr=False)
class TimedIndentation(Result):
    """States of a viscous indentation, one for each time of its path; made by `indent_in_time` or `creep`.

    Every quantity has the shape of `time`; `result[i]` picks a state. At a time at which the rate
    changes, force and fields are those that the piece before it ends with.

    Examples
    --------
    A flat punch of radius 1 is ramped to d = 3 in 1.5 s and held: F = 2E*b d + 8ηb ḋ.

    >>> from mdr_core import FlatPunch, Medium
    >>> path = indent_in_time(FlatPunch(1.0), Medium(E_star=1.0, eta=1.0), [0.0, 3.0, 3.0], [0.0, 1.5, 2.0])
    >>> print(path[1].line_load(0.5))  # E* d + 4η ḋ
    11.0
    """

    profile: Profile
    medium: Medium
    #: Time (s) and indentation depth d (m), as given.
    time: Array
    depth: Array
    #: Normal force (N) with the part of the dashpots, and contact radius a (m), 0 without contact.
    force: Array
    contact_radius: Array
    #: Elastic energy (J), that of relaxing elements out of contact included.
    stored_energy: Array
    #: Energy (J) dissipated so far by yielding, and by the dashpots.
    plastic_work: Array
    viscous_work: Array
    #: Plastic depth d_p (m): the depth of the residual imprint in the 1D foundation.
    plastic_depth: Array
    #: Estimated error of force and energies, each relative to its largest.
    error: float
    _place: Array
    _path: tuple[np.ndarray, np.ndarray] = ()

    #: How it was found.
    model = CHAIN
    _quantities = (
        "time", "depth", "force", "contact_radius", "plastic_radius", "plastic_depth", "stored_energy",
        "plastic_work", "viscous_work",
    )  # fmt: skip
    _shown = _quantities[:6]
    _dimensions = ("time",)

    def __post_init__(self):
        if not self._path:
            object.__setattr__(self, "_path", (np.array(self.time), np.array(self.depth)))
        for name in _ARRAYS:
            object.__setattr__(self, name, _check.frozen(np.array(getattr(self, name))))

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """Where the model's assumptions end along this path, as data."""
        return contact_limits(self.profile, self.medium, self.contact_radius)

    def __getitem__(self, index: Any) -> "TimedIndentation":
        return replace(self, **{name: np.asarray(getattr(self, name)[index]) for name in _ARRAYS})

    @_check.frozen_property
    def plastic_radius(self):
        """Radius c (m) of the plastic zone; 0 if nothing has yielded."""
        radius = self.profile.contact_radius(self.plastic_depth)
        return np.where(np.asarray(self.plastic_depth) > 0, radius, 0.0)

    def line_load(self, x: ArrayLike) -> Array:
        """Line load q = E* u_e + 4ηḋ (N/m) of one state at x (m); Popov (2015), Eqs. (1), (17), (18).

        The elements at x follow the whole path anew: no grid is involved.
        """
        self._one("line_load")
        return self.elements(x)[0]

    def elements(self, x: ArrayLike) -> tuple[Array, Array]:
        """Line load (N/m) and elastic compression (m) of the elements at x (m), in every state.

        Of an element that has let go of the indenter the compression is what has not relaxed yet. Those at
        x follow the whole path anew: no grid is involved.

        Returns
        -------
        tuple of ndarray
            Both of the shape of `time`, followed by that of `x`.
        """
        x = np.abs(_check.finite_array("coordinate x", x, unit="m"))
        medium, (time, depth), place = self.medium, self._path, np.asarray(self._place, int)
        state, last = Elements.virgin(np.asarray(self.profile.reduced(x.ravel()))), int(np.max(place))
        rises, steps = np.diff(depth, prepend=0.0), np.append(np.inf, np.diff(time))
        found = np.empty((2, last + 1, x.size))
        for i in range(last + 1):
            ramp = Ramp(depth[i], rises[i], steps[i], medium.relaxation_time, medium.critical_depth)
            state = element.advance(state, ramp)[0]
            load = np.where(state.contact, medium.E_star * (state.elastic + ramp.lag), 0.0)
            found[:, i] = load, state.elastic
        load, elastic = found[:, place].reshape(2, *place.shape, *x.shape)
        return load[()], elastic[()]

    def pressure(self, r: ArrayLike) -> Array:
        """Contact pressure p = −σ_zz (Pa) of one state at radii r (m); Popov (2015), Eq. (10).

        From the line load at 4000 places, straight in between. Infinite at the rim while the
        dashpots press there.
        """
        self._one("pressure")
        r, radius = _check.finite_array("radius", r, unit="m"), float(self.contact_radius)
        if radius == 0:
            return np.zeros(r.shape)[()]
        x = cell_edges(self.profile, 4000, radius, nodes=(self.plastic_radius,))
        # The last place just inside: the load may end there with a jump, or with one of rounding's size.
        load = self.line_load(np.minimum(x, radius * (1 - 1e-12)))
        load[-1] = load[-1] if load[-1] > 1e-9 * load.max() else 0.0
        return 0.0 - abel.stress_from_line_load(x, load, r)


_ARRAYS = [f.name for f in fields(TimedIndentation) if f.type is Array]
