"""Which profiles and media a calculation takes: what it refuses, and the shape of their arrays."""

import numpy as np

from ..base import check, lazy
from ..base.check import shown
from .medium.medium import Medium
from .profiles.profile import Profile, is_own


def check_pair(profile, medium, what=None):
    """Refuses arguments that are no profile or no medium, and arrays of either if `what` takes one only."""
    if not isinstance(profile, Profile):
        raise TypeError(f"profile must be an mdr_core shape such as Cone(slope=1), got {shown(profile)}")
    if type(profile).__hash__ is None:
        name = type(profile).__name__
        raise TypeError(f"{name} must not change once it is made: declare it with @dataclass(frozen=True)")
    if is_own(profile) and profile.shape:
        lazy.shape.check_tips(profile)
    if not isinstance(medium, Medium):
        raise TypeError(f"medium must be a Medium, got {shown(medium)}")
    if what and (profile.shape or medium.shape):
        raise check.MDRError(
            f"{what} needs a single indenter and a single medium, but their parameters are arrays of shape "
            f"{profile.shape or medium.shape}; take one at a time, as in profile.entries(i)"
        )


def refuse_adhesion(medium, what):
    """Refuses a medium with adhesion for a calculation `what` that has none."""
    if np.any(np.asarray(medium.work_of_adhesion) > 0):
        raise check.MDRError(f"{what} is not computed with adhesion; set work_of_adhesion = 0")


def refuse_own_law(medium, what, instead):
    """Refuses a medium with a `HardnessLaw` for something, `what`, that cannot have one."""
    if medium.has_own_law:
        law = shown(medium.hardness)
        raise check.MDRError(f"{what} does not support {law}; {instead}")


def check_reached(profile, medium, depth):
    """Refuses a shape or a law of a user's own that is invalid at the contact radii of depths (m)."""
    check_shape(profile, depth)
    check_hardness(profile, medium, depth)


def check_shape(profile, depth):
    """Refuses a shape of a user's own that is invalid at the contact radii of depths (m)."""
    if is_own(profile):
        lazy.shape.check_shape(profile, depth)


def check_hardness(profile, medium, depth):
    """Refuses a medium whose law of hardness is invalid at the contact radii of depths (m)."""
    if medium.has_own_law:
        lazy.law.check_law(medium.hardness, profile, depth)


def paths_on(profile, medium, depth):
    """Depths of paths along the last axis, broadcast to arrays of media or profiles."""
    for thing in (profile, medium):
        if thing.shape and thing.shape[-1] != 1:
            raise check.MDRError(
                "a path needs a single indenter and a single medium, but the parameters of "
                f"{type(thing).__name__} are arrays of shape {thing.shape}: give them a last axis of "
                "length 1, one path each, as in Medium(E_star[:, None]), or take medium.entries(i)"
            )
    return np.broadcast_to(depth, shape_with("indent", profile, medium, depth=depth))


def shape_with(what, profile, medium, **values):
    """Shape to which values broadcast with the parameters of profile and medium."""
    sizes = {"profile": np.empty(profile.shape), "medium": np.empty(medium.shape)}
    return check.common_shape(what, **values, **sizes)
