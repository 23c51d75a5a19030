"""Worst errors against references of many digits, by quantity and regime.

    python -m tests.benchmarks.accuracy

writes the tables to assets/accuracy.md and prints them: states over all shapes and media, impacts without
viscosity and with it, and what the chain says of its error beside its error.
"""

from pathlib import Path

import numpy as np
from mpmath import mp, mpf

import mdr_core as mdr

from ..hard_cases import BOUNDS, EXTREMES, MEDIA, QUANTITIES, REGIMES, errors
from ..shapes import name
from . import exact, oblique, stepping

TABLE = Path(__file__).parents[2] / "assets" / "accuracy.md"
MEDIUM, MASS = mdr.Medium(1e9, q_c=10.0), 1e-9
POWERS = (mdr.Cone(0.3), mdr.Paraboloid(1e-5), mdr.PowerLaw(2e-4, 0.5), mdr.PowerLaw(1e11, 3.0))
TIMES = (0.1, 1 + 1e-5, 3.0, 1e4, 2e8)
#: Relaxation times over contact times (of elastic impacts).
SHARES = (1e-4, 1e-2, 1.0, 1e2, 1e4)
WITNESSES = (mdr.Cone(0.3), mdr.Paraboloid(1e-5), mdr.FlatPunch(1e-6))


def states():
    """Cells of the table of states, and the bounds."""
    worst = {}
    for regime in REGIMES:
        for shape in EXTREMES:
            for medium in MEDIA:
                for quantity, error in errors(shape, medium, regime).items():
                    key = regime, quantity
                    worst[key] = max(worst.get(key, (0.0, "")), (error, name(shape)))
    for regime in REGIMES:
        yield regime, *("{:.0e} {}".format(*worst[regime, q]) for q in QUANTITIES)
    yield "**bound**", *(f"{BOUNDS[q]:.0e}" for q in QUANTITIES)


def dry_impacts(times=TIMES):
    """Errors of impacts that come some critical depths deep, against 50 digits."""
    for depth in times:
        worst = np.zeros(3)
        for shape in POWERS:
            state = mdr.indent(shape, MEDIUM, depth * MEDIUM.critical_depth)
            speed = float(np.sqrt(2 * (state.stored_energy + state.plastic_work) / MASS))
            hit = mdr.impact(shape, MEDIUM, MASS, speed)
            found = hit.max_depth, hit.restitution, hit.contact_time
            references = exact.impacts(shape, MEDIUM, MASS, (speed,))
            worst = np.maximum(worst, [r.error(f) for r, f in zip(references, found, strict=True)])
        yield f"{depth:.6g} d_c", *_digits(worst)


def punch_impacts(shares=SHARES):
    """Errors of a damped oscillator from next to no damping to next to nothing else, against 60 digits.

    v̇ + d + ζ v = 0 until d + ζ v = 0, with ζ = τ ω; the dry contact lasts π/ω.
    """
    punch, omega = mdr.FlatPunch(1e-6), np.sqrt(2 * MEDIUM.E_star * 1e-6 / MASS)
    for share in shares:
        medium = mdr.Medium(MEDIUM.E_star, eta=share * np.pi / omega * MEDIUM.E_star / 4)
        hit = mdr.impact(punch, medium, MASS, 0.1)
        with mp.workdps(60):
            w = mp.sqrt(2 * mpf(medium.E_star) * mpf(punch.radius) / mpf(MASS))
            z = 4 * mpf(medium.eta) / mpf(medium.E_star) * w
            root = mp.sqrt(mp.mpc(z * z - 4))
            fast, slow = (-z - root) / 2, (-z + root) / 2

            def motion(t, power, slow=slow, fast=fast, root=root):
                return mp.re((slow**power * mp.exp(slow * t) - fast**power * mp.exp(fast * t)) / root)

            # The first instants at which the velocity, and d + ζ v, are zero: d + ζ v = −v̇.
            turn = mp.re(mp.log(fast / slow) / (slow - fast))
            end = mp.re(mp.log((fast / slow) ** 2) / (slow - fast))
            if end <= 0 or (z < 2 and end < turn):
                end += 2 * mp.pi / mp.im(slow - fast)
            depth = motion(turn, 0) * mpf(0.1) / w
            references = [exact.Exact([value]) for value in (depth, -motion(end, 1), end / w)]
        found = hit.max_depth, hit.restitution, hit.contact_time
        yield (
            f"flat punch, τ/T = {share:g}",
            *_digits(r.error(f) for r, f in zip(references, found, strict=True)),
        )


