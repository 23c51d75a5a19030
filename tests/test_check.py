"""Whatever is handed in: a right answer, or an error that says what is wrong and what to do."""

import itertools
import re
import threading

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.base import check
from mdr_core.show.synonyms import SYNONYMS, plain

from .approx import approx

MEDIUM = mdr.Medium(1e9, q_c=10.0)
HIT = mdr.impact(mdr.Cone(0.3), MEDIUM, 1e-9, 1.0)
STATE = mdr.indent(mdr.Cone(0.3), MEDIUM, 1e-9)
PRESSED = mdr.indent(
    mdr.Cone(0.3), MEDIUM, np.append(np.linspace(0, 1e-6, 50), np.linspace(1e-6, 9.9e-7, 50))
)


@pytest.mark.parametrize(
    "depth",
    [np.float32(2.0**-20), np.array(2.0**-20), np.longdouble(2.0**-20)],
    ids=["float32", "0-d", "longdouble"],
)
def test_kinds_of_numbers_do_not_matter(depth):
    """The same double, in whatever NumPy type it comes."""
    cone = mdr.Cone(0.3)
    assert mdr.indent(cone, MEDIUM, depth).force == mdr.indent(cone, MEDIUM, 2.0**-20).force
    hit = mdr.impact(mdr.Cone(np.float32(0.25)), MEDIUM, depth, np.int8(2))
    assert hit.max_depth == mdr.impact(mdr.Cone(0.25), MEDIUM, 2.0**-20, 2.0).max_depth


def outcome(function, value, **rules):
    """What a check gives or refuses of a value, apart from its type and the index of an entry."""
    try:
        return np.ravel(function("length", value, **rules)).tolist()
    except ValueError as error:
        return error.text.replace("one real number", "real numbers").partition(", got")[0]


@pytest.mark.parametrize("infinite", [False, True])
@pytest.mark.parametrize("zero", [False, True])
def test_a_number_is_checked_as_the_array_of_it(infinite, zero):
    """Inside, on and beyond each bound; bool, text and integers that are no double, too."""
    bounds = [0.0, -0.0, 1e-25, 1e25, 1e-60, 1e60, 1e140, np.inf, np.nan, 1e-26, 1e26, 1e-61, 1e61, 1e141]
    others = (3, -3, 2**53 + 1, 10**20, 10**400, True, "1", np.float32(2))
    for value in (*bounds, *np.negative(bounds), *others):
        for unit in ("", "m"):
            rules = {"unit": unit, "zero": zero, "infinite": infinite}
            one, many = (outcome(check.positive, each, **rules) for each in (value, [value]))
            assert one == many, value
            one, many = (outcome(check.finite_array, each, unit=unit) for each in (value, [value]))
            assert one == many, value


@pytest.mark.parametrize(
    "shape", [mdr.Cone([0.1, 0.2]), mdr.FlatPunch([1e-6, 2e-6]), mdr.Sphere([1.0, 2.0])]
)
def test_geometry_of_many_indenters(shape):
    """Radii and depths broadcast against the indenters."""
    for function in ("height", "reduced", "contact_radius"):
        many = getattr(shape, function)([[0.0], [1e-7]])
        one = [getattr(shape.entries(i), function)([0.0, 1e-7]) for i in range(2)]
        # A few roundings, of arrays of other lengths.
        np.testing.assert_allclose(many, np.transpose(one), rtol=2e-15)
        with pytest.raises(ValueError, match=r"\(3,\), indenters \(2,\) do not broadcast"):
            getattr(shape, function)([1e-7, 2e-7, 3e-7])


def nested(depth):
    value = 1.0
    for _ in range(depth):
        value = [value]
    return value


