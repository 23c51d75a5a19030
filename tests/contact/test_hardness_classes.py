"""Every class of hardness: states against 45 digits, closed limits, impacts."""

import itertools

import numpy as np
import pytest
from mpmath import mp, mpf
from scipy.optimize import brentq

import mdr_core as mdr

from ..reference import Reference
from ..shapes import name

E = 70e9
#: Scale of the hardness (Pa), and of lengths (m).
H, L = 2e9, 1e-6
#: H, q_c and f_c of five mixtures, with one radius L at which their parts are about as hard.
MIXTURES = {
    "H": (H, 0.0, 0.0),
    "f": (0.0, 0.0, H * L * L),
    "H+q": (0.6 * H, 0.5 * H * L, 0.0),
    "q+f": (0.0, 0.7 * H * L, 0.4 * H * L * L),
    "H+q+f": (0.5 * H, 0.3 * H * L, 0.2 * H * L * L),
}
PROFILES = (
    mdr.Cone(slope=0.3),
    mdr.Paraboloid(radius=1e-5),
    mdr.PowerLaw(coefficient=1e11, exponent=3.0),
    mdr.Sphere(radius=1e-5),
    mdr.RoundedCone(tip_radius=3e-6, slope=0.3),
    mdr.TruncatedCone(flat_radius=5e-7, slope=0.3),
)


def medium_of(mixture, **other):
    hardness, q_c, f_c = MIXTURES[mixture]
    return mdr.Medium(E, q_c, hardness=hardness, f_c=f_c, **other)


class State(Reference):
    """A state in 45 digits, with the cap u_c = π a σ_c(a)/(2E*) at the largest contact radius."""

    def __init__(self, profile, medium, depth, largest):
        super().__init__(profile, mdr.Medium(E, 1.0), depth, largest)
        a, modulus = self.radius(mpf(largest)), mpf(medium.E_star)
        hardness = mpf(medium.hardness) + mpf(medium.q_c) / a + mpf(medium.f_c) / a**2
        self.plastic_depth = max(mpf(0), mpf(largest) - mp.pi * a * hardness / (2 * modulus))
        self.live_interval = self.depth - self.plastic_depth
        self.c = self.radius(self.plastic_depth) if self.plastic_depth else mpf(0)


def cap(medium, a):
    return np.pi / (2 * medium.E_star) * a * medium.hardness_at(a)


def spring_force(profile, medium, depth):
    """Force (N) on loading: elements are compressed by depth − g(x), at most by the cap."""
    a = float(profile.contact_radius(depth))
    limit = cap(medium, a)
    if depth <= limit:
        inner = profile.face_radius
        plateau = depth * inner
    else:
        inner = float(profile.contact_radius(depth - limit))
        plateau = limit * inner
    total, kinks = plateau, [float(profile.contact_radius(kink)) for kink in profile.kinks]
    edges = sorted({inner, a, *(x for x in kinks if inner < x < a)})
    for low, high in itertools.pairwise(edges):
        # x = low + h u⁴ unfolds roots at the lower end.
        x = low + (high - low) * NODE**4
        total += np.sum(WEIGHT * 4 * NODE**3 * (high - low) * (depth - profile.reduced(x)))
    return 2 * medium.E_star * total


NODE, WEIGHT = np.polynomial.legendre.leggauss(60)
NODE, WEIGHT = (1 + NODE) / 2, WEIGHT / 2


def work(profile, medium, largest):
    """∫ F ds (J) up to a depth, from the forces of the elements; cut at the onset and at kinks."""

    def excess(s):
        return s - cap(medium, float(profile.contact_radius(s)))

    def passing(depth):
        """Depth at which the plastic depth reaches `depth`."""
        if excess(largest) <= depth:
            return largest
        if depth == 0.0 and excess(1e-9 * largest) > 0:
            return 0.0
        return brentq(lambda s: excess(s) - depth, 1e-9 * largest, largest, xtol=1e-22, rtol=1e-15)

    cuts = [0.0, passing(0.0), *profile.kinks, *(passing(kink) for kink in profile.kinks), largest]
    cuts = sorted({cut for cut in cuts if cut <= largest})
    total = 0.0
    for low, high in itertools.pairwise(cuts):
        s = low + (high - low) * NODE**4
        forces = np.array([spring_force(profile, medium, each) for each in s])
        total += np.sum(WEIGHT * 4 * NODE**3 * (high - low) * forces)
    return total


@pytest.mark.parametrize("mixture", MIXTURES)
@pytest.mark.parametrize("shape", PROFILES, ids=name)
def test_states_against_elements_in_45_digits(shape, mixture):
    """Random depths, an unloading each; forces 10⁻¹², energies 10⁻¹¹ and 10⁻⁹ of their sum."""
    medium = medium_of(mixture)
    rng = np.random.default_rng([PROFILES.index(shape), list(MIXTURES).index(mixture)])
    for largest in np.exp(rng.uniform(np.log(1e-8), np.log(6e-6), 2)):
        live = min(largest, float(cap(medium, shape.contact_radius(largest))))
        path = [largest, largest - rng.uniform(0, 0.9) * live]
        states = mdr.indent(shape, medium, path)
        total = states.stored_energy[0] + states.plastic_work[0]
        for state, depth in zip(states, path, strict=True):
            exact = State(shape, medium, depth, largest)
            assert abs(state.plastic_depth - float(exact.plastic_depth)) <= 1e-13 * largest
            if exact.live_interval > 0:
                assert state.force == pytest.approx(float(exact.force), rel=1e-12)
                assert abs(state.stored_energy - float(exact.stored_energy)) <= 1e-11 * total
        # The work of the elements is stored or plastic.
        assert states.plastic_work[0] + states.stored_energy[0] == pytest.approx(
            work(shape, medium, largest), rel=1e-9
        )
