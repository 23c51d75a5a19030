"""Ideal tips at contact depths at which real ones are blunt."""

import numpy as np

from ...base.remark import Remark, Remedy
from ...show.quantities import engineering
from ...solver.profiles.power import Cone

#: Contact depth (m) below which the rounding of a real tip counts. A cap of radius R takes the depth
#: δ = R(√(1 + s²) − 1) off a cone of slope s, and the area at a contact depth h_c is (1 + δ/h_c)² times
#: that of the cone: under Berkovich's s = 0.358 and R = 0.05 … 0.3 µm, H is 3 to 20 % too large at 200 nm,
#: E* half as much. So it is under a sharp tip of an AFM, s = 2 and R = 10 nm.
_BLUNT = 200e-9


def of_ideal_tip(profile, contact_depth, held=False):
    """Yields a remark on contact depths (m) under an ideal cone, if they are small; NaN is none.

    `held` says whether it is of a fit with first contact held. A fitted one takes the rounding up: with
    R = 0.3 µm and 100 nm of depth E* is then within 2 %, z₀ 20 nm off; with the right z₀ it is 37 % off.
    """
    depths = np.ravel(contact_depth)
    small = depths[depths < _BLUNT]
    if not small.size or not isinstance(profile, Cone):
        return
    least = engineering(small.min(), "m")
    where = (
        f"{small.size} contact depths from {least} on" if small.size > 1 else f"a contact depth of {least}"
    )
    text = (
        f"an ideal tip at {where}: real ones are rounded, so that the hardness is too large by up to a "
        "fifth at 200 nm, E* by half as much, and more at less depth"
    )
    yield Remark(text, "tip", Remedy("give", "profile"), *[Remedy("free", "contact_point")] * held)