def viscous_impacts():
    """Errors of impacts of a cone that yields, against Taylor series of 40 digits."""
    cone = mdr.Cone(0.3)
    for eta, speed in ((0.3, 0.1), (3.0, 0.1), (3.0, 1.0), (30.0, 1.0)):
        medium = mdr.Medium(MEDIUM.E_star, q_c=MEDIUM.q_c, eta=eta)
        hit = mdr.impact(cone, medium, MASS, speed)
        references = stepping.exact(cone, medium, MASS, [speed], 40)
        found = hit.max_depth, hit.restitution, hit.contact_time
        title = f"cone, {hit.max_depth / medium.critical_depth:.2g} d_c deep, e = {hit.restitution:.2g}"
        yield title, *_digits(r.error(f) for r, f in zip(references, found, strict=True))


def chain_impacts(shares=(0.0, 1e-2, 1.0, 1e2, 1e3), tolerance=1e-6):
    """The chain's estimate of the error of restitution and depth, and the largest error of three shapes."""
    for share in shares:
        said = missed = 0.0
        for shape in WITNESSES:
            dry = mdr.impact(shape, MEDIUM, MASS, 0.1)
            medium = mdr.Medium(
                MEDIUM.E_star, q_c=MEDIUM.q_c, eta=share * dry.contact_time * MEDIUM.E_star / 4
            )
            hit = mdr.impact(shape, medium, MASS, 0.1)
            chain = mdr.chain_impact(shape, medium, MASS, 0.1, tolerance=tolerance)
            off = abs(chain.restitution - hit.restitution), abs(chain.max_depth / hit.max_depth - 1)
            said, missed = max(said, chain.error), max(missed, *off)
        yield f"τ/T = {share:g}", f"{said:.0e}", f"{missed:.0e}"


def structures():
    """Impacts on plates and beams, with the restitution and the force of an independent solution of each.

    Zener's equation is s″ + (1 + λ d/dτ) s^1.5 = 0. Fixed steps hold the mean force, with modes that move
    exactly under it, and are extrapolated to steps of no duration.
    """
    zener, steps, ode = "Zener's equation, DOP853", "fixed steps, 1/4000 of the contact", "DOP853"
    plate = mdr.Structure.plate(8e-3, 206e9, 0.3, 7850.0)
    for lam, e in ((0.1, 0.8433394109), (0.5, 0.4368953009), (1.0, 0.1841228742)):
        mass, ball, E_star = 4e-3, mdr.Paraboloid(5e-3), 1e10
        speed = (lam * plate.impedance / mass**0.6) ** 5 / (16 / 9 * E_star**2 * ball.radius)
        hit = mdr.impact(ball, mdr.Medium(E_star), mass, speed, structure=plate)
        yield _solution(f"plate without edges, λ = {lam:g}", hit, zener, e)
    steel = 2.16e11, 7960.0, 0.3
    for length, radius, count, e, force in (
        (0.1535, 0.01, 8, 0.302322901, 4.980), (0.307, 0.02, 6, 0.97312489, 10.28),
    ):  # fmt: skip
        k = np.arange(1, 2 * count, 2)
        omega = (k * np.pi / length) ** 2 * np.sqrt(steel[0] * 1e-8 / 12 / (steel[1] * 1e-4))
        beam = mdr.Structure.modal(omega / (2 * np.pi), np.full(count, steel[1] * 1e-4 * length / 2))
        hit = _ball(radius, steel, mdr.Medium(steel[0] / (1 - steel[2] ** 2) / 2), 0.01, beam)
        title = f"Timoshenko's beam of {length * 1e3:g} mm, its first {count} odd modes"
        yield _solution(title, hit, ode if count == 8 else steps, e, force)
    i, j = (n.ravel() * np.pi / 0.2 for n in np.meshgrid(*2 * (np.arange(1, 16, 2),)))
    square = 131.4233 * i**4 + 2 * (3.867273 + 2 * 8.921508) * (i * j) ** 2 + 77.27888 * j**4
    area_mass = 1580 * 2.69e-3
    modes = np.sqrt(square / area_mass) / (2 * np.pi), np.full(64, area_mass * 0.2**2 / 4)
    laminate = mdr.Medium(1 / ((1 - 0.09) / 210e9 + 1 / 7.9e9))
    hit = _ball(6.35e-3, steel, laminate, 3.0, mdr.Structure.modal(*modes))
    yield _solution("laminate of Sun and Chen, 8 × 8 modes", hit, steps, 0.1846356)
    steel = 206e9, 7833.0, 0.28
    plate = mdr.Structure.supported_isotropic_plate(0.2, 0.2, 8e-3, steel[0], steel[2], steel[1])
    hit = _ball(10e-3, steel, mdr.Medium(steel[0] / (1 - steel[2] ** 2) / 2), 1.0, plate)
    yield _solution("steel plate of Karas, 200 mm × 200 mm × 8 mm", hit, steps, 0.6637, 1375.69)
    steel = 206e9, 7850.0, 0.3
    beam = mdr.Structure.beam(0.78, steel[0] * 60e-3 * 27.8e-3**3 / 12, steel[1] * 60e-3 * 27.8e-3)
    hit = _ball(70e-3, steel, mdr.Medium(steel[0] / (1 - steel[2] ** 2) / 2), 1.0, beam)
    yield _solution("ball of 140 mm on a steel beam of 780 mm", hit, steps, 0.868668, 39301.0)


