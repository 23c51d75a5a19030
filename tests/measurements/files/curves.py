"""A loading and an unloading that the tests of the reading write, and the text of columns."""

import numpy as np

#: Depth (m), force (N), time (s).
DEPTH = 1e-9 * np.append(np.linspace(-20, 200, 56), np.linspace(200, 120, 20)[1:])
FORCE = np.append(np.maximum(DEPTH[:56], 0) ** 1.5 * 1e8, np.maximum(DEPTH[56:] - 110e-9, 0) * 1e5)
TIME = 0.1 * np.arange(DEPTH.size)
#: Force on a cantilever of 0.05 N/m and 60 nm/V, and the position of the piezo.
STIFFNESS, SENSITIVITY = 0.05, 60e-9
SMALL = 1e-6 * FORCE
PIEZO = DEPTH + SMALL / STIFFNESS


def rows(*columns, between=","):
    return "\n".join(between.join(f"{x:.9g}" for x in row) for row in zip(*columns, strict=True)) + "\n"


def assert_curve(curve, depth=DEPTH, force=FORCE, digits=1e-7):
    """Nine digits are written."""
    np.testing.assert_allclose(curve.depth, depth, rtol=0, atol=digits * np.ptp(depth))
    np.testing.assert_allclose(curve.force, force, rtol=0, atol=digits * np.ptp(force))
