"""Whether an unloading has the exponent of an elastic one, or that of a depth that creeps."""

import numpy as np

from ...base.remark import Remark, Remedy
from ...solver.contact.integrals import integrals
from ...solver.contact.live_interval import LiveInterval
from .first_contact import elastic_exponents
from .unloading import laws_of

#: Exponent that unloadings do not have after which more than a share of the largest depth remains.
_STEEP, _REMAINS = 1.7, 0.5
#: Least half-range of m over parts of the unloading that counts.
_VARIES = 0.1
#: Standard deviations of the scatter about the power law that m and its half-range exceed.
_BEYOND = 3.0
#: Least difference of exponents that is not one of the arithmetic, and samples of an elastic unloading.
_ROUNDING, _SAMPLES = 1e-6, 100


def doubt(profile, depth, laws, in_time):
    """A `Remark` on an exponent m that no elastic unloading from a depth (m) has, or None.

    F = α (h − h_f)^m has the m of an elastic contact where nothing has yielded, and a smaller one where the
    imprint fits the tip: 1.2 to 1.6 of most materials. Creep of the depth makes the beginning of the
    unloading steeper, so that m is larger, and another one in each part.
    """
    m, error = laws.exponent, _BEYOND * laws.scatter
    _, elastic = elastic_exponents(profile, depth)
    if m > elastic + error + _ROUNDING:
        elastic = max(elastic, _of_elastic_unloading(profile, depth))
    least, most = laws.exponents
    remaining = laws.remaining(depth)
    steep = _STEEP * max(elastic / 2, 1.0)
    if m > elastic + error + _ROUNDING:
        text = (
            f"no elastic unloading of this tip has m = {m:.3g}, above {elastic:.3g}: E* is not that of a "
            "half-space, or the depth creeps"
        )
    elif remaining > _REMAINS and m > steep + error:
        text = (
            f"m = {m:.3g} is too large for an unloading after which {100 * remaining:.2g} % of the depth "
            "remain: the depth creeps, so that the stiffness is too large"
        )
    elif (most - least) / 2 > max(_VARIES, error):
        text = (
            f"the unloading is no power law: m is between {least:.3g} and {most:.3g} by the part of "
            "it: the depth creeps, so that the stiffness is too large"
        )
    else:
        return None
    return Remark(text, "creep", *[Remedy("give", "time")] * (not in_time))


def _of_elastic_unloading(profile, depth):
    """Largest exponent of the parts of an elastic unloading from a depth (m), whose h_f is fitted, too.

    It is that of a cone where the tip is a truncated one.
    """
    depths = np.linspace(min(depth, profile.known_depth), 0.0, _SAMPLES)
    force = integrals(profile).radius_integral(LiveInterval.elastic(depths))
    return laws_of(depths, force).exponents[1]
