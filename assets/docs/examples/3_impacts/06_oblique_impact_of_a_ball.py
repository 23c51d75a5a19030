r"""
Oblique impact of a ball
========================

Maw's curve: the tangential velocity of the point of contact after an elastic impact of
a ball over its value before, as :math:`\psi = \kappa v_t/(\mu v)`. At small angles the
contact sticks at first, and the point of contact leaves backwards. At large angles it
slips throughout, :math:`\psi_2 = \psi_1 - 4\chi` (Maw, Barber, Fawcett 1976).
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

ball, medium = mdr.Ball(mass=1e-3, radius=5e-3), mdr.Medium(E_star=1e9, poisson=0.3)
kappa, friction, speed = medium.tangential_ratio, 0.3, 1.0
psi = np.linspace(0.2, 8.0, 9)
along = psi * friction * speed / kappa
given = mdr.Paraboloid(ball.radius), medium, ball.mass, speed, along, friction
rotates = {"tangential_mass": ball.tangential_mass}
hit = mdr.oblique_impact(*given, **rotates, tolerance=1e-3)
chi, after = kappa * ball.mass / (2 * ball.tangential_mass), hit.tangential_velocity

plt.plot(psi, kappa * after / (friction * speed), "o-", label="oblique_impact")
plt.plot(psi, psi - 4 * chi, "--", label="slip throughout, ψ₁ − 4χ")
plt.gca().set(xlabel="ψ₁ before", ylabel="ψ₂ after", ylim=(-2, 4))
plt.legend()
plt.show()
