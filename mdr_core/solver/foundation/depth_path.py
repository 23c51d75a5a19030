"""Viscous indentation along a path of depth in time: the chain, refined to a tolerance of the force."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from ...base import check, lazy
from ...base.check import Array, ArrayLike
from ...base.results import CHAIN, Limit, Model, Result, check_single
from ..applicability import check_pair, check_reached, refuse_adhesion
from ..medium.medium import Medium
from ..numerics import abel
from ..profiles.profile import Profile, check_known
from . import element
from .cap import elastic_limit, plastic_depth
from .element import Elements, Ramp
from .fronts import force_and_radius
from .grid import cell_edges
from .refinement import refine
from .row import Row

#: Elements of the coarsest run; largest number of elements times depths of the finest run.
_ELEMENTS, _MAX_ELEMENT_STEPS = 256, 10**8
#: Number of depths with edges at their radii; a longer path has edges at its deepest turning points only.
_MAX_EDGE_DEPTHS = 300
#: Quantities that `follow` records.
_RECORD = ("force", "stored_energy", "plastic_work", "viscous_work", "contact_radius")


def check_times(time, path, quantity):
    """Return `time` as an array if it increases and has the shape of a one-dimensional path."""
    time = check.finite_array("time", time, unit="s")
    if path.ndim != 1 or not path.size or time.shape != path.shape:
        raise check.MDRError(
            f"time of shape {time.shape} and {quantity} of shape {path.shape} must be one-dimensional and "
            f"of the same shape; give one time for each {quantity}"
        )
    back = np.append(False, np.diff(time) <= 0)
    advice = "drop repeated times, and give a jump a short time"
    return check.raise_if("time", time, back, "does not increase", unit="s", advice=advice)


@check.keywords_explained
def indent_in_time(
    profile: Profile, medium: Medium, depth: ArrayLike, time: ArrayLike, *, tolerance: float = 1e-6
) -> "TimedIndentation":
    """Press an indenter into a viscous medium along a path of depth in time.

    The chain solves it, because contact may return to elements that are still relaxing (Popov 2015, Eq. (1)
    for each element).

    Parameters
    ----------
    profile, medium
        The indenter and the medium.
    depth : array_like, shape (N,)
        Indentation depths d (m), linear between times. The first depth is reached quasi-statically.
    time : array_like, shape (N,)
        Increasing times (s).
    tolerance : float, optional
        Largest error of force and energies, each relative to its largest value.

    Returns
    -------
    TimedIndentation
        Quantities of the shape of `time`, with the estimated `error`.

    Raises
    ------
    ValueError
        If a depth is not finite or exceeds the known depth of the profile, or times do not increase.

    Examples
    --------
    Dashpots add 8ηb ḋ to the force of a flat punch and 4ηḋ to its line load, and nothing at constant depth:

    >>> from mdr_core import FlatPunch, Medium, indent_in_time
    >>> path = indent_in_time(FlatPunch(1.0), Medium(E_star=1.0, eta=1.0), [0.0, 3.0, 3.0], [0.0, 1.5, 2.0])
    >>> print(path.force.round(9).tolist(), path[1].line_load(0.5))
    [0.0, 22.0, 6.0] 11.0
    """
    check_pair(profile, medium, "a path in time")
    refuse_adhesion(medium, "a path in time")
    depth = check_known(profile, check.finite_array("depth", depth, unit="m", most=check.LONGEST))
    time = check_times(time, depth, "depth")
    tolerance = check.positive_number("tolerance", tolerance)
    check_reached(profile, medium, np.max(depth))
    nodes = _node_radii(profile, medium, depth, time)
    # A path without contact does not determine a width.
    half_width = float(profile.contact_radius(max(np.max(depth), 0.0))) or min(1.0, profile.known_radius)

    def run(level):
        n = _ELEMENTS * 2**level + 4 * len(nodes)
        return follow(Row.virgin(profile, medium, n + n % 2, half_width, nodes), depth, time)

    levels = 1 + max(0, int(np.log2(_MAX_ELEMENT_STEPS / (_ELEMENTS * depth.size))))
    # The contact radius, the last quantity, is not smooth in the step: it ends between elements.
    record, errors = refine(run, tolerance, levels, 4)
    return TimedIndentation(
        profile, medium, time, depth,
        plastic_depth=plastic_depth(profile, medium, np.maximum.accumulate(depth)),
        error=float(errors[:4].max()),
        _index=np.arange(depth.size), _history=Ramps(profile, medium, np.array(time), np.array(depth)),
        **dict(zip(_RECORD, record.T, strict=True)),
    )  # fmt: skip


def follow(row, depth, time, advance=Row.advance, first=np.inf):
    """Return the `_RECORD` of a row at each time of a path, shape (N, 5).

    `first` is the duration (s) of the move to the first depth.
    """
    record = []
    for new_depth, dt in zip(depth, np.append(first, np.diff(time)), strict=True):
        row = advance(row, new_depth, dt)
        force, radius = force_and_radius(row)
        works = row.stored_energy, row.plastic_work, row.viscous_work
        record.append((force, *works, radius))
    return np.array(record)


def _node_radii(profile, medium, depth, time):
    """Return the radii (m) of fronts of contact, yield and release at the times of a path."""
    if len(depth) > _MAX_EDGE_DEPTHS:
        direction = np.sign(np.diff(depth))
        turns = np.flatnonzero(np.concatenate([[True], direction[1:] != direction[:-1], [True]]))
        turns = np.sort(turns[np.argsort(-depth[turns])[:_MAX_EDGE_DEPTHS]])
        depth, time = depth[turns], time[turns]
    lag = medium.relaxation_time * np.append(0.0, np.diff(depth) / np.diff(time))
    level = np.concatenate([depth, depth + np.minimum(lag, 0.0), plastic_depth(profile, medium, depth)])
    level = np.unique(level[level > 0])
    return profile.contact_radius(level) if level.size else np.empty(0)


class History(Protocol):
    """A path with the states of all elements."""

    model: Model

    def elements(self, x: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
        """Return line load (N/m) and elastic compression (m) at x ≥ 0 (m) in the first `count` states."""
        ...


@dataclass(frozen=True, eq=False)
class Ramps:
    """A path of straight ramps of depth (m) over time (s); the first ramp is infinitely slow.

    `start` returns the elements at coordinates x (m) before the first ramp; by default they are undeformed.
    With `start`, the path begins at the first depth, and `largest` (m) is the largest depth before it.
    """

    profile: Profile
    medium: Medium
    time: np.ndarray
    depth: np.ndarray
    start: Callable | None = None
    largest: float = 0.0

    model = CHAIN

    def elements(self, x, count):
        """Return line load (N/m) and elastic compression (m) at x (m) after each of the first depths."""
        medium = self.medium
        virgin = Elements.virgin(self.profile, x, np.zeros(x.size))
        elements = virgin if self.start is None else self.start(virgin)
        travel = np.diff(self.depth, prepend=0.0 if self.start is None else self.depth[0])
        duration = np.append(np.inf, np.diff(self.time))
        largest = np.maximum.accumulate(np.maximum(self.depth, self.largest))
        limits = elastic_limit(self.profile, medium, largest) + 0 * largest
        ramps = zip(self.depth[:count], travel, duration, limits, strict=False)
        load, elastic = np.empty((2, count, x.size))
        for i, (depth, *piece, limit) in enumerate(ramps):
            ramp = Ramp(depth, *piece, medium.relaxation_time, limit)
            if i or self.start is None:
                elements, _ = element.advance(elements, ramp)
            elastic[i] = elements.elastic
            load[i] = np.where(elements.contact, medium.E_star * (elastic[i] + ramp.lag), 0.0)
        return load, elastic


@dataclass(frozen=True, eq=False)
class _Joined:
    """A path of `count` states, followed by another path that begins in its last state."""

    first: History
    later: History
    count: int

    model = property(lambda self: self.later.model)

    def elements(self, x, count):
        """Return line load (N/m) and elastic compression (m) at x (m) in the first states, (count, M)."""
        parts = [self.first.elements(x, min(count, self.count))]
        if count > self.count:
            parts.append([values[1:] for values in self.later.elements(x, count - self.count + 1)])
        return tuple(np.concatenate(values) for values in zip(*parts, strict=True))


@dataclass(frozen=True, eq=False, repr=False)
class TimedIndentation(Result):
    """States of a viscous indentation at the times of its path, returned by `indent_in_time` or `creep`.

    `model` is the method of solution: the chain, or the scalar equations of creep.

    Every quantity has the shape of `time`; `result[i]` is one state. At a time of changing rate, force and
    fields belong to the end of the earlier piece.

    Examples
    --------
    >>> from mdr_core import FlatPunch, Medium, indent_in_time
    >>> path = indent_in_time(FlatPunch(radius=0.5), Medium(E_star=1.0), [0.0, 1.0], [0.0, 1.0])
    >>> print(round(path[-1].force, 6))  # 2E* a d
    1.0
    """

    profile: Profile
    medium: Medium
    #: Time (s) and indentation depth d (m).
    time: Array
    depth: Array
    #: Normal force (N) including the dashpots, and contact radius a (m), 0 without contact.
    force: Array
    contact_radius: Array
    #: Elastic energy (J), including elements that relax out of contact.
    stored_energy: Array
    #: Energies (J) dissipated so far by yielding, and by the dashpots.
    plastic_work: Array
    viscous_work: Array
    #: Plastic depth d_p (m), the depth of the residual imprint in the 1D foundation.
    plastic_depth: Array
    #: Estimated error of force and energies (`indent_in_time`) or depth (`creep`), relative to the largest.
    error: float
    #: Index of each state on the path of the elements, and this path.
    _index: Array
    _history: "History"

    _shown = ("time", "depth", "force", "contact_radius", "plastic_radius", "plastic_depth")
    _quantities = (*_shown, "stored_energy", "plastic_work", "viscous_work")
    _dimensions = ("time",)
    #: Fields with one entry per state.
    _state_fields = (*(set(_quantities) - {"plastic_radius"}), "_index")

    def __post_init__(self):
        copies = {name: np.array(getattr(self, name)) for name in self._state_fields}
        check.store(self, **{name: check.frozen(values) for name, values in copies.items()})

    @property
    def model(self) -> Model:
        """Name of the model, with the reason for its choice."""
        return self._history.model

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """Limits of the model's assumptions along this path."""
        return lazy.limits.contact_limits(self.profile, self.medium, self.contact_radius)

    def __getitem__(self, index: Any) -> "TimedIndentation":
        return replace(self, **{name: getattr(self, name)[index] for name in self._state_fields})

    @check.frozen_property
    def plastic_radius(self):
        """Plastic radius c (m); 0 if nothing has yielded."""
        radius = self.profile.contact_radius(self.plastic_depth)
        return np.where(np.asarray(self.plastic_depth) > 0, radius, 0.0)

    def line_load(self, x: ArrayLike) -> Array:
        """Return the line load q = E* u_e + 4ηḋ (N/m) of one state at x (m).

        Popov (2015), Eqs. (1), (17), (18).
        """
        check_single(self, "line_load")
        return self.elements(x)[0]

    def elements(self, x: ArrayLike) -> tuple[Array, Array]:
        """Return line load (N/m) and elastic compression (m) of the elements at x (m), in every state.

        Each has the shape of `time`, followed by the shape of `x`. The compression of a released element is
        the part that has not relaxed yet. Both are exact along the path of depth.
        """
        x = np.abs(check.finite_array("coordinate x", x, unit="m"))
        index = np.asarray(self._index, int)
        load, elastic = self._history.elements(x.ravel(), int(np.max(index)) + 1)
        shape = (*index.shape, *x.shape)
        return load[index].reshape(shape)[()], elastic[index].reshape(shape)[()]

    def pressure(self, r: ArrayLike) -> Array:
        """Return the contact pressure p = −σ_zz (Pa) of one state at radii r (m); Popov (2015), Eq. (10).

        It is infinite at the contact radius while the dashpots carry load there.
        """
        check_single(self, "pressure")
        r, radius = check.finite_array("radius r", r, unit="m"), float(self.contact_radius)
        if radius == 0:
            return np.zeros(r.shape)[()]
        # The line load is linear between 4000 coordinates.
        x = cell_edges(self.profile, 4000, radius, nodes=(self.plastic_radius,))
        # The last value is just inside the contact, where the load may jump; rounding is no jump.
        load = self.line_load(np.minimum(x, radius * (1 - 1e-12)))
        load[-1] = load[-1] if load[-1] > 1e-9 * load.max() else 0.0
        return 0.0 - abel.stress_from_line_load(x, load, r)


def states_along(history: History, index: np.ndarray, **quantities: Any) -> TimedIndentation:
    """Return the `TimedIndentation` of quantities by name, in states with these numbers along a history."""
    return TimedIndentation(**quantities, _index=index, _history=history)


def joined(first: TimedIndentation, later: TimedIndentation, force, time) -> TimedIndentation:
    """Join two paths under forces (N) at times (s) of both; one begins in the last state of the other.

    The first path has all states of its history.
    """
    count = len(first.time)
    names = ("depth", "contact_radius", "stored_energy", "plastic_work", "viscous_work", "plastic_depth")
    values = {name: np.append(getattr(first, name), getattr(later, name)[1:]) for name in names}
    return states_along(
        _Joined(first._history, later._history, count),  # noqa: SLF001
        np.append(np.arange(count), count - 1 + later._index[1:]),  # noqa: SLF001
        profile=first.profile, medium=first.medium, time=time, force=force, **values,
        error=first.error + later.error,
    )  # fmt: skip
