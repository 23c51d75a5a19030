"""Sampled tips: exact for their polygon, and careful with what a file may hold."""

import math
import re

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.solver.profiles.sampled import tip_through
from mdr_core.solver.profiles.samples import axis_of_symmetry

from ...approx import approx
from ...shapes import integrate, lower_hull

MEDIUM = mdr.Medium(1e9, q_c=1.0)
D_C = MEDIUM.critical_depth
HISTORIES = ((0.4,), (3.0,), (100.0,), (1000.0, 999.5))
# What is left of a tip of 10 µm curvature with a noise of 2 nm.
_R = np.linspace(0.0, 1e-5, 2000)
_NOISE = 2e-9 * np.random.default_rng(11).standard_normal(_R.size) * (_R > 0)
HULL = mdr.Sampled(*lower_hull(_R, _R**2 / 2e-5 + np.abs(_NOISE)))


def states(first, second, history):
    path = np.array(history) * D_C
    return mdr.indent(first, MEDIUM, path)[-1], mdr.indent(second, MEDIUM, path)[-1]


def assert_same(sampled, exact, tolerance):
    for field in ("contact_radius", "force", "stored_energy", "plastic_work", "stiffness"):
        assert getattr(sampled, field) == approx(getattr(exact, field), rel=tolerance), field
    r = np.array([1e-3, 0.3, 0.9, 0.999, 1.5]) * exact.contact_radius
    np.testing.assert_allclose(sampled.pressure(r), exact.pressure(r), rtol=50 * tolerance)
    np.testing.assert_allclose(sampled.surface(r), exact.surface(r), rtol=50 * tolerance)


@pytest.mark.parametrize("count", [2, 7, 100])
def test_polygon_of_a_cone_is_the_cone(count):
    r = np.linspace(0, 1e-4, count)
    tip, cone = mdr.Sampled(r, 0.3 * r), mdr.Cone(0.3)
    x = np.geomspace(1e-9, 0.99e-4, 40)
    np.testing.assert_allclose(tip.reduced(x), cone.reduced(x), rtol=1e-13)
    np.testing.assert_allclose(tip.height(x), cone.height(x), rtol=1e-13)
    for history in HISTORIES:
        assert_same(*states(tip, cone, history), 1e-14)


def test_samples_of_a_cone_at_uneven_distances_are_not_concave():
    """Slopes over distances of 1 pm to 1 µm differ by 3·10⁻¹⁰, the rounding of the heights."""
    r = np.append(0.0, np.cumsum(np.tile([1e-6, 1e-12, 1e-9, 1e-6, 1e-10], 8)))
    assert np.ptp(np.diff(0.3 * r) / np.diff(r)) > 1e-10
    np.testing.assert_allclose(mdr.Sampled(r, 0.3 * r).reduced(r), mdr.Cone(0.3).reduced(r), rtol=1e-14)
    # A bend of 10⁻⁸ is none of rounding.
    with pytest.raises(ValueError, match=r"concave at r\[15\]"):
        mdr.Sampled(r, 0.3 * r - 1e-8 * np.maximum(r - r[15], 0.0))


@pytest.mark.parametrize("history", HISTORIES)
def test_polygon_with_a_flat_face_is_the_truncated_cone(history):
    b = 1e-6
    tip = mdr.Sampled([0, b, 1e-4], [0, 0, 0.3 * (1e-4 - b)])
    # The slope between the samples carries their rounding, amplified by up to a/(a − c) = 15,000 in the
    # stiffness while yielding.
    assert_same(*states(tip, mdr.TruncatedCone(b, 0.3), history), 1e-11)


def test_refined_polygon_converges():
    """Chords of a parabola: with the contact edge on a vertex the force error falls as h²."""
    radius, a = 1e-3, 0.8e-4
    exact = mdr.Paraboloid(radius)

    def error(count):
        r = np.linspace(0, 1e-4, count + 1)
        tip = mdr.Sampled(r, r * r / (2 * radius))
        depth = tip.reduced(a)
        return abs(
            mdr.indent(tip, mdr.Medium(1e9), depth).force / mdr.indent(exact, mdr.Medium(1e9), depth).force
            - 1
        )

    rates = [math.log2(error(n) / error(2 * n)) for n in (10, 20, 40)]
    # The last chord before the edge counts with a square root: between 1.5 and 2.
    assert all(1.3 < rate < 2.2 for rate in rates), rates


