"""The chain itself: a row of springs, dashpots and yield caps under an indenter, element by element.

Edges between elements stand on the axis, on the flat face, kinks and wall of the shape, and on the radii
that are asked for; elements sit in the middle between edges. With every kink of the line load on an edge,
the sum over elements is of second order.
"""

from dataclasses import dataclass, field

import numpy as np

from .. import _check
from ..medium import Medium, check_pair
from ..quantities import described, engineering
from ..shapes.profile import Profile
from . import element
from .element import Elements, Ramp

#: The most elements of a row: some GB.
_MOST = 10**7


def element_count(n):
    """A number of elements, if it is one for both sides of the axis."""
    count = _check.positive_number("n", n)
    if count % 2 or count > _MOST:
        raise ValueError(
            f"n = {count:g} must be an even whole number up to {_MOST:g}: as many elements on either side"
        )
    return int(count)


@dataclass(frozen=True, eq=False, repr=False)
class Foundation:
    """The 1D foundation of Popov (2015), Fig. 1, as a row of independent elements.

    A spring Δk = E*Δx that never carries more than π q_c/2 per length, and a dashpot Δγ = 4ηΔx in
    parallel with it (Eqs. (1), (12)), at each of n places between −half_width and half_width. A
    foundation does not change: `advance` returns the next one. It uses the reduced profile and the
    law of one element only, nothing that `indent` or `impact` is made of.

    Parameters
    ----------
    profile, medium
        The indenter, which at first touches the virgin surface at depth 0, and the medium.
    n : int
        Number of elements on both sides of the axis together, even, at least 2.
    half_width : float
        Where the row ends on either side (m): at least the largest contact radius to come.
    nodes : sequence of float, optional
        Radii (m) on which an edge between elements must stand. The flat face, the kinks and the
        wall of the shape are edges in any case. With the contact radius and the radius of the
        plastic zone as nodes, sums over the elements are of second order in 1/n.

    Raises
    ------
    ValueError
        If n is odd or too small for the kinks and nodes, or the row is wider than the shape is
        known.

    Notes
    -----
    A straight ramp is one step however long it is: every element is followed exactly, through being
    met, yielding, letting go and relaxing. The line load is that at the end of the ramp, with the
    dashpots still at its rate.

    Examples
    --------
    Cone of slope 1 pressed to three times the depth at which it starts to yield, F = 5 F_c (Popov
    2015, Eqs. (20), (22)), then let go:

    >>> from mdr_core import Cone, Medium
    >>> cone, medium = Cone(slope=1.0), Medium(E_star=1.0, q_c=2.0)
    >>> d_c = medium.critical_depth
    >>> row = Foundation(cone, medium, 12, half_width=3 * d_c / 1.5707963267948966)
    >>> pressed = row.advance(3 * d_c)
    >>> print(round(pressed.force / (3.141592653589793 * 2.0**2 / 2), 12))
    5.0
    >>> pressed.state[6:].tolist()
    ['yielded', 'yielded', 'yielded', 'yielded', 'elastic', 'elastic']
    >>> print(pressed.advance(0.0).force)
    0.0
    """

    profile: Profile
    medium: Medium
    n: int
    half_width: float
    nodes: tuple[float, ...] = ()
    #: Present depth (m) of the indenter.
    depth: float = field(default=0.0, init=False)
    #: Energy (J) dissipated by the dashpots so far.
    viscous_work: float = field(default=0.0, init=False)
    #: The moves so far, as (depth, dt): what another row has to go through to be like this one.
    history: tuple[tuple[float, float], ...] = field(default=(), init=False, repr=False)

    def __post_init__(self):
        check_pair(self.profile, self.medium, "a foundation")
        n = element_count(self.n)
        half_width = _check.positive_number("half_width", self.half_width, unit="m")
        known = self.profile.known_radius
        if half_width > known:
            raise ValueError(
                f"half_width = {half_width:g} m is beyond the radius up to which the shape is known, "
                f"{known:g} m; give at most that"
            )
        nodes = _check.finite_array("nodes", self.nodes, unit="m").ravel()
        edges = cell_edges(self.profile, n // 2, half_width, nodes)
        # At the axis one of no width: what is touched first, and let go of last.
        middle = np.append(0.0, (edges[1:] + edges[:-1]) / 2)
        # A little beyond the end: the row may end on the very contact radius.
        rim = self.profile.reduced(min(half_width * (1 + 1e-9), known))
        self.__dict__.update(
            n=n,
            half_width=half_width,
            nodes=tuple(nodes.tolist()),
            _middle=middle,
            _width=np.append(0.0, np.diff(edges)),
            _rim=np.inf if half_width >= self.profile.wall else rim,
            _lag=0.0,
            _elements=Elements.virgin(self.profile.reduced(middle)),
        )

    def __repr__(self) -> str:
        lines = (
            f"Foundation: {self.n} elements to ±{engineering(self.half_width, 'm')}, after "
            f"{len(self.history)} moves",
            f"  indenter                 {described(self.profile)}",
            f"  medium                   {described(self.medium)}",
            f"  depth d                  {engineering(self.depth, 'm')}",
            f"  force F                  {engineering(self.force, 'N')}",
        )
        return "\n".join(lines)

    def advance(self, depth: float, dt: float = np.inf) -> "Foundation":
        """The foundation after the indenter has moved there, along a straight ramp of depth over time.

        Parameters
        ----------
        depth : float
            New depth d (m); negative means lifted off.
        dt : float, optional
            Time (s) that the move takes, positive; infinitely slow by default, so that the
            dashpots carry nothing and what has been let go is relaxed.

        Returns
        -------
        Foundation

        Raises
        ------
        ValueError
            If the contact would grow beyond the row, or the shape is not known so deep.

        Examples
        --------
        A dashpot alone adds 8ηb ḋ to the force of a flat punch, and nothing once it rests:

        >>> from mdr_core import FlatPunch, Medium
        >>> row = Foundation(FlatPunch(radius=1.0), Medium(E_star=1.0, eta=1.0), 2, half_width=1.0)
        >>> moved = row.advance(3.0, dt=1.5)
        >>> print(moved.force, moved.advance(3.0, dt=1.0).force)  # 2E*b d + 8ηb ḋ
        22.0 6.0
        """
        depth = float(_check.finite_array("depth", _check.number("depth", depth, "m"), unit="m"))
        dt = _check.positive_number("dt", dt, unit="s", infinite=True)
        ramp = self._ramp(depth - self.depth, dt, depth)
        return self._after(ramp, *element.advance(self._elements, ramp))

    def _ramp(self, rise, dt, depth=None):
        medium, depth = self.medium, self.depth + rise if depth is None else depth
        return Ramp(depth, rise, dt, medium.relaxation_time, medium.critical_depth)

    def _after(self, ramp, state, exchange, rate=None):
        """This foundation with its elements at the end of a ramp; at another rate (m/s) there, if given."""
        self._refuse_overflow(ramp.depth)
        new = object.__new__(type(self))
        # What has been computed from the old state does not belong to the new one.
        new.__dict__.update(item for item in vars(self).items() if item[0] not in _CACHED)
        new.__dict__.update(
            depth=float(ramp.depth),
            viscous_work=self.viscous_work + self._total(exchange.viscous),
            history=(*self.history, (ramp.depth, ramp.time)),
            _lag=ramp.lag if rate is None else ramp.tau * rate,
            _elements=state,
        )
        return new

    def _refuse_overflow(self, depth):
        if depth > self.profile.known_depth:
            self.profile._known(np.asarray(depth))
        if depth > self._rim:
            raise ValueError(
                f"half_width = {self.half_width:g} m is less than the contact radius "
                f"{self.profile.contact_radius(depth):g} m at depth = {depth:g} m; give at least that"
            )

    def _total(self, values):
        """E* times the sum over both sides of a quantity of the elements, by width."""
        return float(2 * self.medium.E_star * (values @ self._width))

    def _mirrored(self, values):
        return np.concatenate([values[:0:-1], values[1:]])

    @_check.frozen_property
    def x(self) -> np.ndarray:
        """Places of the elements (m), shape (n,), from −half_width to half_width."""
        return np.concatenate([-self._middle[:0:-1], self._middle[1:]])

    @_check.frozen_property
    def width(self) -> np.ndarray:
        """Widths Δx (m) of the elements: what sums over them are weighted with."""
        return self._mirrored(self._width)

    @_check.frozen_property
    def elastic(self) -> np.ndarray:
        """Elastic part u_e (m) of each element's compression, the one that its spring carries."""
        return self._mirrored(self._elements.elastic)

    @_check.frozen_property
    def plastic(self) -> np.ndarray:
        """Plastic part u_p (m) of each element's compression: the residual imprint."""
        return self._mirrored(self._elements.plastic)

    @_check.frozen_property
    def contact(self) -> np.ndarray:
        """Whether each element is in contact; one that is not may still be relaxing."""
        return self._mirrored(self._elements.contact)

    @_check.frozen_property
    def line_load(self) -> np.ndarray:
        """Line load q = E* u_e + 4ηḋ (N/m), 0 out of contact; Popov (2015), Eqs. (1), (17), (18)."""
        return self._mirrored(self._load)

    @property
    def _load(self):
        state = self._elements
        return np.where(state.contact, self.medium.E_star * np.maximum(state.elastic + self._lag, 0.0), 0.0)

    @_check.frozen_property
    def state(self) -> np.ndarray:
        """State of each element: "yielded" with a plastic part, else "elastic" in contact, else "free"."""
        names = np.where(self._elements.contact, "elastic", "free")
        return self._mirrored(np.where(self._elements.plastic > 0, "yielded", names))

    @property
    def force(self) -> float:
        """Normal force F = Σ q Δx (N); Popov (2015), Eq. (9)."""
        return float(2 * (self._load @ self._width))

    @property
    def stored_energy(self) -> float:
        """Elastic energy U = Σ E* u_e² Δx/2 (J), that of relaxing elements out of contact included."""
        return self._total(self._elements.elastic**2 / 2)

    @property
    def plastic_work(self) -> float:
        """Energy Σ (π q_c/2) u_p Δx (J) dissipated by yielding so far."""
        yields = self.medium.critical_depth < np.inf
        return self._total(self._elements.plastic) * self.medium.critical_depth if yields else 0.0


_CACHED = {"x", "width", "elastic", "plastic", "contact", "line_load", "state"}


def cell_edges(profile, count, half_width, nodes=()):
    """Edges (m) between `count` elements on one side of the axis: 0, `half_width`, nodes and more."""
    posts = _posts(profile, half_width, nodes)
    share = np.diff(posts) / half_width
    if len(share) > count:
        raise ValueError(
            f"n = {2 * count} elements cannot stand on the {len(share)} stretches between the axis, the "
            f"kinks of the shape and the nodes on each side; give at least n = {2 * len(share)}"
        )
    # Half of them by length, half for each stretch alike: one just behind a flat face is short.
    share = (share + 1 / len(share)) / 2
    # One each to begin with; the rest rounded so that they add up.
    extra = np.diff(np.floor((count - len(share)) * np.append(0, np.cumsum(share)) + 0.5).astype(int))
    extra[-1] += count - len(share) - extra.sum()
    stretches = zip(posts, posts[1:], 1 + extra, _grading(profile, posts), strict=False)
    parts = [low + (high - low) * (np.arange(n) / n) ** p for low, high, n, p in stretches]
    return np.concatenate([*parts, [half_width]])


def _posts(profile, half_width, nodes):
    """The radii (m) on which edges must stand, from 0 to the half-width, none closer than rounding."""
    kinks = np.array([0.0, *profile.kinks])
    with np.errstate(all="ignore"):
        # At depth 0 the contact radius is that of the flat face.
        own = profile.contact_radius(kinks)
    radii = np.concatenate([own, [profile.wall], np.asarray(nodes, dtype=float)])
    radii = np.unique(radii[(radii > 0) & (radii < half_width * (1 - 1e-12))])
    apart = np.diff(radii, prepend=0.0) > 1e-12 * half_width
    return np.concatenate([[0.0], radii[apart], [half_width]])


def _grading(profile, posts):
    """The power p with which the edges of each stretch are set as ξ^p, 1 for equal ones.

    Where g rises from the lower end with a vertical tangent, as (x − low)^n with n < 1, the cells
    narrow toward it with p = 3/(1 + n): then h³ g″ is the same for all of them.
    """
    low, long = posts[:-1], np.diff(posts)
    with np.errstate(all="ignore"):
        foot, near, far = profile.reduced(low + long * np.array([[0.0], [2.0**-20], [2.0**-19]]))
        exponent = np.log2((far - foot) / (near - foot))
    return np.where((exponent > 0) & (exponent < 0.99), 3 / (1 + exponent), 1.0)
