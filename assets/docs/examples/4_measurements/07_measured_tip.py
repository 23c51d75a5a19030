"""
A measured tip
==============

A scan across the axis often gives a noisy tip. ``Sampled.fit`` finds the convex profile
nearest to the scan. Here the true tip is a paraboloid, so that the error of the force
is known.
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

radius, noise = 1e-6, 1e-9
r = np.linspace(-400e-9, 400e-9, 201)
z = r**2 / (2 * radius) + noise * np.random.default_rng(1).standard_normal(r.size)
tip = mdr.Sampled.fit(r, z)

medium = mdr.Medium.from_bodies(E1=78e9, nu1=0.42, q_c=100.0)
depth = np.linspace(1e-9, 40e-9, 40)
force = mdr.indent(tip, medium, depth).force
exact = mdr.indent(mdr.Paraboloid(radius), medium, depth).force

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
left.plot(r * 1e9, z * 1e9, ".", label="measured")
left.plot(r * 1e9, tip.height(r) * 1e9, label="Sampled.fit")
left.set(xlabel="r (nm)", ylabel="z (nm)")
left.legend()
right.plot(depth * 1e9, 100 * (force / exact - 1))
right.set(xlabel="d (nm)", ylabel="error of the force (%)")
plt.show()
