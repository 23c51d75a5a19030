"""From measurements back to the medium that made them."""

import numpy as np
import pytest

import mdr_core as mdr

from .shapes import SHAPES, name

E, Q = 10e9, 127.3
MEDIUM = mdr.Medium(E, Q)  # d_c = 20 nm
OUT = np.append(np.linspace(-5e-9, 60e-9, 100), np.linspace(60e-9, 35e-9, 100))
SAMPLES = np.linspace(0.0, 2e-6, 40)
TIPS = (*SHAPES, mdr.Sampled(SAMPLES, SAMPLES**2 / 2e-6))


def curve(shape, medium=MEDIUM, depth=OUT):
    return mdr.indent(shape, medium, depth).force


def noisy(shape, rows, *, seed, depth_noise=0.0, depth=OUT):
    """Curves with 0.4 % noise of the force, and some of the depth (m)."""
    random, force = np.random.default_rng(seed), curve(shape, depth=depth)
    size = rows, depth.size
    return (
        depth + 3e-9 + depth_noise * random.normal(size=size),
        force + 0.004 * force.max() * random.normal(size=size),
    )


def pulls(fit, **truth):
    return {n: (fit._value(n) - true) / fit.standard_errors[n] for n, true in truth.items()}


class TestIndentation:
    @pytest.mark.parametrize("shape", TIPS, ids=name)
    def test_is_the_inverse_of_indent(self, shape):
        """Without noise to rounding, but for the table of the radius, 10⁻¹³ times a fit's condition."""
        fit = mdr.fit_indentation(shape, OUT + 7e-9, curve(shape))
        assert fit.medium.E_star == pytest.approx(E, rel=1e-9)
        assert fit.medium.q_c == pytest.approx(Q, rel=1e-9)
        assert fit.contact_point == pytest.approx(7e-9, rel=1e-9)
        assert not fit.remarks
        assert fit.indentation.force == pytest.approx(
            curve(shape), rel=1e-8, abs=1e-12 * curve(shape).max()
        )

    def test_frame_and_baseline(self):
        shape, C, F0 = mdr.Paraboloid(1e-6), 2e-4, 1e-6
        F = curve(shape)
        fit = mdr.fit_indentation(shape, OUT + C * F, F + F0, baseline=None, frame_compliance=None)
        values = fit.medium.E_star, fit.medium.q_c, fit.frame_compliance, fit.baseline
        assert values == pytest.approx((E, Q, C, F0), rel=1e-8)
        assert len(fit.standard_errors) == len(fit.covariance) == 5

    @pytest.mark.parametrize("depth_noise", [0.0, 0.4e-9])
    def test_errors_are_those_of_repeated_measurements(self, depth_noise):
        """Of 100 curves the standard deviation of pulls is known to 7 %: four of these around 1."""
        shape = mdr.Cone(0.3)
        depth, force = noisy(shape, 100, seed=1, depth_noise=depth_noise)
        fit = mdr.fit_indentation(shape, depth, force, depth_noise=depth_noise)
        for parameter, pull in pulls(fit, E_star=E, q_c=Q, contact_point=3e-9).items():
            assert 0.72 < pull.std() < 1.28, parameter
            assert abs(pull.mean()) < 0.45, parameter
        assert np.mean(fit.reduced_chi_square) == pytest.approx(1.0, abs=0.06)
        assert np.median(fit.force_noise) == pytest.approx(0.004 * curve(shape).max(), rel=0.1)

    def test_noise_of_the_depth_is_no_memory(self):
        """A running maximum of the samples makes E* several times too small; the jitter is named."""
        shape = mdr.Cone(0.3)
        depth, force = noisy(shape, 1, seed=2, depth_noise=4e-9)
        naive = mdr.fit_indentation(shape, depth[0], force[0])
        assert naive.medium.E_star < 0.7 * E
        assert any("depth_noise" in remark for remark in naive.remarks)
        fit = mdr.fit_indentation(shape, depth[0], force[0], depth_noise=4e-9)
        assert abs(pulls(fit, E_star=E)["E_star"]) < 3
        assert fit.standard_errors["E_star"] < 0.2 * E

    def test_rows_are_the_curves_one_by_one(self):
        shape = mdr.Sphere(1e-6)
        depth, force = noisy(shape, 3, seed=3)
        fit = mdr.fit_indentation(shape, depth, force)
        assert fit.shape == fit.medium.E_star.shape == (3,)
        assert fit.indentation.shape == fit.residuals.shape == depth.shape
        for i in range(3):
            one = mdr.fit_indentation(shape, depth[i], force[i])
            # The minimum itself is known to the root of rounding, and to a last step of 10⁻¹¹.
            assert one.medium.E_star == pytest.approx(fit[i].medium.E_star, rel=1e-7)
            assert one.standard_errors["q_c"] == pytest.approx(fit.standard_errors["q_c"][i], rel=1e-5)

    def test_held_parameters(self):
        shape = mdr.Cone(0.3)
        fit = mdr.fit_indentation(shape, OUT, 1.01 * curve(shape), E_star=E, q_c=Q, contact_point=0.0)
        assert (fit.medium.E_star, fit.medium.q_c, fit.contact_point) == (E, Q, 0.0)
        assert fit.residuals == pytest.approx(0.01 * curve(shape), abs=1e-12 * curve(shape).max())
        assert not fit.standard_errors

    def test_elastic_medium(self):
        """Hertz; a critical depth beyond the largest depth leaves nothing of q_c."""
        shape = mdr.Paraboloid(1e-6)
        force = 4 / 3 * E * np.sqrt(1e-6) * np.maximum(OUT, 0.0) ** 1.5
        fit = mdr.fit_indentation(shape, OUT + 3e-9, force)
        assert fit.medium.E_star == pytest.approx(E, rel=1e-9)
        assert fit.medium.q_c == fit.standard_errors["q_c"] == np.inf
        assert "nothing has yielded" in fit.remarks[0]
        held = mdr.fit_indentation(shape, OUT + 3e-9, force, q_c=np.inf)
        assert held.medium.E_star == pytest.approx(E, rel=1e-9)
        # Pressed deeper once more: no class of hardness is asked of what recovers all of its depth.
        twice = np.append(OUT, 1.3 * OUT)
        held = mdr.fit_indentation(shape, twice, curve(shape, mdr.Medium(E), twice), q_c=np.inf)
        assert held.medium.E_star == pytest.approx(E, rel=1e-9)
        assert not held.remarks

    def test_loading_alone_hardly_tells_the_modulus(self):
        shape = mdr.Cone(0.3)
        depth, force = noisy(shape, 1, seed=4, depth=OUT[:100])
        fit = mdr.fit_indentation(shape, depth[0], force[0])
        assert "loading alone" in " ".join(fit.remarks)
        assert fit.standard_errors["E_star"] > 0.02 * fit.medium.E_star

    @pytest.mark.parametrize("depth_noise", [0.0, 0.2e-9])
    def test_recovered_depth_that_grows_is_not_class_b(self, depth_noise):
        shape, random = mdr.Cone(0.3), np.random.default_rng(5)
        way = [OUT * top for top in (0.5, 1.0, 1.5)]
        for growth, said in ((0.0, False), (1.0, True)):
            media = [mdr.Medium(E, Q * (1 + growth * (top - 1))) for top in (0.5, 1.0, 1.5)]
            force = np.concatenate([curve(shape, m, d) for m, d in zip(media, way, strict=True)])
            if not growth:
                force = curve(shape, MEDIUM, np.concatenate(way))
            measured = np.concatenate(way) + depth_noise * random.normal(size=force.size)
            force = force + 0.002 * force.max() * random.normal(size=force.size)
            fit = mdr.fit_indentation(shape, measured, force, depth_noise=depth_noise)
            assert any("not class (b)" in remark for remark in fit.remarks) == said, fit.remarks

    def test_says_what_it_found(self):
        text = repr(
            mdr.fit_indentation(mdr.Cone(0.3), *(part[0] for part in noisy(mdr.Cone(0.3), 1, seed=6)))
        )
        for part in ("E*", "GPa", " ± ", "baseline F₀", "(held)", "reduced χ²"):
            assert part in text

    @pytest.mark.parametrize(
        ("change", "message"),
        [
            ({"force": -curve(mdr.Cone(0.3))}, "no contact"),
            ({"force": OUT[:-1]}, "of one shape"),
            ({"depth": np.full(OUT.size, np.nan)}, "finite"),
            ({"depth_noise": -1e-9}, "depth_noise"),
            ({"E_star": -1.0}, "E_star"),
            ({"depth": OUT[:3], "force": OUT[:3]}, "hold some"),
        ],
    )
    def test_refusals(self, change, message):
        given = {"depth": OUT, "force": curve(mdr.Cone(0.3))} | change
        with pytest.raises(ValueError, match=message):
            mdr.fit_indentation(mdr.Cone(0.3), **given)


