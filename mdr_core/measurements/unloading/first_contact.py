"""First contact of a record that begins in the air."""

from dataclasses import dataclass, replace

import numpy as np

from ...solver.contact.integrals import integrals
from ...solver.contact.live_interval import LiveInterval
from ..common.errors import SIGNIFICANT, block_factors, block_length, roughness
from ..common.least_squares import least_squares

#: Smallest number of samples in the air, and their smallest length as a share of the range of depth.
LEAST_SAMPLES, LEAST_LENGTH = 5, 0.02
#: Largest number of samples for the median and the deviation in the air.
_QUIET = 20
#: Largest force of a trend in the air at the largest depth, as a share of the largest force.
_CONSTANT = 0.01
#: Shares of the largest force up to which a power law is fitted, from large to small.
_SHARES = (1.0, 0.5, 0.25, 0.1, 0.05, 0.02, 0.01)
#: Largest amounts by which the exponent of the loading may be below that of an elastic contact. The second
#: amount serves a second search, for a hardness that falls with the radius. Smallest exponent. Largest
#: amount by which the exponent may be above that of an elastic contact.
_SOFTER, _SOFTEST, _STIFFER = (0.5, 1.2), 0.3, 1.0
#: Trial first contacts, as shares of the depth between the first sample and the first visible force.
_STARTS = np.linspace(0.1, 1.0, 4)
#: Smallest number of samples of a fitted part. Standard deviations of noise that its force must exceed, and
#: within which two first contacts agree.
_FEW, _SEEN, _AGREE = 10, 10.0, 2.0


@dataclass(frozen=True)
class FirstContact:
    """Depth (m) of first contact and force (N) without contact, and their standard errors."""

    depth: float
    depth_error: float
    baseline: float
    baseline_error: float


