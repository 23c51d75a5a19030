"""Impacts on a structure: a plate that carries waves away, a support that gives way."""

import pickle
import re

import numpy as np
import pytest
import scipy
from scipy.integrate import quad

import mdr_core as mdr

from ...approx import approx
from ...events import until
from ...laws import Layered, NixGao
from ...said import limit_of
from ...shapes import name

E, R, MASS, SPEED = 10e9, 5e-3, 4.1e-3, 5.0
ENERGY = MASS * SPEED**2 / 2
BALL = mdr.Paraboloid(R)
POLYGON = mdr.Sampled([0, 1e-4, 3e-4, 2e-3], [0, 5e-6, 4e-5, 8e-4])
ELASTIC, YIELDING = mdr.Medium(E), mdr.Medium(E, q_c=2e5)
SHAPES = (
    BALL,
    mdr.Sphere(R),
    mdr.Cone(0.3),
    mdr.PowerLaw(2e4, 3.0),
    mdr.PowerLaw(0.02, 0.5),
    mdr.FlatPunch(3e-4),
    mdr.TruncatedCone(2e-4, 0.3),
    mdr.TruncatedParaboloid(2e-4, R),
    mdr.RoundedPunch(2e-4, R),
    mdr.ParabolicPunch(R, 4e-4),
    mdr.Hyperboloid(0.3, 1e-3),
    mdr.RoundedCone(1e-3, 0.3),
    POLYGON,
)
#: Media of every class of hardness, and a law of one's own.
MEDIA = {
    "elastic": ELASTIC,
    "b": YIELDING,
    "a": mdr.Medium(E, hardness=3e8),
    "ab": mdr.Medium(E, q_c=5e4, hardness=2e8),
    "abc": mdr.Medium(E, q_c=5e4, hardness=1e8, f_c=20.0),
    "own law": mdr.Medium(E, hardness=NixGao(2e8, 1e-4)),
}
STRUCTURES = {
    "plate": mdr.Structure(346.0),
    "soft support": mdr.Structure(stiffness=2e6),
    "stiff support": mdr.Structure(stiffness=3e8),
}


def lost(hit):
    """Energy that has left the body, over its energy, by the ledger."""
    return (hit.plastic_work + hit.viscous_work + hit.structure_work) / (hit.mass * hit.speed**2 / 2)


def by_integration(profile, medium, structure):
    """Restitution, contact time, largest depth by DOP853 on the force of `indent`."""

    def force_and_stiffness(depth, largest):
        states = mdr.indent(profile, medium, [max(depth, largest), depth])
        return states.force[1], states.stiffness[1]

    def rates(largest, lost_at):
        def rate(_, state):
            depth, velocity = state
            if depth <= lost_at:
                return velocity, 0.0
            force, stiffness = force_and_stiffness(depth, largest)
            own = velocity - force / structure.impedance
            return own / (1 + stiffness / structure.stiffness), -force / MASS

        return rate

    def turning(_, state):
        if state[0] <= 0:
            return 1.0
        return state[1] - force_and_stiffness(state[0], 0.0)[0] / structure.impedance

    rigid = float(mdr.impact(profile, medium, MASS, SPEED).max_depth)
    kinks = [mdr.yield_depth(profile, medium), *profile.kinks]
    options = {"rtol": 1e-12, "atol": [1e-15 * rigid, 1e-15 * SPEED], "longest": 1e4 * rigid / SPEED}
    time, state = 0.0, [0.0, SPEED]
    for edge in [*sorted(float(k) for k in kinks if 0 < k < rigid), 2 * rigid]:

        def at_edge(_, state, edge=edge):
            return state[0] - edge

        which, time, state = until(rates(0.0, 0.0), (time, state), (turning, at_edge), **options)
        if which == 0:
            break
    largest = state[0]
    end = float(mdr.indent(profile, medium, largest).plastic_depth)

    # An elastic contact has the kinks of its loading.
    kinks = [float(k) for k in profile.kinks if end == 0 < k < largest]
    for edge in [*sorted(kinks, reverse=True), end]:

        def at_edge(_, state, edge=edge):
            return state[0] - edge

        _, time, state = until(rates(largest, end), (time, state), (at_edge,), **options)
    return -state[1] / SPEED, time, largest


