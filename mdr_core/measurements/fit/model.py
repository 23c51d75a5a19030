"""Force of a contact with its derivatives: elastic, yielding and viscous, with a linear background.

With the radii a = a(e) of the contact, c = a(d_p) of the plastic zone, and a* = a(d_max) at the largest
depth so far, the cap is u_c = (π/2E*)(H a* + q_c + f_c/a*), and d_p = d_max − u_c:

    F = 2E* ∫ a ds + 8η a max(ḋ, 0)     over [d_p, e],  e = d + min(τḋ, 0),  τ = 4η/E*
    ∂F/∂E* = 2 ∫ a ds − 2c u_c − 2a min(τḋ, 0)       ∂F/∂η = 8a ḋ
    ∂F/∂H = π c a*          ∂F/∂q_c = π c             ∂F/∂f_c = π c/a*
    ∂F/∂d = 2E* a           ∂F/∂d_max = −2E* c p′     p′ = 1 − du_c/dd_max

On a first loading d_max = d, and the last two derivatives add up. Elements are released at e. The measured
force is F + F₀ + F₁ z + ζ ż at the measured depth z.
"""

from dataclasses import dataclass

import numpy as np

from ...solver.contact.integrals import integrals
from ...solver.contact.live_interval import LiveInterval
from ...solver.contact.quadrature import radius_rate
from ...solver.contact.yielding import ConstantCap, RadiusCap, interval_at
from ...solver.medium.hardness import SumOfClasses


@dataclass(frozen=True)
class States:
    """States of the contact at the samples of R curves, arrays (R, N).

    `loading` marks samples at the largest depth (m) so far, and `cap` is u_c (m) at this largest depth.
    `uniform_load` is the line load (N/m) of dashpots, 4ηḋ, or of adhesion. `slope` is ∂F/∂d (N/m), and
    `memory_slope` is ∂F/∂d_max below the largest depth so far. `gradient` has the derivatives of the force
    with respect to the parameters of the medium, by name.
    """

    depth: np.ndarray
    loading: np.ndarray
    cap: np.ndarray
    live_interval: LiveInterval
    uniform_load: np.ndarray
    force: np.ndarray
    slope: np.ndarray
    memory_slope: np.ndarray
    gradient: dict[str, np.ndarray]


def states(profile, values, cap_at, depth, largest, loading, rate):
    """Return the `States` at depths (m) and rates (m/s), with the largest depths (m) so far.

    `values` are the parameters by name, and `cap_at` is `constant_cap` or `radius_cap`. Beyond the known
    depth, the states are those at the known depth.
    """
    E_star, known, modulus = values["E_star"], profile.known_depth, 2 * values["E_star"]
    lag = 4 * values["eta"] / E_star * rate
    ahead = np.minimum(lag, 0.0)
    largest = np.minimum(largest, known)
    cap, rate_of_plastic_depth, cap_by_constants = cap_at(profile, values, largest)
    interval = interval_at(largest, np.minimum(depth + ahead, known), cap)
    contact = interval.length > 0
    a = np.where(contact, profile.radius_at(interval.upper), 0.0)
    c = np.where(contact & (interval.lower > 0), profile.radius_at(interval.lower), 0.0)
    area = integrals(profile).radius_integral(interval)
    gradient = {
        "E_star": 2 * (area - _plastic(c, cap) - a * ahead),
        "eta": 8 * a * rate,
    }
    for name, derivative in cap_by_constants.items():
        gradient[name] = np.pi * _plastic(c, derivative)
    force = modulus * area
    memory_slope = -modulus * _plastic(c, rate_of_plastic_depth)
    slope = modulus * a + np.where(loading, memory_slope, 0.0)
    uniform_load = np.where(contact, E_star * np.maximum(lag, 0.0), 0.0)
    if uniform_load.any():
        force = force + 2 * uniform_load * a
        # da/dd may be infinite at first contact: its bound is the value at the mean distance of samples.
        inside = np.maximum(interval.upper, np.ptp(depth, axis=1, keepdims=True) / depth.shape[1])
        growing = contact & (a < profile.wall)
        growth_rate = radius_rate(profile, np.minimum(inside, known))
        slope = slope + 2 * uniform_load * np.where(growing, growth_rate, 0.0)
    memory_slope = np.where(loading, 0.0, memory_slope)
    return States(depth, loading, cap, interval, uniform_load, force, slope, memory_slope, gradient)


def _plastic(c, rate):
    """Return c times a rate, or 0 without yield, where c = 0 and the rate may be infinite."""
    with np.errstate(invalid="ignore"):
        return np.where(c > 0, c * rate, 0.0)


def constant_cap(profile, values, largest):
    """Return the values of `radius_cap` for the hardness q_c/a alone, where the cap is constant."""
    return ConstantCap.of(profile, values["E_star"], values["q_c"]).critical_depth, 1.0, {"q_c": 1.0}


def radius_cap(profile, values, largest):
    """Return the cap u_c (m) at the largest depths (m), dp/ds, and ∂u_c/∂constant over π/2E*, by name."""
    share = np.pi / 2 / values["E_star"]
    law = SumOfClasses(*(share * values[name] for name in ("hardness", "q_c", "f_c")))
    rule, a = RadiusCap(profile, law), profile.radius_at(np.maximum(largest, 0.0))
    with np.errstate(divide="ignore"):
        by_constants = {"hardness": a, "q_c": 1.0, "f_c": 1 / a}
    return rule.cap_at(a), 1 - rule.cap_rate_at(a), by_constants
