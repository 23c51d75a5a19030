"""The drive *oblique impact*: a free body hits with friction and a speed along the surface."""

from dataclasses import dataclass, replace
from functools import cached_property
from math import pi, sin
from types import SimpleNamespace
from typing import ClassVar

import numpy as np

import mdr_core as mdr
from mdr_core.show import springs as drawn
from mdr_core.show.figures import label, line, mark
from mdr_core.show.limits import friction_limits
from mdr_core.show.units import format_quantity
from mdr_core.solver.impacts.motion import motion as motion_of
from mdr_core.solver.oblique.oblique_motion import along_surface, oblique_motion

from ...common.quantities import QUANTITIES
from ..courses import Course, path_progress
from ..drives import BEFORE_YIELD, INSTANTS, Impact
from ..extra import Extra
from ..plot import AxisSpec, Overlay, Plot, T, View, line_at_time
from ..plots import X, Z
from ..search import IdleSearch

#: Largest number of drawn elements, and halvings of their steps (errors about 10⁻⁵).
_ELEMENTS, _HALVINGS = 300, 2


@dataclass(frozen=True, eq=False, kw_only=True)
class ObliqueCourse(Course):
    """Course of an impact with friction: `motion` is an `ObliqueMotion`, `hit` the normal impact."""

    more_law: ClassVar[str] = ";  |q_x| ≤ μ q  § 13"

    @property
    def limits(self):
        return [*super().limits, *friction_limits(self.scene.medium)]

    @property
    def largest_terms(self):
        drive = self.scene.drive
        speeds = dict.fromkeys(("tangential_velocity", "body_speed", "spin_speed"), drive.tangential_speed)
        return super().largest_terms | speeds | {"tangential_restitution": 1.0}

    @cached_property
    def rebound(self) -> SimpleNamespace:
        """Results (SI) of an oblique impact for the point of contact and for the body."""
        drive, hit, motion = self.scene.drive, self.motion.impact, self.motion
        after = float(motion.tangential_velocity[-1] if hit is None else hit.tangential_velocity)
        largest = np.max(np.abs(motion.tangential_force)) if hit is None else hit.max_tangential_force
        # The impulse changes the speed and the spin of the body.
        impulse = drive.tangential_mass * (after - drive.tangential_speed)
        body = drive.tangential_speed + impulse / drive.mass
        found = {"contact_velocity": after, "body_speed": body, "max_tangential_force": float(largest)}
        found["body_angle"] = float(np.arctan2(float(self.hit.rebound_speed), body))
        found["tangential_restitution"] = -after / (drive.tangential_speed or np.nan)
        if drive.tangential_mass < drive.mass:
            radius, spin = float(self.scene.profile.body_radius), after - body
            found |= {"spin_speed": spin} if radius == np.inf else {"spin": spin / radius}
        return SimpleNamespace(**found)


