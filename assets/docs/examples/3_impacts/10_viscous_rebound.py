"""
Viscous rebound over speed
==========================

A ball of 2 mm hits a polymer. At low speed the viscosity dissipates little energy, at
high speed much. With yield the coefficient of restitution falls further. The contact
time is shorter for faster impacts.
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

ball, mass, speed = mdr.Paraboloid(radius=2e-3), 1e-4, np.geomspace(0.01, 5.0, 40)
media = {
    "yields, η = 30 Pa·s": mdr.Medium(E_star=4e6, q_c=200.0, eta=30.0),
    "elastic, η = 30 Pa·s": mdr.Medium(E_star=4e6, eta=30.0),
    "yields, η = 0": mdr.Medium(E_star=4e6, q_c=200.0),
}
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
for name, medium in media.items():
    hit = mdr.impact(ball, medium, mass, speed)
    left.semilogx(speed, hit.restitution, label=name)
    right.loglog(speed, hit.contact_time * 1e3, label=name)
left.set(xlabel="speed (m/s)", ylabel="coefficient of restitution")
right.set(xlabel="speed (m/s)", ylabel="contact time (ms)")
left.legend()
plt.show()
