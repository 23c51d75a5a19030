"""A free body hits the medium, along the normal or obliquely under friction."""

from dataclasses import replace
from math import pi, sin

import numpy as np

import mdr_core as mdr
from mdr_core.impacts.motion import motion as motion_of
from mdr_core.oblique.oblique_motion import along_surface, oblique_motion

from ..state.quantities import QUANTITIES
from . import Course, Drive, nearest, path_progress
from .press import slow

#: Instants of an impact, and more of them up to the onset of yield, which a fast one passes in one step.
INSTANTS, BEFORE_YIELD = 120, 20
#: Largest number of drawn elements, and halvings of their steps (errors about 10⁻⁵).
_ELEMENTS, _HALVINGS = 300, 2


class Impact(Drive):
    """A free body hits along the normal."""

    solver = ("impact", "mass", "speed")

    def make(self, state, medium):
        return mdr.FreeImpact(state.mass, state.speed, state.plastic_depth)

    def follow(self, scene, progress):
        """Motion of the body; with adhesion states without times, as if pressed and pulled off."""
        hit = scene.solve()
        if scene.medium.work_of_adhesion > 0 and not scene.drive.plastic_depth:
            return slow(scene, progress, hit.turning_point, hit)
        return along(scene, progress, hit, motion_of(hit, INSTANTS, BEFORE_YIELD))

    def turning_point(self, scene):
        return scene.solve().turning_point

    def equivalent(self, state, turning_point):
        """Present mass and speed, or those of an impact of equal depth."""
        if state.drive == "impact":
            return {"mass": state.mass, "speed": state.speed}
        if state.drive == "oblique":
            return {"mass": state.mass, "speed": state.incoming_speed * sin(state.attack)}
        mass = state.mass
        if mass == QUANTITIES["mass"].default:
            # Nobody has set it: as heavy as a ball of the contact's size times ten, of steel.
            mass = float(f"{4.2 * 7800 * (10 * float(turning_point.contact_radius)) ** 3:.1g}")
        work = float(turning_point.stored_energy + turning_point.plastic_work)
        return {"mass": mass, "speed": (2 * work / mass) ** 0.5}


def along(scene, progress, hit, motion, **more):
    """Course of an impact from its motion along the normal."""
    places, peak = path_progress(motion.time, motion.turning_index), motion.turning_index
    return Course(scene, places, motion.states, nearest(places, progress), peak, hit, motion, **more)


class Oblique(Impact):
    """A free body hits with a speed along the surface."""

    solver = ()

    def make(self, state, medium):
        speeds = map(float, mdr.at_angle(state.incoming_speed, pi / 2 - state.attack))
        ball = mdr.Ball(state.mass, 1.0, state.body == "hollow")
        felt = state.mass if state.body == "block" else float(ball.tangential_mass)
        return mdr.FreeObliqueImpact(state.mass, *speeds, state.friction, felt)

    def follow(self, scene, progress):
        """States from one coarse solution of friction."""
        drive, normal = scene.drive, _normal(scene)
        given = drive.tangential_speed, drive.friction, drive.tangential_mass
        motion = along_surface(motion_of(normal, INSTANTS, BEFORE_YIELD), *given, 0)
        words = "friction to three digits so far"
        return along(scene, progress, normal, motion.normal, oblique=motion, pending=words)

    def in_time(self, scene):
        """States from the core's solution, with elements thinned out for drawing."""
        hit = scene.solve()
        motion = oblique_motion(hit, motion_of(hit.normal, INSTANTS, BEFORE_YIELD), _HALVINGS)
        thinned = slice(None, None, -(-motion.x.size // _ELEMENTS))
        load, sticks = (np.array(part[:, thinned]) for part in (motion.tangential_line_load, motion.sticks))
        motion = replace(motion, x=motion.x[thinned], tangential_line_load=load, sticks=sticks)
        return along(scene, 1.0, hit.normal, motion.normal, oblique=motion)

    def turning_point(self, scene):
        return _normal(scene).turning_point

    def equivalent(self, state, turning_point):
        numbers = super().equivalent(state, turning_point)
        incoming = QUANTITIES["incoming_speed"].bounded(numbers["speed"] / sin(state.attack))
        return numbers | {"incoming_speed": incoming}


def _normal(scene):
    """Impact along the normal, which is independent of friction."""
    return mdr.impact(scene.profile, scene.medium, scene.drive.mass, scene.drive.speed)