def test_arrays_stay_what_they_are():
    """Empty ones give empty ones, and read-only ones are taken."""
    assert mdr.indent(mdr.Cone(0.3), MEDIUM, []).force.shape == (0,)
    assert mdr.impact(mdr.Smooth(lambda r: 0.3 + 0 * r), MEDIUM, 1e-9, []).contact_time.shape == (0,)
    assert mdr.impact(mdr.Sphere([]), MEDIUM, 1.0, 1.0).max_depth.shape == (0,)
    depth = np.array([1e-6, 2e-6])
    depth.setflags(write=False)
    assert mdr.indent(mdr.Cone(0.3), MEDIUM, depth).force.shape == (2,)


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: mdr.hardness_class([], [], 1.0), "at least two different energies"),
        (
            lambda: mdr.Foundation(mdr.Cone([0.1, 0.2]), MEDIUM, 10, 1e-6),
            "a single indenter and a single medium",
        ),
        (
            lambda: mdr.chain_impact(mdr.Cone(0.1), mdr.Medium([1e9, 2e9]), 1.0, 1.0),
            "a single indenter and a single medium",
        ),
        (lambda: mdr.chain_impact(3, MEDIUM, 1.0, 1.0), "profile must be an mdr_core shape"),
        (lambda: mdr.Foundation(mdr.Cone(0.1), MEDIUM, 10**9, 1e-6), "even whole number up to 1e.07"),
        (lambda: mdr.Medium(nested(40)), r"E_star must be real numbers, got \[\[\[\[\[\[\[\.\.\."),
        (
            lambda: mdr.indent(nested(2000), MEDIUM, 1.0),
            r"an mdr_core shape such as .*, got \[\[\[\[\[\[\[",
        ),
        (lambda: mdr.Medium(np.longdouble("1e4000")), "E_star = inf Pa must be finite"),
        (
            lambda: mdr.Cone(np.ma.array([1.0, 2.0], mask=[0, 1])),
            "slope must be real numbers, got masked_array",
        ),
        (lambda: mdr.abel.kappa([1.0, [2.0]]), "exponent n must be real numbers"),
        (lambda: mdr.Scene.from_json(b'{"\xff"'), "scene: not UTF-8 text"),
        (lambda: mdr.indent_to_force(mdr.Cone(0.1), MEDIUM, 1e-300), "must be 0 or at least 1e-60"),
        (lambda: mdr.Sampled(np.arange(10**6), np.arange(10**6)), "1000000 samples, more than 5000; thin"),
    ],
)
def test_refusals_name_the_bound_and_the_remedy(make, says):
    with pytest.raises((ValueError, TypeError), match=says):
        make()


def test_an_imprint_deeper_than_the_shape_is_refused():
    tip = mdr.Sampled([0.0, 1e-8], [0.0, 1e-9])
    with pytest.raises(ValueError, match="plastic_depth = 1e-07 m is deeper than the shape is known"):
        mdr.impact(tip, MEDIUM, 1e-9, 0.1, plastic_depth=1e-7)


def test_forces_of_any_span_have_their_depths():
    """A path from nN to N: unloaded parts are found as well as the peak."""
    force = [3.8e-9, 9.4e-6, 1.5e-11, 3.8]
    for shape in (mdr.TruncatedCone(1e-3, 0.1), mdr.Cone(2e-8)):
        result = mdr.indent_to_force(shape, mdr.Medium(2e9), force)
        # Depths of a virgin elastic medium do not depend on the past.
        np.testing.assert_allclose(result.force, force, rtol=1e-12)


class TestBigFiles:
    def test_a_long_table_is_refused(self, tmp_path):
        path = tmp_path / "tip.csv"
        path.write_text("r (nm), z (nm)\n" + "".join(f"{i}, {i}\n" for i in range(10**6)))
        with pytest.raises(ValueError, match="more than 5000 samples: give fewer samples"):
            mdr.Sampled.from_csv(path)

    @pytest.mark.parametrize("text", ["[" * 10**7, '{"a":' * 10**6, "9" * 10**7, b"\xff" * 10**6])
    def test_deep_and_wide_json_is_refused(self, text):
        with pytest.raises(ValueError, match="scene: "):
            mdr.Scene.from_json(text)

    @pytest.mark.parametrize("depth", [33, 64, *range(980, 1000)])
    def test_a_number_that_is_deep_is_refused(self, depth):
        """Deep enough to be too much for NumPy, and for what quotes it, in a scene that is JSON."""
        scene = mdr.Scene(mdr.Cone(0.3), MEDIUM, mdr.scene.DepthPath(1e-6)).to_json()
        with pytest.raises(ValueError, match="scene"):
            mdr.Scene.from_json(scene.replace("1000000000.0", "[" * depth + "1" + "]" * depth))

    def test_a_wide_path_is_read(self):
        scene = mdr.Scene(mdr.Cone(0.3), MEDIUM, mdr.scene.DepthPath(np.linspace(0, 1e-6, 10**5)))
        assert mdr.Scene.from_json(scene.to_json()) == scene


