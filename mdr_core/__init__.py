"""Indentation and impact by the method of dimensionality reduction (MDR).

Axisymmetric rigid indenters on an elastic half-space with a non-local yield criterion (a hardness that
depends on the contact radius), mapped exactly onto a row of independent springs: V. L. Popov,
Facta Universitatis, Mech. Eng. 13(1), 2015, 39–46.
"""

from . import abel, sweep
from ._check import no_attribute
from .contact import closed_forms as closed_forms  # registers the closed forms of the shapes
from .contact.creep import creep
from .contact.indentation import Indentation
from .contact.loading import indent, indent_to_force
from .contact.onset_of_yield import critical_force, yield_depth, yield_speed
from .drives import DepthPath, ForcePath, FreeImpact, FreeObliqueImpact
from .fit.hardness import fit_hardness
from .fit.indentation import fit_indentation
from .fit.oliver_pharr import oliver_pharr
from .foundation.chain_impact import chain_impact
from .foundation.depth_path import TimedIndentation, indent_in_time
from .foundation.foundation import Foundation
from .hardness import HardnessLaw
from .impacts.adhesive import capture_speeds
from .impacts.impact import impact
from .impacts.result import Impact
from .impacts.scaling import ScalingLaw, hardness_class
from .medium import Medium
from .oblique.ball import Ball, at_angle
from .oblique.oblique_impact import ObliqueImpact, oblique_impact
from .profiles.power import Cone, FlatPunch, Paraboloid, PowerLaw
from .profiles.profile import Profile
from .profiles.rounded import Hyperboloid, ParabolicPunch, RoundedCone, Sphere
from .profiles.sampled import Sampled
from .profiles.smooth import Smooth
from .profiles.truncated import RoundedPunch, TruncatedCone, TruncatedParaboloid
from .reading import read_curve, read_curves
from .results.base import Motion
from .scene import Scene

__all__ = [
    "Ball",
    "Cone",
    "DepthPath",
    "FlatPunch",
    "ForcePath",
    "Foundation",
    "FreeImpact",
    "FreeObliqueImpact",
    "HardnessLaw",
    "Hyperboloid",
    "Impact",
    "Indentation",
    "Medium",
    "Motion",
    "ObliqueImpact",
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
    "at_angle",
    "capture_speeds",
    "chain_impact",
    "creep",
    "critical_force",
    "fit_hardness",
    "fit_indentation",
    "hardness_class",
    "impact",
    "indent",
    "indent_in_time",
    "indent_to_force",
    "oblique_impact",
    "oliver_pharr",
    "read_curve",
    "read_curves",
    "sweep",
    "yield_depth",
    "yield_speed",
]

__version__ = "0.6.1"


#: Names that are looked for, and what there is instead.
_INSTEAD = {"Berkovich": "Cone.berkovich()", "Cylinder": "FlatPunch", "Hertz": "Paraboloid"}


def __dir__():
    return __all__


def __getattr__(name):
    if name in _INSTEAD:
        raise AttributeError(f"mdr_core has no {name!r}: take mdr_core.{_INSTEAD[name]}", name=name)
    raise no_attribute("mdr_core", name, __all__)
