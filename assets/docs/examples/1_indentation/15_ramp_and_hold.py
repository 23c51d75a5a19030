"""
Ramp and hold, creep
====================

Under a prescribed depth, a viscous medium relaxes when the ramp ends. Under a
prescribed force it creeps with its relaxation time.
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

medium = mdr.Medium(E_star=4e6, q_c=200.0, eta=30.0)
tau = medium.relaxation_time
time = np.linspace(0, 6, 31) * tau
cone = mdr.Cone(slope=0.3)
depth, force = 2e-4 * np.minimum(time / (2 * tau), 1), np.where(time > 0, 0.2, 0.0)
ramp = mdr.indent_in_time(cone, medium, depth, time, tolerance=1e-2)
held = mdr.creep(cone, medium, force, time, tolerance=1e-2)

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
left.plot(time / tau, ramp.force)
left.set(xlabel="t/τ", ylabel="F (N)", title="ramp and hold")
right.plot(time / tau, held.depth * 1e6)
right.set(xlabel="t/τ", ylabel="d (µm)", title="constant force")
plt.show()
