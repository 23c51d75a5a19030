"""Indentation and impact by the method of dimensionality reduction (MDR).

Axisymmetric rigid indenters on an elastic half-space with a non-local yield criterion (hardness
inversely proportional to the contact radius), mapped exactly onto a row of independent springs:
V. L. Popov, Facta Universitatis, Mech. Eng. 13(1), 2015, 39–46.
"""

from . import abel
from .chain_impact import ChainImpact, chain_impact
from .foundation import Foundation
from .impact import Impact, impact
from .indentation import Indentation, indent, indent_to_force
from .medium import Medium
from .motion import Motion
from .profiles import Cone, FlatPunch, Paraboloid, PowerLaw, Profile
from .rounded import Hyperboloid, ParabolicPunch, RoundedCone, Sphere
from .sampled import Sampled
from .scaling import FastLimit, ScalingLaw, hardness_class
from .scene import DepthPath, ForcePath, FreeImpact, Scene
from .smooth import Smooth
from .timed import TimedIndentation
from .truncated import RoundedPunch, TruncatedCone, TruncatedParaboloid

__all__ = [
    "ChainImpact",
    "Cone",
    "DepthPath",
    "FastLimit",
    "FlatPunch",
    "ForcePath",
    "Foundation",
    "FreeImpact",
    "Hyperboloid",
    "Impact",
    "Indentation",
    "Medium",
    "Motion",
    "ParabolicPunch",
    "Paraboloid",
    "PowerLaw",
    "Profile",
    "RoundedCone",
    "RoundedPunch",
    "Sampled",
    "ScalingLaw",
    "Scene",
    "Smooth",
    "Sphere",
    "TimedIndentation",
    "TruncatedCone",
    "TruncatedParaboloid",
    "abel",
    "chain_impact",
    "hardness_class",
    "impact",
    "indent",
    "indent_to_force",
]