def test_paths_of_many_media():
    """Each row is the path on its own medium; an axis of media along the path is refused."""
    shape, media = mdr.Sphere(1e-6), mdr.Medium([[E], [2 * E]], [[Q], [3 * Q]])
    path = mdr.indent(shape, media, OUT)
    for i, (modulus, q_c) in enumerate(((E, Q), (2 * E, 3 * Q))):
        # Closed by the same quadrature: a few units of rounding.
        assert path.force[i] == pytest.approx(curve(shape, mdr.Medium(modulus, q_c)), rel=1e-13, abs=1e-20)
    with pytest.raises(ValueError, match="path"):
        mdr.indent(shape, mdr.Medium([E, 2 * E]), [1e-9, 2e-9])


class TestImpacts:
    SHAPE, MASS, SPEED = mdr.Cone(0.3), 1e-6, np.geomspace(0.3, 10.0, 25)

    def hit(self, eta=0.0):
        return mdr.impact(self.SHAPE, mdr.Medium(1e10, 2e4, eta), self.MASS, self.SPEED)

    @pytest.mark.parametrize("eta", [0.0, 3e3])
    def test_is_the_inverse_of_impact(self, eta):
        """To the last step of the search, 10⁻⁹; the solver of viscous impacts is right to 10⁻⁹."""
        hit, free = self.hit(eta), {"eta": None if eta else 0.0}
        for given in ({"E_star": 1e10}, {"contact_time": hit.contact_time}):
            fit = mdr.fit_impacts(self.SHAPE, self.MASS, self.SPEED, hit.restitution, **given, **free)
            assert (fit.medium.E_star, fit.medium.q_c) == pytest.approx((1e10, 2e4), rel=1e-7)
            assert fit.medium.eta == pytest.approx(eta, rel=1e-7)
            assert not fit.remarks

    def test_errors_are_those_of_repeated_measurements(self):
        """Of 30 the standard deviation is known to 13 %: three of these around 1."""
        hit, random, found = self.hit(), np.random.default_rng(7), []
        for _ in range(30):
            e = hit.restitution + 0.01 * random.normal(size=25)
            T = hit.contact_time * np.exp(0.02 * random.normal(size=25))
            fit = mdr.fit_impacts(self.SHAPE, self.MASS, self.SPEED, e, contact_time=T)
            found.append([*pulls(fit, E_star=1e10, q_c=2e4).values()])
        assert np.all(np.abs(np.std(found, axis=0) - 1) < 0.39)
        assert np.all(np.abs(np.mean(found, axis=0)) < 0.6)

    @pytest.mark.parametrize("eta", [0.0, None])
    def test_restitution_alone_does_not_tell_the_modulus(self, eta):
        with pytest.raises(ValueError, match=r"combination.* hold E_star"):
            mdr.fit_impacts(self.SHAPE, self.MASS, self.SPEED, self.hit().restitution, eta=eta)

    def test_nothing_yields(self):
        soft = mdr.impact(self.SHAPE, mdr.Medium(1e10), self.MASS, self.SPEED)
        fit = mdr.fit_impacts(
            self.SHAPE, self.MASS, self.SPEED, soft.restitution, contact_time=soft.contact_time
        )
        assert fit.medium.E_star == pytest.approx(1e10, rel=1e-7)
        assert fit.medium.q_c == np.inf
        assert "nothing has yielded" in fit.remarks[0]