def _ball(radius, material, medium, speed, structure):
    """The impact of a ball of a material (Young's modulus, density, Poisson ratio)."""
    mass = 4 / 3 * np.pi * radius**3 * material[1]
    return mdr.impact(mdr.Paraboloid(radius), medium, mass, speed, structure=structure)


def _solution(title, hit, by, e, force=None):
    """A row: restitution and largest force of another solution, with its digits, and of the library."""
    places = len(f"{e}".partition(".")[2])
    row = title, by, f"{e}", f"{hit.restitution:.{places}f}"
    forces = ("", "") if force is None else (f"{force:,g} N", f"{float(f'{hit.max_force:.6g}'):,g} N")
    return *row, *forces, f"{hit.contacts}"


def _digits(values):
    return (f"{value:.0e}" for value in values)


def _table(head, rows):
    rows = [f"| {' | '.join(row)} |" for row in rows]
    return [f"| {' | '.join(head)} |", "|---" * len(head) + "|", *rows, ""]


def main():
    kinds = ", ".join(sorted({type(s).__name__ for s in EXTREMES}))
    impact = "largest depth", "restitution", "contact time"
    lines = [
        "# Accuracy",
        "",
        "Relative errors are near rounding for forces and energies, and 10⁻⁶ for viscous forces. Errors of "
        "stresses below the surface are 10⁻⁸ of the largest stress.",
        "",
        f"States: worst relative error against 40-digit references, over {len(EXTREMES)} indenters "
        "and three media (E* = 1 MPa, 1 GPa, 1 TPa), with its indenter. The indenters are "
        f"{kinds}, with exponents from 0.1 to 50. Errors of the pressure are per unit of its condition "
        "number in r. The radii are r = 10⁻⁹ a and a/2, r = c(1 ± 10⁻⁶) and r = 0.999999 a. Within 10⁻⁶ of "
        "the threshold, plastic work and pressure have the digits of d − d_c.",
        "",
        *_table(("regime", *QUANTITIES), states()),
        "Impacts without viscosity to these depths, worst of cone, paraboloid, √r and r³, against 50 "
        "digits:",
        "",
        *_table(("depth", *impact), dry_impacts()),
        "Impacts on a viscous medium, against 40 or more digits:",
        "",
        *_table(("impact", *impact), (*punch_impacts(), *viscous_impacts())),
        "The chain at its tolerance of 10⁻⁶, worst of cone, paraboloid and flat punch:",
        "",
        *_table(("relaxation over contact time", "its estimate", "its error"), chain_impacts()),
        "Impacts on structures, next to other solutions of the same equations:",
        "",
        *_table(
            ("scene", "other solution", "its e", "e", "its largest force", "largest force", "contacts"),
            structures(),
        ),
        "Oblique impacts without viscosity, against a chain of 2000 cells. Each class of hardness and each "
        "sum has 60 random impacts, with all suitable shapes of the tests. The depth is 0.1 to 10³ times "
        "the depth of the onset, and up to 10³ times the elastic compression u_c there. μ is from 0.01 to "
        "3, m_t/m from 0.1 to 10, ψ from 0.03 to 8, ν from 0 to ½. The table counts only impacts in which "
        "elements stick. Errors of the velocity are relative to W₀, errors of the largest force to it:",
        "",
        *_table(oblique.HEAD, oblique.table()),
        f"Made by `python -m tests.benchmarks.accuracy` with numpy {np.__version__}.",
        "",
    ]
    TABLE.write_text("\n".join(lines), encoding="utf-8")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
