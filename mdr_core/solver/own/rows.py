"""Ensembles of shapes and laws that users wrote: what is reached of each, and which of them is at fault."""

from functools import partial

import numpy as np

from ...base import check
from ...base.check import shown
from ..medium.hardness import HardnessLaw
from ..numerics.blocks import chunks


def largest_in_blocks(profile, depth, shape):
    """Numbers of entries of an ensemble of a shape, and the largest depth (m) of each, 512 at a time.

    Depths are left out where they are not finite and positive; others count as far as the profile is known.
    """
    depth = np.where(depth <= check.LONGEST, depth, 0.0)
    depth = np.broadcast_to(depth, np.broadcast_shapes(depth.shape, shape))
    # Along other axes are the depths of one entry.
    sizes = (1,) * (depth.ndim - len(shape)) + shape
    others = tuple(axis for axis, size in enumerate(sizes) if size == 1)
    largest = np.max(depth, axis=others, initial=0.0).reshape(shape)
    largest = np.minimum(largest, profile.known_depth).ravel()
    rows = np.flatnonzero(largest > 0)
    for block in chunks(rows.size, 512):
        yield rows[block], largest[rows[block]]


def values_of(thing, name, x):
    """What a user's function of a name gives at radii (m), one for each, else refused."""
    return check.values_of(f"{name}()", getattr(thing, name), x, partial(refused, thing))


def refuse_first(thing, bad, what, advice):
    """Refuses the first shape or law of an ensemble that is `bad`; `what` says why for its index."""
    if np.any(bad):
        index = np.unravel_index(np.argmax(bad), bad.shape)
        raise refused(thing.entries(index, bad.shape), what(index), advice)


def refused(thing, what, advice):
    """The error of a shape or a law that is not valid: what is wrong with it, and what to do."""
    quantity = "hardness" if isinstance(thing, HardnessLaw) else "profile"
    text = f"{quantity} {shown(thing)}: {what}; {advice}"
    return check.InvalidArgument(text, quantity, thing, what, "", advice)
