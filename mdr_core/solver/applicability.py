"""Checks of profiles and media for a calculation: supported combinations and array shapes."""

import numpy as np

from ..base import check, lazy
from ..base.check import shown
from .medium.medium import Medium
from .profiles.profile import Profile, is_own


def check_pair(profile, medium, what=None):
    """Raise an error unless these are a profile and a medium; with `what`, also for arrays of them."""
    if not isinstance(profile, Profile):
        raise TypeError(f"profile must be an mdr_core shape such as Cone(slope=1), got {shown(profile)}")
    if type(profile).__hash__ is None:
        name = type(profile).__name__
        raise TypeError(f"{name} must be immutable: declare it with @dataclass(frozen=True)")
    if is_own(profile) and profile.shape:
        lazy.shape.check_tips(profile)
    if not isinstance(medium, Medium):
        raise TypeError(f"medium must be a Medium, got {shown(medium)}")
    if what and (profile.shape or medium.shape):
        raise check.MDRError(
            f"{what} needs a single indenter and a single medium, not parameters of shape "
            f"{profile.shape or medium.shape}: take one at a time, for example profile.entries(i)"
        )


def refuse_adhesion(medium, what):
    """Raise an error if the medium has adhesion, which the calculation `what` does not support."""
    if np.any(np.asarray(medium.work_of_adhesion) > 0):
        raise check.MDRError(f"{what} is not computed with adhesion; set work_of_adhesion = 0")


def refuse_own_law(medium, what, instead):
    """Raise an error if the medium has a `HardnessLaw`, which `what` does not support."""
    if medium.has_own_law:
        law = shown(medium.hardness)
        raise check.MDRError(f"{what} does not support {law}; {instead}")


def check_reached(profile, medium, depth):
    """Raise an error if a user's shape or law is invalid at the contact radii of depths (m)."""
    check_shape(profile, depth)
    check_hardness(profile, medium, depth)


def check_shape(profile, depth):
    """Raise an error if a user's shape is invalid at the contact radii of depths (m)."""
    if is_own(profile):
        lazy.shape.check_shape(profile, depth)


def check_hardness(profile, medium, depth):
    """Raise an error if a user's law of hardness is invalid at the contact radii of depths (m)."""
    if medium.has_own_law:
        lazy.law.check_law(medium.hardness, profile, depth)


def paths_on(profile, medium, depth):
    """Return depths of paths along the last axis, broadcast to arrays of media or profiles."""
    for thing in (profile, medium):
        if thing.shape and thing.shape[-1] != 1:
            raise check.MDRError(
                f"a path needs a single indenter and a single medium, not a {type(thing).__name__} with "
                f"parameters of shape {thing.shape}: give them a last axis of length 1, as in "
                "Medium(E_star[:, None]), for one path each, or take medium.entries(i)"
            )
    return np.broadcast_to(depth, shape_with("indent", profile, medium, depth=depth))


def shape_with(what, profile, medium, **values):
    """Return the shape to which values broadcast with the parameters of profile and medium."""
    sizes = {"profile": np.empty(profile.shape), "medium": np.empty(medium.shape)}
    return check.common_shape(what, **values, **sizes)