# Six by default, of a second or two each; a law of one's own takes up to twenty, a polygon up to fifty.
@pytest.mark.slow
@pytest.mark.few(6)
@pytest.mark.parametrize("structure", STRUCTURES.values(), ids=STRUCTURES)
@pytest.mark.parametrize(
    "medium",
    [
        pytest.param(medium, id=key, marks=[pytest.mark.full] * (key == "own law"))
        for key, medium in MEDIA.items()
    ],
)
@pytest.mark.parametrize(
    "profile",
    [
        pytest.param(shape, id=name(shape), marks=[pytest.mark.full] * (shape is POLYGON))
        for shape in SHAPES
    ],
)
def test_every_combination_by_another_integrator(profile, medium, structure):
    if isinstance(profile, mdr.PowerLaw) and profile.exponent < 1 and not medium.inverse_to_radius:
        pytest.skip("a hardness H needs a convex shape")
    hit = mdr.impact(profile, medium, MASS, SPEED, structure=structure)
    restitution, time, depth = by_integration(profile, medium, structure)
    # The integrator has 10⁻¹² in each of some hundred steps, and some 10⁻¹¹ after all of them. Contact
    # ends slowly, so that its time has 10⁻⁹.
    assert hit.restitution == approx(restitution, abs=1e-10)
    assert hit.max_depth == approx(depth, rel=2e-10)
    if not hit.captured:
        assert hit.contact_time == approx(time, rel=2e-9)
    assert hit.restitution**2 + lost(hit) == approx(1.0, rel=1e-9)


@pytest.mark.parametrize(
    ("number", "restitution"),
    [(0.01, 0.9828761299), (0.1, 0.8433394109), (0.5, 0.4368953009), (1, 0.1841228742), (2, 0.0206825070)],
)
def test_zeners_ball_on_a_plate(number, restitution):
    """s″ + (1 + λ d/dτ) s^1.5 = 0 with λ = m^(3/5) (k² v)^(1/5)/Z, by another integrator to ten digits."""
    k = 4 / 3 * E * np.sqrt(R)
    impedance = MASS**0.6 * (k**2 * SPEED) ** 0.2 / number
    hit = mdr.impact(BALL, ELASTIC, MASS, SPEED, structure=mdr.Structure(impedance))
    assert hit.restitution == approx(restitution, abs=1e-10)
    assert hit.restitution**2 + lost(hit) == approx(1.0, rel=1e-12)


def test_a_slow_wave_takes_a_share_that_is_zeners():
    """de/dλ = −∫s³ dτ at λ = 0, of the Hertzian impact: 1.7301732871."""
    k, number = 4 / 3 * E * np.sqrt(R), 1e-6
    impedance = MASS**0.6 * (k**2 * SPEED) ** 0.2 / number
    hit = mdr.impact(BALL, ELASTIC, MASS, SPEED, structure=mdr.Structure(impedance))
    # The loss has the digits of the work of the waves, 1 − e only those of a difference.
    assert hit.structure_work / ENERGY / 2 / number == approx(1.7301732871, rel=1e-5)


@pytest.mark.parametrize("damping", [1e-6, 0.1, 0.5, 0.9, 0.99, 0.9999, 1 - 1e-9])
def test_a_flat_face_on_a_plate_is_a_damped_oscillator(damping):
    """m on a spring k and a dashpot 1/β in series: ζ = β √(k m)/2."""
    b = 1e-4
    k = 2 * E * b
    structure = mdr.Structure(np.sqrt(k * MASS) / (2 * damping))
    hit = mdr.impact(mdr.FlatPunch(b), ELASTIC, MASS, SPEED, structure=structure)
    root = np.sqrt((1 - damping) * (1 + damping))
    assert hit.restitution == approx(np.exp(-np.pi * damping / root), abs=1e-12)
    # ζ is known to rounding, and its distance from 1 so much worse.
    assert hit.contact_time == approx(np.pi / (np.sqrt(k / MASS) * root), rel=1e-12 + 1e-15 / root**2)
    assert hit.max_deflection == approx(
        MASS * SPEED * (1 + hit.restitution) / structure.impedance, rel=1e-13
    )
    assert not hit.captured


