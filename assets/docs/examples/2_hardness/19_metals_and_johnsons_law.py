r"""
Restitution of a metal ball
===========================

A medium of constant hardness :math:`H` is class (a): glasses and metals. A ball then
rebounds with :math:`e \propto v^{-1/4}`, the exponent of Johnson's law for metals
(Contact Mechanics, 1985, 11.5),
:math:`e = 3.8\,(Y/E^*)^{1/2} (\tfrac12 m v^2/(Y R^3))^{-1/8}`. The prefactor differs: e
is about 0.7 of Johnson's value. The contact radius causes one half of the difference:
:math:`a^2 = R d` as in an elastic contact, instead of :math:`a^2 = 2 R d` by plastic
flow. The unloading, as of a flat face, causes the other half. The model of LAMMPS
(``granular mdr``, 22 July 2025) lies between. It was run for this ball, E = 70 GPa,
ν = 0.3, Y = 1 GPa, without damping.
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

radius, Y = 0.5e-3, 1e9
ball, mass = mdr.Paraboloid(radius), 7800 * 4 / 3 * np.pi * radius**3
medium = mdr.Medium.from_bodies(70e9, 0.3, hardness=2.75 * Y)
speed = np.geomspace(0.1, 100, 200)
hit = mdr.impact(ball, medium, mass, speed)
work = mass * speed**2 / 2
johnson = 3.8 * np.sqrt(Y / medium.E_star) * (work / (Y * radius**3)) ** -0.125

at, lammps = np.array([10.0, 30.0]), [0.752, 0.508]
e = mdr.impact(ball, medium, mass, at).restitution
laws = np.interp(at, speed, johnson)
for v, own, other, law in zip(at, e, lammps, laws, strict=True):
    print(f"{v:g} m/s: e = {own:.3f}, LAMMPS {other}, Johnson {law:.3f}")
print(f"{speed[-1]:g} m/s: {hit.restitution[-1] / johnson[-1]:.2f} of Johnson's")
print(f"onset of yield at {mdr.yield_speed(ball, medium, mass):.3g} m/s")

figure, ax = plt.subplots(layout="constrained")
ax.loglog(speed, hit.restitution, label="constant hardness, H = 2.75 Y")
plastic = johnson < 1
ax.plot(speed[plastic], johnson[plastic], "k--", label="Johnson, fully plastic")
ax.plot(at, lammps, "s", label="LAMMPS, granular mdr")
ax.set(xlabel="speed (m/s)", ylabel="coefficient of restitution", ylim=(0.25, 1.2))
ax.set_yticks([0.3, 0.4, 0.5, 0.7, 1.0], ["0.3", "0.4", "0.5", "0.7", "1"])
ax.set_yticks([], minor=True)
ax.legend()
plt.show()
