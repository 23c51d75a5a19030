"""
Load, unload, reload: pressure and imprint
==========================================

Unloading removes only the elastic part. Reloading follows the unloading curve, and then
continues the first loading. In the plastic zone the pressure is lower than in an
elastic contact, and an imprint remains.
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

medium = mdr.Medium.from_bodies(E1=78e9, nu1=0.42, q_c=100.0)
turns = np.array([0, 8, 6.6, 12, 10.4]) * 1e-9
depth = np.interp(np.linspace(0, 4, 401), range(5), turns)
path = mdr.indent(mdr.Sphere(radius=200e-9), medium, depth)

figure, axes = plt.subplots(1, 3, figsize=(12, 4), layout="constrained")
axes[0].plot(path.depth * 1e9, path.force * 1e6)
axes[0].set(xlabel="d (nm)", ylabel="F (µN)")
for i in (100, 300):
    state, r = path[i], np.linspace(0, 100e-9, 300)
    label = f"d = {state.depth * 1e9:.0f} nm"
    axes[1].plot(r * 1e9, state.pressure(r) / 1e9, label=label)
    axes[2].plot(r * 1e9, -state.imprint(r) * 1e9, label=label)
axes[1].set(xlabel="r (nm)", ylabel="pressure (GPa)")
axes[2].set(xlabel="r (nm)", ylabel="imprint (nm)")
axes[1].legend()
plt.show()
