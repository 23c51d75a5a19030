"""Adhesion: closed limits, 40 digits, balances of energy, and a chain whose rim springs are torn."""

import math

import numpy as np
import pytest

import mdr_core as mdr

from ...approx import approx
from ...said import limit_of

mpmath = pytest.importorskip("mpmath")
mp, mpf = mpmath.mp, mpmath.mpf
E_STAR, Q_C, W, R, SLOPE, B = 1e9, 8.0, 2e-3, 1e-6, 0.2, 1e-7
ELASTIC, YIELDING = mdr.Medium(E_STAR, work_of_adhesion=W), mdr.Medium(E_STAR, q_c=Q_C, work_of_adhesion=W)
D_C = float(YIELDING.critical_depth)
SHAPES = {
    "paraboloid": (mdr.Paraboloid(R), lambda x: x * x / mpf(R), lambda x: 2 * x / mpf(R)),
    "cone": (mdr.Cone(SLOPE), lambda x: mp.pi / 2 * mpf(SLOPE) * x, lambda x: mp.pi / 2 * mpf(SLOPE)),
    "sphere": (
        mdr.Sphere(R),
        lambda x: x * mp.atanh(x / mpf(R)),
        lambda x: mp.atanh(x / mpf(R)) + x * mpf(R) / ((R - x) * (R + x)),
    ),
}
OTHERS = [
    mdr.FlatPunch(B),
    mdr.TruncatedCone(B, SLOPE),
    mdr.ParabolicPunch(R, 2 * B),
    mdr.RoundedCone(R, 0.1),
]
NODE, WEIGHT = (
    (1 + np.polynomial.legendre.leggauss(400)[0]) / 2,
    np.polynomial.legendre.leggauss(400)[1] / 2,
)
#: Loading, unloading below the surface, pull-off, contact on the imprint, deeper, unloading.
PATH = D_C * np.array([-0.1, 0.0, 0.4, -0.01, -2.0, -0.01, 0.2, 3.0, 2.6, 2.02, 1.5, 1.95, 2.0, 3.5, 2.52])


def stretch(a):
    return mp.sqrt(2 * mp.pi * a * mpf(W) / mpf(E_STAR))


def reference(g, slope, d, d_p):
    """Radius, force, and pressure at half of the radius, in 40 digits, on the stable branch."""
    with mp.workdps(40):
        d, d_p = mpf(float(d)), mpf(float(d_p))
        low, high = mpf("1e-12"), mpf("0.9e-6")
        # Of the two roots of g − Δl = d the outer one: g′ > Δl/(2a).
        for _ in range(140):
            a = (low + high) / 2
            if g(a) - stretch(a) < d or slope(a) < stretch(a) / (2 * a):
                low = a
            else:
                high = a
        c = mp.findroot(lambda x: g(x) - d_p, (a / 3, a)) if d_p else mpf(0)
        D, r = g(a), a / 2
        force = 2 * mpf(E_STAR) * (
            mp.quad(lambda x: D - max(g(x), d_p), [0, c, a] if c else [0, a]) - a * stretch(a)
        )  # fmt: skip
        inner = max(c, r)
        # x² = inner² + t² takes the singularity away.
        ring = mp.quad(
            lambda t: slope(mp.sqrt(r * r + t * t)) / mp.sqrt(r * r + t * t),
            [mp.sqrt(inner**2 - r**2), mp.sqrt(a * a - r * r)],
        )
        pressure = mpf(E_STAR) / mp.pi * (ring - stretch(a) / mp.sqrt(a * a - r * r))
        return float(a), float(force), float(r), float(pressure)


@pytest.mark.few(3)
@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("medium", [ELASTIC, YIELDING], ids=["elastic", "yielding"])
def test_states_agree_with_40_digits(name, medium):
    profile, g, slope = SHAPES[name]
    states = mdr.indent(profile, medium, PATH)
    touching = np.flatnonzero(states.contact_radius)
    assert 0 < touching.size < PATH.size
    for i in touching:
        a, force, r, pressure = reference(g, slope, PATH[i], states.plastic_depth[i])
        # Rounding of the live depth, 1e-16 of 3 d_c, over distances from the fold of 0.01 d_c.
        assert states.contact_radius[i] == approx(a, rel=1e-12)
        assert states.force[i] == approx(force, rel=1e-11)
        assert states[i].pressure(r) == approx(pressure, rel=1e-10)
    # The same states under their forces, where these can be held: that of a path in depth goes further.
    held = touching[(states.force[touching] > -0.5 * states.pull_off_force[touching])]
    again = mdr.indent_to_force(profile, medium, states.force[held])
    assert again.depth == approx(PATH[held], rel=1e-10)


