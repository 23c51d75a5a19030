"""
Damaged area over energy for three classes of hardness
======================================================

For hardness inversely proportional to the contact radius, class (b), and a cone, the area damaged by a
fast impact is proportional to its energy (Popov 2015, Eq. (24)). The solution for any speed approaches
it. Classes (a), constant hardness, and (c), hardness inversely proportional to the area, have other powers.
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

medium, mass = mdr.Medium(E_star=8e9, q_c=2000.0), 1e-9
speed = np.geomspace(0.3, 100, 200)
hit = mdr.impact(mdr.Cone(slope=0.5), medium, mass, speed)
energy = mass * speed**2 / 2
yields = hit.damaged_area > 0
plt.loglog(energy[yields], hit.damaged_area[yields], "k", label="(b), every speed")
for name, style in (("a", ":"), ("b", "--"), ("c", "-.")):
    law = mdr.ScalingLaw(name, exponent=1.0)
    area = hit.fast_limit.contact_area[-1] * (energy / energy[-1]) ** law.area
    plt.plot(energy, area, style, label=f"({name}), fast: ∝ W^{law.area:.2g}")
plt.gca().set(xlabel="energy W (J)", ylabel="damaged area (m²)", ylim=(1e-14, 1e-6))
plt.legend()