def test_eight_threads_get_the_same_results():
    """On shapes that remember what they have computed, from the first call on."""

    def everything(shape):
        hit = mdr.impact(shape, mdr.Medium(1e9, q_c=10.0), 1e-9, [1e-3, 0.1])
        state = hit[1].turning_point
        return np.hstack([hit.max_depth, hit.restitution, hit.contact_time, state.pressure([0.0, 1e-8])])

    def fresh():
        r = np.linspace(0.0, 1e-5, 12)
        return mdr.Sampled(r, r**2 / 2e-5), mdr.Smooth(lambda r: r / 1e-5), mdr.RoundedCone(1e-6, 0.3)

    expected = [everything(shape) for shape in fresh()]
    shared, results, start = fresh(), [None] * 8, threading.Barrier(8)

    def work(i):
        start.wait()
        results[i] = [everything(shape) for shape in shared]

    threads = [threading.Thread(target=work, args=(i,)) for i in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for result in results:
        for one, other in zip(result, expected, strict=True):
            # Half a table would be wrong in its first digits.
            np.testing.assert_allclose(one, other, rtol=1e-13)


def test_a_contact_beyond_double_precision_is_refused():
    with pytest.raises(ValueError, match="depth = 1000 m has a contact beyond double precision"):
        mdr.indent(mdr.PowerLaw(1.0, 0.01), MEDIUM, 1e3)
    with pytest.raises(ValueError, match=r"depth = 1e\+140 m is beyond 1e\+25; give it in SI units"):
        mdr.indent(mdr.Paraboloid(1e-6), MEDIUM, 1e140)


def test_what_rounding_leaves_for_zero_is_taken():
    """sin π of a force, and the last digit of an imprint: less than the shortest length and force."""
    cone = mdr.Cone(0.3)
    path = mdr.indent_to_force(cone, MEDIUM, 1e-12 * np.sin([np.pi / 2, np.pi]))
    # Elastic: d ∝ √F, so that √(sin π) of the depth is left.
    assert path.depth[1] == approx(np.sqrt(np.sin(np.pi)) * path.depth[0], rel=1e-12)
    # A part of 10⁻²⁰ of the depth is less than its rounding.
    fresh, again = (mdr.impact(cone, MEDIUM, 1e-12, 0.1, plastic_depth=d).max_depth for d in (0.0, 1e-30))
    assert again == approx(fresh, rel=1e-12)


def test_stress_at_a_radius_next_to_nothing():
    """The stress of q = 1 − x² at the axis is that at any radius that is small enough."""
    x = np.linspace(0, 1, 11)
    stress = mdr.abel.stress_from_line_load(x, 1 - x * x, [1e-30, 1e-60, 0.0])
    np.testing.assert_allclose(stress, stress[2], rtol=1e-13)
    with pytest.raises(ValueError, match="radius r = 1e-300 m must be 0 or lie between 1e-60 and"):
        mdr.abel.stress_from_line_load(x, 1 - x * x, 1e-300)


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: mdr.Cone(angle=20), r"Cone has no parameter 'angle'; it has slope\. .*from_half_angle"),
        (lambda: mdr.Sphere(R=1.0), r"Sphere has no parameter 'R'; it has radius\. .*half of the diameter"),
        (lambda: mdr.Medium(E=1e9), r"Medium has no parameter 'E'; it has E_star, q_c, eta, .*from_bodies"),
        (lambda: mdr.Medium(1e9, viscosity=1.0), "Medium has no parameter 'viscosity'; .*`eta`"),
        (
            lambda: mdr.impact(mdr.Cone(0.3), MEDIUM, mass=1.0, velocity=1),
            r"impact has no parameter 'velocity'; it has profile, medium, mass, speed, .*`speed`",
        ),
        (
            lambda: mdr.indent(mdr.Cone(0.3), MEDIUM, load=1.0),
            "indent has no parameter 'load'; it has profile, .*indent_to_force",
        ),
        (
            lambda: mdr.Medium.from_bodies(E=210e9, nu=0.3),
            r"Medium\.from_bodies has no parameter 'E'; it has E1, nu1, .*`E1` and `nu1` are E and ν",
        ),
        (
            lambda: mdr.Medium.from_hardness(1e9, 1e9, 1e-6, E=1.0),
            "Medium has no parameter 'E'; .*from_bodies",
        ),
        (
            lambda: mdr.impact(mdr.Cone(0.3), MEDIUM, mass=1.0, speed=1.0, angle=0.3),
            "impact has no parameter 'angle'; .*oblique_impact",
        ),
        (
            lambda: mdr.chain_impact(mdr.Cone(0.3), MEDIUM, mass=1.0, speed=1.0, friction=0.3),
            "chain_impact has no parameter 'friction'; .*oblique_impact",
        ),
        (lambda: mdr.Cone.from_half_angle(angle=70), "has no parameter 'angle'; it has degrees"),
        (
            lambda: mdr.Sampled.from_csv("tip.csv", units="nm"),
            "has no parameter 'units'; it has path, unit",
        ),
    ],
)
def test_an_unknown_keyword_is_told_what_there_is(make, says):
    with pytest.raises(TypeError, match=says):
        make()