def test_pull_off_forces_are_jkrs_and_kendalls():
    assert mdr.indent(mdr.Paraboloid(R), ELASTIC, 0.0).pull_off_force == approx(
        1.5 * math.pi * W * R, rel=1e-14
    )
    kendall = math.sqrt(8 * math.pi * W * E_STAR * B**3)
    assert mdr.indent(mdr.FlatPunch(B), ELASTIC, 0.0).pull_off_force == approx(kendall, rel=1e-14)
    # At the rim of the imprint the pull-off is that of a punch of its radius.
    for profile in (mdr.Paraboloid(R), mdr.Cone(SLOPE), mdr.Sphere(R)):
        deep = mdr.indent(profile, YIELDING, 20 * D_C)
        kendall = math.sqrt(8 * math.pi * W * E_STAR * deep.plastic_radius**3)
        assert deep.pull_off_force == approx(kendall, rel=1e-13), profile


@pytest.mark.parametrize("medium", [ELASTIC, YIELDING], ids=["elastic", "yielding"])
@pytest.mark.parametrize("profile", [SHAPES["cone"][0], SHAPES["sphere"][0], *OTHERS], ids=repr)
def test_the_pull_off_force_is_the_largest_tension_on_unloading(profile, medium):
    down = np.linspace(2.0, -0.5, 40001) * D_C
    path = mdr.indent(profile, medium, down)
    # The maximum is flat, or at the end of the contact, which the path meets to 1e-4 of Δl.
    assert path.force.min() == approx(-path.pull_off_force[0], rel=1e-3)
    assert path.force.min() >= -path.pull_off_force[0] * (1 + 1e-12)


@pytest.mark.parametrize("medium", [ELASTIC, YIELDING], ids=["elastic", "yielding"])
@pytest.mark.parametrize("profile", [SHAPES["cone"][0], SHAPES["sphere"][0], *OTHERS], ids=repr)
def test_force_is_the_derivative_of_the_energy(profile, medium):
    step = 1e-5 * D_C
    middle = np.append(np.linspace(0.1, 3.0, 12), np.linspace(2.95, 2.1, 6)) * D_C
    path = np.concatenate([middle + step * side for side in (-1, 0, 1)]).reshape(3, -1).T
    path[12:] = path[12:, ::-1]
    if medium is ELASTIC or profile is not OTHERS[0]:
        state = mdr.indent(profile, medium, path.ravel())
        energy = (state.stored_energy + state.surface_energy + state.plastic_work).reshape(-1, 3)
        rate = (energy[:, 2] - energy[:, 0]) / (path[:, 2] - path[:, 0])
        # Truncation 1e-10, rounding 1e-16/1e-5; kinks lie between the depths.
        assert state.force[1::3] == approx(rate, rel=1e-7)
        rate = (state.force[2::3] - state.force[::3]) / (path[:, 2] - path[:, 0])
        assert state.stiffness[1::3] == approx(rate, rel=1e-5, abs=1e-7 * E_STAR * B)


@pytest.mark.few(2)
@pytest.mark.parametrize("name", ["paraboloid", "cone"])
@pytest.mark.parametrize("d_c", [math.inf, D_C])
def test_a_chain_with_torn_springs_agrees(name, d_c):
    """Elements close where they touch, and the rim moves as long as springs there tear or catch."""
    profile, g, _ = SHAPES[name]
    x = (np.arange(40000) + 0.5) * (0.4e-6 / 40000)
    height, limit = np.array([float(g(one)) for one in x]), np.sqrt(2 * np.pi * x * W / E_STAR)
    set_, count, force, radius = np.zeros(x.size), 0, [], []
    # At d = 0 no element touches.
    depths = PATH + 1e-3 * D_C
    for d in depths:
        stretched = height + set_ - d
        if count == 0:
            count = int(np.count_nonzero(stretched <= 0))
        while 0 < count < x.size and stretched[count] < limit[count]:
            count += 1
        while count and stretched[count - 1] > limit[count - 1]:
            count -= 1
        set_ = np.where(np.arange(x.size) < count, np.maximum(set_, d - height - d_c), set_)
        force.append(2 * E_STAR * (d - height - set_)[:count].sum() * (x[1] - x[0]))
        radius.append(count * (x[1] - x[0]))
    medium = mdr.Medium(E_STAR, q_c=Q_C if d_c < math.inf else math.inf, work_of_adhesion=W)
    path = mdr.indent(profile, medium, depths)
    # One element is 1e-11 m; the force at the rim is E* Δl of it.
    assert path.contact_radius == approx(np.array(radius), abs=3e-11)
    assert path.force == approx(np.array(force), abs=3e-3 * np.abs(force).max())


