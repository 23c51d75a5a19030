"""
The idea in one picture
=======================

A body in a half-space, the equivalent row of springs, and the results: force and
pressure. The README shows this figure, ``assets/idea.svg``.
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

ball, medium = mdr.Paraboloid(radius=200e-9), mdr.Medium(E_star=90e9, q_c=100.0)
path = mdr.indent(ball, medium, np.linspace(0.0, 8e-9, 200))
state, nm = path[-1], 1e-9
r = np.linspace(-110.0, 110.0, 221)
over, radius, deepest = np.abs(r) * nm, state.contact_radius / nm, state.depth / nm

figure, (body, row, curves) = plt.subplots(
    1, 3, figsize=(12, 3.4), layout="constrained"
)
body.fill_between(r, -state.surface(over) / nm, -26, color="#d9dee5")
body.fill_between(r, ball.height(over) / nm - deepest, 26, color="#5b6470")
body.set_title("1  A body z(r) in a half-space")

x = np.arange(-104.0, 105.0, 8.0)
tops = np.where(np.abs(x) < radius, ball.reduced(np.abs(x) * nm) / nm - deepest, 0.0)
for place, top in zip(x, tops, strict=True):
    zigzag = place + 2.2 * np.array([0, 0, 1, -1, 1, -1, 1, -1, 0, 0])
    colour = "#c2410c" if abs(place) * nm < state.plastic_radius else "#1d6fa5"
    row.plot(zigzag, np.linspace(-26, top, 10), color=colour, lw=1.2)
row.fill_between(r, ball.reduced(over) / nm - deepest, 26, color="#5b6470")
row.set_title("2  Springs under g(x); orange: yielded")
for axes in (body, row):
    axes.set(xlim=(-108, 108), ylim=(-26, 26), xticks=[], yticks=[])

curves.plot(path.depth / nm, path.force * 1e6, "o-", markevery=[-1], color="#1d6fa5")
curves.set(xlabel="depth d (nm)", ylabel="F (µN), sum of the springs")
inset = curves.inset_axes((0.55, 0.24, 0.42, 0.36), xlabel="r (nm)", ylabel="p (GPa)")
inset.plot(r, state.pressure(over) / 1e9, color="#c2410c")
curves.set_title("3  Force and pressure")
plt.show()