def test_pressure_integrates_to_the_force():
    r = np.linspace(0, 1e-5, 25)
    tip = mdr.Sampled(r, r**3 / 1e-10 + 0.05 * r)
    state = mdr.indent(tip, MEDIUM, 5 * D_C)
    edges = np.unique([*r[r < state.contact_radius], state.plastic_radius, state.contact_radius])
    force = integrate(lambda r: 2 * math.pi * r * state.pressure(r), edges)
    # The logarithms at the vertices cost the adaptive quadrature some digits.
    assert force == approx(state.force, rel=1e-8)


def test_heights_count_from_the_first_sample():
    r = np.array([0, 1e-6, 2e-6])
    assert mdr.Sampled(r, [5.0, 5.25, 5.75]) == mdr.Sampled(r, [0.0, 0.25, 0.75])


def test_radius_at_the_height_of_a_polygon():
    """On its facets, at the edge of a flat face, and ∞ where it is not known."""
    tip = mdr.Sampled([0.0, 1e-6, 2e-6, 4e-6], [0.0, 0.0, 1e-7, 7e-7])
    radius = tip.radius_at_height(np.array([0.0, 5e-8, 1e-7, 4e-7, 7e-7, 7.1e-7]))
    np.testing.assert_allclose(radius, [1e-6, 1.5e-6, 2e-6, 3e-6, 4e-6, np.inf], rtol=1e-15)


@pytest.mark.parametrize(
    ("r", "z", "says"),
    [
        ([0, 1, 2], [0, 2, 3], r"concave at r\[1\] = 1 m"),
        ([0, 1, 1], [0, 2, 3], r"Sampled r\[2\] = 1 m does not ascend"),
        ([0.1, 1], [0, 2], r"r\[0\] = 0.1 m must be 0"),
        ([0, 1], [0, 0], "flat throughout"),
        ([0, 1, 2], [0, -1, 3], r"z\[1\] = -1 m is below the tip"),
        ([0], [0], "two lists of the same length"),
        ([0, 1], [0, 1, 2], "two lists of the same length"),
        ([0, 1], [0, math.nan], r"Sampled z\[1\] = nan m"),
        ([0, "one"], [0, 1], "Sampled r must be real numbers"),
    ],
)
def test_bad_samples_are_refused(r, z, says):
    with pytest.raises(ValueError, match=says):
        mdr.Sampled(r, z)


def test_deeper_than_measured_is_refused():
    tip = mdr.Sampled([0, 1e-6], [0, 1e-7])
    # The whole tip: (π/2) z at its last sample.
    assert mdr.indent(tip, MEDIUM, math.pi / 2 * 1e-7 * (1 - 1e-15)).contact_radius == approx(1e-6)
    with pytest.raises(ValueError, match=r"depth\[1\] = 1.6e-07 m is deeper than the shape is known, 1.57"):
        mdr.indent(tip, MEDIUM, [0, 1.6e-7])
    with pytest.raises(ValueError, match=r"radius r = 1\.1e-06 m must not exceed .*, 1e-06 m"):
        tip.height(1.1e-6)
    with pytest.raises(ValueError, match="presses deeper than the shape is known"):
        mdr.indent_to_force(tip, MEDIUM, 1.0)
    with pytest.raises(ValueError, match="presses deeper than the shape is known"):
        mdr.impact(tip, MEDIUM, 1.0, 1.0)


def test_impact_of_the_polygon_of_a_paraboloid():
    """Chords of a paraboloid: energy is kept, and results come as close as the polygon does."""
    r = np.linspace(0.0, 3e-6, 40)
    polygon, exact = mdr.Sampled(r, r**2 / 2e-5), mdr.Paraboloid(1e-5)
    dry = mdr.impact(exact, mdr.Medium(1e9, q_c=10.0), 1e-9, 0.03)
    medium = mdr.Medium(1e9, q_c=10.0, eta=0.3 * dry.contact_time * 1e9 / 4)
    hits = [mdr.impact(shape, medium, 1e-9, 0.03) for shape in (polygon, exact)]
    for quantity in ("max_depth", "restitution", "contact_time"):
        # The chords lie above the curve by 1/8 of the squared spacing over R: 10⁻³ of the height.
        assert getattr(hits[0], quantity) == approx(getattr(hits[1], quantity), rel=5e-3), quantity
    lost = (hits[0].plastic_work + hits[0].viscous_work) / (1e-9 * 0.03**2 / 2)
    assert hits[0].restitution ** 2 + lost == approx(1, rel=1e-9)


