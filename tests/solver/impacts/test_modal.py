"""Impacts on a structure by its modes, against other ways to solve them: an ODE, and fixed steps."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import mdr_core as mdr
from mdr_core.solver.medium.modes import compliance_of_plate, modes_of_plate

from ...approx import approx

BALL, SOFT = mdr.Paraboloid(8e-3), mdr.Medium(10e9)
#: Steel, the beam of Timoshenko (1913) and the ball on it.
E, DENSITY, NU = 2.16e11, 7960.0, 0.3
STEEL = E / (1 - NU**2) / 2


def ball_mass(radius, density=DENSITY):
    return 4 / 3 * np.pi * radius**3 * density


def timoshenko(length, count, damping=0.0):
    """Odd modes of a beam of 10 mm × 10 mm, hit in its middle, without the compliance of the others."""
    k = np.arange(1, 2 * count, 2)
    omega = (k * np.pi / length) ** 2 * np.sqrt(E * 1e-8 / 12 / (DENSITY * 1e-4))
    mass = np.full(count, DENSITY * 1e-4 * length / 2)
    return mdr.Structure.modal(omega / (2 * np.pi), mass, damping=damping)


def one_mode(stiffness, mass):
    return mdr.Structure.modal(np.sqrt(stiffness / mass) / (2 * np.pi), mass)


def by_ode(profile, medium, mass, speed, structure, end, imprint=0.0):
    """Restitution by DOP853 on the public force over depth, with its memory, in phases without kinks."""
    modes, n = structure.modes, len(structure.modes.frequency)
    omega, masses, zeta = (
        2 * np.pi * np.array(modes.frequency),
        np.array(modes.mass),
        np.array(modes.damping),
    )
    deepest = [0.0]
    if imprint:
        # The depth that leaves this imprint.
        low, high = imprint, 100 * imprint
        for _ in range(200):
            middle = (low + high) / 2
            left = mdr.indent(profile, medium, middle).plastic_depth
            low, high = (middle, high) if left < imprint else (low, middle)
        deepest = [high]

    def force(depth):
        if depth <= 0:
            return 0.0
        path = [deepest[0], depth] if depth < deepest[0] else [depth]
        return float(mdr.indent(profile, medium, path).force[-1])

    def depth(s):
        return s[0] - s[2 : 2 + n].sum()

    def rate(s):
        return s[1] - s[2 + n :].sum()

    def slope(t, s):
        way, velocity = s[2 : 2 + n], s[2 + n :]
        F = force(depth(s))
        bend = F / masses - 2 * zeta * omega * velocity - omega**2 * way
        return np.concatenate([[s[1], -F / mass], velocity, bend])

    def touches(t, s):
        return depth(s) - imprint_now[0]

    def turns(t, s):
        return rate(s)

    def passes(t, s):
        return depth(s) - deepest[0]

    imprint_now = [imprint]
    for event in (touches, turns, passes):
        event.terminal = True
    state, t = np.concatenate([[imprint, speed], np.zeros(2 * n)]), 0.0
    while t < end:
        found = solve_ivp(
            slope, (t, end), state, "DOP853", rtol=1e-11, atol=1e-15, events=(touches, turns, passes),
            first_step=1e-9 * end, max_step=0.4 / max(omega.max(), 1 / end),
        )  # fmt: skip
        t, state = found.t[-1], found.y[:, -1]
        if depth(state) > deepest[0]:
            deepest[0] = depth(state)
            imprint_now[0] = float(mdr.indent(profile, medium, deepest[0]).plastic_depth)
        # Past the event, so that the next phase does not end where it begins.
        nudge = min(1e-9 * end, end - t)
        state, t = state + nudge * slope(t, state), t + max(nudge, 1e-12 * end)
    return -state[1] / speed


CASES = {
    "elastic": (BALL, SOFT, 0.1, one_mode(2e6, 1e-2), 0.0),
    "several contacts": (BALL, SOFT, 1.0, one_mode(1e6, 1e-2), 0.0),
    "two modes, damped": (
        BALL,
        SOFT,
        0.05,
        mdr.Structure.modal([900.0, 4000.0], [0.02, 0.05], damping=0.03),
        0.0,
    ),
    "class (a)": (BALL, mdr.Medium(10e9, hardness=2e8), 0.1, one_mode(2e6, 2e-2), 0.0),
    "class (b)": (BALL, mdr.Medium(10e9, q_c=1e5), 0.1, one_mode(2e6, 2e-2), 0.0),
    "sum of classes": (BALL, mdr.Medium(10e9, hardness=1e8, q_c=5e4), 0.1, one_mode(2e6, 2e-2), 0.0),
    "cone": (mdr.Cone(0.4), mdr.Medium(1e9, q_c=1e4), 0.02, one_mode(1e6, 1e-2), 0.0),
    "flat face": (mdr.FlatPunch(1e-3), SOFT, 0.05, one_mode(4e6, 1e-2), 0.0),
    "rounded cone": (
        mdr.RoundedCone(tip_radius=1e-3, slope=0.4),
        mdr.Medium(1e9, hardness=5e7),
        0.02,
        one_mode(1e6, 1e-2),
        0.0,
    ),
    "class (c)": (BALL, mdr.Medium(10e9, f_c=60.0), 0.1, one_mode(2e6, 2e-2), 0.0),
    "imprint": (BALL, mdr.Medium(10e9, q_c=1e5), 0.1, one_mode(2e6, 2e-2), 3e-5),
}


@pytest.mark.few(4)
@pytest.mark.parametrize("case", CASES)
def test_the_restitution_is_that_of_an_ode_on_the_public_force(case):
    """To what the ODE loses by steps of 10⁻⁹ of the time behind each kink."""
    profile, medium, mass, structure, imprint = CASES[case]
    hit = mdr.impact(profile, medium, mass, 1.0, plastic_depth=imprint, structure=structure)
    end = 1.001 * float(hit.contact_time)
    expected = by_ode(profile, medium, mass, 1.0, structure, end, imprint)
    assert hit.restitution == approx(expected, abs=2e-7)


def by_steps(radius, medium, mass, speed, structure, duration, steps):
    """Restitution and contacts (impulse, largest force) by fixed steps with a mean force in each.

    Modes under a constant force are exact. Of second order: the answer is that of Richardson.
    """
    modes = structure.modes
    omega, M, zeta = 2 * np.pi * np.array(modes.frequency), np.array(modes.mass), np.array(modes.damping)
    stiffness, cap = 4 / 3 * medium.E_star * np.sqrt(radius), np.pi * medium.q_c / 2 / medium.E_star

    def run(dt):
        root = omega * (-zeta + 1j * np.sqrt(1 - zeta**2))
        turn, inverse = np.exp(root * dt), 1 / root.imag
        weight = (turn - 1) / root / M
        z, y, v, force, deepest, contacts = np.zeros(omega.size, complex), 0.0, speed, 0.0, 0.0, []
        for _ in range(round(duration / dt)):
            mean, free = force, turn * z
            for _ in range(3):
                d = y + v * dt - mean * dt * dt / 2 / mass - np.dot((free + weight * mean).imag, inverse)
                p = max(max(deepest, d) - cap, 0.0)
                new = stiffness * (d**1.5 - p**1.5) if d > p else 0.0
                mean = (force + new) / 2
            y, v, z = y + v * dt - mean * dt * dt / 2 / mass, v - mean * dt / mass, free + weight * mean
            deepest = max(deepest, d)
            if new > 0 and force == 0:
                contacts.append([0.0, 0.0])
            if contacts:
                contacts[-1] = [contacts[-1][0] + mean * dt, max(contacts[-1][1], new)]
            force = new
        return -v / speed, np.array(contacts)

    (coarse, _), (fine, contacts) = run(duration / steps), run(duration / steps / 2)
    return fine + (fine - coarse) / 3, contacts


@pytest.mark.parametrize(
    ("length", "radius", "q_c", "damping", "count"),
    [
        (0.1535, 0.01, np.inf, 0.0, 8), (0.1535, 0.01, 2e4, 0.0, 6), (0.1535, 0.01, 2e4, 0.02, 6),
        pytest.param(0.307, 0.02, np.inf, 0.0, 6, marks=pytest.mark.slow),
    ],
)  # fmt: skip
def test_the_beam_of_timoshenko_by_fixed_steps(length, radius, q_c, damping, count):
    """Restitution, and force and impulse of each contact; steps of the modes' period over 30 and 60."""
    structure, mass = timoshenko(length, count, damping), ball_mass(radius)
    medium = mdr.Medium(STEEL, q_c=q_c)
    hit = mdr.impact(mdr.Paraboloid(radius), medium, mass, 0.01, structure=structure)
    duration = 1.2 * hit.contact_time
    steps = round(30 * duration * max(structure.modes.frequency))
    e, contacts = by_steps(radius, medium, mass, 0.01, structure, duration, steps)
    assert hit.restitution == approx(e, abs=1e-5)
    assert hit.contacts == len(contacts)
    for each, (impulse, force) in zip(hit.hits, contacts, strict=True):
        assert each.impulse == approx(impulse, rel=1e-3)
        assert each.max_force == approx(force, rel=1e-3)


