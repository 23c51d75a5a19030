"""Drives of the indenter, and the courses of scenes."""

from abc import ABC, abstractmethod
from dataclasses import replace
from typing import Any

import numpy as np

import mdr_core as mdr
from mdr_core.solver.contact.unloading import unloading
from mdr_core.solver.contact.yielding import yield_rule
from mdr_core.solver.impacts.motion import motion as motion_of

from ..common.quantities import QUANTITIES
from .courses import LAST_PROGRESS, Course, nearest, onset_depth, path_progress
from .state import State, medium, profile

#: Places from 0 to 1, dense at both ends, where radii change as a root of the depth.
_SPREAD = (1 - np.cos(np.linspace(0, np.pi, 41))) / 2
#: Instants of an impact, and extra instants before yield, which a fast impact would pass in one step.
INSTANTS, BEFORE_YIELD = 120, 20
#: Note on a captured body.
_HELD = "Adhesion holds the body: e = 0. The plots show the unloading as if the body were pulled off."


class Drive(ABC):
    """Drive of the indenter, on the page and in `mdr.Scene`.

    Its choices, numbers and readouts are in assets/quantities.json, or in the JSON file of its extra.
    """

    @abstractmethod
    def make(self, state: State) -> Any:
        """Return the drive of a scene for a state of the page."""

    def given(self, state: State) -> dict[str, Any]:
        """Return the arguments of the core's function for this drive, with the arrays of a sweep."""
        return {}

    def given_quickly(self, state: State) -> dict[str, Any]:
        """Return `given` for many solutions, with a coarser model if the exact model is slow."""
        return self.given(state)

    def limiting_cases(self, state: State) -> dict[str, dict[str, Any]]:
        """Return arguments of limiting cases, by the names of their lines in a sweep."""
        return {}

    def follow(self, scene: mdr.Scene, progress: float) -> Course:
        """Return the states of a scene, one of them at `progress`; approximate if exact ones are slow.

        By default the drive loads and unloads slowly.
        """
        return slow(scene, progress, scene.solve())

    def exact(self, scene: mdr.Scene) -> Course:
        """Return the exact states of a scene whose course of `follow` is pending."""
        raise NotImplementedError

    @abstractmethod
    def equivalent(self, state: State, turning_point: mdr.Indentation) -> dict[str, Any]:
        """Return numbers of this drive that lead to the same largest depth."""

    def converted(self, state: State, choice: str, wanted: str) -> dict[str, Any]:
        """Return numbers that keep their meaning under another option of a choice of this drive."""
        return {}


def limited_force(turning_point):
    """Return the force (N) of a state, limited to 90 % of the force of a fully yielded contact."""
    rule = yield_rule(turning_point.profile, turning_point.medium)
    most = 2 * turning_point.medium.E_star * float(rule.wall_integral())
    return min(float(turning_point.force), 0.9 * most)


def slow(scene: mdr.Scene, progress: float, turning_point: mdr.Indentation) -> Course:
    """Return the course of loading to a state, unloading, and lifting to the undeformed surface."""
    depth, onset = float(turning_point.depth), onset_depth(scene)
    elastic = min(onset / depth, 1.0) if depth > 0 else 1.0
    loading = np.concatenate([elastic * _SPREAD, elastic + (1 - elastic) * _SPREAD])
    # With adhesion the force jumps to zero at the pull-off.
    lifted = np.append(2 + 1e-5, np.linspace(2, LAST_PROGRESS, 9))
    places = np.unique(np.concatenate([loading, 1 + _SPREAD, lifted, [progress]]))
    depths = np.minimum(places, 1.0) * depth
    # The product may exceed the onset by a rounding error.
    depths = np.where(places <= elastic, np.minimum(depths, onset), depths)
    path = mdr.indent(scene.profile, scene.medium, depths)
    # The share falls to −1 from 2 to the last place.
    share = np.where(
        places > 2, np.interp(places, [2, LAST_PROGRESS], [0, -1]), np.minimum(2 - places, 1.0)
    )
    states = unloading(path, share, isinstance(scene.drive, mdr.scene.ForcePath))
    return Course(scene=scene, progress=places, states=states)


class Depth(Drive):
    """Pressing to a depth."""

    def make(self, state):
        return mdr.scene.DepthPath(**self.given(state))

    def given(self, state):
        return {"depth": state.max_depth}

    def equivalent(self, state, turning_point):
        return {"max_depth": float(turning_point.depth)}


class Force(Drive):
    """Pressing to a force."""

    def make(self, state):
        return mdr.scene.ForcePath(**self.given(state))

    def given(self, state):
        return {"force": state.max_force}

    def equivalent(self, state, turning_point):
        return {"max_force": limited_force(turning_point)}


class Impact(Drive):
    """Impact of a free body along the normal."""

    def make(self, state):
        return mdr.scene.FreeImpact(**self.given(state))

    def given(self, state):
        return {"mass": state.mass, "speed": state.speed, "plastic_depth": state.plastic_depth}

    def follow(self, scene, progress):
        """Return the motion of the body; with adhesion, states of slow pressing and pulling, no times."""
        hit = scene.solve()
        if scene.medium.work_of_adhesion > 0 and not scene.drive.plastic_depth:
            notes = (_HELD,) * bool(hit.captured)
            return replace(slow(scene, progress, hit.turning_point), hit=hit, notes=notes)
        motion = motion_of(hit, INSTANTS, BEFORE_YIELD)
        places = path_progress(motion.time, motion.depth)
        return Course(scene=scene, progress=places, states=motion.states, motion=motion, hit=hit)

    def equivalent(self, state, turning_point):
        """Return the present mass and speed, or values for equal depth, on a virgin surface."""
        present = DRIVES[state.drive].make(state)
        if hasattr(present, "speed"):
            return {"mass": present.mass, "speed": present.speed, "plastic_depth": 0.0}
        mass = state.mass
        if mass == QUANTITIES["mass"].default:
            # The default mass: use the mass of a steel ball of ten times the contact radius.
            mass = float(f"{4.2 * 7800 * (10 * float(turning_point.contact_radius)) ** 3:.1g}")
        work = float(turning_point.stored_energy + turning_point.plastic_work)
        return {"mass": mass, "speed": (2 * work / mass) ** 0.5, "plastic_depth": 0.0}


#: Drives by options of the choice "drive"; extras add further drives.
DRIVES: dict[str, Drive] = {"depth": Depth(), "force": Force(), "impact": Impact()}
#: Exact courses by scenes whose drive gives an approximate course; extras add their results.
EXACT: dict[mdr.Scene, Course] = {}


def scene_of(state: State) -> mdr.Scene:
    return mdr.Scene(profile(state), medium(state), DRIVES[state.drive].make(state))


def follow(state: State) -> Course:
    """Return the course of a state."""
    scene = scene_of(state)
    course = EXACT.get(scene) or DRIVES[state.drive].follow(scene, state.at)
    return replace(course, now=nearest(course.progress, state.at), drive=state.drive)


def turning_point(state: State) -> mdr.Indentation:
    """Return the state at the largest depth of a scene after slow pressing."""
    scene = scene_of(state)
    course = DRIVES[state.drive].follow(scene, 1.0)
    return mdr.indent(scene.profile, scene.medium, course.turning_point.depth)