def test_without_adhesion_nothing_changes():
    none = mdr.Medium(E_STAR, q_c=Q_C, work_of_adhesion=0.0)
    path = PATH[2:]
    for profile in (mdr.Cone(SLOPE), mdr.Sphere(R)):
        plain = mdr.indent(profile, mdr.Medium(E_STAR, q_c=Q_C), path)
        assert (mdr.indent(profile, none, path).force == plain.force).all(), profile
        # Δl is √(w/E*): of 1e-30 J/m² it is 1e-14 of the depths.
        faint = mdr.indent(profile, mdr.Medium(E_STAR, q_c=Q_C, work_of_adhesion=1e-36), path)
        assert faint.force == approx(plain.force, rel=1e-9, abs=1e-12 * plain.force.max()), profile
    assert none == mdr.Medium(E_STAR, q_c=Q_C)


def test_fields_are_balanced():
    for depth in ([2 * D_C], [2 * D_C, 1.2 * D_C], [2 * D_C, D_C]):
        state = mdr.indent(mdr.Cone(SLOPE), YIELDING, depth)[-1]
        a, c = state.contact_radius, state.plastic_radius
        # r = a sin t takes the singularity of the rim away; at r = c the pressure has a vertical tangent.
        edge = np.arcsin(c / a)
        t = np.concatenate([edge * NODE, edge + (np.pi / 2 - edge) * NODE])
        weight = np.concatenate([edge * WEIGHT, (np.pi / 2 - edge) * WEIGHT])
        integral = (state.pressure(a * np.sin(t)) * np.sin(2 * t) * np.pi * a * a * weight).sum()
        assert integral == approx(state.force, rel=1e-4)
        r = np.linspace(0, 0.999, 7) * a
        whole = state.surface(r) + state.imprint(r)
        assert whole == approx(state.depth - mdr.Cone(SLOPE).height(r), rel=1e-9, abs=1e-9 * D_C)
        stress = state.stress(0.5 * a, [0.0, 1e-4 * a])
        assert -stress.zz[0] == approx(state.pressure(0.5 * a), rel=1e-12)
        assert stress.zz[1] == approx(stress.zz[0], rel=1e-3)
        assert [state.pressure(a), state.pressure(1.001 * a)] == [-math.inf, 0]
        assert state.line_load(0.999999 * a) < 0
    punch = mdr.indent(mdr.FlatPunch(B), ELASTIC, [1e-9, -1e-10])
    assert [one.pressure(B) for one in punch] == [math.inf, -math.inf]


def test_energy_of_separation_is_johnson_and_pollocks():
    """W_a = k (w⁵R⁴/E*²)^(1/3), with a₀^(3/2) = √(2π) and a₁^(3/2) = a₀^(3/2)/4 in units w = R = E* = 1."""
    with mp.workdps(40):
        k = mp.sqrt(2 * mp.pi)

        def energy(a):
            d = a * a - k * mp.sqrt(a)
            return mp.quad(lambda x: (d - x * x) ** 2, [0, a]) - mp.pi * a * a

        expected = float(energy((k / 4) ** (mpf(2) / 3)) - energy(k ** (mpf(2) / 3)))
    assert expected == approx(7.092196, abs=5e-7)
    hit = mdr.impact(mdr.Paraboloid(R), ELASTIC, 1e-12, np.array([1e-3, 1.0]))
    work = expected * (W**5 * R**4 / E_STAR**2) ** (1 / 3)
    assert hit.captured.tolist() == [True, False]
    assert hit.adhesive_work[1] == approx(work, rel=1e-12)
    assert hit.restitution == approx([0.0, math.sqrt(1 - work / 0.5e-12)], rel=1e-12)
    low, high = mdr.capture_speeds(mdr.Paraboloid(R), ELASTIC, 1e-12)
    assert low == approx(math.sqrt(2 * work / 1e-12), rel=1e-10)
    assert high == math.inf