class TestABodyThatNeverLeaves:
    """Where τ_w² c ≥ 4μ."""

    @pytest.mark.parametrize("damping", [1.0 + 1e-12, 1.1, 30.0, 1e6])
    def test_a_flat_face(self, damping):
        b = 1e-4
        structure = mdr.Structure(np.sqrt(2 * E * b * MASS) / (2 * damping))
        hit = mdr.impact(mdr.FlatPunch(b), ELASTIC, MASS, SPEED, structure=structure)
        assert hit.captured
        assert hit.restitution == 0
        assert hit.contact_time == np.inf
        assert hit.structure_work == approx(ENERGY, rel=1e-14)
        assert hit.max_deflection == approx(MASS * SPEED / structure.impedance, rel=1e-14)

    @pytest.mark.parametrize("damping", [1.1, 30.0, 100.0])
    def test_the_motion_of_a_flat_face_is_that_of_the_overdamped_oscillator(self, damping):
        """d = v₀ (exp(−r₁t) − exp(−r₂t))/(r₂ − r₁) with the rates r = ω (ζ ∓ √(ζ² − 1))."""
        b = 1e-4
        structure = mdr.Structure(np.sqrt(2 * E * b * MASS) / (2 * damping))
        motion = mdr.impact(mdr.FlatPunch(b), ELASTIC, MASS, SPEED, structure=structure).motion(60)
        fast = np.sqrt(2 * E * b / MASS) * (damping + np.sqrt(damping**2 - 1))
        slow = 2 * E * b / MASS / fast
        depth = SPEED * (np.exp(-slow * motion.time) - np.exp(-fast * motion.time)) / (fast - slow)
        # Steps have 10⁻¹⁰ each, and there are a hundred; near first contact depths have it of the largest.
        np.testing.assert_allclose(motion.depth, depth, rtol=1e-8, atol=1e-10 * depth.max())
        assert motion.depth[-1] < 2e-3 * depth.max()

    def test_is_decided_by_the_radius_that_is_left(self):
        """Of a yielding contact by c, of a sharp elastic one never: there it leaves, however slowly."""
        for impedance in np.geomspace(20, 400, 10):
            hit = mdr.impact(BALL, YIELDING, MASS, SPEED, structure=mdr.Structure(impedance))
            held = (MASS / impedance) ** 2 * hit.plastic_radius * 2 * E >= 4 * MASS
            assert hit.captured == held
            assert hit.restitution**2 + lost(hit) == approx(1.0, rel=1e-9)
            assert not mdr.impact(BALL, ELASTIC, MASS, SPEED, structure=mdr.Structure(impedance)).captured

    def test_its_motion_goes_to_a_thousandth_of_the_force(self):
        hit = mdr.impact(BALL, YIELDING, MASS, SPEED, structure=mdr.Structure(60.0))
        motion = hit.motion(50)
        assert motion.live_depth[-1] == approx(1e-3 * hit.turning_point.live_interval.length, rel=1e-9)
        assert 0 < motion.body_velocity[-1] < 0.01 * SPEED

    def test_its_limits_say_that_plates_have_edges(self):
        hit = mdr.impact(BALL, YIELDING, MASS, SPEED, structure=mdr.Structure(60.0))
        edges = limit_of(hit, "edges")
        assert edges.exceeded
        assert edges.value == np.inf


@pytest.mark.parametrize("share", [1e-5, 1.0, 1e4])
def test_a_flat_face_on_a_support_is_two_springs(share):
    b = 1e-4
    k = 2 * E * b
    hit = mdr.impact(mdr.FlatPunch(b), ELASTIC, MASS, SPEED, structure=mdr.Structure(stiffness=share * k))
    both = k * share / (1 + share)
    assert hit.restitution == 1
    assert hit.contact_time == approx(np.pi * np.sqrt(MASS / both), rel=1e-12)
    assert hit.max_force == approx(SPEED * np.sqrt(both * MASS), rel=1e-13)
    assert hit.max_deflection == approx(hit.max_force / (share * k), rel=1e-13)


def test_a_drop_weight_on_a_simply_supported_plate():
    """ASTM D7136: 5.5 kg, 1 m/s, 16 mm on 75 × 125 × 4.5 mm; K by Navier's series."""
    thickness, modulus, nu, a, b = 4.5e-3, 25e9, 0.3, 0.075, 0.125
    bending = modulus * thickness**3 / 12 / (1 - nu**2)
    m, n = np.meshgrid(np.arange(1, 2001, 2), np.arange(1, 2001, 2))
    stiffness = bending * np.pi**4 * a * b / 4 / np.sum(1 / ((m / a) ** 2 + (n / b) ** 2) ** 2)
    assert stiffness == approx(2.33e6, rel=2e-3)
    medium = mdr.Medium(15e9, q_c=7e5)
    body = mdr.Sphere(8e-3), medium, 5.5, 1.0
    rigid, hit = mdr.impact(*body), mdr.impact(*body, structure=mdr.Structure(stiffness=stiffness))
    # The support takes most of the energy, and gives it back.
    assert hit.max_force < rigid.max_force
    assert hit.restitution > rigid.restitution
    energy = hit.stored_energy + hit.plastic_work + hit.max_force**2 / (2 * stiffness)
    assert energy == approx(5.5 / 2, rel=1e-12)


