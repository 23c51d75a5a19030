r"""
Adhesion and pull-off
=====================

A sphere on an adhesive medium jumps into contact. On unloading it sticks until the
pull-off force. A deeper indentation leaves a larger imprint and needs a larger pull-off
force. Without yield it is :math:`\frac{3}{2} \pi w R` (Johnson, Kendall, Roberts 1971).
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

radius, w = 1e-6, 0.05
sphere = mdr.Paraboloid(radius=radius)
for q_c in (np.inf, 1.0):
    medium = mdr.Medium(E_star=1e9, q_c=q_c, work_of_adhesion=w)
    depth = np.append(np.linspace(-5e-9, 12e-9, 300), np.linspace(12e-9, -15e-9, 500))
    path = mdr.indent(sphere, medium, depth)
    name = "elastic" if np.isinf(q_c) else f"q_c = {q_c:g} N/m"
    plt.plot(path.depth * 1e9, path.force * 1e6, label=name)
    force, jkr = path[299].pull_off_force, 1.5 * np.pi * w * radius
    print(f"{name}: pull-off {force * 1e6:.4f} µN, 3πwR/2 = {jkr * 1e6:.4f} µN")
plt.gca().set(xlabel="d (nm)", ylabel="F (µN)")
plt.legend()
plt.show()
