"""A free body hits the medium obliquely, under friction."""

from dataclasses import asdict, replace
from math import hypot, isclose, pi

import numpy as np

import mdr_core as mdr
from mdr_core.dynamics.oblique_motion import along_surface, oblique_motion

from ..quantities import CHOICES, QUANTITIES, USED
from ..units import written
from . import impact
from .drive import Drive

#: Most elements that are kept to be drawn, and how often steps are halved for that: errors of some 10⁻⁵.
_ELEMENTS, _HALVINGS = 300, 2


def _balls(mass):
    """Tangential mass (kg) of each option of the choice "body"."""
    solid, hollow = (mdr.Ball(mass, 1.0, hollow) for hollow in (False, True))
    return {"block": mass, "solid": solid.tangential_mass, "hollow": hollow.tangential_mass}


def _make(explorer):
    speeds = explorer.speed, explorer.tangential_speed
    if explorer.aim == "angle":
        speeds = mdr.at_angle(explorer.incoming_speed, pi / 2 - explorer.attack)
    body = _balls(explorer.mass)[explorer.body]
    return mdr.FreeObliqueImpact(explorer.mass, *map(float, speeds), explorer.friction, float(body))


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


def _alike(explorer, deepest):
    numbers = impact.alike(explorer, deepest)
    along = numbers["speed"] / np.tan(explorer.attack)
    return numbers | _aimed(numbers["speed"], float(along))


def _opened(scene):
    drive = scene.drive
    bodies = _balls(drive.mass).items()
    body = next((body for body, mass in bodies if isclose(mass, drive.tangential_mass)), None)
    if body is None:
        raise ValueError(
            "a body other than a block or a ball is not shown here: solve the scene by mdr_core"
        )
    numbers = {"mass": drive.mass, "friction": drive.friction, "speed": drive.speed}
    choices = {"drive": "oblique", "surface": "virgin", "body": body, "aim": "components"}
    if drive.tangential_speed == 0:
        del numbers["speed"]
        return choices | {"aim": "angle"}, numbers | {"incoming_speed": drive.speed, "attack": pi / 2}
    return choices, numbers | {"tangential_speed": drive.tangential_speed}


def _follow(scene, progress):
    """All states; along the surface of one coarse run, as long as a move has no time for more."""
    drive = scene.drive
    normal = mdr.impact(scene.profile, scene.medium, drive.mass, drive.speed)
    given = drive.tangential_speed, drive.friction, drive.tangential_mass
    motion = along_surface(normal, *given, impact.INSTANTS, 0)
    return _way(scene, progress, normal, motion, "friction to three digits so far")


def _in_time(scene):
    """The same with quantities as exact as the core has them, and a motion as exact as is seen."""
    hit = scene.solve()
    motion = oblique_motion(hit, impact.INSTANTS, _HALVINGS)
    some = slice(None, None, -(-motion.x.size // _ELEMENTS))
    load, sticks = (np.array(part[:, some]) for part in (motion.tangential_line_load, motion.sticks))
    motion = replace(motion, x=motion.x[some], tangential_line_load=load, sticks=sticks)
    return _way(scene, 1.0, hit.normal, motion)


def _way(scene, progress, normal, motion, pending=""):
    way = impact.along(scene, progress, normal, motion.normal)
    return replace(way, oblique=motion, pending=pending)


def ends(way):
    """Velocity of the contact point after (m/s), largest force along the surface (N), friction work (J)."""
    motion, hit = way.oblique, way.oblique.impact
    if hit is not None:
        return tuple(map(float, (hit.tangential_velocity, hit.max_tangential_force, hit.friction_work)))
    force = float(np.max(np.abs(motion.tangential_force)))
    return float(motion.tangential_velocity[-1]), force, float(motion.friction_work[-1])


def _cells(way):
    drive, motion, profile = way.scene.drive, way.oblique, way.scene.profile
    after, largest, work = ends(way)
    # The impulse changes the speed of the body, and for the rest its spin.
    body = drive.tangential_speed + drive.tangential_mass / drive.mass * (after - drive.tangential_speed)
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
    return impact.cells(way) + rows


def _snippet(way, given, prefix):
    hit, motion, numbers = f"{prefix}hit", f"{prefix}motion", asdict(way.scene.drive)
    numbers = ", ".join(f"{name}={number!r}" for name, number in numbers.items())
    values = ("time", "force", "tangential_force", "tangential_velocity", "stick_radius", "slip_radius")
    shown = ", ".join(f"{motion}.{value}[i]" for value in values)
    return [
        f"{hit} = mdr.oblique_impact({given}, {numbers})",
        f"print({hit}.tangential_velocity, {hit}.rebound_angle, {hit}.friction_work)",
        f"{motion} = {hit}.motion({impact.INSTANTS})",
        f"i = {way.now}",
        f"print({shown})",
    ]


def _words(explorer):
    names, body = USED["aim"][explorer.aim], CHOICES["body"][explorer.body]
    quantities = ((QUANTITIES[name], getattr(explorer, name)) for name in names)
    return [*(f"{q.symbol} = {written(value, q.kind, 3)}" for q, value in quantities), body]


OBLIQUE = Drive(
    make=_make,
    owns=lambda value: isinstance(value, mdr.FreeObliqueImpact),
    opened=_opened,
    follow=_follow,
    deepest=lambda scene: (
        mdr.impact(scene.profile, scene.medium, scene.drive.mass, scene.drive.speed).deepest
    ),
    alike=_alike,
    snippet=_snippet,
    form=("aim", "body", "inertia"),
    cells=_cells,
    words=_words,
    duration=lambda explorer: float(explorer.solved().depth) / explorer.scene().drive.speed,
    in_time=_in_time,
)
