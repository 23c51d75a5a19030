"""Arrays in blocks that fit into the cache."""

import numpy as np

#: Rows of a block if each block takes about a thousand calls of NumPy.
LONG = 2**14


def chunks(size, most=8192):
    """Return slices of at most `most` rows, so that the arrays of a block fit into the cache."""
    return (slice(start, start + most) for start in range(0, size, most))


def broadcast_flat(*arrays):
    """Return the shape to which arrays broadcast, and the broadcast arrays as 1D arrays."""
    arrays = np.broadcast_arrays(*arrays)
    return arrays[0].shape, [part.ravel() for part in arrays]