TIPS = {
    # Straight but for rounding: vertices that are none.
    "straight": (
        np.append(0, np.geomspace(1e-4, 1, 399)) / 0.35809,
        np.append(0, np.geomspace(1e-4, 1, 399)),
    ),
    "three scales": ([0.0, 1.0, 1.0001, 1e5], [0.0, 1.0, 1.00021, 4e5]),
    "next to nothing, then flat to 1": ([0.0, 1e-9, 1.0], [0.0, 0.0, 0.3]),
    "a face and a corner next to it": ([0.0, 1e-6, 1.000001e-6, 1e-5], [0.0, 0.0, 1e-13, 5e-6]),
    "six decades": ([0.0, *np.geomspace(1e-9, 1e-3, 7)], [0.0, *np.geomspace(1e-9, 1e-3, 7) ** 1.5]),
    "convex hull of a noisy tip": (HULL.r, HULL.z),
}


@pytest.mark.parametrize("tip", TIPS)
class TestInverse:
    """g(a(d)) = d, on every side of every vertex, whatever the ratios of the radii."""

    @staticmethod
    def assert_inverted(tip, depth):
        a = tip.contact_radius(depth)
        # Behind a vertex g rises with a vertical tangent: only between neighbours of a can it be told that
        # the depth is passed, but for the few roundings of g itself.
        below, above = (tip.reduced(np.minimum(a * (1 + k), tip.r[-1])) for k in (-1e-15, 1e-15))
        assert np.all(below <= depth * (1 + 4e-15))
        assert np.all(above >= depth * (1 - 4e-15))

    def test_everywhere(self, tip):
        tip = mdr.Sampled(*TIPS[tip])
        least = min(k for k in (*tip.kinks, tip.known_depth))
        depth = np.geomspace(1e-12 * least, tip.known_depth, 3000)
        depth[-1] = tip.known_depth
        self.assert_inverted(tip, depth)
        # Behind a flat face neighbours may differ by less than their roundings.
        a = tip.contact_radius(depth)
        assert np.all(np.diff(a) >= -4e-16 * a[1:])

    def test_some_units_of_rounding_around_the_vertices(self, tip):
        tip = mdr.Sampled(*TIPS[tip])
        steps = 1 + np.finfo(float).eps * np.arange(-4, 5)
        depth = (np.array(tip.kinks)[:, None] * steps).ravel()
        depth = np.append(depth, tip.known_depth * steps[:5])
        self.assert_inverted(tip, depth)

    def test_the_deepest_itself_is_known(self, tip):
        tip = mdr.Sampled(*TIPS[tip])
        assert tip.contact_radius(tip.known_depth) == approx(tip.r[-1], rel=4e-16)
        assert mdr.indent(tip, MEDIUM, tip.known_depth).contact_radius == approx(tip.r[-1], rel=4e-16)
        with pytest.raises(ValueError, match="is deeper than the shape is known"):
            tip.contact_radius(np.nextafter(tip.known_depth, np.inf))


