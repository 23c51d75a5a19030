"""A free body that is to hit a chain, and how deep it can come."""

from dataclasses import dataclass

import numpy as np

from . import _check
from .bounds import least_depth, resistance
from .foundation import Foundation
from .medium import Medium
from .profiles import Profile

#: Fewer elements stand evenly.
_FEW = 16
#: Further elements on each side close to the axis, and the radii they stand between, in elements' widths
#: of the even grid: where damping rules, all but the last thousandth of the contact may be gone when it
#: ends, and how long that takes is up to them.
_TIP, _TIP_NODES = 16, 4.0 * 4.0 ** -np.arange(8)


@dataclass(frozen=True)
class Body:
    """What flies, against what, and from where."""

    profile: Profile
    medium: Medium
    mass: float
    speed: float
    history: tuple[tuple[float, float], ...] = ()

    def __post_init__(self):
        object.__setattr__(self, "mass", _check.positive_number("mass", self.mass, unit="kg"))
        object.__setattr__(self, "speed", _check.positive_number("speed", self.speed, unit="m/s"))

    @property
    def met_before(self):
        """Largest depth (m) of the history, at least 0."""
        return max([0.0, *(depth for depth, _ in self.history)])

    def row(self, n, deepest, tip):
        """The chain on which the body starts, wide enough for a depth (m), with a fine `tip` if asked to.

        Edges stand at the contact radii and plastic zones of that depth and of the largest one before,
        unless elements are few; few also err in how deep the body comes.
        """
        past = self.met_before
        level = np.array([past, deepest])
        level = np.append(level, level - self.medium.critical_depth)
        nodes = self.profile.contact_radius(level[level > 0]) if n >= _FEW else ()
        widest = min((1.02 + 2 / n) * max(past, deepest), self.profile.deepest)
        half_width = self.profile.contact_radius(widest)
        # A plastic zone lets go as a whole.
        if tip and self.medium.eta > 0 and deepest <= self.medium.critical_depth:
            nodes, n = np.append(nodes, 2 * half_width / n * _TIP_NODES), n + 2 * _TIP
        row = Foundation(self.profile, self.medium, n, half_width, nodes=tuple(nodes))
        for depth, dt in self.history:
            row = row.advance(depth, dt)
        return row


def reach(body):
    """A depth (m) that the body does not exceed, beyond what was met before."""
    profile, medium = body.profile, body.medium
    momentum, energy = body.mass * body.speed, body.mass * body.speed**2 / 2
    past = resistance(profile, medium, body.met_before)

    def stops(now):
        spent = now.work - past.work >= energy
        return spent or (medium.eta > 0 and now.momentum - past.momentum >= momentum)

    return least_depth(profile, medium, stops, body.met_before)
