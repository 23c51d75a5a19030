"""Drives: each is one value in a module of its own, and one entry here."""

from . import impact, oblique, path, press

#: Every drive of the page, by its option of the choice "drive".
DRIVES = {
    "depth": press.Depth(), "force": press.Force(), "path": path.Path(), "impact": impact.Impact(),
    "oblique": oblique.Oblique(),
}  # fmt: skip


def drive_of(scene):
    """The drive that shows a scene."""
    return next(drive for drive in DRIVES.values() if drive.owns(scene.drive))


def follow(scene, progress):
    """The trajectory of a scene, with a state at the progress where the page stands."""
    return drive_of(scene).follow(scene, progress)
