"""The yield cap of the elements: how far their springs are compressed elastically.

Popov (2015), Eqs. (12), (17)–(19). It is the chain's own, and shares no code with the rule of yield that
the chain bears witness of.
"""

import numpy as np

from ..medium import refuse_other_classes


def refuse_hardness(medium):
    """Refuses a medium whose elements have another cap in a larger contact."""
    instead = "elements of the foundation have one cap; set hardness = 0 and f_c = 0"
    refuse_other_classes(medium, "a foundation", instead)


def elastic_limit(medium):
    """Largest elastic compression d_c = π q_c/(2E*) (m) of the elements."""
    return medium.critical_depth


def plastic_depth(medium, largest):
    """Plastic part (m) of the element at the axis after a largest depth (m)."""
    return np.maximum(largest - elastic_limit(medium), 0.0)


def flat_face_load(medium, radius):
    """Force π q_c b (N) of a flat face of a radius (m) that has yielded throughout."""
    return np.pi * medium.q_c * radius
