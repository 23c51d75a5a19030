"""What the plots show of an oblique impact: forces and velocities along the surface, and Maw's diagram."""

from functools import cache

import numpy as np

import mdr_core as mdr

from .drives.oblique import ends
from .resting import Found

#: Impacts on Maw's curve where stick and slip meet, and error allowed there: less than is seen.
_PLACES, _TOLERANCE = 14, 1e-3


def axes(way, force):
    """Axes of velocities, and of forces that hold one, with their directions, as `View` describes them."""
    largest = {name: float(np.max(np.abs(way.on[name]))) for name in ("force", "W", "v")}
    along, fastest = max(force, largest["force"]), 1.05 * max(largest["W"], largest["v"])
    back = 1.0 if np.min(way.on["force"]) < 0 else 0.0
    (before, after), chi = _psi(way), _chi(way)
    reach = _reach(before, chi)
    return [
        ("force", "F, Fₓ, force", "force", along, back),
        ("W", "W, speed along the surface", "speed", fastest, 1.0),
        ("v", "−v, speed away from the surface", "speed", fastest, 1.0),
        ("ψ₁", "ψ₁, speed along the surface before", "number", reach),
        ("ψ₂", "ψ₂, speed along the surface after", "number", max(reach - 4 * chi, abs(after), 1.2), 1.0),
    ]


def table(motion):
    """Columns of the curves that are taken away."""
    return {
        "tangential velocity W (m/s)": motion.tangential_velocity,
        "tangential force F_x (N)": motion.tangential_force,
        "friction work W_f (J)": motion.friction_work,
        "outer radius of stick (m)": motion.stick_radius,
        "inner radius of stick (m)": motion.slip_radius,
    }


def leaning(way, i, r):
    """How far elements at some radii lean in state i (m), and whether they stick."""
    m, medium = way.oblique, way.scene.medium
    # The first element is a flat face, which most shapes have not.
    first = int(m.x[0] == 0)
    load, sticks = (
        np.interp(r, m.x[first:], part[i, first:]) for part in (m.tangential_line_load, m.sticks)
    )
    return load / (medium.tangential_ratio * medium.E_star), sticks > 0.5


def forces_still(view):
    on, most = view.way.on, view.way.scene.drive.friction * view.way.force
    both = np.append(on["t"], [np.nan, *on["t"]]), np.append(most, [np.nan, *-most])
    rows = {"normal force F": (on["t"], on["F"]), "force along Fₓ": (on["t"], on["force"])}
    return rows | {"most friction ±μF": both} | view.held_on("t", "force")


def forces(view, i):
    marks = {"now": view.mark(i, "t", "force"), "F now": view.mark(i, "t", "F")}
    return marks | {"time": view.time(i, "force")}


def hodograph_still(view):
    W, v, steps = view.way.on["W"], view.way.on["v"], view.way.oblique.sticks.any(axis=1)[1:]
    rows = {}
    for name, some in (("something sticks", steps), ("all slips", ~steps)):
        rows[name] = np.where(np.append(some, False) | np.append(False, some), W, np.nan), v
    ways = (("path before", 0), ("path after", -1))
    rows |= {name: (np.array([0.0, W[k]]), np.array([0.0, v[k]])) for name, k in ways}
    return rows | view.held_on("W", "v")


def _psi(way):
    """ψ₁ and ψ₂ of an impact: speeds of the contact point over μv₀/κ."""
    drive, after = way.scene.drive, ends(way)[0]
    unit = drive.friction * drive.speed / float(way.scene.medium.tangential_ratio)
    return (drive.tangential_speed / unit, after / unit) if unit else (0.0, 0.0)


def _chi(way):
    """χ = κm/(2m_t)."""
    drive = way.scene.drive
    return float(way.scene.medium.tangential_ratio) * drive.mass / (2 * drive.tangential_mass)


def _reach(psi, chi):
    """How far Maw's diagram goes: beyond where all slips throughout."""
    return 1.15 * max(psi, 4 * chi + 1)


def maw_still(view):
    psi = _psi(view.way)
    return {"this impact": tuple(np.array([each]) for each in psi)} if psi[0] else {}


def maw(way):
    """The elastic curve of the same body, as far as it has been found: Maw's own under a paraboloid."""
    drive, medium = way.scene.drive, way.scene.medium
    elastic = mdr.Medium(medium.E_star, poisson=medium.poisson)
    body, found = (drive.mass, drive.speed, drive.tangential_mass), [(0.0, 0.0)]
    last = max(4 * _chi(way) - 1, 1.0)
    for psi in [*np.linspace(0, last, _PLACES)[1:], _reach(_psi(way)[0], _chi(way))]:
        found.append((psi, _after(way.scene.profile, elastic, *body, float(psi))))
        yield Found(
            {"elastic (Maw)": tuple(np.array(found).T)}, [], "" if psi > last else "finding the curve …"
        )


@cache
def _after(profile, medium, mass, speed, tangential_mass, psi):
    """ψ₂ of an elastic impact with some ψ₁."""
    unit = speed / float(medium.tangential_ratio)
    hit = mdr.oblique_impact(
        profile, medium, mass, speed, psi * unit, 1.0, tangential_mass=tangential_mass, tolerance=_TOLERANCE
    )
    return float(hit.tangential_velocity) / unit