@pytest.mark.slow
def test_a_ball_on_the_laminate_of_sun_and_chen_by_fixed_steps():
    """Of 36 modes; without edges the restitution is 0.034, and the second contact makes it 0.18."""
    given = 131.4233, 3.867273, 77.27888, 8.921508, 1580 * 2.69e-3
    plate = mdr.Structure.supported_plate(0.2, 0.2, *given, modes=36)
    structure = mdr.Structure.modal(plate.modes.frequency, plate.modes.mass)
    radius, medium = 6.35e-3, mdr.Medium(1 / ((1 - 0.09) / 210e9 + 1 / 7.9e9))
    hit = mdr.impact(mdr.Paraboloid(radius), medium, ball_mass(radius), 3.0, structure=structure)
    steps = round(30 * 1.1 * hit.contact_time * max(structure.modes.frequency))
    e, contacts = by_steps(radius, medium, ball_mass(radius), 3.0, structure, 1.1 * hit.contact_time, steps)
    assert hit.restitution == approx(e, abs=1e-5)
    assert [each.max_force for each in hit.hits] == approx(contacts[:, 1], rel=1e-3)
    endless = mdr.Structure.laminate(*given, edge=0.1)
    alone = mdr.impact(mdr.Paraboloid(radius), medium, ball_mass(radius), 3.0, structure=endless)
    assert alone.restitution < 0.04 < 0.15 < hit.restitution


