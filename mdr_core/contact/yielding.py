"""Which rule of yield holds for a profile on a medium: the one way to a `YieldRule`.

`ConstantCap` for the hardness q_c/a and where nothing yields, `OwnCap` for a law of one's own, `RadiusCap`
for any other sum H + q_c/a + f_c/a². For H alone some profiles have closed forms.
"""

from functools import singledispatch

import numpy as np

from .._door import above
from ..medium import Medium
from ..profiles.profile import Profile
from .integrals import integrals
from .radius_cap import RadiusCap
from .rule_of_yield import ConstantCap, YieldRule


def yield_rule(profile: Profile, medium: Medium) -> YieldRule:
    """The rule by which a medium yields under a profile.

    Examples
    --------
    >>> import numpy as np
    >>> from mdr_core.contact.yielding import yield_rule
    >>> from mdr_core import Cone, Medium
    >>> rule = yield_rule(Cone(slope=1.0), Medium.from_critical_depth(1.0, critical_depth=1.0))
    >>> rule.path(np.array([0.5, 3.0, 2.5, 1.0])).length.tolist()
    [0.5, 1.0, 0.5, 0.0]
    """
    if medium.inverse_to_radius:
        return ConstantCap.of(profile, medium.E_star, medium.q_c)
    if medium.has_own_law:
        return above("own.cap").OwnCap.of(profile, medium)
    if np.any(medium.hardness) and not integrals(profile).convex:
        raise ValueError(
            "a hardness above 0 is not computed under a shape that is not convex: where g(x)/x falls, a "
            "contact that has yielded becomes elastic again; set hardness = 0, or take a convex shape"
        )
    if np.any(medium.q_c) or np.any(medium.f_c):
        return RadiusCap.of(profile, medium)
    return constant_hardness(profile).of(profile, medium)


@singledispatch
def constant_hardness(profile: Profile) -> type[RadiusCap]:
    """The rule for a constant hardness alone: closed forms if registered for the class of the profile."""
    return RadiusCap
