r"""
The cone of the paper, equation by equation
===========================================

Reproduce Popov (2015). The script prints each equation for a cone, :math:`z = s r`,
with the number of the library. The figure draws section 4 of the paper: the line load
q(x), the force, the width a − c of the elastic ring, and the damaged area A(W).
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

E, q_c, s, mass = 10e9, 100.0, 0.3, 1e-9
cone, medium = mdr.Cone(slope=s), mdr.Medium(E_star=E, q_c=q_c)
d_c, F_c = np.pi * q_c / (2 * E), np.pi * q_c**2 / (2 * E * s)
path = mdr.indent(cone, medium, np.linspace(0, 4 * d_c, 201))
state, speed = path[-1], np.geomspace(8e-3, 10.0, 100)
a, c = state.contact_radius, state.plastic_radius
hit, work = mdr.impact(cone, medium, mass, speed), mass * speed**2 / 2
fast = 4 * work / (np.pi * q_c * s)

rows = [
    ("(14) reduced profile at a: (π/2) s a", np.pi / 2 * s * a, cone.reduced(a)),
    ("(12) yield line load: π q_c/2", np.pi / 2 * q_c, medium.yield_line_load),
    ("(16) contact radius: 2d/(π s)", 8 * d_c / (np.pi * s), a),
    ("(19) critical depth: π q_c/(2E*)", d_c, medium.critical_depth),
    ("(20) critical force: π q_c²/(2E* s)", F_c, mdr.yield_force(cone, medium)),
    ("(21) plastic radius: a − q_c/(E* s)", a - q_c / (E * s), c),
    ("(22) force: F_c + 2 (q_c/s) (d − d_c)", F_c + 2 * q_c / s * 3 * d_c, state.force),
    ("(24) damaged area: 4W/(π q_c s)", fast[-1], hit.damaged_area[-1]),
]
for name, formula, number in rows:
    print(f"{name:40} {formula:.6e}   {number:.6e}")

# %%
# Equation (24) holds for fast impacts. Dots mark first yield.
figure, axes = plt.subplots(2, 2, figsize=(9, 6.4), layout="constrained")
(load, force), (ring, area) = axes
for each in (state, path[100], path[50]):
    x = np.linspace(-1.1, 1.1, 400) * a
    load.plot(x * 1e9, each.line_load(np.abs(x)), label=f"d = {each.depth / d_c:g} d_c")
load.axhline(np.pi / 2 * q_c, color="gray", linestyle=":")
load.set(xlabel="x (nm)", ylabel="line load q (N/m)", title="(17), (18): q ≤ π q_c/2")
load.set_ylim(0, 210)
load.legend(loc="upper center", ncols=3, handlelength=1)
force.plot(path.depth * 1e9, path.force * 1e6)
force.plot(d_c * 1e9, F_c * 1e6, "o")
force.set(xlabel="d (nm)", ylabel="F (µN)", title="(22): linear after first yield")
ring.plot(path.depth * 1e9, (path.contact_radius - path.plastic_radius) * 1e9)
ring.plot(d_c * 1e9, q_c / (E * s) * 1e9, "o")
ring.set(xlabel="d (nm)", ylabel="a − c (nm)", title="(21): constant after first yield")
area.loglog(work, hit.damaged_area, label="impact")
area.plot(work, fast, "k--", label="4W/(π q_c s)")
area.set(xlabel="energy W (J)", ylabel="damaged area A (m²)", title="(24): A ∝ W")
area.legend()
plt.show()
