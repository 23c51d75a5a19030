r"""
Damaged area over energy for three classes of hardness
======================================================

A fast impact of a cone on a medium of class (b), with a hardness inversely proportional
to the contact radius, damages an area in proportion to its energy (Popov 2015,
Eq. (24)). The solution for any speed approaches this law. Class (a) has a constant
hardness, and class (c) a hardness inversely proportional to the area. They have other
powers, drawn through the same point.
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

medium, mass = mdr.Medium(E_star=8e9, q_c=2000.0), 1e-9
speed = np.geomspace(0.5, 100, 400)
hit = mdr.impact(mdr.Cone(slope=0.5), medium, mass, speed)
energy = mass * speed**2 / 2
yields = hit.damaged_area > 0

figure, ax = plt.subplots(layout="constrained")
ax.loglog(energy[yields], hit.damaged_area[yields], "k", label="(b), any speed")
for name, style, power in (("a", ":", "2/3"), ("b", "--", "1"), ("c", "-.", "2")):
    law = mdr.ScalingLaw(name, exponent=1.0)
    area = hit.fast_limit.contact_area[-1] * (energy / energy[-1]) ** law.area
    label = rf"({name}), fast: $A \propto W^{{{power}}}$"
    ax.plot(energy, area, style, label=label)
ax.set(xlabel="energy W (J)", ylabel="damaged area A (m²)", ylim=(1e-14, 1e-7))
ax.legend()
plt.show()
