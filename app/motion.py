"""The motion of a dry impact: times and energies along the way."""

from dataclasses import dataclass

import numpy as np

import mdr_core as mdr

_FINE = 2001


@dataclass(frozen=True, eq=False)
class Motion:
    """Time, speeds, states and energies (SI) from first contact to its loss."""

    time: np.ndarray
    depth: np.ndarray
    velocity: np.ndarray
    force: np.ndarray
    contact_radius: np.ndarray
    plastic_radius: np.ndarray
    plastic_depth: np.ndarray
    live_depth: np.ndarray
    kinetic_energy: np.ndarray
    stored_energy: np.ndarray
    plastic_work: np.ndarray
    viscous_work: np.ndarray


def motion(hit, n):
    """Motion of one dry impact at n times, the turning point among them."""
    largest, d_p = float(hit.max_depth), float(hit.plastic_depth)
    # The square takes out the square root of the speed at the turning point.
    rise = 1 - (1 - np.linspace(0, 1, _FINE)) ** 2
    loading = largest * rise
    unloading = largest - (largest - d_p) * np.linspace(0, 1, _FINE) ** 2
    energy = float(hit.mass * hit.speed**2 / 2)
    times = [_times(hit, path, energy) for path in (loading, unloading)]
    half = n // 2 + 1
    down = np.interp(np.linspace(0, times[0][-1], half), times[0], loading)
    up = np.interp(np.linspace(0, times[1][-1], n - half + 1), times[1], unloading)[1:]
    depth = np.append(down, up)
    depth[half - 1], depth[-1] = largest, d_p
    time = np.append(
        np.linspace(0, times[0][-1], half),
        times[0][-1] + np.linspace(0, times[1][-1], n - half + 1)[1:],
    )
    states = mdr.indent(hit.profile, hit.medium, depth)
    kinetic = np.maximum(energy - states.stored_energy - states.plastic_work, 0.0)
    speed = np.sqrt(2 * kinetic / hit.mass)
    return Motion(
        time=time,
        depth=depth,
        velocity=np.where(np.arange(n) < half, speed, -speed),
        force=states.force,
        contact_radius=states.contact_radius,
        plastic_radius=states.plastic_radius,
        plastic_depth=states.plastic_depth,
        live_depth=states.live.length,
        kinetic_energy=kinetic,
        stored_energy=states.stored_energy,
        plastic_work=states.plastic_work,
        viscous_work=np.zeros(n),
    )


def _times(hit, path, energy):
    """Times at which a stretch of depths is passed, by the midpoint rule."""
    middle = (path[1:] + path[:-1]) / 2
    way = np.append(float(hit.max_depth), middle) if path[0] > path[-1] else middle
    states = mdr.indent(hit.profile, hit.medium, way)[-len(middle) :]
    kinetic = np.maximum(energy - states.stored_energy - states.plastic_work, energy * 1e-15)
    return np.append(0.0, np.cumsum(np.abs(np.diff(path)) / np.sqrt(2 * kinetic / hit.mass)))