@pytest.mark.parametrize(
    ("owner", "name", "says"),
    [
        (mdr, "Berkovich", r"mdr_core has no 'Berkovich': take mdr_core\.Cone\.berkovich\(\)"),
        (mdr, "Paraboloide", "has no 'Paraboloide'; did you mean 'Paraboloid'"),
        (mdr, "xyzzy", "mdr_core has no 'xyzzy'$"),
        (mdr.indent(mdr.Cone(0.3), MEDIUM, 1e-9), "forse", "this Indentation has no 'forse'; .* 'force'"),
        (
            mdr.impact(mdr.Cone(0.3), MEDIUM, 1e-9, 1.0),
            "depth",
            "this Impact has no 'depth'; .*'max_depth'",
        ),
        # What the field calls so comes before the nearest spelling.
        (mdr, "JKR", r"take mdr_core\.Paraboloid\(radius\) on a Medium\(E_star, work_of_adhesion=w\)"),
        (mdr, "Sneddon", r"take mdr_core\.Cone\.from_half_angle"),
        (mdr, "Vickers", r"take mdr_core\.Cone\.berkovich\(\)"),
        (mdr, "DMT", r"work_of_adhesion=w.*Tabor's parameter"),
        (mdr, "Hertz", r"take mdr_core\.Paraboloid"),
        (mdr, "CubeCorner", r"from_half_angle\(42\.28\)"),
        (HIT, "e", "this Impact has no 'e'; did you mean 'restitution'"),
        (HIT, "cor", "did you mean 'restitution'"),
        (HIT, "load", "did you mean 'max_force'"),
        (HIT, "displacement", "did you mean 'max_depth'"),
        (HIT, "velocity", r"did you mean 'speed' \(before the impact\) and 'rebound_speed' \(after"),
        (STATE, "load", "this Indentation has no 'load'; did you mean 'force'"),
        (STATE, "p0", "did you mean 'max_pressure'"),
        (STATE, "displacement", "did you mean 'depth'"),
        (STATE, "E", r"did you mean 'medium', .*\.E_star"),
        # Fields have no class attribute.
        (mdr.indent(mdr.Cone(0.3), MEDIUM, 1e-9), "depht", "this Indentation has no 'depht'; .* 'depth'"),
    ],
)
def test_an_unknown_name_is_told_the_nearest_one(owner, name, says):
    with pytest.raises(AttributeError, match=says):
        getattr(owner, name)


MOTION, SLID = HIT.motion(3), mdr.oblique_impact(mdr.Cone(0.3), MEDIUM, 1e-9, 1.0, 0.1, 0.1)
RESULTS = (STATE, HIT, MOTION, SLID, mdr.oliver_pharr(mdr.Cone(0.3), PRESSED.depth, PRESSED.force))