@pytest.mark.slow
@pytest.mark.few(2)
@pytest.mark.parametrize("seed", [0, 1, 2, 4, 5, 7])
def test_nothing_overlaps_between_contacts(seed):
    """On a fine grid of the whole motion: the energies cannot see a contact that is missed."""
    profile, medium, mass, structure = random_scene(seed)
    hit = mdr.impact(profile, medium, mass, 1.0, structure=structure)
    assert hit.contacts > 1
    motion = hit.motion(5000)
    flying = motion.force == 0
    assert flying.any()
    assert np.all((motion.depth - motion.plastic_depth)[flying] <= 1e-9 * hit.max_depth)


def random_scene(seed):
    """A profile, a medium, a mass, and one to four modes, with or without the compliance of others."""
    rng = np.random.default_rng(seed)
    profile = [BALL, mdr.FlatPunch(1e-3), mdr.Cone(0.3), mdr.RoundedCone(tip_radius=1e-3, slope=0.3)][
        seed % 4
    ]
    given = [{}, {"hardness": 3e8}, {"q_c": 2e5}, {"hardness": 1e8, "q_c": 1e5}][rng.integers(4)]
    medium, mass = mdr.Medium(10e9, **given), 10 ** rng.uniform(-3, 0)
    time = float(mdr.impact(profile, medium, mass, 1.0).contact_time)
    n = rng.integers(1, 5)
    frequency, masses = 10 ** rng.uniform(-0.5, 1.3, n) / time / 2, mass * 10 ** rng.uniform(-2, 1, n)
    compliance = np.sum(1 / (masses * (2 * np.pi * frequency) ** 2))
    more = {"stiffness": 1 / compliance / rng.uniform(1, 1.5)} if rng.random() < 0.5 else {}
    damping = rng.choice([0.0, 0.03])
    return profile, medium, mass, mdr.Structure.modal(frequency, masses, damping=damping, **more)