class TestCsv:
    def read(self, tmp_path, text, **options):
        path = tmp_path / "tip.csv"
        path.write_text(text, encoding="utf-8")
        return mdr.Sampled.from_csv(path, **options)

    @pytest.mark.parametrize(
        "text",
        [
            "r (nm), z (nm)\n0, 0\n100, 10\n200, 30\n",
            "# a tip\nr [nm];z [nm]\n0;0\n100;10\n200;30",
            "r (nm);z (nm)\n0,0;0,0\n100,0;10,0\n2,0e2;30\n",
            "radius/nm\theight/µm\n0\t0\n1,0e2\t0,01\n2e2\t0,03\n",
            '"r (nm)","z (nm)","error (nm)"\n"0","0","1"\n100,10,1\n200,30,1\n',
            "r (nm);z (nm);\n0;0;\n100;10;\n200;30;\n",
            "r (nm) z (nm)\n0,0 0,0\n100,0 10,0\n2,0e2 30,0\n",
            "# r (nm)\tz (nm)\r\n0\t0\r\n1e2\t1e1\r\n\r\n2e2\t3e1\r\n",
            "\ufeffr (um) z (nm)\n0 0\n.1 10\n.2 30\n",
        ],
    )
    def test_units_in_the_header(self, tmp_path, text):
        tip = self.read(tmp_path, text)
        np.testing.assert_allclose(tip.r, [0, 1e-7, 2e-7], rtol=1e-15)
        np.testing.assert_allclose(tip.z, [0, 1e-8, 3e-8], rtol=1e-15)

    def test_units_given(self, tmp_path):
        assert self.read(tmp_path, "0,0\n1,1\n", unit="mm").r == (0.0, 1e-3)
        assert self.read(tmp_path, "0;0;7\n0,5;1;7\n", unit="mm").r == (0.0, 5e-4)

    @pytest.mark.parametrize(
        ("text", "options", "says"),
        [
            ("0,0\n1,1\n", {}, "header must name the units"),
            ("r (inch), z (inch)\n0,0\n1,1\n", {}, "header must name the units"),
            ("r (nm), z (nm)\n0,0\n1,1\n", {"unit": "mm"}, "unit='mm' was given, but the header says nm"),
            ("0,0\n1,1\n", {"unit": "inch"}, "unit = 'inch' must be one of"),
            ("r (nm), z (nm)\n0,0\n1;x\n", {}, "line 3: expected two numbers"),
            ("r (nm), z (nm)\n0,0,0\n", {}, "line 2: expected two numbers"),
            ("r (nm); z (nm); e (nm)\n0;0;1\n1;1\n", {}, "line 3: expected 3 numbers, r and z first"),
            ("r (nm);z (nm)\n0;0\n;1\n", {}, "line 3: expected two numbers"),
            ("r (nm), z (nm)\n", {}, "no samples"),
            ("r (nm), z (nm)\n0,0\n1,nan\n", {}, "line 3: expected two numbers r, z, found '1,nan'"),
            (
                "r (nm), z (nm)\n0,0\n1e-300,1\n2,3\n",
                {},
                r"Sampled r\[1\] = 1e-309 m must be 0 or at least 1e-25",
            ),
            ("r (m), z (m)\n0,0\n1,1\n1e26,1e27\n", {}, r"Sampled r\[2\] = 1e\+26 m is beyond 1e\+25"),
            ("r (nm), z (nm)\n0,0\n1,1\n", {"unit": ["nm"]}, "must be one of"),
            ("(" * 9999 + "\n0,0\n1,1\n", {}, "header must name the units"),
            ("1 " * 10**6, {}, "a line is longer than 10000 characters"),
        ],
    )
    def test_bad_files_are_refused(self, tmp_path, text, options, says):
        with pytest.raises(ValueError, match=says):
            self.read(tmp_path, text, **options)

    @pytest.mark.parametrize("encoding", ["utf-16", "cp1252"])
    def test_other_encodings(self, tmp_path, encoding):
        path = tmp_path / "tip.csv"
        path.write_text("r (µm), z (µm)\n0,0\n1,1\n", encoding=encoding)
        assert mdr.Sampled.from_csv(path).r == (0.0, 1e-6)


