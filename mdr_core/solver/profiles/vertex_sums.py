"""Sums over the vertices of a polygon, in a time that does not grow with their number.

A polygon is a sum of truncated cones, one from each vertex: g is Σ β x arccos(r/x) over vertices at radii r
with changes β of the slope. Over a panel of lengths x, at least twice its width away from a vertex, such
a term is a polynomial to rounding. Panels are halved until few vertices are nearer; the others share one
polynomial.
"""

import numpy as np
from numpy.polynomial import Chebyshev, Polynomial, chebyshev

from ..numerics.blocks import chunks
from ..numerics.stable import root

#: Largest number of vertices near a panel, and distance of a far vertex in widths of the panel.
_NEAR, _FAR = 6, 2.0
#: Chebyshev points of a panel. With 12 points g′ has errors of 5·10⁻¹⁴, with 14 only rounding errors.
_COUNT = 14
#: Width of a panel, over its position, below which it is not halved: vertices may be neighbouring numbers.
_LEAST = 2.0**-45
#: Nodes, and matrices from values there to Chebyshev coefficients and to values in both halves. Powers are
#: computed from the coefficients; directly from values they would lose five digits.
_NODE = np.cos(np.pi * (np.arange(_COUNT) + 0.5) / _COUNT)
_TO_CHEBYSHEV = np.linalg.inv(chebyshev.chebvander(_NODE, _COUNT - 1)).T
_HALVES = [_TO_CHEBYSHEV @ chebyshev.chebvander((_NODE + side) / 2, _COUNT - 1).T for side in (-1, 1)]
_TO_POWERS = np.array([
    np.pad(Chebyshev.basis(k).convert(kind=Polynomial).coef, (0, _COUNT - 1 - k)) for k in range(_COUNT)
])  # fmt: skip


class VertexSums:
    """∫ g dx (m²), g (m) and g′ of a polygon with vertices r (m), ascending, of bends β, up to a length."""

    def __init__(self, r, bend, end):
        outside = r > 0
        # A sharp tip is a cone.
        self._cone, r, bend = np.pi / 2 * bend[~outside].sum(), r[outside], bend[outside]
        lower, width, far, first, count = map(np.concatenate, zip(*_panels(r, bend, end), strict=True))
        order = np.argsort(lower)
        self._lower, self._end, self._first, self._places = lower[order], end, first[order], count.max()
        self._half = width[order] / 2
        self._powers = (far[order] @ _TO_CHEBYSHEV @ _TO_POWERS)[..., ::-1]
        self._r = np.append(r, np.full(self._places, 2 * end))
        self._bend = np.append(bend, np.zeros(self._places))

    def __call__(self, x):
        """Return ∫ g dx, g and g′ at lengths x ≥ 0 (m), (3, *x.shape); on a vertex, of its outer side."""
        flat = np.ravel(x)
        sums = self._cone * np.array([flat * flat / 2, flat, np.ones_like(flat)])
        known = flat <= self._end
        for rows in chunks(flat.size):
            own = flat[rows]
            if known[rows].all():
                sums[:, rows] += self._from_panels(own)
            else:
                sums[:, rows] += _direct(own, self._r, self._bend)
        return sums.reshape(3, *np.shape(x))

    def _from_panels(self, x):
        panel = self._lower.searchsorted(x, side="right") - 1
        half = self._half[panel]
        powers = np.vander((x - self._lower[panel]) / half - 1, _COUNT)
        near = self._first[panel, None] + np.arange(self._places)
        terms = _terms(x[:, None], self._r[near])
        return np.einsum("xp,xsp->sx", powers, self._powers[panel]) + np.einsum(
            "sxk,xk->sx", terms, self._bend[near]
        )


def _direct(x, r, bend):
    """Return sums beyond the end of the polygon, from all terms one by one."""
    sums = np.empty((3, x.size))
    for rows in chunks(x.size, max(1, 2**15 // max(r.size, 1))):
        sums[:, rows] = _terms(x[rows, None], r) @ bend
    return sums


def _terms(x, r):
    """Return ∫ g dx, g and g′ at x (m) of vertices r > 0 (m) with bend 1, broadcast; 0 inside r."""
    distance = root(x, r)
    angle = np.arctan2(distance, r)
    with np.errstate(divide="ignore", invalid="ignore"):
        area = (x * x * angle - r * distance) / 2
        return np.array([area, x * angle, np.where(x >= r, angle + r / distance, 0.0)])


def _panels(r, bend, end):
    """Yield panels: lower edges, widths, sums over far vertices at nodes, first and number of near ones."""
    lower, width, far, first = np.zeros(1), np.array([end]), np.zeros((1, 3, _COUNT)), np.zeros(1, int)
    while lower.size:
        count = r.searchsorted(lower + width) - first
        done = (count <= _NEAR) | (width <= _LEAST * (lower + width))
        yield lower[done], width[done], far[done], first[done], count[done]
        lower, width, far, before = lower[~done], width[~done] / 2, far[~done], np.tile(first[~done], 2)
        lower, width = np.append(lower, lower + width), np.tile(width, 2)
        far = np.concatenate([far @ half for half in _HALVES])
        first = r.searchsorted(lower - _FAR * width, side="right")
        _add_ranges(far, lower + width / 2, width / 2, r, bend, before, first)


def _add_ranges(far, middle, half, r, bend, start, stop):
    """Add the terms of vertices from number `start` to `stop` to the sums at the nodes of each panel."""
    count = stop - start
    begin, panel = np.cumsum(count) - count, np.repeat(np.arange(count.size), count)
    vertex = np.arange(panel.size) + (start - begin)[panel]
    x = middle[panel, None] + half[panel, None] * _NODE
    terms = _terms(x, r[vertex, None]) * bend[vertex, None]
    some = np.flatnonzero(count)
    if some.size:
        far[some] += np.add.reduceat(terms, begin[some], axis=1).transpose(1, 0, 2)