@pytest.mark.few(4)
@pytest.mark.parametrize("seed", range(12))
def test_energies_add_up_at_every_instant(seed):
    """Of body, medium, modes and damping, each by a formula of its own; and nothing overlaps in flight."""
    profile, medium, mass, structure = random_scene(seed)
    hit = mdr.impact(profile, medium, mass, 1.0, structure=structure)
    motion, energy = hit.motion(300), mass / 2
    parts = "kinetic_energy", "stored_energy", "plastic_work", "structure_work", "support_energy"
    assert sum(getattr(motion, name) for name in parts) == approx(np.full(300, energy), rel=3e-9)
    assert energy * (1 - hit.restitution**2) == approx(hit.plastic_work + hit.structure_work, rel=1e-9)
    assert np.all(np.diff(motion.structure_work) > -1e-12 * energy)
    flying = motion.force == 0
    assert np.all((motion.depth - motion.plastic_depth)[flying] <= 1e-9 * hit.max_depth)
    assert motion.force.max() <= hit.max_force * (1 + 1e-9)
    # The structure begins at rest.
    assert motion.velocity[0] == approx(1.0, rel=1e-12)
    assert motion.deflection.max() <= hit.max_deflection * (1 + 1e-3)
    assert sum(each.impulse for each in hit.hits) == approx(mass * (1 + hit.restitution), rel=1e-9)


@pytest.mark.parametrize("profile", [BALL, mdr.FlatPunch(1e-3), mdr.Cone(0.3)])
@pytest.mark.parametrize("ratio", [0.3, 1.0, 3.0])
def test_two_free_bodies(profile, ratio):
    """A plate on threads: the relative velocity returns with the restitution of the reduced mass.

    To the errors of some hundred steps, 10⁻⁹ each of the impulse.
    """
    mass, other = 0.1, 0.1 / ratio
    structure = mdr.Structure.modal(0.0, other)
    for medium in (SOFT, mdr.Medium(10e9, hardness=2e8)) if profile is BALL else (SOFT,):
        alone = mdr.impact(profile, medium, mass * other / (mass + other), 1.0)
        hit = mdr.impact(profile, medium, mass, 1.0, structure=structure)
        assert hit.restitution == approx((other * alone.restitution - mass) / (mass + other), abs=1e-9)
        assert hit.max_force == approx(float(alone.max_force), rel=1e-8)
        assert hit.contact_time == approx(float(alone.contact_time), rel=1e-9)


def test_a_large_plate_is_one_without_edges():
    """Zener's restitution at 400 times the mass of the ball, to what the edges do (theory, section 21)."""
    thickness, radius, speed = 8e-3, 5e-3, 3.0
    mass = ball_mass(radius, 7850.0)
    side = np.sqrt(400 * mass / 7850.0 / thickness)
    plate = 206e9, 0.3, 7850.0
    given = mdr.Paraboloid(radius), mdr.Medium(206e9 / 0.91 / 2), mass, speed
    endless = mdr.impact(*given, structure=mdr.Structure.plate(thickness, *plate))
    edges = mdr.Structure.supported_isotropic_plate(side, side, thickness, *plate, modes=400)
    assert mdr.impact(*given, structure=edges).restitution == approx(endless.restitution, abs=5e-4)


