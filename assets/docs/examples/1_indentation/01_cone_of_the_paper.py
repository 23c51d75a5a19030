r"""
The cone of the paper, equation by equation
===========================================

Every equation of Popov (2015) for a cone, :math:`z = s r`, beside the number of the library.
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

E, q_c, s = 10e9, 100.0, 0.3
cone, medium = mdr.Cone(slope=s), mdr.Medium(E_star=E, q_c=q_c)
d_c = np.pi * q_c / (2 * E)
state = mdr.indent(cone, medium, 4 * d_c)
d, a, c = state.depth, state.contact_radius, state.plastic_radius
hit = mdr.impact(cone, medium, mass=1e-9, speed=10.0)
work = hit.mass * hit.speed**2 / 2
F_c = np.pi * q_c**2 / (2 * E * s)

rows = [
    ("(14) reduced profile at a: (π/2) s a", np.pi / 2 * s * a, cone.reduced(a)),
    ("(12) yield line load: π q_c/2", np.pi / 2 * q_c, medium.yield_line_load),
    ("(16) contact radius: 2d/(π s)", 2 * d / (np.pi * s), a),
    ("(19) critical depth: π q_c/(2E*)", d_c, medium.critical_depth),
    ("(20) critical force: π q_c²/(2E* s)", F_c, mdr.yield_force(cone, medium)),
    ("(21) plastic radius: a − q_c/(E* s)", a - q_c / (E * s), c),
    (
        "(22) force: F_c + 2 (q_c/s) (d − d_c)",
        F_c + 2 * q_c / s * (d - d_c),
        state.force,
    ),
    ("(24) damaged area: 4W/(π q_c s)", 4 * work / (np.pi * q_c * s), hit.damaged_area),
]
for name, formula, number in rows:
    print(f"{name:40} {formula:.6e}   {number:.6e}")

# %%
# The last one holds for fast impacts. The force is linear in the depth after first yield:
path = mdr.indent(cone, medium, np.linspace(0, 4 * d_c, 200))
plt.plot(path.depth * 1e9, path.force * 1e6)
plt.plot(d_c * 1e9, F_c * 1e6, "o")
plt.gca().set(xlabel="d (nm)", ylabel="F (µN), first yield at the dot")
