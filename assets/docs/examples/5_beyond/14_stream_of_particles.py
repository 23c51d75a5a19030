"""
A stream of particles
=====================

Ten thousand spheres of random radius and speed hit a composite. ``sweep.impacts`` takes
arrays with named dimensions and returns a dataset. ``assets/erosion.py`` does the same
for 10⁹ particles on a cluster.
"""

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr

import mdr_core as mdr

random, number = np.random.default_rng(1), 10**4
sizes = 25e-6 * np.exp(0.4 * random.standard_normal(number))
radius = xr.DataArray(sizes, dims="particle")
speed = xr.DataArray(30.0 * random.weibull(2.0, number) + 1e-3, dims="particle")
hits = mdr.sweep.impacts(
    mdr.Paraboloid,
    radius=radius,
    E_star=8e9,
    q_c=2000.0,
    mass=2650.0 * 4 / 3 * np.pi * radius**3,  # quartz
    speed=speed,
    quantities=("restitution", "damaged_area"),
)
elastic = float((hits.damaged_area == 0).mean())

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
left.hist(hits.restitution, bins=100)
left.set(xlabel="coefficient of restitution", ylabel="particles")
left.set(title=f"e = 1 without yield: {elastic:.1%} of the particles")
right.hist(hits.damaged_area * 1e12, bins=np.geomspace(1, 1e4, 100))
right.set(xlabel="damaged area (µm²)", ylabel="particles", xscale="log")
plt.show()