class Oblique(Impact):
    """Impact of a free body with a speed along the surface."""

    def make(self, state):
        speeds = map(float, mdr.at_angle(state["oblique.incoming_speed"], pi / 2 - state["oblique.attack"]))
        ball = mdr.Ball(state.mass, 1.0, state["oblique.body"] == "hollow")
        felt = state.mass if state["oblique.body"] == "block" else float(ball.tangential_mass)
        return mdr.scene.FreeObliqueImpact(state.mass, *speeds, state["oblique.friction"], felt)

    def follow(self, scene, progress):
        """Return states from a coarse solution of friction, until the exact states are known."""
        drive, normal = scene.drive, _normal(scene)
        given = drive.tangential_speed, drive.friction, drive.tangential_mass
        motion = along_surface(motion_of(normal, INSTANTS, BEFORE_YIELD), *given, 0)
        course = _course(scene, normal, motion)
        return replace(course, pending="Computing friction; the plots have three digits so far.")

    def exact(self, scene):
        """Return states from the core's solution, with fewer elements for drawing."""
        hit = scene.solve()
        motion = oblique_motion(hit, motion_of(hit.normal, INSTANTS, BEFORE_YIELD), _HALVINGS)
        thinned = slice(None, None, -(-motion.x.size // _ELEMENTS))
        load, sticks = (np.array(part[:, thinned]) for part in (motion.tangential_line_load, motion.sticks))
        motion = replace(motion, x=motion.x[thinned], tangential_line_load=load, sticks=sticks)
        return _course(scene, hit.normal, motion)

    def equivalent(self, state, turning_point):
        numbers = super().equivalent(state, turning_point)
        incoming = QUANTITIES["oblique.incoming_speed"].bounded(
            numbers["speed"] / sin(state["oblique.attack"])
        )
        return numbers | {"oblique.incoming_speed": incoming}


def _course(scene, hit, motion):
    places, states = path_progress(motion.time, motion.depth), motion.normal.states
    return ObliqueCourse(scene=scene, progress=places, states=states, motion=motion, hit=hit)


def _normal(scene):
    """Return the impact along the normal, which is independent of friction."""
    return mdr.impact(scene.profile, scene.medium, scene.drive.mass, scene.drive.speed)


def leaning(course: ObliqueCourse, i: int, r):
    """Return the tangential displacement (m) of elements in state i, and whether they stick."""
    m, medium = course.motion, course.scene.medium
    # The first element is a flat face; most shapes have none.
    first = int(m.x[0] == 0)
    load, sticks = (
        np.interp(r, m.x[first:], part[i, first:]) for part in (m.tangential_line_load, m.sticks)
    )
    return load / (medium.tangential_ratio * medium.E_star), sticks > 0.5


def _feet(state, rows: dict, half: float, base: float) -> dict:
    """Return leaning springs, and lines below sticking and slipping springs."""
    found, width = {}, 0.8 * half / drawn.SPRINGS
    paths = [np.reshape(part, (-1, 9)) for part in (np.hstack([rows["sticks"], rows["slips"]]))]
    yielded = drawn.reduced(state.profile, np.abs(paths[0][:, 0])) < state.live_interval.lower
    for name, subset in (("elastic", ~yielded), ("yielded", yielded)):
        leaning = [part[subset].ravel() for part in paths]
        found[name] = tuple(np.append(part, more) for part, more in zip(rows[name], leaning, strict=True))
    for name in ("sticks", "slips"):
        foot = rows[name][0].reshape(-1, 9)[:, 0]
        ends = foot[:, None] + np.array([-width, width, np.nan])
        found[name] = ends.ravel(), np.full(ends.size, 0.97 * base)
    return found


FEET = (line("sticks", "stick", 4.0), line("slips", "slip", 4.0))


def springs(view: View, i: int) -> dict:
    """Return leaning springs with marks of stick and slip, instead of upright springs."""
    course = view.course
    if not isinstance(course, ObliqueCourse):
        return {}
    state, half, z = course.states[i], view.end(X), view.axis(Z)
    rows = drawn.springs(
        state, half, z.start, z.end, lambda g: course.relaxing(i, g), lambda r: leaning(course, i, r)
    )
    return {name: rows[name] for name in ("elastic", "yielded")} | _feet(state, rows, half, z.start)


def _forces(course):
    """Return the range of the normal and tangential forces (N)."""
    forces = course.states.force, np.abs(course.motion.tangential_force)
    most = float(max(np.max(force) for force in forces))
    return -min(course.scene.drive.friction, 1.0) * most, most


FORCE = AxisSpec("F, Fₓ, force", "force", _forces)


def _regime(course) -> str:
    """Describe in words when the contact sticks."""
    motion = course.motion
    sticking = np.flatnonzero(motion.stick_radius > 0)
    if not sticking.size:
        return "slips throughout"
    begins, ends = (format_quantity(float(motion.time[k]), "time", 3) for k in sticking[[0, -1]])
    first = (
        "sticks in part from first contact"
        if sticking[0] <= 1
        else f"slips, then sticks in part from {begins}"
    )
    return f"{first} to {ends}, then slips" if sticking[-1] < len(motion.time) - 2 else first


def forces(view: View, i: int) -> dict:
    course = view.course
    time, force = course.motion.time, course.states.force
    most = course.scene.drive.friction * force
    return {
        "normal force F": (time, force),
        "tangential force Fₓ": (time, course.motion.tangential_force),
        "regime": (0.02 * view.end(T), 0.98 * view.end(FORCE), _regime(course)),
        "largest friction ±μF": (np.append(time, [np.nan, *time]), np.append(most, [np.nan, *-most])),
        "now": (time[[i]], course.motion.tangential_force[[i]]),
        "F now": (time[[i]], force[[i]]),
        "time": line_at_time(view, i, FORCE),
    }


FORCES = Plot(
    "forces", "Forces of an oblique impact", "|F_x| ≤ μ F,  § 13", (T, FORCE),
    (
        line("largest friction ±μF", "slip", 1.2, "dashed", "μF"),
        line("normal force F", "elastic", 2.2, symbol="F"),
        line("tangential force Fₓ", "stick", 2.2, symbol="Fₓ"),
        line("time", "ink", 1.0, "dashed", legend=False),
        mark("now"),
        mark("F now", marker="diamond", legend=False),
        label("regime"),
    ),
    forces, applies=lambda view: isinstance(view.course, ObliqueCourse),
    tab="Friction", order=50,
)  # fmt: skip


EXTRA = Extra(
    "oblique",
    drives={"oblique": Oblique()},
    service=IdleSearch,
    plots=(FORCES,),
    overlays=(Overlay("springs", FEET, springs),),
)
