"""A free body hits the medium."""

import mdr_core as mdr

from . import Course, Drive, nearest, path_progress
from .press import slow

#: Instants of an impact.
INSTANTS = 120


class Impact(Drive):
    """A free body hits along the normal."""

    key, values = "impact", (mdr.FreeImpact,)
    form = ("surface", "again", "inertia")
    line = (
        "force", "depth", "contact_radius", "plastic_radius", "restitution", "contact_time",
        "damaged_area", "plastic_work",
    )  # fmt: skip
    solver = ("impact", "mass", "speed")
    results = (
        "damaged_area", "restitution", "max_depth", "max_force", "contact_time", "rebound_speed",
        "plastic_work", "viscous_work", "contact_radius", "plastic_radius", "plastic_depth",
    )  # fmt: skip

    def make(self, state):
        before = state.plastic_depth if state.surface == "imprint" else 0.0
        return mdr.FreeImpact(state.mass, state.speed, before)

    def follow(self, scene, progress):
        """Motion of the body; with adhesion states without times, as if pressed and pulled off."""
        hit = scene.solve()
        if scene.medium.work_of_adhesion > 0 and not scene.drive.plastic_depth:
            return slow(scene, progress, hit.turning_point, hit)
        return along(scene, progress, hit, hit.motion(INSTANTS))

    def turning_point(self, scene):
        return scene.solve().turning_point

    def equivalent(self, state, turning_point):
        """Present mass and speed, or those of an impact of equal depth."""
        if state.drive in ("impact", "oblique"):
            return {"mass": state.mass, "speed": state.speed}
        # A body as heavy as a ball of the contact's size times ten, of steel.
        mass = float(f"{4.2 * 7800 * (10 * float(turning_point.contact_radius)) ** 3:.1g}")
        work = float(turning_point.stored_energy + turning_point.plastic_work)
        return {"mass": mass, "speed": (2 * work / mass) ** 0.5}

    def duration(self, state, turning_point):
        return float(turning_point.depth) / self.make(state).speed


def along(scene, progress, hit, motion, **more):
    """Course of an impact from its motion along the normal."""
    places, peak = path_progress(motion.time, motion.turning_index), motion.turning_index
    return Course(scene, places, motion.states, nearest(places, progress), peak, hit, motion, **more)
