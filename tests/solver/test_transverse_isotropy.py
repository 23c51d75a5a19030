"""Half-spaces that are pressed along their axis of symmetry: effective modulus, and what is refused."""

import pickle

import numpy as np
import pytest

import mdr_core as mdr

from ..approx import approx

#: E_p, E_z, ν_p, ν_zp, G_z.
QUASI_ISOTROPIC = 52e9, 9e9, 0.31, 0.06, 4e9
ALONG_FIBRES = 9e9, 135e9, 0.4, 0.3, 5e9
WOOD = 0.6e9, 11e9, 0.6, 0.35, 0.7e9
AUXETIC = 60e9, 12e9, 0.3, -0.2, 5e9


def compliances(E_p, E_z, nu_p, nu_zp, G_z):
    """Compliances (1/Pa) in Voigt's notation, axis 3 along the axis of symmetry."""
    S = np.zeros((6, 6))
    S[0, 0] = S[1, 1] = 1 / E_p
    S[2, 2] = 1 / E_z
    S[0, 1] = S[1, 0] = -nu_p / E_p
    S[:2, 2] = S[2, :2] = -nu_zp / E_z
    S[3, 3] = S[4, 4] = 1 / G_z
    S[5, 5] = 2 * (1 + nu_p) / E_p
    return S


def barnett_lothe(C):
    """E* (Pa) from the impedance of the surface, Barnett and Lothe's integral, of stiffnesses C (Pa).

    A pressure p cos kx displaces the surface by 2 p cos kx/(E* k), since the two-dimensional Fourier
    transform of 1/(π E* r) is 2/(E* k).
    """
    voigt = np.array([[0, 5, 4], [5, 1, 3], [4, 3, 2]])
    c = C[voigt[:, :, None, None], voigt[None, None, :, :]]
    along, normal = np.eye(3)[0], np.eye(3)[2]
    impedance = np.zeros((3, 3))
    # The integrand is smooth and periodic, so that the trapezoidal rule converges exponentially.
    angles = np.arange(256) * np.pi / 256
    for angle in angles:
        m = np.cos(angle) * along + np.sin(angle) * normal
        n = -np.sin(angle) * along + np.cos(angle) * normal
        mm, mn, nn = (np.einsum("i,ijkl,l->jk", one, c, other) for one, other in ((m, m), (m, n), (n, n)))
        impedance += (mm - mn @ np.linalg.solve(nn, mn.T)) / angles.size
    return 2 / np.linalg.inv(impedance)[2, 2]


@pytest.mark.parametrize("constants", [QUASI_ISOTROPIC, ALONG_FIBRES, WOOD, AUXETIC])
def test_the_modulus_is_that_of_the_impedance_of_the_surface(constants):
    E_star = mdr.Medium.from_transversely_isotropic(*constants).E_star
    # Inverting the compliances costs their condition number, below 10³.
    assert E_star == approx(barnett_lothe(np.linalg.inv(compliances(*constants))), rel=1e-12)


def test_random_stable_media():
    rng = np.random.default_rng(14)
    for _ in range(50):
        E_p, E_z, G_z = 10 ** rng.uniform(9, 11, 3)
        nu_p = rng.uniform(-0.9, 0.9)
        nu_zp = rng.uniform(-0.9, 0.9) * np.sqrt((1 - nu_p) * E_z / (2 * E_p))
        constants = E_p, E_z, nu_p, nu_zp, G_z
        E_star = mdr.Medium.from_transversely_isotropic(*constants).E_star
        assert E_star == approx(barnett_lothe(np.linalg.inv(compliances(*constants))), rel=1e-10), constants


def test_zinc_from_its_stiffnesses():
    """69.6181 GPa, from the stiffnesses of zinc (GPa) by both ways."""
    C = np.diag([165.0, 165.0, 61.8, 39.6, 39.6, (165.0 - 31.1) / 2])
    C[0, 1] = C[1, 0] = 31.1
    C[:2, 2] = C[2, :2] = 50.0
    S = np.linalg.inv(C)
    constants = 1 / S[0, 0], 1 / S[2, 2], -S[0, 1] / S[0, 0], -S[0, 2] / S[2, 2], 1 / S[3, 3]
    E_star = mdr.Medium.from_transversely_isotropic(*constants).E_star
    assert E_star == approx(barnett_lothe(C), rel=1e-13)
    assert E_star == approx(69.6181, abs=5e-5)


