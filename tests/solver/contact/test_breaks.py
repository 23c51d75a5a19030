"""Where a loading is not smooth: at the onset of yield, and where the live interval passes a kink."""

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.solver.contact.integrals import integrals
from mdr_core.solver.contact.yielding import yield_rule

from ...shapes import SHAPES, name

#: A polygon of three facets: g′ is infinite at its vertices.
FACETS = mdr.Sampled([0.0, 1e-6, 2e-6, 4e-6], [0.0, 0.2e-6, 0.5e-6, 1.3e-6])
#: Steps, over the penetration, of the coarse and of the fine differences.
COARSE, FINE = 4e-3, 4e-3 / 16


def medium_of(given, onset):
    """A medium of one class or of several that yields under a ball at about a depth (m)."""
    E_star, a = 1e9, np.sqrt(1e-5 * onset)
    shares = {"q_c": a, "hardness": 1.0, "f_c": a * a}
    return mdr.Medium(
        E_star, **{each: 2 * E_star * onset / np.pi / a / len(given) * shares[each] for each in given}
    )


def is_smooth(rule, imprint, y):
    """Whether the slopes of the stiffness on both sides of penetrations y (m) are the same.

    From the coarse step to the fine one its second differences fall 256 times where it is smooth, 16 times
    where its slope jumps, and 64 times where its slope rises as a root.
    """

    def stiffness(y):
        return rule.loading_stiffness_radius(*rule.loading(y, imprint))

    def difference(step):
        return np.abs(stiffness(y * (1 - step)) - 2 * stiffness(y) + stiffness(y * (1 + step)))

    coarse, fine = difference(COARSE), difference(FINE)
    # Of a stiffness that is nearly a straight line, the fourth power of the step or rounding is left.
    return (fine < coarse / 128) | (fine < 1e-11 * rule.profile.radius_at(imprint + y))


@pytest.mark.parametrize("given", [("q_c",), ("f_c",), ("hardness", "q_c", "f_c")], ids="+".join)
@pytest.mark.parametrize("profile", [*SHAPES, FACETS], ids=name)
@pytest.mark.parametrize("imprint", [0.0, 40e-9, 300e-9])
def test_a_loading_is_smooth_but_for_the_breaks(profile, given, imprint):
    if "hardness" in given and not integrals(profile).convex:
        pytest.skip("a hardness above 0 is not computed under a shape that is not convex")
    rule = yield_rule(profile, medium_of(given, 60e-9))
    deepest = min(1.5e-6, profile.known_depth) * 0.98
    at = rule.breaks(np.array([[imprint]]), np.array([[deepest]]))
    kinks = np.hstack([at.upper, at.lower]).ravel()
    breaks = np.append(at.onset.ravel(), kinks)
    breaks = np.unique(breaks[(breaks > 1e-9) & (breaks < (deepest - imprint) / (1 + 3 * COARSE))])
    # Where g is concave a plastic radius rises with the slope 0.
    if integrals(profile).convex or imprint:
        assert not is_smooth(rule, imprint, breaks).any()
    # All kinks that either end passes are among them.
    lower = rule.loading(np.array(deepest - imprint), imprint)[0].lower
    assert kinks.size == sum(int(kink < deepest) + int(kink < lower) for kink in profile.kinks)
    y = np.geomspace(2e-9, (deepest - imprint) / (1 + 3 * COARSE), 500)
    far = np.all(np.abs(y[:, None] - breaks) > 20 * COARSE * y[:, None], axis=1)
    assert far.sum() > 200
    assert is_smooth(rule, imprint, y[far]).all()
