"""Indentation and impact by the method of dimensionality reduction (MDR).

Axisymmetric rigid indenters on an elastic half-space with a non-local yield criterion (hardness
inversely proportional to the contact radius), mapped exactly onto a row of independent springs:
V. L. Popov, Facta Universitatis, Mech. Eng. 13(1), 2015, 39–46.
"""

from .impact import Impact, impact
from .indentation import Indentation, indent
from .medium import Medium
from .profiles import Cone, FlatPunch, Paraboloid, PowerLaw, Profile
from .scene import DepthPath, FreeImpact, Scene

__all__ = [
    "Cone",
    "DepthPath",
    "FlatPunch",
    "FreeImpact",
    "Impact",
    "Indentation",
    "Medium",
    "Paraboloid",
    "PowerLaw",
    "Profile",
    "Scene",
    "impact",
    "indent",
]