class TestRigid:
    ARGUMENTS = BALL, YIELDING, MASS, np.array([1.0, 5.0, 20.0])

    @pytest.mark.parametrize("structure", [mdr.Structure(), mdr.Structure(np.inf, np.full(3, np.inf))])
    def test_in_all_rows_is_none(self, structure):
        hit, rigid = mdr.impact(*self.ARGUMENTS), mdr.impact(*self.ARGUMENTS, structure=structure)
        assert all(np.array_equal(value, rigid.to_dict()[key]) for key, value in hit.to_dict().items())

    def test_adhesion_and_viscosity_are_as_ever(self):
        for medium in (mdr.Medium(E, work_of_adhesion=1.0), mdr.Medium(E, eta=1.0)):
            hit = mdr.impact(BALL, medium, MASS, SPEED, structure=mdr.Structure())
            assert hit.restitution == mdr.impact(BALL, medium, MASS, SPEED).restitution

    @pytest.mark.parametrize("beside", [{"impedance": [np.inf, 346.0]}, {"stiffness": [np.inf, 1e7]}])
    def test_beside_others(self, beside):
        hit = mdr.impact(BALL, YIELDING, MASS, SPEED, structure=mdr.Structure(**beside))
        alone = mdr.impact(BALL, YIELDING, MASS, SPEED)
        # The others are not solved in closed form, and this row with them.
        assert hit[0].restitution == approx(alone.restitution, rel=1e-12)
        assert hit[0].contact_time == approx(alone.contact_time, rel=1e-10)
        assert hit[0].max_deflection == hit[0].structure_work == 0

    @pytest.mark.parametrize("structure", [mdr.Structure(1e12), mdr.Structure(stiffness=1e18)])
    def test_is_the_limit(self, structure):
        hit, alone = (mdr.impact(BALL, YIELDING, MASS, SPEED, structure=s) for s in (structure, None))
        # The share of the structure is about 10⁻⁹.
        assert hit.restitution == approx(alone.restitution, rel=1e-8)
        assert hit.contact_time == approx(alone.contact_time, rel=1e-8)


def test_arrays_of_all_structures_at_once():
    structure = mdr.Structure([np.inf, 346.0, np.inf, 60.0], [np.inf, np.inf, 1e7, np.inf])
    hit = mdr.impact(BALL, YIELDING, MASS, SPEED, structure=structure)
    for i in range(4):
        alone = mdr.impact(BALL, YIELDING, MASS, SPEED, structure=structure.entries(i))
        assert hit[i].structure == structure.entries(i)
        for key, value in alone.to_dict().items():
            # Rounding: other lengths of arrays, of steps with 10⁻⁷.
            assert hit[i].to_dict()[key] == approx(value, rel=1e-9), key
    assert hit.captured.tolist() == [False, False, False, True]
    again = pickle.loads(pickle.dumps(hit))
    assert again.structure == structure
    assert again.restitution.tolist() == hit.restitution.tolist()


@pytest.mark.few(6)
@pytest.mark.parametrize("structure", STRUCTURES.values(), ids=STRUCTURES)
@pytest.mark.parametrize("medium", MEDIA.values(), ids=MEDIA)
def test_the_ledger_closes_at_every_instant(medium, structure):
    hit = mdr.impact(mdr.Sphere(R), medium, MASS, SPEED, structure=structure)
    motion = hit.motion(60)
    energy = motion.kinetic_energy + motion.stored_energy + motion.plastic_work
    energy += motion.structure_work + motion.support_energy
    # Between the nodes of a step the motion has 10⁻¹⁰.
    assert energy == approx(np.full(60, ENERGY), rel=1e-9)
    assert -motion.body_velocity[-1] == approx(hit.rebound_speed, abs=1e-8 * SPEED)
    assert motion.deflection.max() == approx(hit.max_deflection, rel=1e-7)
    assert motion.depth.max() == approx(hit.max_depth, rel=1e-7)
    # The velocity is the rate of the depth, and with that of the deflection the body's.
    fine = hit.motion(4001)
    middle = (fine.time[1:] + fine.time[:-1]) / 2
    for rate, path in ((fine.velocity, fine.depth), (fine.body_velocity, fine.depth + fine.deflection)):
        difference = np.diff(path) / np.diff(fine.time)
        means = np.interp(middle, fine.time, rate)
        # Differences and means are of second order; next to a kink of the path of first order.
        assert np.mean(np.abs(means - difference)) < 2e-4 * SPEED


def test_hits_on_an_imprint_lose_less_and_less_by_yield():
    depth, plate, yielded = 0.0, mdr.Structure(346.0), []
    for _ in range(4):
        hit = mdr.impact(BALL, YIELDING, MASS, SPEED, plastic_depth=depth, structure=plate)
        assert hit.restitution**2 + lost(hit) == approx(1.0, rel=1e-10)
        depth = hit.plastic_depth
        yielded.append(hit.plastic_work)
    assert np.all(np.diff(yielded) < 0)