@pytest.mark.parametrize("result", RESULTS, ids=lambda result: type(result).__name__)
@pytest.mark.parametrize("row", SYNONYMS, ids=lambda row: row.words[0])
def test_a_word_of_the_field_leads_to_what_a_result_has_for_it(row, result):
    """The quantities that are meant, all of which it has; without them no other one is guessed."""
    has = next((names for names in row.meanings if all(hasattr(result, name) for name in names)), ())
    for word in row.words:
        name = re.sub(r"[ -]", "_", word.replace("'", ""))
        if not hasattr(result, name):
            with pytest.raises(AttributeError) as error:
                getattr(result, name)
            assert re.findall(r"'(\w+)'", str(error.value).partition(";")[2].partition(":")[0]) == [*has]


def test_each_word_of_the_field_has_one_meaning():
    words = [plain(word) for row in SYNONYMS for word in row.words]
    assert len(words) == len(set(words))


@pytest.mark.parametrize("result", RESULTS, ids=lambda result: type(result).__name__)
def test_no_energy_depth_or_velocity_is_taken_for_another_one_that_is_spelled_alike(result):
    """A misspelled one is still found: "plasitc_work"."""
    for last in ("energy", "work", "depth", "speed", "velocity"):
        for first in ("adsorbed", "total", "stripped", "crushed", "max_plastic"):
            with pytest.raises(AttributeError, match="has no") as error:
                getattr(result, f"{first}_{last}")
            assert "did you mean" not in str(error.value)
    for right in ("plastic_work", "stored_energy", "rebound_speed", "plastic_depth"):
        if hasattr(result, right):
            with pytest.raises(AttributeError, match=f"did you mean '{right}'"):
                getattr(result, right[1] + right[0] + right[2:])


@pytest.mark.parametrize(
    ("name", "cone", "area"),
    [("Vickers", mdr.Cone.berkovich(), 24.504), ("CubeCorner", mdr.Cone.from_half_angle(42.28), 2.598)],
)
def test_cones_of_pyramids_have_their_area(name, cone, area):
    """A = area h²: 4 tan²68° of Vickers, 3√3/2 of a corner of a cube; to 0.1 %, as the cone is given."""
    with pytest.raises(AttributeError, match=r"take mdr_core\.Cone"):
        getattr(mdr, name)
    assert np.pi / cone.slope**2 == approx(area, rel=1e-3)


#: Names of models, shapes and materials that the package does not have, and words for its arguments.
TRIED = (
    "Berkovich Brinell Cattaneo Conical Conospherical COR Coulomb CubeCorner Cylinder DMT HalfSpace Hertz "
    "JKR Johnson KelvinVoigt Material Maugis Maxwell Mindlin Punch Pyramid read_csv Sample "
    "Sneddon SphericalIndenter Substrate Thornton Vickers Viscoelastic"
)
WORDS = (
    "angle theta R diameter E modulus nu velocity energy gamma adhesion viscosity tau H poisson_ratio mu "
    "force load displacement time critical_depth"
)
CALLED = (
    mdr.Cone, mdr.Cone.from_half_angle, mdr.Cone.pyramid, mdr.Sphere, mdr.Medium, mdr.Medium.from_bodies,
    mdr.impact, mdr.chain_impact, mdr.oblique_impact, mdr.indent, mdr.indent_to_force,
)  # fmt: skip


def test_what_a_hint_names_is_there():
    """Functions and classes of the package, and parameters and quantities of results."""
    texts = []
    for name in TRIED.split():
        with pytest.raises(AttributeError, match=": take ") as unknown:
            getattr(mdr, name)
        texts.append(str(unknown.value))
    for function, word in itertools.product(CALLED, WORDS.split()):
        # A word that is a parameter is taken, and others are missing.
        with pytest.raises(TypeError) as unknown:
            function(**{word: 1.0})
        texts.append(str(unknown.value))
    called = r"\b((?:[A-Z]\w+|indent\w*|impact|oblique_impact|creep|at_angle)(?:\.\w+)?)\("
    named = set(re.findall(called, " ".join(texts)))
    assert len(named) > 15
    for name in named:
        thing = mdr
        for part in name.split("."):
            thing = getattr(thing, part)
