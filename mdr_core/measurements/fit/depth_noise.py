"""Curves with noise of the depth: turning points, branches and the nearest states.

A running maximum of noisy depths would grow with the noise. Therefore the largest depth d_max at each
turning point is a parameter. Each sample is assigned to the nearest point of its branch, in units of both
noises (orthogonal distances: Boggs, Byrd & Schnabel, SIAM J. Sci. Stat. Comput. 8, 1987, 1052). The
residual is the distance in units of √(σ_F² + (S σ_d)²) with the slope S at this point.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..common.errors import roughness
from .curves import Curves


@dataclass(frozen=True)
class NoisyDepthCurves(Curves):
    """`Curves` with noise of the depth, and with K turning points each.

    `turning_points` (R, K) and the starts of the loadings before them, `loading_starts`, are indices of
    samples. A curve that ends on a loading has one more start.
    """

    turning_points: np.ndarray
    loading_starts: np.ndarray

    @cached_property
    def branches(self):
        """Index of the last turning point before each sample, or −1, and a mask of samples on a loading."""
        sample = np.arange(self.depth.shape[1])
        last = np.sum(sample > self.turning_points[:, :, None], axis=1) - 1
        loading = np.zeros(self.depth.shape, bool)
        for k in range(self.loading_starts.shape[1]):
            stop = self.turning_points[:, k, None] if k < self.turning_points.shape[1] else sample.size
            loading |= (sample >= self.loading_starts[:, k, None]) & (sample <= stop)
        return last, loading

    def largest_so_far(self, depth, turning_depth):
        last, loading = self.branches
        turning_depth = np.hstack([np.full_like(self.length, -np.inf), turning_depth])
        largest = np.take_along_axis(turning_depth, last + 1, axis=1)
        loading = loading & (depth >= largest)
        return np.where(loading, depth, largest), loading

    def states(self, x):
        """Return the parameters by name, and the state of its branch that is nearest to each sample."""
        values = self.values(x)
        measured = self.depth - values["contact_point"]
        load = self.force - self.background(values)

        def distance(state):
            depth, force = measured - state.depth, load - state.force
            return (depth / self.depth_noise) ** 2 + (force / self.sigma) ** 2

        state = self.states_at(values, measured)
        nearest, least = state.depth, distance(state)
        # Without contact the slope is 0, so the search also starts just within the contact.
        state = self.states_at(values, np.maximum(measured, state.live_interval.lower + self.depth_noise))
        for _ in range(6):
            sum_of_squares = distance(state)
            nearest = np.where(sum_of_squares < least, state.depth, nearest)
            least = np.minimum(sum_of_squares, least)
            residual = load - state.force - state.slope * (measured - state.depth)
            share = state.slope * self.depth_noise**2 / self.noise(state.slope) ** 2
            state = self.states_at(values, measured + share * residual)
        nearest = np.where(distance(state) < least, state.depth, nearest)
        return values, self.states_at(values, nearest)

    def noise(self, slope):
        return np.sqrt(self.sigma**2 + (slope * self.depth_noise) ** 2)

    def turning_gradient(self, state):
        last, _ = self.branches
        own = last[..., None] == np.arange(self.turning_points.shape[1])
        return np.where(own, state.memory_slope[..., None], 0.0)

    def first_turning_depth(self):
        return np.take_along_axis(self.depth, self.turning_points, axis=1)


def with_depth_noise(curves):
    """Yield numbers of curves with equally many turning points, and their `NoisyDepthCurves`."""
    samples = zip(curves.depth, curves.force, strict=True)
    indices = [turning_points_of(*row, curves.depth_noise) for row in samples]
    elastic = np.isinf(curves.held.get("q_c", np.zeros(len(curves.depth))))
    indices = [((), ()) if known else pair for known, pair in zip(elastic, indices, strict=True)]
    counts = [(len(turns), len(starts)) for turns, starts in indices]
    for count in sorted(set(counts)):
        rows = np.array([i for i, other in enumerate(counts) if other == count])
        turns, starts = (np.array(each, int) for each in zip(*(indices[i] for i in rows), strict=True))
        subset = curves.rows(rows)
        yield rows, subset.as_kind(NoisyDepthCurves, turning_points=turns, loading_starts=starts)


def turning_points_of(depth, force, depth_noise):
    """Return the `turning_points` of a curve (N,), whose depth and force turn back at the same sample.

    The path is the weighted sum of depth and force; the quieter of the two has the larger weight.
    """
    path, variance, threshold = 0.0, 0.0, 0.0
    for values, sigma in ((depth, depth_noise), (force, roughness(force[None])[0, 0])):
        size = np.ptp(values)
        weight = 1 / (0.005 + sigma / size)
        path = path + weight * values / size
        threshold += 0.02 * weight
        variance += (weight * sigma / size) ** 2
    return turning_points(path.tolist(), max(threshold, 6 * np.sqrt(variance)))


def turning_points(path, threshold):
    """Return the indices where a path turns back from a new largest value, and where the loadings start.

    Moves of less than `threshold` are noise. A path that ends at a new largest value has one more start
    than turning points.
    """
    turns, starts, extreme, largest = [], [], 0, -np.inf
    rising, start = True, 0
    for i, value in enumerate(path):
        if (rising and value >= path[extreme]) or (not rising and value <= path[extreme]):
            extreme = i
        elif abs(value - path[extreme]) > threshold:
            if not rising:
                start = extreme
            elif path[extreme] > largest + threshold / 2:
                turns.append(extreme)
                starts.append(start)
                largest = path[extreme]
            rising, extreme = not rising, i
    if rising and path[extreme] > largest + threshold / 2:
        starts.append(start)
    return turns, starts