def first_contact(profile, depth, force):
    """Return the `FirstContact` of a loading that begins in the air, or None, and the samples before it.

    F = F₀ + k (h − z₀)^m is fitted to the samples up to several shares of the largest force. With a worn
    tip, or a medium that begins to yield, only the beginning of the loading follows a power law. A share is
    valid if its z₀ agrees with the z₀ of all smaller shares (Lepski, Theory Probab. Appl. 35, 1990, 454).
    The valid share with the smallest error gives the result; the error includes the difference to smaller
    shares. m is from 1/2 below to 1 above the exponent of an elastic contact.
    """
    top = int(np.argmax(force))
    seen, level, noise = first_seen(force[: top + 1])
    length = depth[top] - depth[0]
    if seen < LEAST_SAMPLES or top - seen < _FEW or depth[seen] - depth[0] <= LEAST_LENGTH * length:
        return None, 0
    # The last samples before may already be in contact, below the noise.
    quiet = slice(max(LEAST_SAMPLES, seen // 2))
    if _trend(depth[quiet], force[quiet]) * length > _CONSTANT * (force[top] - level):
        return None, 0
    for softer in _SOFTER:
        loading = depth[: top + 1], force[: top + 1]
        contact = _contact_of_loading(profile, *loading, seen, level, noise, softer)
        if softer > _SOFTER[0]:
            # Such a force begins almost at once; the distance of the samples limits the accuracy.
            step = depth[seen] - depth[seen - 1]
            contact = replace(contact, depth_error=float(np.hypot(contact.depth_error, step)))
        before = np.count_nonzero(depth[:seen] < contact.depth - 2 * contact.depth_error)
        if before >= LEAST_SAMPLES and contact.depth - depth[0] >= LEAST_LENGTH * length:
            return contact, before
    return None, 0


def contact_before(profile, depth, force):
    """Return the `FirstContact` before the first sample of a loading that begins in contact, no offset."""
    noise = roughness(force[None])[0, 0]
    return _contact_of_loading(profile, depth, force, 0, 0.0, noise, _SOFTER[0])


def first_seen(force):
    """Return the index of the first sample with a visible force, and level and noise (N) before it."""
    rough, seen = roughness(force[None])[0, 0], 0
    for _ in range(2):
        # The air may consist of the first few samples only; more samples determine the noise better.
        quiet = force[: max(LEAST_SAMPLES, min(_QUIET, seen // 2))]
        level = np.median(quiet)
        noise = max(rough, np.std(quiet), 1e-12 * abs(force[-1] - level))
        below = np.flatnonzero(force <= level + SIGNIFICANT * noise)
        seen = int(below[-1]) + 1 if below.size else 0
    return seen, level, noise


def _trend(depth, force):
    """Return the slope (N/m) of the force in the air, 0 within its scatter."""
    x, y = depth - depth.mean(), force - force.mean()
    sum_of_squares = max(x @ x, 1e-300)
    slope = x @ y / sum_of_squares
    scatter = np.sqrt(np.sum((y - slope * x) ** 2) / (x.size - 2) / sum_of_squares)
    return abs(slope) if abs(slope) > SIGNIFICANT * scatter else 0.0


def _contact_of_loading(profile, depth, force, seen, level, noise, softer):
    """Return the `FirstContact` of a loading whose force is visible from sample `seen`."""
    least, most = elastic_exponents(profile, depth[-1] - depth[0])
    exponents = max(least - softer, _SOFTEST), most + _STIFFER
    parts, contacts = [], []
    for share in _SHARES:
        height = share * (force[-1] - level)
        end = int(np.argmax(force >= level + height)) + 1
        if end - seen >= _FEW and height > _SEEN * noise:
            parts.append((depth[:end], force[:end]))
            contacts.append(_power_law(*parts[-1], seen, *exponents))
    contacts = [each for each in contacts if each.depth_error < np.inf]
    agreeing = []
    for i, each in enumerate(contacts):
        smaller = contacts[i + 1 :]
        distances = [abs(each.depth - other.depth) for other in smaller]
        if all(
            distance <= _AGREE * np.hypot(each.depth_error, other.depth_error)
            for distance, other in zip(distances, smaller, strict=True)
        ):
            others = zip(distances[:2], smaller[:2], strict=True)
            bias = max((min(distance, other.depth_error) for distance, other in others), default=0.0)
            agreeing.append(replace(each, depth_error=float(np.hypot(each.depth_error, bias))))
    if agreeing:
        return min(agreeing, key=lambda each: each.depth_error)
    # If the exponent is undetermined, first contact is between the results for both bounds.
    part = parts[-1] if parts else (depth, force)
    ends = [_power_law(*part, seen, exponent, exponent) for exponent in exponents]
    middle, half = (sum(each.depth for each in ends) / 2, abs(ends[1].depth - ends[0].depth) / 2)
    return replace(ends[0], depth=middle, depth_error=half)


def elastic_exponents(profile, largest):
    """Return the smallest and the largest exponent m of F ∝ d^m of elastic contacts up to a depth (m)."""
    depth = min(largest, profile.known_depth) * np.array([0.05, 0.2, 1.0])
    force = integrals(profile).radius_integral(LiveInterval.elastic(depth))
    exponents = depth * profile.radius_at(depth) / force
    return float(exponents.min()), float(exponents.max())


def _power_law(depth, force, seen, least, most):
    """Return the `FirstContact` by F₀ + k (h − z₀)^m with m between bounds.

    The error is infinite if m is at a bound. The first `seen` samples are in the air. If there are none,
    F₀ is 0.
    """
    size, origin, length = np.ptp(force), depth[0], depth[-1] - depth[0]
    level = force[:seen].mean() if seen else 0.0
    x, y = (depth - origin) / length, (force - level) / size

    def function(parameters, _):
        F0, k, z, m = parameters.T[:, :, None]
        reach = np.maximum(1 - z, 1e-9)
        u = np.maximum(x - z, 0.0) / reach
        power = u**m
        by_depth = k * m * (power - np.where(u > 0, np.maximum(u, 1e-9) ** (m - 1), 0.0)) / reach
        by_exponent = k * power * np.log(np.maximum(u, 1e-300))
        by_level = np.full_like(power, 1.0 if seen else 0.0)
        return F0 + k * power - y, np.stack([by_level, power, by_depth, by_exponent], axis=-1)

    z = np.minimum(_STARTS * x[min(seen, x.size - 1)], 0.98) if seen else -_STARTS
    start = np.column_stack([0 * z, 0 * z + y[-1], z, 0 * z + (least + most) / 2])
    # Bounds of baseline and range of force, relative to the force range, of first contact, and of m.
    lower, upper = ([-1.0, 1e-3, -2.0 if seen else -50.0, least], [1.0, 10.0, 1.0, most])
    lower, upper = (np.tile(each, (z.size, 1)) for each in (lower, upper))
    minimum = least_squares(function, start, lower, upper, steps=60, tolerance=1e-8)
    best = int(np.argmin(minimum.sum_of_squares))
    values, residual = minimum.x[best], minimum.residual[best]
    errors = np.full(4, np.inf)
    if not minimum.at_bound[best].any():
        jacobian = minimum.jacobian[best]
        scatter = np.sqrt(np.sum(residual**2) / max(x.size - 4, 1))
        _, s, vt = np.linalg.svd(jacobian, full_matrices=False)
        errors = np.linalg.norm(vt.T / np.maximum(s, 1e-14 * s[0]), axis=1) * scatter
        errors *= block_factors(residual, jacobian, block_length(residual))
    air = np.std(force[:seen]) / np.sqrt(seen) if seen else 0.0
    return FirstContact(
        float(origin + values[2] * length),
        float(errors[2] * length),
        float(level + values[0] * size),
        float(air),
    )