class TestFit:
    """Least squares over noisy, two-sided samples of a paraboloid."""

    shape, depth = mdr.Paraboloid(1e-6), 40e-9
    r = np.linspace(-4e-7, 4e-7, 401)

    def measured(self, seed):
        return self.shape.height(self.r) + 1e-9 * np.random.default_rng(seed).standard_normal(self.r.size)

    def test_noise_has_no_preference(self):
        force = [
            mdr.indent(mdr.Sampled.fit(self.r, self.measured(seed)), MEDIUM, self.depth).force
            for seed in range(50)
        ]
        error = np.array(force) / mdr.indent(self.shape, MEDIUM, self.depth).force - 1
        # Three standard errors of the mean of 50; one tip scatters by 1 %, as its height at the apex does.
        assert abs(np.mean(error)) < 3 * np.std(error) / np.sqrt(50)
        assert np.std(error) < 0.015

    @pytest.mark.parametrize("waves", [2, 5, 12])
    @pytest.mark.parametrize("rows", [161, 401, 5000])
    @pytest.mark.parametrize("sides", [1, 2])
    def test_a_wavy_tip_is_refused(self, waves, rows, sides):
        """50 nm on a tip of 80 nm, with 1 nm of noise: the misfit is that of a sine or less, 35 nm."""
        r = np.linspace(4e-7 * (1 - sides), 4e-7, rows)
        z = self.shape.height(r) + 5e-8 * np.sin(2 * np.pi * waves * r / 4e-7)
        z += 1e-9 * np.random.default_rng(1).standard_normal(rows)
        with pytest.raises(ValueError, match="wavy or concave") as refused:
            mdr.Sampled.fit(r, z)
        # Its two digits are in nm.
        miss = float(re.search(r"by (\S+) nm \(rms", str(refused.value))[1])
        assert 10 < miss < 40

    @pytest.mark.parametrize("wavelength", [8e-9, 30e-9 * 2 * math.pi])
    @pytest.mark.parametrize("rows", [100, 400, 2000])
    @pytest.mark.parametrize("width", [8e-7, 2e-6])
    def test_a_wave_is_found_among_noise_of_a_fifth_of_it(self, wavelength, rows, width):
        """From 0.4 to 471 samples a wavelength: neighbours alone do not tell coarse waves from noise."""
        r = np.linspace(0, width, rows)
        z = self.shape.height(r / 2) + 5e-8 * np.sin(2 * math.pi * r / wavelength)
        for seed in range(3):
            with pytest.raises(ValueError, match="wavy or concave"):
                mdr.Sampled.fit(r, z + 1e-8 * np.random.default_rng(seed).standard_normal(rows))

    @pytest.mark.parametrize("rows", [50, 100, 400, 2000])
    @pytest.mark.parametrize("width", [1, 5])
    def test_noise_of_any_size_is_no_wave(self, rows, width):
        """1, 10 or 50 nm on a tip of 90 nm, also if the instrument has averaged five neighbours."""
        r = np.linspace(0, 6e-7, rows)
        for seed in range(24):
            size = [1e-9, 1e-8, 5e-8][seed % 3]
            noise = np.random.default_rng(seed).standard_normal(rows + width - 1)
            z = r**2 / 4e-6 + size * np.convolve(noise, np.ones(width) / width**0.5, "valid")
            tip = mdr.Sampled.fit(r, z)
            # A fitted height is known better than that of one row: two standard errors of two of these.
            assert abs(np.ptp(tip.height([2e-7, 5e-7])) - 5.25e-8) < 2 * math.sqrt(2) * size

    def test_order_side_and_height_do_not_matter(self):
        z = self.measured(1)
        order = np.random.default_rng(2).permutation(self.r.size)
        one, other = mdr.Sampled.fit(self.r, z), mdr.Sampled.fit(-self.r[order], z[order] - 3e-8)
        # Rounding of the solver, in units of the height.
        np.testing.assert_allclose(one.height(one.r), other.height(one.r), atol=1e-12 * one.z[-1])

    def test_what_is_convex_already_is_kept(self):
        r = np.array([0.0, 1.0, 2.0, 4.0])
        tip = mdr.Sampled.fit(np.append(-r, r), np.tile([5.0, 5.0, 5.5, 7.5], 2))
        np.testing.assert_allclose(tip.height(r), [0.0, 0.0, 0.5, 2.5], atol=1e-14)

    @pytest.mark.parametrize(
        ("r", "z", "says"),
        [
            ([0, 1, 2], [0, 1], "two lists of the same length"),
            ([], [], "two lists of the same length"),
            ([-1, 0, 1], [1, 0, 1], "three or more different radii"),
            ([0, 1, 2], [0, -1, -2], "does not increase with the radius r"),
            ([0, 1, 2], [0, math.inf, 2], r"z\[1\] = inf m must be finite"),
        ],
    )
    def test_bad_samples_are_refused(self, r, z, says):
        with pytest.raises(ValueError, match=says):
            mdr.Sampled.fit(r, z)


