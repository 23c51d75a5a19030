"""A free body hits the medium."""

import numpy as np

import mdr_core as mdr

from ..trajectory import Trajectory, nearest, rounded
from .drive import Drive

#: Instants of an impact.
INSTANTS = 120


def _make(explorer):
    before = explorer.plastic_depth if explorer.surface == "imprint" else 0.0
    return mdr.FreeImpact(explorer.mass, explorer.speed, before)


def _numbers(drive):
    before = {"plastic_depth": drive.plastic_depth} if drive.plastic_depth > 0 else {}
    return {"mass": drive.mass, "speed": drive.speed} | before


def _opened(scene):
    surface = "imprint" if scene.drive.plastic_depth > 0 else "virgin"
    return {"drive": "impact", "surface": surface}, _numbers(scene.drive)


def _follow(scene, progress):
    hit = scene.solve()
    return along(scene, progress, hit, hit.motion(INSTANTS))


def along(scene, progress, hit, motion):
    """All states of an impact, from its motion along the normal."""
    time, peak = motion.time, motion.turning_point
    turn, end = time[peak], time[-1]
    way = rounded(np.where(time <= turn, time / turn, 1 + (time - turn) / (end - turn)))
    return Trajectory(scene, way, motion.states, nearest(way, progress), peak, hit, motion)


def alike(explorer, deepest):
    """Mass and speed of the body that hits, or of one that comes as deep."""
    if explorer.drive in ("impact", "oblique"):
        drive = explorer.scene().drive
        return {"mass": drive.mass, "speed": drive.speed}
    # A body as heavy as a ball of the contact's size times ten, of steel.
    mass = float(f"{4.2 * 7800 * (10 * float(deepest.contact_radius)) ** 3:.1g}")
    work = float(deepest.stored_energy + deepest.plastic_work)
    return {"mass": mass, "speed": (2 * work / mass) ** 0.5}


def _snippet(way, given, prefix):
    hit, motion = f"{prefix}hit", f"{prefix}motion"
    numbers = ", ".join(f"{name}={float(number)!r}" for name, number in _numbers(way.scene.drive).items())
    lines = [
        f"{hit} = mdr.impact({given}, {numbers})",
        f"print({hit}.max_depth, {hit}.max_force, {hit}.restitution, {hit}.contact_time)",
    ]
    if way.now == way.peak:
        return lines
    values = ("time", "depth", "velocity", "force", "contact_radius", "plastic_radius")
    shown = ", ".join(f"{motion}.{value}[i]" for value in values)
    return [*lines, f"{motion} = {hit}.motion({INSTANTS})", f"i = {way.now}", f"print({shown})"]


def cells(way):
    """What the impact comes to along the normal."""
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


IMPACT = Drive(
    make=_make,
    owns=lambda value: isinstance(value, mdr.FreeImpact),
    opened=_opened,
    follow=_follow,
    deepest=lambda scene: scene.solve().deepest,
    alike=alike,
    snippet=_snippet,
    form=("surface", "again", "inertia"),
    cells=cells,
    solver=("impact", "mass", "speed"),
    results=(
        "damaged_area", "restitution", "max_depth", "max_force", "contact_time", "rebound_speed",
        "plastic_work", "viscous_work", "contact_radius", "plastic_radius", "plastic_depth",
    ),
    duration=lambda explorer: float(explorer.solved().depth) / explorer.speed,
)  # fmt: skip