class TestAForceThatFalls:
    """A flat face with slopes beside it, and a hardness f_c/a²: the force falls after the onset."""

    TIP, MEDIUM = mdr.TruncatedCone(1.0, 0.3), mdr.Medium(1.0, f_c=0.1 * 2 / np.pi)
    ONSET = float(mdr.yield_depth(TIP, MEDIUM))
    #: Largest slope by which it falls (N/m).
    FALL = -float(mdr.indent(TIP, MEDIUM, ONSET * (1 + 1e-9)).stiffness)

    def hit(self, stiffness, speed):
        return mdr.impact(self.TIP, self.MEDIUM, 1.0, speed, structure=mdr.Structure(stiffness=stiffness))

    def test_snaps_on_a_soft_support(self):
        assert self.FALL > 0
        with pytest.raises(ValueError, match=r"stiffness = .* the contact snaps") as refused:
            self.hit(0.5 * self.FALL, 1.0)
        assert refused.value.argument == "stiffness"

    @pytest.mark.parametrize("speed", [1.5, 3.0])
    def test_the_error_gives_the_steepest_fall(self, speed):
        """Here far below the onset: a hardness that falls at a radius. To the distance of the depths."""
        tip, medium = mdr.Paraboloid(1.0), mdr.Medium(1.0, hardness=Layered(0.14, 0.6, 1.0, 0.1))
        depth = float(mdr.yield_depth(tip, medium)) * np.geomspace(1.001, 100, 4000)
        steepest = -mdr.indent(tip, medium, depth).stiffness.min()

        def hit(stiffness):
            return mdr.impact(tip, medium, 1.0, speed, structure=mdr.Structure(stiffness=stiffness))

        with pytest.raises(ValueError, match="the contact snaps") as raised:
            hit(0.5 * steepest)
        bound = float(re.search(r"must exceed (\S+) N/m", str(raised.value))[1])
        assert bound == approx(steepest, rel=1e-4)
        assert hit(bound * (1 + 1e-4)).max_depth > 2
        with pytest.raises(ValueError, match="the contact snaps"):
            hit(bound * (1 - 1e-4))

    def test_does_not_before_it_yields(self):
        slow = 0.5 * np.sqrt(self.ONSET**2 * 2 * (1 + 2 / (0.5 * self.FALL)))
        hit = self.hit(0.5 * self.FALL, slow)
        assert hit.max_depth < self.ONSET
        assert hit.restitution == 1

    def test_does_not_on_a_stiffer_one(self):
        hit = self.hit(1.01 * self.FALL, 1.0)
        assert hit.max_depth > self.ONSET
        support = hit.turning_point.force**2 / (2 * 1.01 * self.FALL)
        assert hit.stored_energy + hit.plastic_work + support == approx(0.5, rel=1e-12)
        assert hit.motion(30).support_energy.max() <= hit.max_force**2 / (2 * 1.01 * self.FALL) * (
            1 + 1e-12
        )

    @pytest.mark.parametrize("structure", [mdr.Structure(5.0), mdr.Structure(stiffness=100.0)])
    def test_has_its_largest_force_at_the_onset(self, structure):
        hit = mdr.impact(self.TIP, self.MEDIUM, 1.0, 0.3, structure=structure)
        assert hit.max_depth > self.ONSET
        at_onset = float(mdr.indent(self.TIP, self.MEDIUM, self.ONSET).force)
        assert hit.max_force == approx(at_onset, rel=1e-9)
        assert hit.max_force > hit.turning_point.force


class TestStructures:
    def test_a_plate_is_an_isotropic_laminate(self):
        bending = 70e9 * 2e-3**3 / 12 / (1 - 0.33**2)
        plate = mdr.Structure.plate(2e-3, 70e9, 0.33, 2700.0)
        laminate = mdr.Structure.laminate(bending, 0.33 * bending, bending, bending * 0.335, 2700 * 2e-3)
        assert plate.impedance == approx(8 * np.sqrt(bending * 2700 * 2e-3), rel=1e-14)
        assert laminate.impedance == approx(plate.impedance, rel=1e-14)
        assert laminate.wave_spread == approx(plate.wave_spread, rel=1e-14)

    @pytest.mark.parametrize(
        "stiffnesses",
        [(135, 2.7, 9, 5), (80, 2.7, 60, 5), (1, 0, 1, 1e-9), (1, -0.9, 1, 0.1), (1, 0.9, 1, 50)],
    )
    def test_a_laminate_is_the_mean_over_directions(self, stiffnesses):
        D11, D12, D22, D66 = stiffnesses

        def slowness(angle):
            c, s = np.cos(angle), np.sin(angle)
            return (D11 * c**4 + 2 * (D12 + 2 * D66) * (c * s) ** 2 + D22 * s**4) ** -0.5

        mean = 2 / np.pi * quad(slowness, 0, np.pi / 2, epsabs=0, epsrel=1e-12, limit=200)[0]
        impedance = mdr.Structure.laminate(D11, D12, D22, D66, mass_per_area=4.0).impedance
        assert impedance == approx(8 * np.sqrt(4.0) / mean, rel=1e-11)

    def test_waves_are_back_from_an_edge(self):
        """Where Si(ξ) = π/2 with ξ = r²/(4 t √(D/ρh)), the way r to the edge and back."""
        xi = scipy.optimize.brentq(lambda x: scipy.special.sici(x)[0] - np.pi / 2, 1.5, 2.5)
        # It is 7.7058, written with three digits.
        assert 4 * xi == approx(7.70, abs=6e-3)

    @pytest.mark.parametrize(
        ("make", "message"),
        [
            (lambda: mdr.Structure(346.0, 1e7), r"stiffness = 1e\+07 N/m .* Structure\.modal"),
            (lambda: mdr.Structure(0.0), "impedance = 0 N·s/m must be positive"),
            (lambda: mdr.Structure(346.0, edge=-1.0), "edge = -1 m"),
            (lambda: mdr.Structure.plate(-4e-3, 50e9, 0.3, 1600.0), "thickness = -0.004 m"),
            (lambda: mdr.Structure.plate(4e-3, 50e9, 0.5, 1600.0), "nu = 0.5 must lie"),
            (lambda: mdr.Structure.laminate(1.0, 1.1, 1.0, 1.0, 1.0), "D12 = 1.1 N·m must be below"),
            (lambda: mdr.Structure.laminate(1.0, 0.1, 1.0, 0.0, 1.0), "D66 = 0 N·m"),
            (lambda: mdr.Structure.rod(1e-4, 0.0, 8000.0), "modulus E = 0 Pa"),
            (lambda: mdr.Structure([1.0, 2.0], edge=[1.0, 2.0, 3.0]), "do not broadcast"),
        ],
    )
    def test_refusals(self, make, message):
        with pytest.raises(ValueError, match=message):
            make()


