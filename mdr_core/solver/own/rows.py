"""Ensembles of users' shapes and laws: the largest depth of each entry, and errors for faulty entries."""

from functools import partial

import numpy as np

from ...base import check
from ...base.check import shown
from ..medium.hardness import HardnessLaw
from ..numerics.blocks import chunks


def largest_in_blocks(profile, depth, shape):
    """Yield numbers of entries of an ensemble of a shape, and the largest depth (m) of each, 512 at a time.

    Depths that are not finite and positive are left out. Others are limited to the known depth.
    """
    depth = np.where(depth <= check.LONGEST, depth, 0.0)
    depth = np.broadcast_to(depth, np.broadcast_shapes(depth.shape, shape))
    # The other axes have the depths of one entry.
    sizes = (1,) * (depth.ndim - len(shape)) + shape
    others = tuple(axis for axis, size in enumerate(sizes) if size == 1)
    largest = np.max(depth, axis=others, initial=0.0).reshape(shape)
    largest = np.minimum(largest, profile.known_depth).ravel()
    rows = np.flatnonzero(largest > 0)
    for block in chunks(rows.size, 512):
        yield rows[block], largest[rows[block]]


def values_of(thing, name, x):
    """Return the values of a user's named function at radii (m); raise an error unless they are numbers."""
    return check.values_of(f"{name}()", getattr(thing, name), x, partial(refused, thing))


def refuse_first(thing, bad, what, advice):
    """Raise an error for the first `bad` shape or law of an ensemble; `what(index)` is the reason."""
    if np.any(bad):
        index = np.unravel_index(np.argmax(bad), bad.shape)
        raise refused(thing.entries(index, bad.shape), what(index), advice)


def refused(thing, what, advice):
    """Return the error for an invalid shape or law, with its fault and the remedy."""
    quantity = "hardness" if isinstance(thing, HardnessLaw) else "profile"
    text = f"{quantity} {shown(thing)}: {what}; {advice}"
    return check.InvalidArgument(text, quantity, thing, what, "", advice)
