"""
A first hour
============

You press a cone into gold, look at the springs, exceed a limit, evaluate a measured
curve, hit a plate and save a table. Each part is a few lines; paste them into Python
one after the other. To answer the question below each part, change one number and run
the part again.

It needs ``pip install ".[all]" matplotlib``, in the folder of the project. All
quantities are in SI units. Close each figure to go on.
"""

# %%
# Press a cone into gold
# ----------------------
# A medium has an effective modulus E* and a hardness. The hardness of gold at the
# nanoscale falls with the contact radius, σ_c = q_c/a. The path goes down to 8 nm and
# back to 6.6 nm.

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

gold = mdr.Medium.from_bodies(E1=78e9, nu1=0.42, q_c=100.0)
cone = mdr.Cone(slope=0.3)
depth = np.append(np.linspace(0, 8e-9, 200), np.linspace(8e-9, 6.6e-9, 100))
path = mdr.indent(cone, gold, depth)
print(path)

plt.plot(path.depth * 1e9, path.force * 1e6)
plt.gca().set(xlabel="depth (nm)", ylabel="force (µN)")
plt.show()

# %%
# **Change the slope of the cone to 0.15: does the force at 8 nm rise or fall?**
#
# The springs
# -----------
# A row of springs is equivalent to the medium. The springs under the tip have yielded
# and carry the same line load. Towards the rim of the contact the springs are elastic.
# The pressure is an integral over the springs.

state = path[199]
x = np.linspace(-1.2, 1.2, 400) * state.contact_radius
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.5), layout="constrained")
left.fill_between(x * 1e9, state.line_load(np.abs(x)))
left.axvline(state.plastic_radius * 1e9, color="black", linestyle=":")
left.set(xlabel="x (nm)", ylabel="line load of the springs (N/m)")
right.plot(x * 1e9, state.pressure(np.abs(x)) / 1e9)
right.set(xlabel="r (nm)", ylabel="pressure (GPa)")
print(f"contact radius {state.contact_radius * 1e9:.1f} nm")
print(f"plastic radius {state.plastic_radius * 1e9:.1f} nm")
plt.show()

# %%
# **Change q_c to 200 N/m: which of the two radii changes, and by how much?**
#
# A limit of the model
# --------------------
# A result lists the assumptions that it exceeds. A common mistake: ``Cone`` takes a
# slope, not an angle. 70.3 as a slope is a needle; write
# ``Cone.from_half_angle(70.3)`` for a Berkovich tip.

for limit in mdr.indent(mdr.Cone(slope=70.3), gold, 1e-9).limits:
    print(limit.what, "is exceeded:" if limit.exceeded else "holds:", limit.sentence)

# %%
# **Change 70.3 to 0.3581, the slope of the cone of a Berkovich tip: which message does
# the limit have now?**
#
# A measured curve
# ----------------
# ``read_curve`` reads the tables of instruments and reports their columns. The
# unloading gives modulus and hardness by Oliver and Pharr. ``quoted`` is the number to
# quote. By default the fit assumes class (b), a hardness q_c/a. That is wrong for
# silica, as the figure shows.

curve = mdr.read_curve(mdr.example("silica.csv"))
berkovich = mdr.Cone.from_half_angle(70.3)
print(curve)
print(mdr.oliver_pharr(berkovich, curve))
fit = mdr.fit_indentation(berkovich, curve, contact_point=0.0)
print(fit.quoted)

top = np.argmax(curve.force)
part = slice(top + np.argmax(curve.force[top:] < 0.12 * curve.force[top]))
depth, force = curve.depth[part] * 1e6, curve.force[part] * 1e3
fitted = force - fit.residuals[part] * 1e3
plt.figure()
plt.plot(depth, force, ".", markersize=2, label="measured")
plt.plot(depth, fitted, label="fitted, hardness q_c/a")
plt.gca().set(xlabel="depth (µm)", ylabel="force (mN)")
plt.legend()
plt.show()

# %%
# The hardness of silica does not depend on the size of the contact, and the fit shows
# it: ``print(fit)`` names class (a).
#
# **Add hardness=None to the fit: how does the fitted curve change?**
#
# A ball hits a plate
# -------------------
# A plate carries energy away by bending waves. Here a steel ball of 10 mm falls on
# 4 mm of a carbon laminate.

ball = mdr.Paraboloid(radius=5e-3)
plate = mdr.Structure.plate(thickness=4e-3, E=50e9, nu=0.3, density=1600.0)
laminate, speed = mdr.Medium(E_star=10e9), np.geomspace(0.1, 10, 30)
block = mdr.impact(ball, laminate, mass=4.1e-3, speed=speed)
hit = mdr.impact(ball, laminate, mass=4.1e-3, speed=speed, structure=plate)

plt.figure()
plt.semilogx(speed, block.restitution, label="thick block")
plt.semilogx(speed, hit.restitution, label="plate of 4 mm")
plt.gca().set(xlabel="speed (m/s)", ylabel="coefficient of restitution", ylim=(0, 1.05))
plt.legend()
plt.show()

# %%
# **Change the thickness to 8 mm: which of the two curves moves?**
#
# A table
# -------
# Each result is a table with units, for pandas, xarray or a file.

table = hit.to_pandas()
print(table[["speed", "restitution", "contact_time", "max_deflection"]].iloc[::10])
# table.to_csv("plate.csv") writes it. hit.to_xarray().to_netcdf("plate.nc") keeps the
# units with it.

# %%
# Without code: the :doc:`explorer </explorer>` has sliders for all of this, and its
# page ``/app?fit`` evaluates your curve. :doc:`How do I </how_do_i>` has an answer for
# most other tasks.