@pytest.mark.parametrize("profile", [*(each[0] for each in SHAPES.values()), *OTHERS[:3]], ids=repr)
def test_energies_of_impacts_sum_to_the_kinetic_energy(profile):
    speed = np.geomspace(1e-3, 0.5, 40)
    if isinstance(profile, mdr.FlatPunch):
        speed = speed[speed < 0.2]
    hit = mdr.impact(profile, YIELDING, 1e-12, speed)
    kinetic = 0.5e-12 * speed**2
    total = hit.restitution**2 * kinetic + hit.plastic_work + hit.adhesive_work
    # The depth to rounding, with energies of adhesion of up to ten times the kinetic one.
    assert total == approx(kinetic, rel=1e-10)
    low, high = mdr.capture_speeds(profile, YIELDING, 1e-12)
    assert (hit.captured == ((speed < low) | (speed > high))).all()
    assert np.isinf(hit.contact_time[hit.captured]).all()
    # The deepest states of ascending speeds are those of one loading, to the rounding of the depth.
    state = mdr.indent(profile, YIELDING, hit.max_depth)
    assert hit.max_force == approx(state.force, rel=1e-9, abs=1e-9 * np.abs(state.force).max())
    assert hit.plastic_depth == approx(state.plastic_depth, rel=1e-9, abs=1e-12 * D_C)
    edge = mdr.impact(profile, YIELDING, 1e-12, low * np.array([1 - 1e-6, 1 + 1e-6]))
    assert edge.captured.tolist() == [True, False]


def test_a_cone_bounces_between_two_speeds():
    cone = mdr.Cone(SLOPE)
    hit = mdr.impact(cone, YIELDING, 1e-12, np.array([0.1, 1.0, 30.0, 36.0]))
    # Two digits of an independent chain.
    assert hit.restitution[:3] == approx([0.92, 0.33, 0.024], rel=0.03)
    high = mdr.capture_speeds(cone, YIELDING, 1e-12)[1]
    edge = mdr.impact(cone, YIELDING, 1e-12, high * np.array([1 - 1e-6, 1 + 1e-6]))
    assert edge.captured.tolist() == [False, True]
    assert mdr.capture_speeds(cone, YIELDING, [1e-12, 4e-12])[1] == approx([high, high / 2])
    # For large w/q_c there is no such window, without adhesion no end.
    strong = mdr.Medium(E_STAR, q_c=0.1, work_of_adhesion=1.0)
    assert np.isnan(mdr.capture_speeds(cone, strong, 1e-12)).all()
    assert mdr.capture_speeds(cone, mdr.Medium(E_STAR, q_c=Q_C), 1e-12) == (0.0, math.inf)


def test_the_end_of_an_impact_is_the_pull_off():
    """Contact time against steps of a tenth of a percent, and a second impact on the imprint."""
    hit = mdr.impact(mdr.Cone(SLOPE), YIELDING, 1e-12, 0.1)
    turn, low = float(hit.max_depth), float(hit.max_depth) - D_C - 1e-8
    path = np.append(
        turn - turn * np.linspace(1, 0, 20001) ** 2, turn - (turn - low) * np.linspace(0, 1, 20001) ** 2
    )
    states = mdr.indent(mdr.Cone(SLOPE), YIELDING, path)
    energy = states.stored_energy + states.surface_energy + states.plastic_work
    velocity = np.sqrt(np.maximum(0.1**2 - 2e12 * (energy - energy[0]), 0.0))
    held = (states.contact_radius > 0)[1:]
    mean = (velocity[1:] + velocity[:-1]) / 2
    time = (np.abs(np.diff(path))[held & (mean > 0)] / mean[held & (mean > 0)]).sum()
    assert hit.contact_time == approx(time, rel=1e-3)
    again = mdr.impact(mdr.Cone(SLOPE), YIELDING, 1e-12, 0.1, plastic_depth=hit.plastic_depth)
    total = again.restitution**2 * 0.5e-14 + again.plastic_work + again.adhesive_work
    assert total == approx(0.5e-14, rel=1e-10)
    assert again.restitution > hit.restitution


def test_limits_say_tabors_parameter():
    state = mdr.indent(mdr.Paraboloid(R), ELASTIC, 1e-9)
    limit = next(each for each in state.limits if "Tabor" in each.what)
    assert limit.value == approx((R * W**2 / (E_STAR**2 * 0.3e-9**3)) ** (1 / 3))
    assert (limit.exceeded, limit.bound) == (True, 5)
    assert not any("Tabor" in each.what for each in mdr.indent(mdr.Cone(SLOPE), ELASTIC, 1e-9).limits)