class TestHardness:
    DEPTH = MEDIUM.critical_depth * np.geomspace(1.2, 50, 10)

    @pytest.mark.parametrize("shape", [mdr.Cone(0.3), mdr.Paraboloid(1e-5), mdr.Sphere(1e-5)], ids=name)
    def test_is_the_inverse_of_the_mean_pressure(self, shape):
        state = mdr.indent(shape, MEDIUM, self.DEPTH)
        # States of one path of first loading.
        fit = mdr.fit_hardness(shape, state.mean_pressure, state.contact_radius, E_star=E)
        assert fit.medium.q_c == pytest.approx(Q, rel=1e-11)
        assert fit.class_.hardness == "b"
        assert fit.class_.slope == pytest.approx(-1.0, rel=1e-10)

    @pytest.mark.parametrize(("power", "found"), [(0.0, "a"), (-1.0, "b"), (-2.0, "c"), (-0.5, None)])
    def test_class(self, power, found):
        """Far beyond yield (H ≪ E* s/2) hardness is q_c/a to a thousandth."""
        a = np.geomspace(1e-7, 1e-6, 9)
        noise = np.exp(0.01 * np.random.default_rng(8).normal(size=9))
        fit = mdr.fit_hardness(mdr.Cone(0.3), 1e6 * (a / 1e-7) ** power * noise, a, E_star=E)
        assert fit.class_.hardness == found
        assert abs(fit.class_.slope - power) < 4 * fit.class_.slope_error
        assert (found == "b") != any("not class (b)" in remark for remark in fit.remarks)

    def test_elastic_contacts_are_refused(self):
        state = mdr.indent(mdr.Cone(0.3), mdr.Medium(E), self.DEPTH)
        with pytest.raises(ValueError, match="nothing has yielded"):
            mdr.fit_hardness(mdr.Cone(0.3), 1.01 * state.mean_pressure, state.contact_radius, E_star=E)
