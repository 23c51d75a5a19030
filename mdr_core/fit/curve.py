"""Force–depth curves: their model with its derivatives, and their branches.

    ∂F/∂ln E* = F − 2E* c d_c,   ∂F/∂ln q_c = 2E* c d_c,   ∂F/∂d = 2E* a,   ∂F/∂d_max = −2E* c

with d_max the largest depth so far; on a first loading it is d itself, and the last two add up. A viscous
medium has the force of an elastic one at the depth e = d + min(τḋ, 0), at which elements are released, and
that of the dashpots, 8η a max(ḋ, 0), so that ∂F/∂η = 8 a(e) ḋ. The measured force is F + F₀ + F₁ z + ζ ż at
the measured depth z.

A running maximum of noisy depths would grow with every jitter. With depth noise the d_max of each turning
point is therefore a parameter, and each sample is assigned to the nearest point of its branch, in units of
both noises (orthogonal distances: Boggs, Byrd & Schnabel, SIAM J. Sci. Stat. Comput. 8, 1987, 1052). The
residual is the distance in units of √(σ_F² + (S σ_d)²), S the slope at that point.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..integrals import integrals
from ..live_interval import LiveInterval
from ..quadrature import radius_rate
from ..yielding import ConstantCap
from .adhesive_curve import adhesive_states, next_to_jumps

#: All parameters in the order of a fit, those of the background, those fitted as logarithms, and those by
#: which the force of the contact has derivatives, without and with adhesion.
PARAMETERS = "E_star", "q_c", "eta", "contact_point", "baseline", "tilt", "drag", "work_of_adhesion"
BACKGROUND = ("baseline", "tilt", "drag")
LOGARITHMIC = ("E_star", "q_c", "contact_point", "work_of_adhesion")
_OF_FORCE = ("E_star", "q_c", "eta")
_WITH_ADHESION = ("E_star", "work_of_adhesion")
#: Standard deviations of samples that are not to weigh, in units of those they would have.
NO_WEIGHT = 1e6
#: The contact point is searched down to so many ranges of depth below the record.
REACH = 30.0


@dataclass(frozen=True)
class CurveProblem:
    """Least-squares problem of R curves of N samples with K turning points each, one curve a row.

    `rate` is ż (m/s); `fixed` holds the fixed parameters by name (R,); `depth_noise` and `sigma` (R, N) are
    the standard deviations of depth (m) and force (N); `turning_points` (R, K) and `loading_starts` are
    indices; `contact` (R, N) says with adhesion which samples are in contact; `time` (s) may be None.
    Scaled parameters x are logarithms of E*, q_c, w and `top` − z₀, otherwise shares of `length` (m),
    `load` (N) and `speed` (m/s).
    """

    profile: object
    depth: np.ndarray
    force: np.ndarray
    rate: np.ndarray
    fixed: dict
    depth_noise: float
    sigma: np.ndarray
    turning_points: np.ndarray
    loading_starts: np.ndarray
    contact: np.ndarray | None = None
    time: np.ndarray | None = None

    def rows(self, rows):
        fixed = {name: value[rows] for name, value in self.fixed.items()}
        names = ["depth", "force", "rate", "sigma", "turning_points", "loading_starts"]
        names += [name for name in ("contact", "time") if getattr(self, name) is not None]
        return replace(self, fixed=fixed, **{name: getattr(self, name)[rows] for name in names})

    #: Largest depth (m), ranges of depth (m) and force (N) and largest speed (m/s) of each curve (R, 1);
    #: names of free parameters.
    top = cached_property(lambda self: self.depth.max(axis=1, keepdims=True))
    length = cached_property(lambda self: np.ptp(self.depth, axis=1, keepdims=True))
    load = cached_property(lambda self: np.ptp(self.force, axis=1, keepdims=True))
    speed = cached_property(lambda self: np.abs(self.rate).max(axis=1, keepdims=True))
    free = cached_property(lambda self: tuple(name for name in PARAMETERS if name not in self.fixed))

    @property
    def memoryless(self):
        """Whether the medium is held elastic: the order of the samples does not matter."""
        return bool(np.all(np.isinf(self.fixed.get("q_c", 0.0))))

    @property
    def adhesive(self):
        """Whether there is adhesion, of a medium that is then held elastic."""
        return bool(np.any(self.fixed.get("work_of_adhesion", 1.0)))

    def in_contact(self, contact):
        """The problem with the samples (R, N) that are in contact."""
        return replace(self, contact=contact)

    @property
    def free_turning_points(self):
        """Number of turning points whose depths are parameters."""
        return self.turning_points.shape[1] if self.depth_noise else 0

    def _columns(self, values, turning_depth):
        """Columns of the free parameters and of the free turning depths (R, P)."""
        columns = [values[name] for name in self.free]
        return np.hstack([*columns, turning_depth[:, : self.free_turning_points]])

    @cached_property
    def scale(self):
        """Unit of each scaled parameter, 1 for a logarithm (R, P)."""
        units = dict.fromkeys(LOGARITHMIC, np.ones_like(self.length))
        units |= {"baseline": self.load, "tilt": self.load / self.length}
        if {"eta", "drag"} & set(self.free):
            units["drag"] = self.load / self.speed
            radius = self.profile._radius(np.minimum(self.length, self.profile.known_depth))
            units["eta"] = units["drag"] / (8 * radius)
        return self._columns(units, np.repeat(self.length, self.turning_points.shape[1], axis=1))

    @cached_property
    def offset(self):
        """Origin of each scaled parameter (R, P): turning depths count from the largest depth."""
        origins = dict.fromkeys(PARAMETERS, np.zeros_like(self.top))
        return self._columns(origins, np.repeat(self.top, self.turning_points.shape[1], axis=1))

    def parameters(self, x):
        """Parameters by name (R, 1) and turning depths (R, K) of scaled parameters."""
        plain = self.offset + self.scale * x
        values = {name: value[:, None] for name, value in self.fixed.items()}
        for name, column in zip(self.free, plain.T, strict=False):
            values[name] = (np.exp(column) if name in LOGARITHMIC else column)[:, None]
        if "contact_point" in self.free:
            values["contact_point"] = self.top - values["contact_point"]
        return values, plain[:, len(self.free) :]

    def scaled(self, values, turning_depth):
        """Scaled parameters: the inverse of `parameters`."""
        values = values | {"contact_point": self.top - values["contact_point"]}
        values |= {name: np.log(values[name]) for name in LOGARITHMIC if name in self.free}
        return (self._columns(values, turning_depth) - self.offset) / self.scale

    def units(self, values):
        """Derivatives of the free parameters by the scaled ones (R, P)."""
        units = self.scale[:, : len(self.free)].copy()
        values = values | {"contact_point": values["contact_point"] - self.top}
        for i, name in enumerate(self.free):
            if name in LOGARITHMIC:
                units[:, i] = np.where(np.isfinite(values[name]), values[name], 1.0)[:, 0]
        return units

    @cached_property
    def branches(self):
        """Index of the last turning point before each sample (−1: none), and whether it is on a loading."""
        sample = np.arange(self.depth.shape[1])
        last = np.sum(sample > self.turning_points[:, :, None], axis=1) - 1
        loading = np.zeros(self.depth.shape, bool)
        for k in range(self.loading_starts.shape[1]):
            stop = self.turning_points[:, k, None] if k < self.turning_points.shape[1] else sample.size
            loading |= (sample >= self.loading_starts[:, k, None]) & (sample <= stop)
        return last, loading

    def largest_so_far(self, depth, turning_depth):
        """Largest depth so far (m), and whether it is the depth of the sample itself."""
        if self.memoryless:
            return depth, np.ones(depth.shape, bool)
        if not self.depth_noise:
            largest = np.maximum.accumulate(depth, axis=1)
            return largest, depth >= largest
        last, loading = self.branches
        turning_depth = np.hstack([np.full_like(self.length, -np.inf), turning_depth])
        largest = np.take_along_axis(turning_depth, last + 1, axis=1)
        loading = loading & (depth >= largest)
        return np.where(loading, depth, largest), loading

    def background(self, values):
        """Force F₀ + F₁ z + ζ ż (N) that is not of the contact."""
        columns = self.background_columns
        used = (name for name in BACKGROUND if name in self.free or values[name].any())
        return sum((values[name] * columns[name] for name in used), 0.0)

    @cached_property
    def background_columns(self):
        """Derivatives of the background by its parameters."""
        return {"baseline": np.ones_like(self.depth), "tilt": self.depth, "drag": self.rate}

    def states(self, x):
        """Parameters, distance (m) of each sample from the nearest state of its branch, and that state."""
        values, turning_depth = self.parameters(x)
        measured, turning_depth = (z - values["contact_point"] for z in (self.depth, turning_depth))
        with np.errstate(all="ignore"):
            state = CurveState.at(self, values, measured, turning_depth)
            if self.depth_noise:
                state = self._nearest(values, measured, turning_depth, state)
        return values, measured - state.depth, state

    def _nearest(self, values, measured, turning_depth, state):
        """The state of each branch that is nearest to its sample."""
        load, noise = self.force - self.background(values), self.depth_noise

        def distance(state):
            return ((measured - state.depth) / noise) ** 2 + ((load - state.force) / self.sigma) ** 2

        nearest, least = state.depth, distance(state)
        # The slope is 0 without contact: the search also starts just within the contact.
        inside = np.maximum(measured, state.live_interval.lower + noise)
        state = CurveState.at(self, values, inside, turning_depth)
        for _ in range(6):
            squares = distance(state)
            nearest = np.where(squares < least, state.depth, nearest)
            least = np.minimum(squares, least)
            residual = load - state.force - state.slope * (measured - state.depth)
            step = state.slope * noise**2 * residual / (self.sigma**2 + (state.slope * noise) ** 2)
            state = CurveState.at(self, values, measured + step, turning_depth)
        nearest = np.where(distance(state) < least, state.depth, nearest)
        return CurveState.at(self, values, nearest, turning_depth)

    def residuals(self, x):
        """Residuals in units of their noise (R, N), and derivatives by the scaled parameters (R, N, P)."""
        values, distance, state = self.states(x)
        noise = self.noise(state.slope)
        residual = self.force - self.background(values) - state.force - state.slope * distance
        return residual / noise, state.derivatives(self, values) / noise[..., None] * self.scale[:, None, :]

    def noise(self, slope):
        """Standard deviation (N) of the residuals from both noises, at slopes of the curve (N/m)."""
        if self.adhesive:
            return np.where(next_to_jumps(self.contact), NO_WEIGHT, 1.0) * self.sigma
        return np.sqrt(self.sigma**2 + (slope * self.depth_noise) ** 2)

    def with_best_turning_points(self, x):
        """The problem with each turning point at the sample for which its two branches fit best."""
        sample, turning_points = np.arange(self.depth.shape[1]), self.turning_points.copy()
        stops = np.hstack([self.loading_starts[:, 1:], np.full((len(self.depth), 1), sample.size)])
        for k in range(turning_points.shape[1]):
            start, stop = self.loading_starts[:, k], stops[:, k]
            squares = []
            for index in (stop - 1, start):
                trial = self.turning_points.copy()
                trial[:, k] = index
                squares.append(replace(self, turning_points=trial).residuals(x)[0] ** 2)
            gain = np.cumsum(squares[0] - squares[1], axis=1)
            between = (sample >= start[:, None]) & (sample < stop[:, None])
            turning_points[:, k] = np.argmin(np.where(between, gain, np.inf), axis=1)
        return replace(self, turning_points=turning_points)


@dataclass(frozen=True)
class CurveState:
    """States of the model at all samples, arrays (R, N).

    `loading` says whether the depth is the largest so far; `uniform_load` is the line load (N/m) of
    dashpots, 4ηḋ, or of adhesion, `slope` ∂F/∂d, `memory_slope` ∂F/∂d_max where the depth is not the
    largest so far, `gradient` ∂F by the parameters of `_OF_FORCE` or `_WITH_ADHESION`.
    """

    depth: np.ndarray
    loading: np.ndarray
    live_interval: LiveInterval
    uniform_load: np.ndarray
    force: np.ndarray
    slope: np.ndarray
    memory_slope: np.ndarray
    gradient: np.ndarray

    @classmethod
    def at(cls, problem, values, depth, turning_depth):
        """States at depths (m) from first contact, turning points likewise."""
        largest, loading = problem.largest_so_far(depth, turning_depth)
        if problem.adhesive:
            *states, gradient = adhesive_states(problem.profile, values, depth, problem.contact)
            return cls(depth, loading, *states, np.zeros_like(depth), gradient)
        rate = problem.rate if values["eta"].any() or "eta" in problem.free else 0.0
        return cls.without_adhesion(problem.profile, values, depth, largest, loading, rate)

    @classmethod
    def without_adhesion(cls, profile, values, depth, largest, loading, rate):
        """States at depths (m) and rates (m/s), the largest depths so far given.

        Above the known depth they are those at it.
        """
        rule, modulus = ConstantCap.of(profile, values["E_star"], values["q_c"]), 2 * values["E_star"]
        known, lag = profile.known_depth, 4 * values["eta"] / values["E_star"] * rate
        ahead = np.minimum(lag, 0.0)
        largest = np.minimum(largest, known)
        interval = rule.at(largest, np.minimum(depth + ahead, known))
        contact = interval.length > 0
        a = np.where(contact, profile._radius(interval.upper), 0.0)
        c = np.where(contact & (interval.lower > 0), profile._radius(interval.lower), 0.0)
        force, memory_slope = modulus * integrals(profile).radius_integral(interval), -modulus * c
        yielded = np.where(c > 0, -memory_slope * rule.cap(largest), 0.0)
        gradient = np.stack([force - yielded - modulus * a * ahead, yielded, 8 * a * rate])
        slope = modulus * a + np.where(loading, memory_slope, 0.0)
        memory_slope = np.where(loading, 0.0, memory_slope)
        uniform_load = np.where(contact, values["E_star"] * np.maximum(lag, 0.0), 0.0)
        if uniform_load.any():
            force = force + 2 * uniform_load * a
            # da/dd may be infinite at first contact: that at the mean distance of samples is the largest.
            inside = np.maximum(interval.upper, np.ptp(depth, axis=1, keepdims=True) / depth.shape[1])
            growing = contact & (a < profile.wall)
            rate_of_radius = radius_rate(profile, np.minimum(inside, known))
            slope = slope + 2 * uniform_load * np.where(growing, rate_of_radius, 0.0)
        return cls(depth, loading, interval, uniform_load, force, slope, memory_slope, gradient)

    def derivatives(self, problem, values):
        """−∂F by the free parameters, in logarithms, and by turning depths (R, N, P)."""
        names = _WITH_ADHESION if problem.adhesive else _OF_FORCE
        columns = dict(zip(names, -self.gradient, strict=True))
        shift = values["contact_point"] - problem.top
        columns["contact_point"] = shift * (self.slope + self.memory_slope)
        background = problem.background_columns.items()
        columns |= {name: -column for name, column in background if name in problem.free}
        last, _ = problem.branches
        turning = [np.where(last == k, -self.memory_slope, 0.0) for k in range(problem.free_turning_points)]
        free = [columns[name] for name in problem.free]
        return np.stack([*free, *turning], axis=-1) if free or turning else self.force[..., None][..., :0]