@pytest.mark.parametrize("nu", [-0.5, 0.0, 0.3, 0.5])
def test_an_isotropic_medium_is_the_limit(nu):
    E = 3e9
    medium = mdr.Medium.from_transversely_isotropic(E, E, nu, nu, E / (2 * (1 + nu)))
    assert medium.E_star == approx(E / (1 - nu**2), rel=1e-15)


def test_an_incompressible_medium_is_admissible_whatever_rounding_does():
    """ν_zp = 1/2 and ν_p = 1 − E_p/(2E_z), as of muscle; there 2/(√(C₁₁C₃₃) + C₁₃) vanishes."""
    E_z = np.linspace(0.7, 3.0, 200)
    medium = mdr.Medium.from_transversely_isotropic(1.0, E_z, 1 - 0.5 / E_z, 0.5, 0.4)
    assert medium.E_star == approx(2 * np.sqrt(0.4 * E_z / (1 - 0.25 / E_z)), rel=1e-7)


@pytest.mark.parametrize(
    ("changed", "says"),
    [
        ({"E_in_plane": 0.0}, "modulus E_in_plane = 0 Pa must be finite and positive"),
        ({"E_axial": -1.0}, "modulus E_axial = -1 Pa"),
        ({"G_axial": np.inf}, "modulus G_axial = inf Pa"),
        ({"nu_in_plane": 1.0}, "Poisson ratio nu_in_plane = 1 must lie in −1 < ν < 1"),
        ({"nu_axial": 0.31}, r"Poisson ratio nu_axial = 0.31 leaves .* below 0.2444; nu_axial is ν_zp"),
        ({"nu_axial": np.nan}, "Poisson ratio nu_axial"),
        ({"nu_axial": [0.0, 0.9]}, r"nu_axial\[1\] = 0.9"),
    ],
)
def test_what_is_not_stable_is_refused(changed, says):
    names = ("E_in_plane", "E_axial", "nu_in_plane", "nu_axial", "G_axial")
    constants = dict(zip(names, QUASI_ISOTROPIC, strict=True)) | changed
    with pytest.raises(ValueError, match=says):
        mdr.Medium.from_transversely_isotropic(**constants)


class TestMedium:
    medium = mdr.Medium.from_transversely_isotropic(*QUASI_ISOTROPIC, hardness=0.5e9)

    def test_it_is_pressed_and_hit_like_any_other(self):
        isotropic = mdr.Medium(self.medium.E_star, hardness=0.5e9)
        tip = mdr.Paraboloid(radius=5e-3)
        assert mdr.indent(tip, self.medium, 1e-4).force == mdr.indent(tip, isotropic, 1e-4).force
        hits = [mdr.impact(tip, medium, 4e-3, 5.0).restitution for medium in (self.medium, isotropic)]
        assert hits[0] == hits[1]

    def test_what_needs_more_than_the_modulus_is_refused(self):
        state = mdr.indent(mdr.Paraboloid(5e-3), self.medium, 1e-4)
        for asked in (
            lambda: state.stress(0.0, 1e-4),
            lambda: state.stress_peak(),
            lambda: state.largest_stress(1e-4),
            lambda: self.medium.tangential_ratio,
            lambda: mdr.oblique_impact(mdr.Paraboloid(5e-3), self.medium, 1e-3, 1.0, 1.0, 0.3),
        ):
            with pytest.raises(ValueError, match=r"needs more elastic constants than E\*"):
                asked()

    def test_it_remembers_what_it_is(self):
        assert self.medium.poisson is None
        assert self.medium != mdr.Medium(self.medium.E_star, hardness=0.5e9)
        assert pickle.loads(pickle.dumps(self.medium)) == self.medium
        scene = mdr.Scene(mdr.Cone(0.1), self.medium, mdr.scene.DepthPath(1e-9))
        assert mdr.Scene.from_json(scene.to_json()) == scene
        assert "poisson=None" in scene.to_python()
        assert "no Poisson ratio" in str(mdr.indent(mdr.Cone(0.1), self.medium, 1e-9))
        many = mdr.Medium.from_transversely_isotropic([52e9, 60e9], 9e9, 0.31, 0.06, 4e9)
        assert many.entries(1).poisson is None

    def test_all_constants_relax_alike(self):
        wet = mdr.Medium.from_transversely_isotropic(*QUASI_ISOTROPIC, eta=1e3)
        assert wet.relaxation_time == approx(4e3 / wet.E_star, rel=1e-15)
        hit = mdr.impact(mdr.Paraboloid(5e-3), wet, 4e-3, 5.0)
        assert not any(limit.what == "Poisson ratio" for limit in hit.limits)
