"""Contact times of ensembles from polynomials in two variables.

On a virgin medium the contact time over d_max/v₀ is a function of d_max, in units of the depth of the first
kink, and of X = d_p/d_c, which is 0 without yield. The plane of both has blocks: octaves of d_max, in which
u² is d_max over its lower end less 1, and bands of v = √X/(1 + √X). The time is smooth in u from a kink on,
in v at the onset of yield and in the limit d_p ≫ d_c. Where an ensemble has many impacts in a block, it is
halved into cells until polynomials in u and v are the time.
"""

from functools import lru_cache

import numpy as np
from numpy.polynomial import chebyshev

from .._numeric import chunks

#: Number of impacts in a block that is worth its cells.
MANY = 2000
#: Chebyshev points on [0, 1] in each variable, and the matrix that takes values there to coefficients.
_COUNT = 12
_NODE = (1 + np.cos(np.pi * (np.arange(_COUNT) + 0.5) / _COUNT)) / 2
_TO_SERIES = np.linalg.inv(chebyshev.chebvander(2 * _NODE - 1, _COUNT - 1))
#: Largest of the last two coefficients of a cell: the error stays below 5 × 10⁻¹⁰ of the contact time.
_LAST = 1e-11
#: Length of a side after all halvings, and the exponents of 2 of the octaves with blocks.
_SHORTEST, _OCTAVES = 2.0**-6, range(-40, 20)


def tabulated_ratio(profile, function, depth, X):
    """Contact time over d_max/v₀ of virgin impacts, NaN where no cell has it, from 1-D arrays.

    `function` of the `profile`, d_max and X gives it by quadrature; `depth` is d_max (m). There are no
    cells deeper than the second kink.
    """
    result, root = np.full(depth.size, np.nan), np.sqrt(X)
    unit, end = _unit(profile), min([*profile.kinks[1:2], profile.known_depth])
    depth, v = depth / unit, root / (1 + root)
    mantissa, exponent = np.frexp(depth)
    borders = _borders(profile, depth)
    band = (v > borders[1]).astype(int) + (v > borders[2])
    low, high = (np.choose(band, borders[k : k + 3]) for k in (0, 1))
    places = np.array([np.sqrt(2 * mantissa - 1), (v - low) / (high - low)])
    blocks, inverse, counts = np.unique(3 * (exponent - 1) + band, return_inverse=True, return_counts=True)
    order, stops = np.argsort(inverse, kind="stable"), np.cumsum(counts)
    for block, count, stop in zip(blocks, counts, stops, strict=True):
        octave, band = divmod(int(block), 3)
        if count > MANY and octave in _OCTAVES and 2.0 ** (octave + 1) * unit <= end:
            cells = _cells(profile, function, octave, band)
            for chunk in chunks(count, 2048):
                rows = order[stop - count : stop][chunk]
                result[rows] = _values(*cells, places[:, rows])
    return result


def _unit(profile):
    """Depth (m) of the first kink, without kinks 1 m."""
    return (profile.kinks or (1.0,))[0]


def _borders(profile, depth):
    """v at the four borders of the bands: of a profile with a kink those at which d_p or d_c is there."""
    low = np.full_like(depth, 0.3)
    if profile.kinks:
        kink = 1 / (1 + np.sqrt(np.maximum(depth - 1, 0.0)))
        low = np.where(depth > 1, np.minimum(kink, 1 - kink), low)
    return np.zeros_like(depth), low, 1 - low, np.ones_like(depth)


@lru_cache(maxsize=512)
def _cells(profile, function, octave, band):
    """Cells of a block: a grid of their numbers, −1 for none, and their corners, sides and series."""
    grid, cells = np.full((round(1 / _SHORTEST),) * 2, -1), []
    low, side = np.zeros((1, 2)), np.ones((1, 2))
    # Where so many are rough, the profile has changes that are not known.
    while 0 < len(low) <= 64:
        depth, place = (low[:, k, None] + side[:, k, None] * _NODE for k in (0, 1))
        depth, place = np.broadcast_arrays(2.0**octave * (1 + depth[:, :, None] ** 2), place[:, None, :])
        values = [_by_quadrature(profile, function, band, *rows) for rows in zip(depth, place, strict=True)]
        series = _TO_SERIES @ np.array(values) @ _TO_SERIES.T
        last = [np.abs(part).max(axis=(1, 2)) for part in (series[:, -2:], series[:, :, -2:])]
        smooth = np.max(last, axis=0) < _LAST
        cells += zip(low[smooth], side[smooth], series[smooth], strict=True)
        # The side along which the last coefficients are larger is halved.
        half = side * np.where(np.argmax(last, axis=0)[:, None] == [0, 1], 0.5, 1.0)
        rough = ~smooth & (half.min(axis=1) >= _SHORTEST)
        low, half, step = low[rough], half[rough], (side - half)[rough]
        low, side = np.concatenate([low, low + step]), np.concatenate([half, half])
    # One that the grid does not show, for places without a cell.
    cells.append((np.zeros(2), np.ones(2), np.zeros((_COUNT, _COUNT))))
    for number, (corner, side, _) in enumerate(cells[:-1]):
        (i, j), (m, n) = (corner / _SHORTEST).astype(int), (side / _SHORTEST).astype(int)
        grid[i : i + m, j : j + n] = number
    return grid, *(np.array(part) for part in zip(*cells, strict=True))


def _by_quadrature(profile, function, band, depth, place):
    """`function` at depths in units and places in a band, from 0 to 1, arrays of one shape."""
    low, high = _borders(profile, depth.ravel())[band : band + 2]
    v = low + (high - low) * place.ravel()
    return function(profile, depth.ravel() * _unit(profile), (v / (1 - v)) ** 2).reshape(depth.shape)


def _values(grid, low, side, series, places):
    """Contact times over d_max/v₀ at places in a block, (2, N); NaN where there is no cell."""
    cell = grid[tuple(np.clip((places / _SHORTEST).astype(int), 0, len(grid) - 1))]
    x = 2 * (places - low[cell].T) / side[cell].T - 1
    rows, columns = chebyshev.chebvander(x, _COUNT - 1)
    value = np.einsum("ij,ij->i", rows, np.einsum("ijk,ik->ij", series[cell], columns))
    return np.where(cell < 0, np.nan, value)