class TestWhatIsRefused:
    PLATE = mdr.Structure(346.0)

    def test_dashpots(self):
        with pytest.raises(ValueError, match=r"eta = 1 Pa·s .*chain_impact"):
            mdr.impact(BALL, mdr.Medium(E, eta=1.0), MASS, SPEED, structure=self.PLATE)

    def test_dashpots_in_a_row_that_has_a_structure(self):
        medium = mdr.Medium(E, eta=np.array([1.0, 0.0]))
        hit = mdr.impact(BALL, medium, MASS, SPEED, structure=mdr.Structure([np.inf, 346.0]))
        alone = mdr.impact(BALL, mdr.Medium(E, eta=1.0), MASS, SPEED)
        # A block of two has other rounding.
        assert hit[0].viscous_work == approx(alone.viscous_work, rel=1e-9)
        assert hit[0].max_force == approx(alone.max_force, rel=1e-9)
        assert hit[1].viscous_work == hit[0].structure_work == 0
        assert hit[1].structure_work > 0
        with pytest.raises(ValueError, match=r"eta\[0\]"):
            mdr.impact(BALL, medium, MASS, SPEED, structure=mdr.Structure([346.0, np.inf]))

    def test_adhesion(self):
        with pytest.raises(ValueError, match=r"work_of_adhesion = 1 J/m² .* set work_of_adhesion = 0"):
            mdr.impact(BALL, mdr.Medium(E, work_of_adhesion=1.0), MASS, SPEED, structure=self.PLATE)

    def test_another_thing(self):
        with pytest.raises(TypeError, match="structure must be a Structure"):
            mdr.impact(BALL, ELASTIC, MASS, SPEED, structure=346.0)

    def test_the_fast_limit(self):
        hit = mdr.impact(BALL, mdr.Medium(E, q_c=1e4), MASS, SPEED, structure=self.PLATE)
        assert "fast limit" not in [limit.what for limit in hit.limits]
        with pytest.raises(ValueError, match=r"fast limit .*; leave the structure out"):
            _ = hit.fast_limit


