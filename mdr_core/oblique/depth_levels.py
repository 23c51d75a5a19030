"""Levels of depth, and the times at which a normal impact passes them: a grid for friction."""

from dataclasses import dataclass

import numpy as np

from ..contact.yielding import yield_rule
from ..impacts.dense_motion import dense_motion

#: Largest number of levels of a run.
MOST_LEVELS = 6000


@dataclass(frozen=True)
class Levels:
    """Levels: depths (m), times (s) and velocities (m/s) on loading, live depths and times on unloading."""

    depth: np.ndarray
    loading_time: np.ndarray
    velocity: np.ndarray
    live_depth: np.ndarray
    unloading_time: np.ndarray


def levels(hit, inertia, halvings, instants=()):
    """The `Levels` of a run along the surface under one normal `Impact`, with C = 2κE*/m_t (1/(m s²)).

    Steps of loading are halved in time; depths at `instants` (s) are levels as well.
    """
    dense, max_depth, lower = dense_motion(hit), hit.max_depth, hit.plastic_depth
    loading, unloading, turn = dense.loading, dense.unloading, dense.turning_time
    instants = np.asarray(instants, dtype=float)
    early = np.append(_even_times(hit, loading, 0.0, inertia), instants[instants < turn])
    late = np.append(_even_times(hit, unloading, lower, inertia), instants[instants > turn])
    onset = min(yield_rule(hit.profile, hit.medium).onset(), max_depth)
    inner = np.append(lower + unloading.at(late).depth, [lower, onset])
    inner = inner[(inner > 0) & (inner < max_depth)]
    depth = np.concatenate([[0.0, max_depth], loading.at(early).depth, inner])
    coarse, first = np.unique(np.clip(depth, 0.0, max_depth), return_index=True)
    time = np.concatenate([[0.0, turn], early, loading.when(inner)])[first]
    time = np.maximum.accumulate(np.minimum(time, turn))
    # Each step of loading in equal parts.
    count = 2**halvings
    time = np.append(time[:-1, None] + np.diff(time)[:, None] * (np.arange(count) / count), time[-1])
    state = loading.at(time)
    depth = np.clip(state.depth[:-1], np.repeat(coarse[:-1], count), np.repeat(coarse[1:], count))
    depth[::count] = coarse[:-1]
    depth = np.append(depth, coarse[-1])
    live_depth = np.append(depth[depth > lower][::-1] - lower, 0.0)
    unloading_time = np.maximum.accumulate(np.append(turn, unloading.when(live_depth[1:])))
    return Levels(depth, time, np.maximum(state.velocity, 0.0), live_depth, unloading_time)


def _even_times(hit, branch, lower, inertia):
    """Times (s) at equal shares of all change on a branch whose depths count from `lower` (m)."""
    state = branch.nodes(25)
    radius = hit.profile.radius_at(np.clip(lower + state.depth, 0.0, hit.max_depth))
    # Stick relaxes on springs and dashpots at these rates (1/s).
    stick = np.sqrt(inertia * radius) + inertia * hit.medium.relaxation_time * radius
    rates = 1 / np.ptp(state.time) + stick
    share = np.diff(state.time) * (rates[1:] + rates[:-1]) / 2
    sizes = np.ptp(state.depth), radius.max(), np.ptp(state.velocity)
    for values, size in zip((state.depth, radius, state.velocity), sizes, strict=True):
        share += np.abs(np.diff(values)) / size
    share = np.append(0.0, np.cumsum(share))
    count = int(np.ceil(min(4 * share[-1], MOST_LEVELS / 16)))
    return np.interp(np.linspace(0, share[-1], count + 1)[1:-1], share, state.time)
