"""
Stress under a tip
==================

The largest shear stress below a sphere that has yielded. The peak marks the place where
delamination would begin.
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

medium = mdr.Medium(E_star=95e9, q_c=100.0, poisson=0.42)
state = mdr.indent(mdr.Paraboloid(radius=200e-9), medium, 4 * medium.critical_depth)
a = state.contact_radius
r, z = np.meshgrid(np.linspace(-2, 2, 161) * a, np.linspace(0.01, 2.5, 100) * a)
shear = state.stress(r, z).max_shear
peak = state.stress_peak()

levels = plt.contourf(r * 1e9, z * 1e9, shear / 1e9, 20)
plt.colorbar(levels, label="largest shear stress (GPa)")
plt.plot([peak.r * 1e9, -peak.r * 1e9], [peak.z * 1e9] * 2, "w+", markersize=12)
plt.gca().set(xlabel="r (nm)", ylabel="depth z (nm)", aspect="equal")
plt.gca().invert_yaxis()
print(f"largest shear stress {peak.value / 1e9:.2f} GPa at z = {peak.z / a:.2f} a")
plt.show()