def test_a_slow_impact_is_one_on_a_support():
    """The mode turns 60 times during the contact, and takes less than 10⁻⁴ of the energy."""
    structure = one_mode(1e6, 1e-6)
    hit = mdr.impact(BALL, mdr.Medium(10e9, q_c=1e5), 0.1, 0.1, structure=structure)
    support = mdr.impact(BALL, mdr.Medium(10e9, q_c=1e5), 0.1, 0.1, structure=mdr.Structure(stiffness=1e6))
    assert hit.restitution == approx(support.restitution, abs=2e-4)
    assert hit.max_force == approx(float(support.max_force), rel=5e-3)


def test_contacts_of_arrays_are_those_of_single_impacts():
    structure = mdr.Structure.modal([800.0, 5000.0], [0.05, 0.1], damping=[0.0, 0.01], stiffness=1e6)
    medium, speed, imprint = mdr.Medium(10e9, q_c=[1e5, 2e5]), np.array([[0.2], [1.0]]), [0.0, 1e-6]
    hits = mdr.impact(BALL, medium, 0.02, speed, plastic_depth=imprint, structure=structure)
    for i, j in np.ndindex(2, 2):
        one = BALL, medium.entries(j), 0.02, speed[i, 0]
        hit = mdr.impact(*one, plastic_depth=imprint[j], structure=structure)
        assert hits.contacts[i, j] == hit.contacts
        assert hits[i, j].hits == hit.hits


def test_impacts_without_modes_have_one_contact():
    hit = mdr.impact(BALL, mdr.Medium(10e9, q_c=1e5), 0.1, [0.5, 1.0])
    assert hit.contacts.tolist() == [1, 1]
    ((only,), _) = hit.hits
    assert (only.start, only.end, only.max_force) == (0.0, hit.contact_time[0], hit.max_force[0])
    assert only.impulse == approx(0.1 * 0.5 * (1 + hit.restitution[0]))


@pytest.mark.parametrize(
    ("sides", "stiffness", "at"),
    [
        ((1.0, 1.0), (1.0, 1.0, 1.0), (0.5, 0.5)), ((0.2, 0.3), (131.4, 21.7, 77.3), (0.3, 0.45)),
        ((1.0, 0.1), (5.0, 1.0, 0.2), (0.5, 0.2)), ((0.3, 1.0), (1.0, -0.9, 1.0), (0.5, 0.5)),
        ((0.3, 1.0), (1.0, 3.0, 1.0), (0.1, 0.7)),
    ],
)  # fmt: skip
def test_the_compliance_of_a_plate_is_that_of_all_its_modes(sides, stiffness, at):
    """Navier's double series; what is left of it falls as the square of the number of terms."""
    D11, H, D22 = stiffness

    def navier(count):
        k = np.arange(1, count + 1)
        x, y = (np.pi * k / side for side in sides)
        square = D11 * x[:, None] ** 4 + 2 * H * np.multiply.outer(x**2, y**2) + D22 * y**4
        shape = np.multiply.outer(np.sin(np.pi * at[0] * k) ** 2, np.sin(np.pi * at[1] * k) ** 2)
        return 4 / sides[0] / sides[1] * np.sum(shape / square)

    expected = navier(1600) + (navier(1600) - navier(800)) / 3
    assert compliance_of_plate(sides, stiffness, at) == approx(expected, rel=2e-6)


def test_the_stiffness_of_a_square_plate_is_that_of_handbooks():
    """F L²/D = 0.01160 w (Timoshenko and Woinowsky-Krieger, section 34)."""
    assert compliance_of_plate((1.0, 1.0), (1.0, 1.0, 1.0), (0.5, 0.5)) == approx(0.01160, abs=5e-6)


