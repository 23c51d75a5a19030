r"""
Oblique impact of a ball
========================

Maw's curve: the tangential velocity of the point of contact after an elastic impact of a ball over its
value before, as :math:`\psi = \kappa v_t/(\mu v)`. At small angles the contact sticks at first, and the
point of contact leaves backwards; at large angles it slips throughout, :math:`\psi_2 = \psi_1 - 4\chi`
(Maw, Barber, Fawcett 1976).
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

ball, medium = mdr.Ball(mass=1e-3, radius=5e-3), mdr.Medium(E_star=1e9, poisson=0.3)
kappa, friction, speed = medium.tangential_ratio, 0.3, 1.0
psi = np.linspace(0.2, 8.0, 9)
hit = mdr.oblique_impact(
    mdr.Paraboloid(ball.radius), medium, ball.mass, speed, psi * friction * speed / kappa, friction,
    tangential_mass=ball.tangential_mass, tolerance=1e-3,
)  # fmt: skip
chi = kappa * ball.mass / (2 * ball.tangential_mass)

plt.plot(
    psi,
    kappa * hit.tangential_velocity / (friction * speed),
    "o-",
    label="oblique_impact",
)
plt.plot(psi, psi - 4 * chi, "--", label="slip throughout, ψ₁ − 4χ")
plt.gca().set(xlabel="ψ₁ before", ylabel="ψ₂ after", ylim=(-2, 4))
plt.legend()
