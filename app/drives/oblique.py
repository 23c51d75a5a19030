"""A free body hits the medium obliquely, under friction."""

from dataclasses import replace
from math import hypot, pi

import numpy as np

import mdr_core as mdr
from mdr_core.dynamics.oblique_motion import along_surface, oblique_motion

from ..state.quantities import CHOICES, QUANTITIES, USED
from ..state.units import written
from . import impact

#: Maximum number of drawn elements, and halvings of steps for them (errors about 10⁻⁵).
_ELEMENTS, _HALVINGS = 300, 2


def _balls(mass):
    """Tangential mass (kg) for each option of the choice "body"."""
    solid, hollow = (mdr.Ball(mass, 1.0, hollow) for hollow in (False, True))
    return {"block": mass, "solid": solid.tangential_mass, "hollow": hollow.tangential_mass}


class Oblique(impact.Impact):
    """A free body hits with a speed along the surface."""

    key, values = "oblique", (mdr.FreeObliqueImpact,)
    form = ("aim", "body", "inertia")
    line = (
        "force", "tangential_force", "depth", "contact_radius", "restitution", "body_angle",
        "tangential_restitution", "friction_work",
    )  # fmt: skip
    solver, results = (), ()

    def make(self, state):
        speeds = state.speed, state.tangential_speed
        if state.aim == "angle":
            speeds = mdr.at_angle(state.incoming_speed, pi / 2 - state.attack)
        body = _balls(state.mass)[state.body]
        return mdr.FreeObliqueImpact(state.mass, *map(float, speeds), state.friction, float(body))

    def follow(self, scene, progress):
        """States from one coarse solution of friction."""
        drive, normal = scene.drive, _normal(scene)
        given = drive.tangential_speed, drive.friction, drive.tangential_mass
        motion = along_surface(normal, *given, impact.INSTANTS, 0)
        words = "friction to three digits so far"
        return impact.along(scene, progress, normal, motion.normal, oblique=motion, pending=words)

    def in_time(self, scene):
        """States from the core's solution, with elements thinned out for drawing."""
        hit = scene.solve()
        motion = oblique_motion(hit, impact.INSTANTS, _HALVINGS)
        thinned = slice(None, None, -(-motion.x.size // _ELEMENTS))
        load, sticks = (np.array(part[:, thinned]) for part in (motion.tangential_line_load, motion.sticks))
        motion = replace(motion, x=motion.x[thinned], tangential_line_load=load, sticks=sticks)
        return impact.along(scene, 1.0, hit.normal, motion.normal, oblique=motion)

    def turning_point(self, scene):
        return _normal(scene).turning_point

    def equivalent(self, state, turning_point):
        numbers = super().equivalent(state, turning_point)
        along = numbers["speed"] / np.tan(state.attack)
        return numbers | _aimed(numbers["speed"], float(along))

    def words(self, state):
        quantities = ((QUANTITIES[n], state[n]) for n in USED["aim"][state.aim])
        texts = (f"{q.symbol} = {written(value, q.kind, 3)}" for q, value in quantities)
        return [*texts, CHOICES["body"][state.body]]


def _normal(scene):
    """Impact along the normal, which is independent of friction."""
    return mdr.impact(scene.profile, scene.medium, scene.drive.mass, scene.drive.speed)


def aim(state, option):
    """Speed as components, or as magnitude and angle of attack."""
    if state.drive != "oblique":
        return {}
    drive = Oblique().make(state)
    return _aimed(drive.speed, drive.tangential_speed)


def _aimed(normal, along):
    numbers = {"speed": normal, "tangential_speed": along, "incoming_speed": hypot(normal, along)}
    numbers["attack"] = float(np.arctan2(normal, along))
    return {name: QUANTITIES[name].bounded(value) for name, value in numbers.items()}