class TestAreaFunction:
    @pytest.mark.parametrize(
        ("coefficients", "shape", "tolerance"),
        # A = C₀h² is a cone, which its polygon is; A = 2πRh a paraboloid, above which its chords lie.
        [
            ([24.5], mdr.Cone(math.sqrt(math.pi / 24.5)), 1e-12),
            ([0.0, 2e-6 * math.pi], mdr.Paraboloid(1e-6), 1e-4),
        ],
    )
    def test_known_tips(self, coefficients, shape, tolerance):
        tip, depth = mdr.Sampled.from_area_function(coefficients, 1e-6), [1e-8, 1e-7, 5e-7]
        force, exact = (mdr.indent(s, MEDIUM, depth).force for s in (tip, shape))
        np.testing.assert_allclose(force, exact, rtol=tolerance)

    def test_a_calibrated_tip_keeps_its_area(self):
        """Slightly concave, as calibrated ones are: within the 3 % that are allowed."""
        h = np.array([1e-8, 1e-7, 1e-6])
        area = 24.5 * h**2 + 1e-7 * h + 1e-11 * h**0.5
        tip = mdr.Sampled.from_area_function([24.5, 1e-7, 1e-11], 1e-6)
        np.testing.assert_allclose(tip.height(np.sqrt(area / math.pi)), h, rtol=0.03)

    def test_coefficients_are_in_the_unit_that_is_given(self):
        """The same tip in m, and in nm as instruments give it: Cᵢ has the unit to the 2 − 2/2ⁱ."""
        coefficients = np.array([24.5, 80.0, 100.0])
        size = 1e-9 ** (2 - 2.0 / 2.0 ** np.arange(3))
        tip = mdr.Sampled.from_area_function(coefficients, 1e-6, unit="nm")
        np.testing.assert_allclose(tip.z, mdr.Sampled.from_area_function(coefficients * size, 1e-6).z)
        np.testing.assert_allclose(tip.r, mdr.Sampled.from_area_function(coefficients * size, 1e-6).r)

    @pytest.mark.parametrize("height", [1000, 1.0])
    def test_a_height_in_the_unit_of_the_coefficients_is_refused(self, height):
        """1000 for nm was 1 km, of which the lowest sample is above the blunt part: A was 7 % too small."""
        with pytest.raises(ValueError, match=r"height = .* m is .* nm, and must be at most 1e\+06 nm"):
            mdr.Sampled.from_area_function([24.5, 500.0], height, unit="nm")

    def test_a_calibration_that_is_negative_near_the_tip(self):
        """Coefficients of an instrument (micromechanics, Example.xls): A < 0 up to 6 nm of 2 µm."""
        c = [27.3136, 152.698859, -494.182317]
        tip = mdr.Sampled.from_area_function(c, 2e-6, unit="nm")
        h = np.array([50.0, 200.0, 2000.0])
        area = c[0] * h**2 + c[1] * h + c[2] * h**0.5
        np.testing.assert_allclose(
            tip.height(1e-9 * np.sqrt(area / math.pi)), 1e-9 * h, rtol=0.03, atol=6e-9
        )

    @pytest.mark.parametrize(
        ("arguments", "says"),
        [
            (
                ([24.5, 800.0], 1e-6),
                r"radius is 0\.016 m; .* 1\.6e\+04 must be between 0\.01 and 100: check the unit",
            ),
            (([24.5, 0.5], 1e-6), "must be between 0.01 and 100: check the unit of the coefficients, m"),
            (([1e-6], 1e-6), "must be between 0.01 and 100: check the unit"),
            (([24.5, 0.0, -1e-7], 1e-6), r"area A\(h\).* does not grow"),
            (([-24.5], 1e-6), r"area A\(h\).* does not grow .* check the coefficients"),
            (([24.5, *[0.0] * 7, 1e-12], 1e-6), "concave by more than 3 %"),
            (([24.5], -1.0), "height = -1 m"),
            (([24.5], 1e-6, 1), "samples = 1 must be a whole number from 2"),
        ],
    )
    def test_bad_area_functions_are_refused(self, arguments, says):
        with pytest.raises(ValueError, match=says):
            mdr.Sampled.from_area_function(*arguments)


def test_many_samples_are_not_listed():
    assert repr(HULL) == f"Sampled({len(HULL.r)} samples to r = 1e-05 m, z = {HULL.z[-1]:g} m)"
    assert repr(mdr.Sampled([0, 1], [0, 2])) == "Sampled(r=(0.0, 1.0), z=(0.0, 2.0))"


