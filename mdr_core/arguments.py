"""Checks of the indenter and the medium that a caller hands in."""

from ._check import shown
from .medium import Medium
from .profiles import Profile


def check_types(profile, medium):
    """Refuses what is no indenter or no medium."""
    if not isinstance(profile, Profile):
        raise TypeError(f"profile must be an mdr_core shape such as Cone(slope=1), got {shown(profile)}")
    if not isinstance(medium, Medium):
        raise TypeError(f"medium must be a Medium, got {shown(medium)}")


def check_one(profile, medium):
    """Refuses, besides, more than one indenter or medium."""
    check_types(profile, medium)
    if profile.shape or medium.shape:
        raise ValueError(
            "a path is that of one indenter on one medium, but their parameters are arrays of shape "
            f"{profile.shape or medium.shape}; indent one at a time, as in profile.entries(i)"
        )