class TestLimits:
    def limits(self, structure, speed=SPEED):
        hit = mdr.impact(BALL, ELASTIC, MASS, speed, structure=structure)
        return hit, {limit.what: limit for limit in hit.limits}

    def test_edges(self):
        near, far = (mdr.Structure.plate(4e-3, 50e9, 0.3, 1600.0, edge=x) for x in (0.05, 0.2))
        hit, limits = self.limits(near)
        bending = 50e9 * 4e-3**3 / 12 / (1 - 0.3**2)
        back = 0.1**2 / (7.70 * np.sqrt(bending / 1600 / 4e-3))
        assert limits["edges"].value == approx(hit.contact_time / back, rel=1e-12)
        assert limits["edges"].exceeded
        assert not self.limits(far)[1]["edges"].exceeded
        assert "edges" not in self.limits(mdr.Structure.plate(4e-3, 50e9, 0.3, 1600.0))[1]
        assert "wave_spread" in self.limits(mdr.Structure(346.0, edge=0.2))[1]["edges"].sentence

    def test_of_a_laminate_are_those_of_the_faster_wave(self):
        plate = mdr.Structure.laminate(400.0, 20.0, 100.0, 30.0, 6.4, edge=0.1)
        assert plate.wave_spread == approx(np.sqrt(400 / 6.4), rel=1e-14)

    def test_thin(self):
        assert not self.limits(mdr.Structure.plate(4e-3, 50e9, 0.3, 1600.0))[1]["thin"].exceeded
        hit, limits = self.limits(mdr.Structure.laminate(293.0, 88.0, 293.0, 103.0, 6.4, thickness=1e-3))
        assert limits["thin"].value == approx(hit.contact_radius / 0.5e-3, rel=1e-12)
        assert limits["thin"].exceeded
        thick = mdr.Structure.plate(0.1, 50e9, 0.3, 1600.0)
        hit, limits = self.limits(thick)
        assert limits["thin"].value == approx(6 * 0.1 / thick.shear_speed / hit.contact_time, rel=1e-12)
        assert "shear wave" in limits["thin"].sentence

    def test_a_support_has_no_edges(self):
        assert not {"edges", "thin"} & self.limits(mdr.Structure(stiffness=1e7))[1].keys()

    @pytest.mark.parametrize("side", [0.08, 0.2, 0.4])
    def test_a_second_contact_is_told_where_there_is_one(self, side):
        """By the modes of the same plate: two contacts of more than 1 % of the momentum."""
        plate = 4e-3, 50e9, 0.3, 1600.0
        _, limits = self.limits(mdr.Structure.plate(*plate, edge=side / 2))
        modes = mdr.Structure.supported_isotropic_plate(side, side, *plate)
        hits = mdr.impact(BALL, ELASTIC, MASS, SPEED, structure=modes).hits
        several = sum(hit.impulse > 0.01 * MASS * SPEED for hit in hits) > 1
        assert several == limits["second contact"].exceeded

    def test_the_mass_of_a_support(self):
        """A ball on a steel beam: 5.0 kN without its mass, 39.3 kN by 50 modes. D7136, which yields."""
        radius, length, line_mass = 0.07, 0.78, 7850 * 0.06 * 0.0278
        beam = mdr.Structure.beam(length, 206e9 * 0.06 * 0.0278**3 / 12, line_mass)
        ball = mdr.Paraboloid(radius), mdr.Medium(206e9 / 0.91 / 2), 4 / 3 * np.pi * radius**3 * 7850, 1.0
        support = mdr.Structure(stiffness=beam.stiffness, mass=line_mass * length / 2)
        hit = mdr.impact(*ball, structure=support)
        limit = limit_of(hit, "support")
        by_modes = mdr.impact(*ball, structure=beam)
        assert by_modes.max_force > 7 * hit.max_force
        assert limit.exceeded
        # One mode is an estimate of fifty.
        assert 0.5 < limit.value / (by_modes.max_force / hit.max_force - 1) < 2
        drop = mdr.Paraboloid(8e-3), mdr.Medium(10e9, q_c=4e5), 5.5, 1.0
        support = mdr.Structure(stiffness=2.332e6, mass=0.075 * 0.125 * 4.5e-3 * 1600 / 4)
        limit = limit_of(mdr.impact(*drop, structure=support), "support")
        assert not limit.exceeded
        assert limit.value < 0.01

    def test_without_a_mass_a_support_says_how_to_give_one(self):
        _, limits = self.limits(mdr.Structure(stiffness=1e7))
        assert not limits["support"].exceeded
        assert "with a mass of the structure" in limits["support"].sentence

    def test_deflection_dent_and_weight(self):
        plate = mdr.Structure.laminate(293.0, 88.0, 293.0, 103.0, 6.4, thickness=1e-3)
        hit, limits = self.limits(plate, 50.0)
        assert limits["deflection"].value == approx(hit.max_deflection / 0.5e-3, rel=1e-12)
        assert limits["dent"].value == 0
        assert "weight" not in limits
        dented = mdr.impact(BALL, mdr.Medium(E, hardness=1e8), MASS, SPEED, structure=plate)
        dent = limit_of(dented, "dent")
        assert dent.value == approx(dented.plastic_depth / 0.5e-3, rel=1e-12)
        slow, limits = self.limits(mdr.Structure(stiffness=100.0), 0.1)
        assert limits["weight"].value == approx(9.81 * slow.contact_time / 0.1, rel=1e-12)
        assert limits["weight"].level == "note"

    def test_a_plate_that_only_follows_the_body_is_named(self):
        force = mdr.impact(BALL, ELASTIC, MASS, SPEED).max_force
        with pytest.raises(ValueError, match="Λ") as refused:
            mdr.impact(BALL, ELASTIC, MASS, SPEED, structure=mdr.Structure(0.01, thickness=1e-3))
        assert f"{force / (0.01 * SPEED):.3g}" in str(refused.value)
        assert f"{MASS * SPEED / 0.01 / 1e-3:.3g} thicknesses" in str(refused.value)


