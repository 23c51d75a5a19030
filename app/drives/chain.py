"""States of a viscous path in time, with what the plots ask of an `Indentation`."""

from functools import cached_property

import numpy as np

import mdr_core as mdr
from mdr_core import abel
from mdr_core.yielding import LiveInterval

#: Places at which the elements are followed, besides the radii a and c of all states.
_PLACES = 300


class ChainStates:
    """A `TimedIndentation` whose elements are followed once for all states; `states[i]` is one of them."""

    def __init__(self, path, at=slice(None), whole=None):
        self._path, self._at, self._whole = path, at, whole or self
        self._states = path[at]

    def __getattr__(self, name):
        return getattr(self._states, name)

    def __getitem__(self, index):
        return ChainStates(self._path, index, self._whole)

    @property
    def mean_pressure(self):
        a = np.asarray(self.contact_radius)
        return (self.force / np.where(a > 0, np.pi * a * a, np.inf))[()]

    @property
    def live(self):
        """What is pressed down further than the imprint, as far as one interval of depths tells."""
        a, lower = np.asarray(self.contact_radius), np.asarray(self.plastic_depth)
        upper = np.where(a > 0, np.maximum(self.profile.reduced(a), lower), lower)
        length = np.where(a > 0, np.maximum(upper - lower, np.finfo(float).tiny), 0.0)
        return LiveInterval(lower, upper, length)

    @cached_property
    def _elements(self):
        """Places x, reduced heights there, line loads and elastic compressions, a row for each state."""
        path = self._path
        half = float(np.max(path.contact_radius)) or 1.0
        x = np.linspace(0, half, _PLACES)
        x = np.unique(np.concatenate([x, path.contact_radius, np.minimum(path.plastic_radius, half)]))
        return x, path.profile.reduced(x), *path.elements(x)

    def relaxing(self, g):
        """What is left (m) of the elastic compression of elements at heights g that have let go."""
        _, heights, load, elastic = self._whole._elements
        return np.interp(g, heights, np.where(load[self._at] > 0, 0.0, elastic[self._at]), right=0.0)

    def surface(self, r):
        """Elastic displacement (m) of the surface, u = (2/π) ∫ u_e dx/√(r² − x²), also of what relaxes."""
        x, _, _, elastic = self._whole._elements
        u, r = elastic[self._at], np.asarray(r, float)[..., None]
        inside, slope = np.minimum(x, r), np.diff(u) / np.diff(x)
        with np.errstate(invalid="ignore"):
            angle = np.diff(np.where(r > 0, np.arcsin(inside / np.where(r > 0, r, 1.0)), np.pi / 2))
        rest = np.diff(np.sqrt((r - inside) * (r + inside)))
        return 2 / np.pi * np.sum((u[:-1] - slope * x[:-1]) * angle - slope * rest, axis=-1)

    def imprint(self, r):
        """Depth (m) of the residual imprint, as at rest."""
        return mdr.Indentation(self.profile, self.medium, self.depth, self.live_interval).imprint(r)

    def pressure(self, r):
        """Contact pressure (Pa) at radii r (m), from the elements followed for all states."""
        x, g, load, _ = self._whole._elements
        radius, r = float(self.contact_radius), np.asarray(r, float)
        inside = x < radius
        if not inside.any():
            return np.zeros(r.shape)[()]
        x, q = np.append(x[inside], radius), load[self._at][inside]
        # Dashpots that are pressed down end with a jump.
        rim = q[-1] - self.medium.E_star * float(self.profile.reduced(radius) - g[inside][-1])
        pressed = self._at > 0 and self._path.depth[self._at] > self._path.depth[self._at - 1]
        q = np.append(q, min(max(rim, 0.0), q[-1]) if pressed else 0.0)
        return 0.0 - abel.stress_from_line_load(x, q, r)