@pytest.mark.parametrize("stiffness", [(1.0, 1.0, 1.0), (5.0, -0.5, 0.2)])
def test_no_lower_mode_of_a_plate_is_missed(stiffness):
    """Of a strip, whose modes along it are many; those with a node at the point of contact are left out."""
    D11, H, D22 = stiffness
    frequency, mass = modes_of_plate(np.array([1.0, 0.15]), stiffness, 2.0, (0.5, 0.3), 60)
    i, j = (n.ravel() for n in np.meshgrid(np.arange(1, 200, 2), np.arange(1, 200), indexing="ij"))
    x, y = np.pi * i, np.pi * j / 0.15
    square = (D11 * x**4 + 2 * H * x**2 * y**2 + D22 * y**4) / 2.0
    shape = np.sin(np.pi * 0.3 * j)
    seen = np.abs(shape) > 1e-6
    order = np.argsort(square[seen])[:60]
    assert frequency == approx(np.sqrt(square[seen][order]) / (2 * np.pi))
    assert np.sort(mass) == approx(np.sort(2.0 * 0.15 / 4 / shape[seen][order] ** 2))


@pytest.mark.few(1)
@pytest.mark.parametrize("at", [0.5, 0.2])
def test_more_modes_change_less_and_less(at):
    """Of a beam with its static stiffness: 12, 24 and 48 of its modes."""
    e = [
        mdr.impact(
            BALL, SOFT, 0.05, 1.0, structure=mdr.Structure.beam(0.3, 50.0, 0.4, at=at, modes=n)
        ).restitution
        for n in (12, 24, 48, 200)
    ]
    errors = np.abs(np.array(e[:3]) - e[3])
    assert errors[2] < errors[0] / 4
    assert errors[2] < 1e-4


@pytest.mark.slow
def test_errors_cover_what_more_modes_change():
    """In seven of eight impacts of steel balls on plates, with 25 of the modes and with 100."""
    covered = []
    for seed in range(8):
        rng = np.random.default_rng(seed)
        sides, thickness, radius = (
            rng.uniform(0.08, 0.3, 2),
            rng.uniform(2e-3, 8e-3),
            rng.uniform(4e-3, 1.5e-2),
        )
        given = *sides, thickness, 70e9, 0.3, 2700.0
        few, many = (mdr.Structure.supported_isotropic_plate(*given, modes=n) for n in (25, 100))
        medium = mdr.Medium(65e9, hardness=10 ** rng.uniform(8.5, 9.5))
        given = mdr.Paraboloid(radius), medium, ball_mass(radius), rng.uniform(0.2, 3.0)
        hit, better = (mdr.impact(*given, structure=each) for each in (few, many))
        covered.append(abs(hit.restitution / better.restitution - 1) <= hit.errors.restitution)
    assert sum(covered) >= 7


