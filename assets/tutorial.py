# %% [markdown]
# # From a first curve to an impact
# Run it cell by cell, or as it is. It needs
# `pip install ".[all]" matplotlib`, in the folder of the project.

# %% A first curve: a sphere of 200 nm pressed into gold, let go, pressed again; shown, plotted, saved.
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

medium = mdr.Medium.from_bodies(E1=78e9, nu1=0.42, q_c=100.0)  # hardness 100 N/m over the contact radius
depth = np.concatenate(
    [np.linspace(0, 10e-9, 200), np.linspace(10e-9, 9e-9, 50), np.linspace(9e-9, 12e-9, 50)]
)
path = mdr.indent(mdr.Sphere(radius=200e-9), medium, depth)
print(path)
data = path.to_xarray()
data["force"].plot(x="depth")
plt.savefig("curve.png")
data.to_netcdf("curve.nc")  # path.to_pandas().to_csv("curve.csv") writes a table

# %% [markdown]
# Every quantity of the path is an array; a state of it has fields.

# %%
state = path[-1]
print(f"a = {state.contact_radius * 1e9:.2f} nm, mean pressure {state.mean_pressure / 1e9:.3f} GPa")
r = np.linspace(0, 1.2 * state.contact_radius, 200)
pressure, imprint = state.pressure(r), state.imprint(r)

# %% [markdown]
# Where the model ends is part of the result: slopes here are small, a needle is told.

# %%
for limit in mdr.indent(mdr.Cone(slope=70.3), medium, 1e-9).limits:
    print(limit.what, "exceeded:" if limit.exceeded else "holds:", limit.sentence)

# %% [markdown]
# A measured curve: fused silica under a Berkovich tip, which has the area of a cone of 70.3°. `read_curve`
# reads tables as instruments write them, Excel files, and AFM files by `afmformats`, and shows how it
# understood them. The unloading alone gives modulus and hardness; the fit of the whole curve adds the yield
# constant, with the remark that glass is not in the class of media of this model.

# %%
curve = mdr.read_curve(Path(__file__).with_name("silica.csv"))
print(curve)
berkovich = mdr.Cone.from_half_angle(70.3)
print(mdr.oliver_pharr(berkovich, curve))
print(mdr.fit_indentation(berkovich, curve, contact_point=0.0))

# %% [markdown]
# Tips as they are measured: noisy, on both sides of the axis; `mdr.Sampled.from_csv` reads them.

# %%
noise = np.random.default_rng(1).standard_normal(401)
across = np.linspace(-400e-9, 400e-9, 401)
tip = mdr.Sampled.fit(across, across**2 / 2e-6 + 1e-9 * noise)
ideal = mdr.indent(mdr.Paraboloid(radius=1e-6), medium, 40e-9)
print(f"force off by {mdr.indent(tip, medium, 40e-9).force / ideal.force - 1:.2%}")

# %% [markdown]
# A ball that falls on a polymer: the viscosity takes more than yielding does.

# %%
polymer = mdr.Medium(E_star=4e6, q_c=200.0, eta=30.0)
hit = mdr.impact(mdr.Paraboloid(radius=2e-3), polymer, mass=1e-4, speed=0.5)
print(hit)
motion = hit.motion(200).to_xarray()
motion["force"].plot(x="time")

# %% [markdown]
# Many impacts at once, as a table.

# %%
speeds = mdr.impact(mdr.Cone(slope=0.3), medium, mass=1e-12, speed=np.geomspace(0.01, 10, 7))
print(speeds.to_pandas()[["speed", "restitution", "contact_time", "plastic_work"]])