@pytest.mark.parametrize(("count", "exceeded"), [(20, True), (50, True), (200, False), (1000, False)])
def test_limits_say_what_facets_change(count, exceeded):
    """The pull-off of a paraboloid is 3π w R/2; the facets here reach 20 of its contact radii."""
    r = np.linspace(0, 20 * (9 * math.pi * W * R**2 / (8 * E_STAR)) ** (1 / 3), count)
    tip = mdr.Sampled(r, r**2 / (2 * R))
    state = mdr.indent(tip, ELASTIC, 1e-9)
    limit = limit_of(state, "facets")
    error = state.pull_off_force / (1.5 * math.pi * W * R) - 1
    assert limit.exceeded == exceeded == (error > limit.bound)
    if not exceeded:
        # With many facets in the contact the estimate is good to its leading term.
        assert limit.value == approx(error, rel=0.3)


def test_samples_of_a_cone_have_no_facets():
    """Their slope is one; neither have samples without adhesion."""
    r = np.linspace(0, 1e-6, 50)
    for tip, medium in (((r, SLOPE * r), ELASTIC), ((r, r**2 / R), mdr.Medium(E_STAR))):
        limits = mdr.indent(mdr.Sampled(*tip), medium, 1e-9).limits
        assert "facets" not in {each.what for each in limits}
    media = mdr.Medium(E_STAR, work_of_adhesion=np.array([[0.0], [W]]))
    limits = mdr.indent(mdr.Sampled(r[::9], r[::9] ** 2 / R), media, [[0.0]]).limits
    assert "facets" in {each.what for each in limits}


def test_a_rim_that_jumps_from_facet_to_facet_names_the_way_out():
    """A smooth tip of the same shape bounces as the paraboloid does, to the rounding of the fit."""
    r = np.linspace(0, 1e-7, 200)
    fit = np.polynomial.Polynomial.fit(r**2, r**2 / (2 * R), 1, domain=[0, 1e-14])
    samples, smooth = mdr.Sampled(r, r**2 / (2 * R)), mdr.Smooth(lambda x: 2 * x * fit.deriv()(x**2), 1e-6)
    for call in (
        lambda tip: mdr.impact(tip, ELASTIC, 1e-15, 0.1).restitution,
        lambda tip: mdr.capture_speeds(tip, ELASTIC, 1e-15)[0],
        lambda tip: mdr.indent_to_force(tip, ELASTIC, 1e-9).depth,
    ):
        with pytest.raises(ValueError, match=r"Sampled .* Smooth"):
            call(samples)
        assert call(smooth) == approx(call(mdr.Paraboloid(R)), rel=1e-9)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: mdr.Medium(1e9, work_of_adhesion=-1.0), "work of adhesion .*not negative"),
        (lambda: mdr.Medium(1e9, work_of_adhesion=math.nan), "work of adhesion"),
        (lambda: mdr.Medium(1e9, eta=1.0, work_of_adhesion=1.0), "viscosity"),
        (lambda: mdr.indent(mdr.PowerLaw(1.0, 0.5), ELASTIC, 1e-9), "spreads without limit"),
        (lambda: mdr.indent_in_time(mdr.Cone(0.2), ELASTIC, [0, 1e-9], [0, 1]), "path in time"),
        (lambda: mdr.chain_impact(mdr.Cone(0.2), ELASTIC, 1e-12, 1.0), "chain"),
        (lambda: mdr.oblique_impact(mdr.Cone(0.2), ELASTIC, 1e-12, 1.0, 1.0, 0.1), "oblique"),
        (lambda: mdr.impact(mdr.Cone(0.2), ELASTIC, 1e-12, 1.0).motion(), "motion"),
        (lambda: mdr.indent(mdr.Sampled([0, 1e-6], [0, 1e-7]), ELASTIC, 1.57e-7), "adhesion"),
        (
            lambda: mdr.impact(mdr.Sampled([0, 1e-7], [0, 3e-8]), YIELDING, 1e-12, 50.0),
            "reduce speed or mass",
        ),
    ],
)
def test_what_is_not_modelled_is_refused(call, words):
    with pytest.raises(ValueError, match=words):
        call()


def test_pull_off_of_a_rim_that_only_a_given_depth_holds():
    """Outside the edge of the face the tension falls on unloading: the present one is the largest."""
    medium = mdr.Medium(1e6, work_of_adhesion=0.05)
    path = mdr.indent(mdr.TruncatedCone(1e-6, 0.05), medium, [0.0, 1e-7, 0.5e-7, 0.0])
    assert (np.diff(path.force[1:]) > 0).all()
    np.testing.assert_allclose(path.pull_off_force[1:], -path.force[1:], rtol=1e-12)