@pytest.mark.parametrize("noise", [0.0, 2e-9])
def test_the_axis_of_a_tip_that_is_measured_on_both_sides(noise):
    """Both sides of a paraboloid differ by a square of the distance from its axis."""
    axis, r = 0.12e-6, 1e-6 * np.linspace(-1.0, 1.3, 301)
    z = (r - axis) ** 2 / 2e-6 + np.random.default_rng(5).normal(0.0, noise, r.size)
    # Linear interpolation between samples; noise over the mean slope of 0.5 and the root of their number.
    tolerance = 1e-3 * 1e-6 + 4 * noise / 0.5 / np.sqrt(r.size)
    assert axis_of_symmetry(r, z) == approx(axis, abs=tolerance)
    # The order of the samples does not matter.
    assert axis_of_symmetry(r[::-1], z[::-1]) == approx(axis, abs=tolerance)


def test_few_convex_samples_are_the_tip_as_they_are():
    r = np.array([0.0, 1e-7, 2e-7, 4e-7])
    tip, scatter = tip_through(r, r**2 / 2e-6, 60, 2000)
    assert (tip, scatter) == (mdr.Sampled(r, r**2 / 2e-6), None)


@pytest.mark.parametrize("rows", [41, 4000])
def test_noisy_samples_about_any_axis_become_a_convex_tip_of_few(rows):
    """The noise is the scatter, and the tip is that of the paraboloid within it, in its force too."""
    r, noise = 1e-6 * np.linspace(-1.0, 1.3, rows), 2e-9
    z = (r - 0.12e-6) ** 2 / 2e-6 + np.random.default_rng(5).normal(0.0, noise, rows)
    tip, scatter = tip_through(r, z, 60, 2000)
    assert len(tip.r) <= 60
    # Of 41 samples the standard deviation is known to a ninth, and the fit takes some of it.
    assert scatter == approx(noise, rel=0.35)
    exact = mdr.indent(mdr.Paraboloid(1e-6), MEDIUM, 2e-7).force
    # Noise of the height of the apex, of a few samples, over the depth; forces go with its power 3/2.
    assert mdr.indent(tip, MEDIUM, 2e-7).force == approx(exact, rel=1.5 * noise / 2e-7 * 2)


def test_a_repaired_area_function_says_by_how_much():
    """A = 24.5 h² + 50 h^(1/2) nm² is concave near the tip; 24.5 h² is a cone, which stays as it is."""
    repaired = mdr.Sampled.from_area_function([24.5, 0.0, 50.0], 1e-6, unit="nm")
    r, z = 1e9 * np.array(repaired.r[1:]), 1e9 * np.array(repaired.z[1:])
    # The height at which the area function has the area of each vertex.
    h = np.geomspace(1e-2, 1.01e3, 200_000)
    change = np.abs(z - np.interp(np.pi * r**2, 24.5 * h**2 + 50.0 * h**0.5, h)).max()
    (remark,) = repaired.remarks
    # Two digits are written, and the table of heights is finer.
    said = float(re.search(r"changed by up to ([\d.]+) pm", remark)[1])
    assert said == approx(1e3 * change, rel=0.06)
    assert remark in repr(repaired)
    assert mdr.Sampled.from_area_function([24.5], 1e-6).remarks == ()


@pytest.mark.parametrize("coefficients", [[24.5, -150.0], [24.5, -300.0, 5000.0]])
def test_an_area_function_with_negative_terms_is_used_from_a_depth_on(coefficients):
    """The error names it. Heights are within 3 % (of 100 nm at least) from there on, areas twice that."""
    with pytest.raises(ValueError, match="concave by more than 3 %") as error:
        mdr.Sampled.from_area_function(coefficients, 1e-6, unit="nm")
    least = float(re.search(r"from_depth=([\d.e-]+)", str(error.value))[1])
    tip = mdr.Sampled.from_area_function(coefficients, 1e-6, unit="nm", from_depth=1.01 * least)
    h = np.geomspace(1.2 * least, 0.9e-6, 20)
    area = sum(c * (1e9 * h) ** (2 / 2**i) for i, c in enumerate(coefficients)) * 1e-18
    allowed = 0.065 * np.maximum(h, 1e-7) / h
    assert np.all(np.abs(np.pi * tip.radius_at_height(h) ** 2 / area - 1) < allowed)
    assert "is not used below" in str(tip.remarks)
    with pytest.raises(ValueError, match="from_depth = 6e-07 m is above half of the height"):
        mdr.Sampled.from_area_function(coefficients, 1e-6, unit="nm", from_depth=6e-7)
