"""References for the chain by other methods: small steps of the law, and a scalar equation of motion."""

import numpy as np
from scipy.integrate import solve_ivp

import mdr_core as mdr


class SmallSteps:
    """Elements that follow their law in steps of first order.

    u_p ← max(u_p, u − d_c), u_e = u − u_p in contact, released at u_e + τḋ < 0, then u_e ∝ exp(−t/τ).
    """

    def __init__(self, medium, reduced):
        self.medium, self.reduced = medium, np.asarray(reduced, dtype=float)
        self.plastic = np.zeros_like(self.reduced)
        self.elastic = np.zeros_like(self.reduced)
        self.contact = np.zeros(self.reduced.shape, bool)

    def step(self, depth, rate, dt):
        """Move to a depth (m) at a rate (m/s) in a time (s)."""
        tau = self.medium.relaxation_time
        relaxed = self.elastic * np.exp(-dt / tau)
        penetration = depth - self.reduced - self.plastic
        self.contact = (self.contact | (penetration > relaxed)) & (penetration + tau * rate > 0)
        excess = np.where(self.contact, np.maximum(penetration - self.medium.critical_depth, 0.0), 0.0)
        self.plastic = self.plastic + excess
        self.elastic = np.where(self.contact, penetration - excess, relaxed)

    def follow(self, time, depth, steps):
        """Follow a path in this number of steps between successive times."""
        for t0, t1, d0, d1 in zip(time, time[1:], depth, depth[1:], strict=False):
            for k in range(1, steps + 1):
                self.step(d0 + (d1 - d0) * k / steps, (d1 - d0) / (t1 - t0), (t1 - t0) / steps)
        return self

    def load(self, rate):
        """Line load (N/m) of each element."""
        lag = self.medium.relaxation_time * rate
        return self.medium.E_star * np.where(self.contact, np.maximum(self.elastic + lag, 0.0), 0.0)

    def fly(self, width, mass, depth, velocity, dt):
        """Impact of a body of a mass (kg) on elements of given widths (m): final depth, velocity, time."""
        time, touched = 0.0, False
        while velocity > 0 or self.contact.any() or not touched:
            velocity -= 2 * self.load(velocity) @ width / mass * dt
            depth += velocity * dt
            time += dt
            self.step(depth, velocity, dt)
            touched |= bool(self.contact.any())
        return depth, velocity, time


def scalar_impact(shape, medium, mass, speed):
    """Restitution, maximum depth and contact time of an impact on a virgin medium.

    While ḋ ≥ 0: m d̈ = −φ(d) + φ(d_p) − 8ηa ḋ. Then elements are released at g = d + τḋ, outside first:
    m d̈ = −φ(d + τḋ) + φ(d_p), until d + τḋ = d_p.
    """
    tau, d_c = medium.relaxation_time, medium.critical_depth
    dry, elastic = (mdr.Medium(medium.E_star, q_c=q) for q in (medium.q_c, np.inf))

    def loading(_, y):
        d = max(y[0], 0.0)
        force = mdr.indent(shape, dry, d).force + 8 * medium.eta * shape.contact_radius(d) * y[1]
        return [y[1], -force / mass]

    down = _until(lambda _, y: y[1], loading, 0.0, [0.0, speed], 1e-9 * d_c / speed)
    max_depth = down.y[0, -1]
    plastic = max(0.0, max_depth - d_c)
    base = mdr.indent(shape, elastic, plastic).force

    def unloading(_, y):
        edge_depth = max(y[0] + tau * y[1], plastic)
        return [y[1], -(mdr.indent(shape, elastic, edge_depth).force - base) / mass]

    turn = down.t[-1]
    up = _until(lambda _, y: y[0] + tau * y[1] - plastic, unloading, turn, [max_depth, 0.0], 1e-6 * turn)
    return -up.y[1, -1] / speed, max_depth, up.t[-1]


def _until(event, slope, start, state, first):
    event.terminal, event.direction = True, -1
    # The absolute tolerance must not matter: depths are of the order of nanometres.
    return solve_ivp(
        slope, (start, 1e9), state, "DOP853", events=event, rtol=1e-11, atol=1e-24, first_step=first
    )
