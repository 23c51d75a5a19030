"""
Erosion at an angle
===================

A particle of 50 µm hits a composite at 10 m/s. The plastic work grows with the angle of attack; the
friction work has its maximum between 30° and 45°.
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

attack = np.radians([10, 20, 30, 45, 60, 75, 90])
medium, mass = mdr.Medium(E_star=8e9, q_c=2000.0), 1.7e-10
speeds = mdr.at_angle(10.0, np.pi / 2 - attack)
hit = mdr.oblique_impact(mdr.Paraboloid(25e-6), medium, mass, *speeds, 0.2, tolerance=1e-3)

energy = mass * 10.0**2 / 2
plt.plot(np.degrees(attack), hit.plastic_work / energy, "o-", label="plastic work")
plt.plot(np.degrees(attack), hit.friction_work / energy, "s-", label="friction work")
plt.gca().set(xlabel="angle of attack (°)", ylabel="share of the energy")
plt.legend()
