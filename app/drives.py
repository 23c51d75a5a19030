"""Drives of the indenter, and the courses of scenes."""

from abc import ABC, abstractmethod
from dataclasses import replace
from typing import Any

import numpy as np

import mdr_core as mdr
from mdr_core.contact.unloading import unloading
from mdr_core.contact.yielding import yield_rule
from mdr_core.impacts.motion import motion as motion_of

from .courses import Course, Hit, HitInTime, nearest, onset_depth, path_progress, rounded
from .quantities import QUANTITIES
from .state import State, medium, profile

#: Places from 0 to 1, dense at both ends, where radii change as a root of the depth.
_SPREAD = (1 - np.cos(np.linspace(0, np.pi, 41))) / 2
#: Instants of an impact, and more of them up to the onset of yield, which a fast one passes in one step.
INSTANTS, BEFORE_YIELD = 120, 20


class Drive(ABC):
    """A drive of the indenter, as set on the page and as in `mdr.Scene`.

    Its choices, numbers and readouts are in assets/quantities.json, or beside its extra.
    """

    @abstractmethod
    def make(self, state: State, medium: mdr.Medium) -> Any:
        """Drive of a scene, from the state of the page."""

    @abstractmethod
    def follow(self, scene: mdr.Scene, progress: float) -> Course:
        """States of a scene; may be approximate where an exact solution is slow."""

    @abstractmethod
    def turning_point(self, scene: mdr.Scene) -> mdr.Indentation:
        """State of largest depth of a scene."""

    @abstractmethod
    def equivalent(self, state: State, turning_point: mdr.Indentation) -> dict[str, Any]:
        """Numbers of this drive that lead to the same largest depth."""


def limited_force(turning_point):
    """Force (N) of a state, limited to 90 % of what a contact carries that has yielded throughout."""
    rule = yield_rule(turning_point.profile, turning_point.medium)
    most = 2 * turning_point.medium.E_star * float(rule.wall_integral())
    return min(float(turning_point.force), 0.9 * most)


def slow(scene: mdr.Scene, progress: float, turning_point: mdr.Indentation) -> dict[str, Any]:
    """Fields of a course of slow loading to a state, unloading to the pull-off, and lifting."""
    depth = float(turning_point.depth)
    share = min(onset_depth(scene) / depth, 1.0) if depth > 0 else 1.0
    loading = np.concatenate([share * _SPREAD, share + (1 - share) * _SPREAD])
    # With adhesion the force jumps to zero at the pull-off.
    lifted = 2 + 0.2 * np.append(5e-5, np.linspace(0, 1, 9))
    places = np.unique(rounded(np.concatenate([loading, 1 + _SPREAD, lifted, [progress]])))
    path = mdr.indent(scene.profile, scene.medium, np.minimum(places, 1.0) * depth)
    touching = places <= 2
    share, under_force = np.clip(2 - places, 0.0, 1.0), isinstance(scene.drive, mdr.ForcePath)
    states = unloading(scene.profile, scene.medium, path.live_interval, share, touching, under_force)
    start = states.depth[touching][-1]
    end = min(2 * start, 0.0)
    lifted = end + (start - end) * np.maximum(2.2 - places, 0.0) / 0.2
    states = replace(states, depth=np.where(touching, states.depth, lifted))
    return {
        "scene": scene,
        "progress": places,
        "states": states,
        "peak": nearest(places, 1.0),
    }


class Press(Drive):
    """Quasi-static loading to a depth or force, and unloading."""

    def follow(self, scene, progress):
        """Loading, unloading, and lifting of the indenter to the undeformed surface."""
        return Course(**slow(scene, progress, scene.solve()))

    def turning_point(self, scene):
        return scene.solve()


class Depth(Press):
    """Pressed to a depth."""

    def make(self, state, medium):
        return mdr.DepthPath(state.max_depth)

    def equivalent(self, state, turning_point):
        return {"max_depth": float(turning_point.depth)}


class Force(Press):
    """Pressed to a force."""

    def make(self, state, medium):
        return mdr.ForcePath(state.max_force)

    def equivalent(self, state, turning_point):
        return {"max_force": limited_force(turning_point)}


def along(scene: mdr.Scene, motion: mdr.Motion) -> dict[str, Any]:
    """Fields of a course of an impact from its motion along the normal."""
    places = path_progress(motion.time, motion.turning_index)
    return {
        "scene": scene,
        "progress": places,
        "states": motion.states,
        "peak": motion.turning_index,
        "motion": motion,
    }


class Impact(Drive):
    """A free body hits along the normal."""

    def make(self, state, medium):
        return mdr.FreeImpact(state.mass, state.speed, state.plastic_depth)

    def follow(self, scene, progress):
        """Motion of the body; with adhesion states without times, as if pressed and pulled off."""
        hit = scene.solve()
        if scene.medium.work_of_adhesion > 0 and not scene.drive.plastic_depth:
            return Hit(**slow(scene, progress, hit.turning_point), hit=hit)
        return HitInTime(**along(scene, motion_of(hit, INSTANTS, BEFORE_YIELD)), hit=hit)

    def turning_point(self, scene):
        return scene.solve().turning_point

    def equivalent(self, state, turning_point):
        """Present mass and speed, or those of an impact of equal depth, on a virgin surface."""
        present = DRIVES[state.drive].make(state, turning_point.medium)
        if hasattr(present, "speed"):
            return {"mass": present.mass, "speed": present.speed, "plastic_depth": 0.0}
        mass = state.mass
        if mass == QUANTITIES["mass"].default:
            # Nobody has set it: as heavy as a ball of the contact's size times ten, of steel.
            mass = float(f"{4.2 * 7800 * (10 * float(turning_point.contact_radius)) ** 3:.1g}")
        work = float(turning_point.stored_energy + turning_point.plastic_work)
        return {"mass": mass, "speed": (2 * work / mass) ** 0.5, "plastic_depth": 0.0}


#: Every drive by its option of the choice "drive"; extras add theirs.
DRIVES: dict[str, Drive] = {"depth": Depth(), "force": Force(), "impact": Impact()}


def scene_of(state: State) -> mdr.Scene:
    made = medium(state)
    return mdr.Scene(profile(state), made, DRIVES[state.drive].make(state, made))


def follow(state: State) -> Course:
    """Course of a state."""
    course = DRIVES[state.drive].follow(scene_of(state), state.progress)
    return replace(course, now=nearest(course.progress, state.progress), drive=state.drive)


def turning_point(state: State) -> mdr.Indentation:
    """State of largest depth, without the path."""
    return DRIVES[state.drive].turning_point(scene_of(state))
