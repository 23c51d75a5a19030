"""Indentation and impact by the method of dimensionality reduction (MDR).

Axisymmetric rigid indenters on an elastic half-space with a non-local yield criterion (a hardness that
depends on the contact radius), mapped exactly onto a row of independent springs: V. L. Popov,
Facta Universitatis, Mech. Eng. 13(1), 2015, 39–46.
"""

from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING

from .base.check import no_attribute

if TYPE_CHECKING:
    from . import abel, sweep
    from .base.errors import MDRError
    from .base.motions import Motion
    from .base.remark import Remark, Remedy
    from .measurements.fit.hardness import fit_hardness
    from .measurements.fit.indentation import fit_indentation
    from .measurements.reading import UnknownColumns, read_curve, read_curves
    from .measurements.unloading.oliver_pharr import oliver_pharr
    from .scenes.drives import DepthPath, ForcePath, FreeImpact, FreeObliqueImpact
    from .scenes.scene import Scene
    from .solver.contact.creep import creep
    from .solver.contact.indentation import Indentation
    from .solver.contact.loading import indent, indent_to_force
    from .solver.contact.onset_of_yield import critical_force, yield_depth, yield_speed
    from .solver.foundation.chain_impact import chain_impact
    from .solver.foundation.depth_path import TimedIndentation, indent_in_time
    from .solver.foundation.foundation import Foundation
    from .solver.impacts.adhesive import capture_speeds
    from .solver.impacts.impact import impact
    from .solver.impacts.result import Impact
    from .solver.impacts.scaling import ScalingLaw, hardness_class
    from .solver.medium.hardness import HardnessLaw
    from .solver.medium.medium import Medium
    from .solver.medium.structure import Structure
    from .solver.oblique.ball import Ball, at_angle
    from .solver.oblique.oblique_impact import ObliqueImpact, oblique_impact
    from .solver.profiles.power import Cone, FlatPunch, Paraboloid, PowerLaw
    from .solver.profiles.profile import Profile
    from .solver.profiles.rounded import Hyperboloid, ParabolicPunch, RoundedCone, Sphere
    from .solver.profiles.sampled import Sampled
    from .solver.profiles.smooth import Smooth
    from .solver.profiles.truncated import RoundedPunch, TruncatedCone, TruncatedParaboloid

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
    "MDRError",
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
    "solver.contact.creep": ("creep",),
    "solver.contact.indentation": ("Indentation",),
    "solver.contact.loading": (
        "indent",
        "indent_to_force",
    ),
    "solver.contact.onset_of_yield": (
        "critical_force",
        "yield_depth",
        "yield_speed",
    ),
    "scenes.drives": (
        "DepthPath",
        "ForcePath",
        "FreeImpact",
        "FreeObliqueImpact",
    ),
    "measurements.fit.hardness": ("fit_hardness",),
    "measurements.fit.indentation": ("fit_indentation",),
    "measurements.unloading.oliver_pharr": ("oliver_pharr",),
    "solver.foundation.chain_impact": ("chain_impact",),
    "solver.foundation.depth_path": (
        "TimedIndentation",
        "indent_in_time",
    ),
    "solver.foundation.foundation": ("Foundation",),
    "solver.medium.hardness": ("HardnessLaw",),
    "solver.impacts.adhesive": ("capture_speeds",),
    "solver.impacts.impact": ("impact",),
    "solver.impacts.result": ("Impact",),
    "solver.impacts.scaling": (
        "ScalingLaw",
        "hardness_class",
    ),
    "solver.medium.medium": ("Medium",),
    "base.errors": ("MDRError",),
    "base.motions": ("Motion",),
    "base.remark": (
        "Remark",
        "Remedy",
    ),
    "solver.oblique.ball": (
        "Ball",
        "at_angle",
    ),
    "solver.oblique.oblique_impact": (
        "ObliqueImpact",
        "oblique_impact",
    ),
    "solver.profiles.power": (
        "Cone",
        "FlatPunch",
        "Paraboloid",
        "PowerLaw",
    ),
    "solver.profiles.profile": ("Profile",),
    "solver.profiles.rounded": (
        "Hyperboloid",
        "ParabolicPunch",
        "RoundedCone",
        "Sphere",
    ),
    "solver.profiles.sampled": ("Sampled",),
    "solver.profiles.smooth": ("Smooth",),
    "solver.profiles.truncated": (
        "RoundedPunch",
        "TruncatedCone",
        "TruncatedParaboloid",
    ),
    "measurements.reading": (
        "UnknownColumns",
        "read_curve",
        "read_curves",
    ),
    "scenes.scene": ("Scene",),
    "solver.medium.structure": ("Structure",),
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