class TestHardCases:
    """Random impacts: a closed ledger, a body that never leaves, or a refusal."""

    @pytest.mark.few(20)
    @pytest.mark.parametrize("seed", range(200))
    def test_closes_the_ledger(self, seed):
        rng = np.random.default_rng(seed)
        modulus, length = 10 ** rng.uniform(3, 12), 10 ** rng.uniform(-8, 0)
        profile = [
            lambda: mdr.Paraboloid(length),
            lambda: mdr.Sphere(length),
            lambda: mdr.Cone(rng.uniform(0.05, 0.6)),
            lambda: mdr.TruncatedCone(0.1 * length, 0.3),
            lambda: mdr.FlatPunch(length),
            lambda: mdr.RoundedCone(length, 0.3),
            lambda: mdr.ParabolicPunch(length, 0.1 * length),
            lambda: mdr.RoundedPunch(0.1 * length, length),
            lambda: mdr.PowerLaw(0.1 * length ** (1 - (n := rng.uniform(1, 6))), n),
        ][seed % 9]()
        depth = min(length * 10 ** rng.uniform(-5, -1), 0.5 * float(profile.known_depth))
        elastic = mdr.indent(profile, mdr.Medium(modulus), depth)
        mass = 10 ** rng.uniform(-12, 3)
        speed = float(np.sqrt(2 * elastic.stored_energy / mass))
        critical = depth * 10 ** rng.uniform(-8, 1)
        hardness = float(elastic.mean_pressure) * 10 ** rng.uniform(-2, 0.5)
        medium = [
            mdr.Medium(modulus),
            mdr.Medium.from_critical_depth(modulus, critical_depth=critical),
            mdr.Medium(modulus, hardness=hardness),
        ][rng.integers(3)]
        if rng.random() < 0.5:
            structure = mdr.Structure(mass * speed / depth / 10 ** rng.uniform(-6, 1))
        else:
            structure = mdr.Structure(stiffness=float(elastic.stiffness) * 10 ** rng.uniform(-5, 5))
        try:
            hit = mdr.impact(profile, medium, mass, speed, structure=structure)
        except ValueError:
            # Too deep for the shape, on a rigid body as well.
            with pytest.raises(ValueError, match="presses deeper"):
                mdr.impact(profile, medium, mass, speed)
            return
        energy = mass * speed**2 / 2
        if structure.is_support:
            # e is from the balance itself: what is taken up is compared with what was given.
            taken = hit.stored_energy + hit.plastic_work + hit.max_deflection**2 * structure.stiffness / 2
            assert taken == approx(energy, rel=1e-9)
        else:
            bound = 1e-9 if hit.restitution >= 1e-3 else 1e-8
            assert hit.restitution**2 + lost(hit) == approx(1.0, rel=bound)


def test_a_scene_on_a_structure_is_solved_by_its_script():
    for structure in (mdr.Structure.plate(4e-3, 50e9, 0.3, 1600.0), mdr.Structure(stiffness=1e7)):
        scene = mdr.Scene(BALL, YIELDING, mdr.scene.FreeImpact(MASS, SPEED, structure=structure))
        hit = scene.solve()
        assert hit.restitution == mdr.impact(BALL, YIELDING, MASS, SPEED, structure=structure).restitution
        names = {}
        exec(scene.to_python(), names)
        assert names["result"].restitution == hit.restitution


def test_models_of_a_scene():
    def models(medium, **drive):
        return mdr.Scene(BALL, medium, mdr.scene.FreeImpact(MASS, SPEED, **drive)).models

    plate, support = mdr.Structure(346.0), mdr.Structure(stiffness=1e7)
    assert models(YIELDING, structure=plate) == ("scalar ODE", "chain")
    assert models(YIELDING, structure=support) == ("closed form", "scalar ODE", "chain")
    assert models(mdr.Medium(E, eta=1.0), structure=plate) == ("chain",)
    scene = mdr.Scene(BALL, YIELDING, mdr.scene.FreeImpact(MASS, SPEED, structure=support))
    exact, in_time = scene.solve(), scene.solve("scalar ODE")
    # The steps of the second have 10⁻⁷ between their nodes.
    assert in_time.restitution == approx(exact.restitution, rel=1e-10)
    assert in_time.contact_time == approx(exact.contact_time, rel=1e-9)


def test_the_mass_of_a_support_is_estimated_for_the_worst_of_many_impacts():
    """Where the contact yields the mass hides: the excess of an elastic impact among others is told."""
    support = mdr.Structure(stiffness=5e6, mass=0.02, thickness=4e-3)
    given = mdr.Paraboloid(8e-3), mdr.Medium(10e9, q_c=1.6e6), 5.5
    speed = np.array([0.6, 1.0, 2.0, 2.6])

    def told(hit):
        limit = limit_of(hit, "support")
        return limit

    many = mdr.impact(*given, speed, structure=support)
    alone = [told(many[i]) for i in range(speed.size)]
    assert told(many).exceeded == any(each.exceeded for each in alone)
    assert told(many).value == approx(max(each.value for each in alone if each.exceeded), rel=0.05)


def test_a_wide_contact_on_a_support_of_known_thickness_is_told():
    support = mdr.Structure(stiffness=5e6, thickness=2e-3)
    hit = mdr.impact(mdr.Paraboloid(8e-3), mdr.Medium(10e9, q_c=1.6e6), 5.5, 2.0, structure=support)
    thin = limit_of(hit, "thin")
    assert thin.exceeded
    assert thin.value == approx(2 * float(hit.contact_radius) / 2e-3)
