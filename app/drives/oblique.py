"""A free body hits the medium obliquely, under friction."""

from dataclasses import replace
from math import hypot, isclose, pi

import numpy as np

import mdr_core as mdr
from mdr_core.dynamics.oblique_motion import along_surface, oblique_motion

from ..quantities import CHOICES, QUANTITIES, USED
from ..units import written
from . import impact
from .drive import arguments

#: Most elements that are kept to be drawn, and how often steps are halved for that: errors of some 10⁻⁵.
_ELEMENTS, _HALVINGS = 300, 2


def _balls(mass):
    """Tangential mass (kg) of each option of the choice "body"."""
    solid, hollow = (mdr.Ball(mass, 1.0, hollow) for hollow in (False, True))
    return {"block": mass, "solid": solid.tangential_mass, "hollow": hollow.tangential_mass}


class Oblique(impact.Impact):
    """A free body hits with a speed along the surface."""

    values = (mdr.FreeObliqueImpact,)
    form = ("aim", "body", "inertia")
    solver, results = (), ()

    def make(self, explorer):
        speeds = explorer.speed, explorer.tangential_speed
        if explorer.aim == "angle":
            speeds = mdr.at_angle(explorer.incoming_speed, pi / 2 - explorer.attack)
        body = _balls(explorer.mass)[explorer.body]
        return mdr.FreeObliqueImpact(explorer.mass, *map(float, speeds), explorer.friction, float(body))

    def opened(self, scene):
        drive = scene.drive
        bodies = _balls(drive.mass).items()
        body = next((body for body, mass in bodies if isclose(mass, drive.tangential_mass)), None)
        if body is None:
            raise ValueError(
                "a body other than a block or a ball is not shown here: solve the scene by mdr_core"
            )
        numbers = {"mass": drive.mass, "friction": drive.friction}
        choices = {"drive": "oblique", "surface": "virgin", "body": body, "aim": "components"}
        if drive.tangential_speed == 0:
            return choices | {"aim": "angle"}, numbers | {"incoming_speed": drive.speed, "attack": pi / 2}
        return choices, numbers | {"speed": drive.speed, "tangential_speed": drive.tangential_speed}

    def follow(self, scene, progress):
        """All states; along the surface of one coarse run, as long as a move has no time for more."""
        drive, normal = scene.drive, _normal(scene)
        given = drive.tangential_speed, drive.friction, drive.tangential_mass
        motion = along_surface(normal, *given, impact.INSTANTS, 0)
        words = "friction to three digits so far"
        return impact.along(scene, progress, normal, motion.normal, oblique=motion, pending=words)

    def in_time(self, scene):
        """The same with quantities as exact as the core has them, and a motion as exact as is seen."""
        hit = scene.solve()
        motion = oblique_motion(hit, impact.INSTANTS, _HALVINGS)
        some = slice(None, None, -(-motion.x.size // _ELEMENTS))
        load, sticks = (np.array(part[:, some]) for part in (motion.tangential_line_load, motion.sticks))
        motion = replace(motion, x=motion.x[some], tangential_line_load=load, sticks=sticks)
        return impact.along(scene, 1.0, hit.normal, motion.normal, oblique=motion)

    def deepest(self, scene):
        return _normal(scene).turning_point

    def alike(self, explorer, deepest):
        numbers = super().alike(explorer, deepest)
        along = numbers["speed"] / np.tan(explorer.attack)
        return numbers | _aimed(numbers["speed"], float(along))

    def snippet(self, way, given, prefix):
        hit, told = f"{prefix}hit", ("tangential_velocity", "friction_work")
        values = ("time", "force", "tangential_force", "tangential_velocity", "stick_radius", "slip_radius")
        solved = f"{hit} = mdr.oblique_impact({given}, {arguments(way.scene.drive)})"
        drive = way.scene.drive
        before, share = drive.tangential_speed, drive.tangential_mass / drive.mass
        body = f"{before!r} + {share!r} * ({hit}.tangential_velocity - {before!r})"
        # The core has the angle of the contact point from the normal.
        angle = [
            "from math import atan2, degrees",
            f"print(degrees(atan2({hit}.normal.rebound_speed, {body})))  # of the body, to the surface",
        ]
        return [solved, impact.printed(hit, told), *angle, *impact.in_motion(way, prefix, values)]

    def cells(self, way):
        drive, motion, profile = way.scene.drive, way.oblique, way.scene.profile
        after, largest, work = ends(way)
        # The impulse changes the speed of the body, and for the rest its spin.
        impulse = drive.tangential_mass * (after - drive.tangential_speed)
        body = drive.tangential_speed + impulse / drive.mass
        normal, spin, radius = float(way.hit.rebound_speed), after - body, float(profile.body_radius)
        rows = [
            ("F_x", "force along the surface", "force", motion.tangential_force),
            ("W", "speed along the surface", "speed", motion.tangential_velocity),
            ("α_r", "rebound angle", "angle", float(np.arctan2(normal, body))),
            ("e_t", "tangential restitution", "number", -after / (drive.tangential_speed or np.nan)),
            ("V_x", "rebound along the surface", "speed", body),
            ("F_x,max", "largest along the surface", "force", largest),
            ("W_f", "friction work, in all", "energy", work),
        ]
        if drive.tangential_mass < drive.mass:
            known = ("Ω", "spin after", "spin", spin / radius), ("RΩ", "spin after, times R", "speed", spin)
            rows.append(known[radius == np.inf])
        return super().cells(way) + rows

    def words(self, explorer):
        quantities = ((QUANTITIES[n], getattr(explorer, n)) for n in USED["aim"][explorer.aim])
        said = (f"{q.symbol} = {written(value, q.kind, 3)}" for q, value in quantities)
        return [*said, CHOICES["body"][explorer.body]]


def _normal(scene):
    """The impact along the normal, on which friction has no effect."""
    return mdr.impact(scene.profile, scene.medium, scene.drive.mass, scene.drive.speed)


def aim(explorer, option):
    """The speed by its components, or as one with its angle of attack."""
    if explorer.drive != "oblique":
        return {}
    drive = explorer.scene().drive
    return _aimed(drive.speed, drive.tangential_speed)


def _aimed(normal, along):
    numbers = {"speed": normal, "tangential_speed": along, "incoming_speed": hypot(normal, along)}
    numbers["attack"] = float(np.arctan2(normal, along))
    return {name: QUANTITIES[name].bounded(value) for name, value in numbers.items()}


def ends(way):
    """Velocity of the contact point after (m/s), largest force along the surface (N), friction work (J)."""
    motion, hit = way.oblique, way.oblique.impact
    if hit is not None:
        return tuple(map(float, (hit.tangential_velocity, hit.max_tangential_force, hit.friction_work)))
    force = float(np.max(np.abs(motion.tangential_force)))
    return float(motion.tangential_velocity[-1]), force, float(motion.friction_work[-1])
