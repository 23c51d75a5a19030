"""Measured curves as a least-squares problem: residuals and their derivatives by scaled parameters.

`Curves` assumes exact depths. `adhesion.py` and `depth_noise.py` have the problems with adhesion and with
noise of the depth.
"""

from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np

from ...solver.profiles.profile import Profile
from ..common.least_squares import least_squares
from .model import constant_cap, radius_cap, states
from .parameters import BACKGROUND, CLASSES, PARAMETERS, TOGETHER

#: Factor on the standard deviation of a sample that removes its weight.
NO_WEIGHT = 1e6


@dataclass(frozen=True)
class Curves:
    """R curves of N samples with exact depths, one curve in each row.

    Fields are depth z (m), force (N) and its standard deviation `sigma` (N), rate ż (m/s), and time (s) or
    None. The standard deviation of the depth (m) is 0 here. `held` has the values (R,) of held parameters
    by name. Scaled parameters x (R, P) are the free parameters and then the depths at K turning points,
    which are parameters if depths are noisy.
    """

    profile: Profile
    depth: np.ndarray
    force: np.ndarray
    sigma: np.ndarray
    rate: np.ndarray
    time: np.ndarray | None
    depth_noise: float
    held: dict[str, np.ndarray]

    #: Whether the media are adhesive.
    adhesive = False

    def rows(self, rows):
        """Return the curves at some rows."""
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        arrays = {name: value[rows] for name, value in values.items() if isinstance(value, np.ndarray)}
        return replace(self, **arrays, held={name: value[rows] for name, value in self.held.items()})

    def as_kind(self, kind, **values):
        """Return the curves as a subclass with further fields."""
        own = {field.name: getattr(self, field.name) for field in fields(Curves)}
        return kind(**own, **values)

    @cached_property
    def top(self):
        """Largest depth (m) of each curve (R, 1)."""
        return self.depth.max(axis=1, keepdims=True)

    @cached_property
    def length(self):
        """Range of depth (m) of each curve (R, 1)."""
        return np.ptp(self.depth, axis=1, keepdims=True)

    @cached_property
    def load(self):
        """Range of force (N) of each curve (R, 1)."""
        return np.ptp(self.force, axis=1, keepdims=True)

    @cached_property
    def speed(self):
        """Largest speed (m/s) of each curve (R, 1)."""
        return np.abs(self.rate).max(axis=1, keepdims=True)

    @cached_property
    def left_out(self):
        """Mask of samples without weight (R, N)."""
        return self.sigma > np.sqrt(NO_WEIGHT) * self.sigma.min(axis=1, keepdims=True)

    @cached_property
    def free(self):
        """Names of the free parameters."""
        return tuple(name for name in PARAMETERS if name not in self.held)

    @cached_property
    def constants(self):
        """Names of the constants of the hardness that are not held at 0."""
        return tuple(name for name in CLASSES.values() if name not in self.held or self.held[name].any())

    @cached_property
    def parameters(self):
        """All parameters by name, with their scaling."""
        return PARAMETERS if len(self.constants) == 1 else PARAMETERS | TOGETHER

    @cached_property
    def held_elastic(self):
        """Whether the media are held elastic, so the order of the samples does not matter."""
        return bool(np.all(np.isinf(self.held.get("q_c", 0.0))))

    @cached_property
    def background_columns(self):
        """Derivatives of the background by its parameters, by name."""
        return {"baseline": np.ones_like(self.depth), "tilt": self.depth, "drag": self.rate}

    def values(self, x):
        """Return parameters by name (R, 1), and depths at turning points (R, K) as `turning_depth`."""
        values = {name: value[:, None] for name, value in self.held.items()}
        for i, name in enumerate(self.free):
            values[name] = self.parameters[name].value(x[:, [i]], self)
        values["turning_depth"] = self.top + self.length * x[:, len(self.free) :]
        return values

    def scaled(self, values):
        """Return the scaled parameters: the inverse of `values`."""
        columns = [self.parameters[name].scaled(values[name], self) for name in self.free]
        return np.hstack([*columns, (values["turning_depth"] - self.top) / self.length])

    def units(self, values):
        """Return the derivatives of free parameters and turning depths by the scaled parameters (R, P)."""
        columns = [self.parameters[name].rate(values[name], self) for name in self.free]
        return np.hstack([*columns, self.length + np.zeros_like(values["turning_depth"])])

    def bounds(self, start):
        """Return the bounds of the scaled parameters in a search from a start (R, P)."""
        lower, upper = np.full_like(start, -np.inf), np.full_like(start, np.inf)
        for i, name in enumerate(self.free):
            lower[:, [i]], upper[:, [i]] = self.parameters[name].bounds(start[:, [i]], self)
        return lower, upper

    def background(self, values):
        """Return the background force F₀ + F₁ z + ζ ż (N)."""
        used = (name for name in BACKGROUND if name in self.free or values[name].any())
        return sum((values[name] * self.background_columns[name] for name in used), 0.0)

    def largest_so_far(self, depth, turning_depth):
        """Return the largest depth so far (m), and whether it is the depth of the sample itself."""
        largest = np.maximum.accumulate(depth, axis=1)
        return largest, depth >= largest

    def states_at(self, values, depth):
        """Return the states of the model with the samples at depths (m) from first contact."""
        turning_depth = values["turning_depth"] - values["contact_point"]
        largest, loading = self.largest_so_far(depth, turning_depth)
        cap_at = constant_cap if self.constants == ("q_c",) else radius_cap
        return states(self.profile, values, cap_at, depth, largest, loading, self.rate)

    def states(self, x):
        """Return the parameters by name, and the states of the model at the samples."""
        values = self.values(x)
        return values, self.states_at(values, self.depth - values["contact_point"])

    def model_states(self, x):
        """Return `states` with contact at the samples where the model has contact."""
        return self.states(x)

    def noise(self, slope):
        """Return the standard deviation (N) of the residuals for a slope (N/m) of the force."""
        return self.sigma

    def turning_gradient(self, state):
        """Return the derivatives of the force by the depths at turning points (R, N, K)."""
        return np.zeros((*self.depth.shape, 0))

    def residuals(self, x):
        """Return residuals over their noise (R, N), and derivatives by the scaled parameters (R, N, P)."""
        values, state = self.states(x)
        distance = self.depth - values["contact_point"] - state.depth
        residual = self.force - self.background(values) - state.force - state.slope * distance
        gradient = state.gradient | self.background_columns
        gradient["contact_point"] = -(state.slope + state.memory_slope)
        jacobian = np.empty((*self.depth.shape, x.shape[1]))
        for i, name in enumerate(self.free):
            jacobian[..., i] = -gradient[name]
        jacobian[..., len(self.free) :] = -self.turning_gradient(state)
        noise = self.noise(state.slope)
        jacobian *= self.units(values)[:, None, :] / noise[..., None]
        return residual / noise, jacobian

    def minimum(self, start):
        """Return the `Minimum` of the sum of squares near scaled parameters."""
        return least_squares(lambda x, rows: self.rows(rows).residuals(x), start, *self.bounds(start))

    def search(self, start):
        """Return `minimum`; a subclass may also assign samples to parts of the curve."""
        return self.minimum(start)

    def first_turning_depth(self):
        """Return the measured depths (m) at turning points (R, K)."""
        return np.zeros((len(self.depth), 0))
