"""Indentation and impact by the method of dimensionality reduction (MDR).

Axisymmetric rigid indenters on an elastic half-space with a non-local yield criterion (a hardness that
depends on the contact radius), mapped exactly onto a row of independent springs: V. L. Popov,
Facta Universitatis, Mech. Eng. 13(1), 2015, 39–46.
"""

from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING

from ._check import no_attribute

if TYPE_CHECKING:
    from . import abel, sweep
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
    from .numerics.motions import Motion
    from .numerics.remark import Remark, Remedy
    from .oblique.ball import Ball, at_angle
    from .oblique.oblique_impact import ObliqueImpact, oblique_impact
    from .profiles.power import Cone, FlatPunch, Paraboloid, PowerLaw
    from .profiles.profile import Profile
    from .profiles.rounded import Hyperboloid, ParabolicPunch, RoundedCone, Sphere
    from .profiles.sampled import Sampled
    from .profiles.smooth import Smooth
    from .profiles.truncated import RoundedPunch, TruncatedCone, TruncatedParaboloid
    from .reading import UnknownColumns, read_curve, read_curves
    from .scene import Scene
    from .structure import Structure

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
    "Remark",
    "Remedy",
    "RoundedCone",
    "RoundedPunch",
    "Sampled",
    "ScalingLaw",
    "Scene",
    "Smooth",
    "Sphere",
    "Structure",
    "TimedIndentation",
    "TruncatedCone",
    "TruncatedParaboloid",
    "UnknownColumns",
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

__version__ = "0.9.0.dev0"

#: Modules of the public names. Each is imported when one of its names is first asked for.
_MODULES = {
    "contact.creep": ("creep",),
    "contact.indentation": ("Indentation",),
    "contact.loading": (
        "indent",
        "indent_to_force",
    ),
    "contact.onset_of_yield": (
        "critical_force",
        "yield_depth",
        "yield_speed",
    ),
    "drives": (
        "DepthPath",
        "ForcePath",
        "FreeImpact",
        "FreeObliqueImpact",
    ),
    "fit.hardness": ("fit_hardness",),
    "fit.indentation": ("fit_indentation",),
    "fit.oliver_pharr": ("oliver_pharr",),
    "foundation.chain_impact": ("chain_impact",),
    "foundation.depth_path": (
        "TimedIndentation",
        "indent_in_time",
    ),
    "foundation.foundation": ("Foundation",),
    "hardness": ("HardnessLaw",),
    "impacts.adhesive": ("capture_speeds",),
    "impacts.impact": ("impact",),
    "impacts.result": ("Impact",),
    "impacts.scaling": (
        "ScalingLaw",
        "hardness_class",
    ),
    "medium": ("Medium",),
    "numerics.motions": ("Motion",),
    "numerics.remark": (
        "Remark",
        "Remedy",
    ),
    "oblique.ball": (
        "Ball",
        "at_angle",
    ),
    "oblique.oblique_impact": (
        "ObliqueImpact",
        "oblique_impact",
    ),
    "profiles.power": (
        "Cone",
        "FlatPunch",
        "Paraboloid",
        "PowerLaw",
    ),
    "profiles.profile": ("Profile",),
    "profiles.rounded": (
        "Hyperboloid",
        "ParabolicPunch",
        "RoundedCone",
        "Sphere",
    ),
    "profiles.sampled": ("Sampled",),
    "profiles.smooth": ("Smooth",),
    "profiles.truncated": (
        "RoundedPunch",
        "TruncatedCone",
        "TruncatedParaboloid",
    ),
    "reading": (
        "UnknownColumns",
        "read_curve",
        "read_curves",
    ),
    "scene": ("Scene",),
    "structure": ("Structure",),
}
_MODULE_OF = {name: module for module, names in _MODULES.items() for name in names}


def __dir__():
    return __all__


def __getattr__(name):
    if name in _MODULE_OF:
        value = getattr(import_module(f".{_MODULE_OF[name]}", __name__), name)
    elif name.isidentifier() and not name.startswith("__") and find_spec(f"{__name__}.{name}"):
        value = import_module(f".{name}", __name__)
    else:
        raise no_attribute("mdr_core", name, __all__)
    # The next time it is found without this function.
    globals()[name] = value
    return value