def test_a_scene_with_modes_is_kept_as_json_and_as_python():
    beam = mdr.Structure.beam(0.3, 50.0, 0.4, modes=3, damping=0.01, thickness=0.01)
    scene = mdr.Scene(BALL, SOFT, mdr.scene.FreeImpact(0.05, 1.0, structure=beam))
    assert mdr.Scene.from_json(scene.to_json()) == scene
    names = {}
    exec(scene.to_python(), names)
    assert names["result"].restitution == scene.solve().restitution
    assert scene.models == ("modes",)


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (
            lambda: mdr.Structure.modal([100.0, 200.0], [1.0, 1.0], stiffness=1e9),
            "stiffness = 1e[+]09 N/m .* 315827",
        ),
        (lambda: mdr.Structure.modal([0.0, 200.0], [1.0, 1.0], stiffness=1e3), "stiffness .* frequency 0"),
        (lambda: mdr.Structure.modal([-1.0], [1.0]), "frequency"),
        (lambda: mdr.Structure.modal([1.0], [0.0]), "modal mass"),
        (lambda: mdr.Structure.modal([1.0, 2.0], [1.0, 1e62]), "modal mass.* node at the contact"),
        (lambda: mdr.Structure.modal([1.0, 2.0], [1.0, np.inf]), "modal mass.* node at the contact"),
        (lambda: mdr.Structure.modal([1.0], [1.0], damping=1.0), "damping ratio"),
        (lambda: mdr.Structure.modal([1.0, 2.0], [1.0, 2.0, 3.0]), "broadcast"),
        (lambda: mdr.Structure.beam(1.0, 1.0, 1.0, at=1.0), "at = 1"),
        (lambda: mdr.Structure.beam(1.0, 1.0, 1.0, modes=0), "modes = 0"),
        (lambda: mdr.Structure.supported_plate(0.2, 0.0, 1.0, 0.3, 1.0, 0.3, 1.0), "length"),
        (lambda: mdr.Structure.supported_plate(0.2, 0.2, 1.0, 2.0, 1.0, 0.3, 1.0), "D12"),
        (
            lambda: mdr.Structure.supported_plate(0.2, 0.2, 1.0, 0.3, 1.0, 0.3, 1.0, at=0.5),
            "at must be two",
        ),
        (lambda: mdr.Structure(10.0, modes=one_mode(1.0, 1.0).modes), "impedance"),
        (lambda: mdr.Structure(stiffness=[1.0, 2.0], modes=one_mode(9.0, 1.0).modes), r"shape \(2,\)"),
    ],
)
def test_structures_that_there_are_not(make, told):
    with pytest.raises(ValueError, match=told):
        make()


@pytest.mark.parametrize(
    ("solve", "told"),
    [
        (lambda s: mdr.impact(BALL, mdr.Medium(1e9, eta=1.0), 0.1, 1.0, structure=s), "viscosity eta"),
        (
            lambda s: mdr.impact(BALL, mdr.Medium(1e9, work_of_adhesion=1.0), 0.1, 1.0, structure=s),
            "adhesion",
        ),
        (lambda s: mdr.chain_impact(BALL, SOFT, 0.1, 1.0, structure=s), "modes"),
        (
            lambda s: mdr.impact(
                mdr.Sampled([0.0, 1e-3, 2e-3], [0.0, 1e-4, 4e-4]), SOFT, 5.0, 10.0, structure=s
            ),
            "deeper than the shape is known",
        ),
    ],
)
def test_what_is_not_solved_with_modes(solve, told):
    with pytest.raises(ValueError, match=told):
        solve(one_mode(1e6, 1e-2))


@pytest.mark.parametrize("share", [0.5, 1.02])
def test_a_force_that_falls_snaps_on_what_is_softer(share):
    """A flat face and a hardness f_c/a²: where 1/r of the missing modes is below the fall of the force."""
    tip, medium = mdr.TruncatedCone(1.0, 0.3), mdr.Medium(1.0, f_c=0.1 * 2 / np.pi)
    onset = float(mdr.yield_depth(tip, medium))
    fall = -float(mdr.indent(tip, medium, onset * (1 + 1e-9)).stiffness)
    mode = 0.5, 0.2
    given = 1 / (mode[1] * (2 * np.pi * mode[0]) ** 2)
    structure = mdr.Structure.modal(*mode, stiffness=1 / (given + 1 / (share * fall)))
    if share < 1:
        with pytest.raises(ValueError, match="1/r"):
            mdr.impact(tip, medium, 1.0, 2.0, structure=structure)
        # Before it yields it does not.
        assert mdr.impact(tip, medium, 1.0, 0.01, structure=structure).plastic_work == 0
    else:
        hit = mdr.impact(tip, medium, 1.0, 2.0, structure=structure)
        assert hit.max_depth > onset
        taken = hit.plastic_work + hit.structure_work
        assert 2 * (1 - hit.restitution**2) == approx(taken, rel=1e-7)
