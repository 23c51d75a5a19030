"""A free body hits the medium."""

import mdr_core as mdr

from ..trajectory import Trajectory, nearest, passed
from .drive import Drive, arguments

#: Instants of an impact.
INSTANTS = 120


class Impact(Drive):
    """A free body hits along the normal."""

    values = (mdr.FreeImpact,)
    form = ("surface", "again", "inertia")
    solver = ("impact", "mass", "speed")
    results = (
        "damaged_area", "restitution", "max_depth", "max_force", "contact_time", "rebound_speed",
        "plastic_work", "viscous_work", "contact_radius", "plastic_radius", "plastic_depth",
    )  # fmt: skip

    def make(self, explorer):
        before = explorer.plastic_depth if explorer.surface == "imprint" else 0.0
        return mdr.FreeImpact(explorer.mass, explorer.speed, before)

    def opened(self, scene):
        drive, numbers = scene.drive, {"mass": scene.drive.mass, "speed": scene.drive.speed}
        if drive.plastic_depth > 0:
            return {"drive": "impact", "surface": "imprint"}, numbers | {
                "plastic_depth": drive.plastic_depth
            }
        return {"drive": "impact", "surface": "virgin"}, numbers

    def follow(self, scene, progress):
        hit = scene.solve()
        return along(scene, progress, hit, hit.motion(INSTANTS))

    def deepest(self, scene):
        return scene.solve().turning_point

    def alike(self, explorer, deepest):
        """Mass and speed of the body that hits, or of one that comes as deep."""
        if explorer.drive in ("impact", "oblique"):
            drive = explorer.scene().drive
            return {"mass": drive.mass, "speed": drive.speed}
        # A body as heavy as a ball of the contact's size times ten, of steel.
        mass = float(f"{4.2 * 7800 * (10 * float(deepest.contact_radius)) ** 3:.1g}")
        work = float(deepest.stored_energy + deepest.plastic_work)
        return {"mass": mass, "speed": (2 * work / mass) ** 0.5}

    def snippet(self, way, given, prefix):
        hit, told = f"{prefix}hit", ("max_depth", "max_force", "restitution", "contact_time")
        lines = [f"{hit} = mdr.impact({given}, {arguments(way.scene.drive)})", printed(hit, told)]
        values = ("time", "depth", "velocity", "force", "contact_radius", "plastic_radius")
        return lines if way.now == way.peak else lines + in_motion(way, prefix, values)

    def cells(self, way):
        hit = way.hit
        rows = [
            ("e", "restitution", "number", hit.restitution),
            ("T", "contact time", "time", hit.contact_time),
            ("A", "damaged area", "area", hit.damaged_area),
            ("v_r", "rebound speed", "speed", hit.rebound_speed),
            ("W_p", "plastic work, in all", "energy", hit.plastic_work),
        ]
        viscous = ("W_v", "viscous work, in all", "energy", hit.viscous_work)
        return [*rows, *[viscous] * bool(hit.viscous_work > 0)]

    def duration(self, explorer):
        return float(explorer.solved().depth) / explorer.scene().drive.speed


def along(scene, progress, hit, motion, **more):
    """All states of an impact, from its motion along the normal."""
    way, peak = passed(motion.time, motion.turning_index), motion.turning_index
    return Trajectory(scene, way, motion.states, nearest(way, progress), peak, hit, motion, **more)


def printed(name, values, index=""):
    """A line of Python that prints some values of a result."""
    return f"print({', '.join(f'{name}.{value}{index}' for value in values)})"


def in_motion(way, prefix, values):
    """Lines of Python that come to the present state of an impact, and print some of its values."""
    motion = f"{prefix}motion"
    return [
        f"{motion} = {prefix}hit.motion({INSTANTS})",
        f"i = {way.now}",
        printed(motion, values, "[i]"),
    ]
