"""Drives: each is one value in a module of its own, and one entry here."""

from . import impact, oblique, path, press

#: Every drive of the page, by its option of the choice "drive".
DRIVES = {
    "depth": press.DEPTH, "force": press.FORCE, "path": path.PATH, "impact": impact.IMPACT,
    "oblique": oblique.OBLIQUE,
}  # fmt: skip


def drive_of(scene):
    """Name of the drive that shows a scene."""
    return next(name for name, drive in DRIVES.items() if drive.owns(scene.drive))


def follow(scene, progress):
    """The trajectory of a scene, with a state at the progress where the page stands."""
    return DRIVES[drive_of(scene)].follow(scene, progress)
