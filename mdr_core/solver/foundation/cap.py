"""The yield cap of the elements: the largest elastic compression of their springs.

Popov (2015), Eqs. (12), (17)–(19), with the hardness σ_c(a) at the contact radius a of the largest depth.
It uses the law of hardness, which defines the medium. It shares no code with the rule of yield, because the
chain checks this rule independently.
"""

import numpy as np

from ...base import check
from ..numerics.roots import increasing_root


def elastic_limit(profile, medium, largest):
    """Return the largest elastic compression u_c = π a σ_c(a)/(2E*) (m) for a largest depth (m)."""
    if medium.inverse_to_radius:
        return medium.critical_depth
    a = profile.contact_radius(np.maximum(largest, 0.0))
    with np.errstate(over="ignore"):
        return medium.law.scaled(np.pi / (2 * medium.E_star), 1.0).line_load(a)


def plastic_depth(profile, medium, largest):
    """Return the plastic part (m) of the element at the axis after a largest depth (m)."""
    return np.maximum(largest - elastic_limit(profile, medium, largest), 0.0)


def onset_depth(profile, medium):
    """Return the depth (m) at which the first element yields; infinite if it exceeds the known depth."""
    if medium.inverse_to_radius:
        return medium.critical_depth

    def ratio(depth):
        """Return depth over elastic limit, which grows with depth, and its approximate derivative."""
        depth = np.minimum(depth, check.LONGEST)
        value = depth / elastic_limit(profile, medium, depth)
        before = depth * (1 - 1e-6)
        return value, (value - before / elastic_limit(profile, medium, before)) / (1e-6 * depth)

    if ratio(check.SHORTEST)[0] > 1:
        return 0.0
    return float(increasing_root(ratio, 1.0, 1.0, profile.known_depth, largest=check.LONGEST))


def flat_face_load(medium, radius):
    """Return the force π (H b² + q_c b) (N) of a fully yielded flat face of radius b (m).

    It is infinite for an infinite radius.
    """
    return np.pi * (medium.hardness * radius + medium.q_c) * radius if radius < np.inf else np.inf
