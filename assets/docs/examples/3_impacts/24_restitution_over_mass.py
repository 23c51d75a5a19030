"""
Restitution over the mass of the body
=====================================

Bodies with a tip radius of 10 mm hit the middle of a simply supported plate at 3 m/s.
The plate has 120 mm × 120 mm × 4 mm. A light body leaves before waves are back from the
edges; a heavy body meets a spring. Between them the plate swings back, early or late,
and may hit the body more than once.
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

ball, medium, speed = mdr.Paraboloid(radius=10e-3), mdr.Medium(10e9), 3.0
side, plate = 0.12, {"thickness": 4e-3, "E": 50e9, "nu": 0.3, "density": 1600.0}
plate_mass = plate["density"] * plate["thickness"] * side**2
modes = mdr.Structure.supported_isotropic_plate(side, side, **plate, modes=36)
ratio = np.geomspace(0.01, 10, 60)

figure, ax = plt.subplots(figsize=(7, 4), layout="constrained")
hit = mdr.impact(ball, medium, ratio * plate_mass, speed, structure=modes)
ax.semilogx(ratio, hit.restitution, "C0", lw=2, label="by its modes")
endless = mdr.Structure.plate(**plate)
support = mdr.Structure(stiffness=modes.stiffness)
limits = (endless, "k:", "without edges"), (support, "k--", "support")
for structure, style, name in limits:
    hit = mdr.impact(ball, medium, ratio * plate_mass, speed, structure=structure)
    ax.semilogx(ratio, hit.restitution, style, lw=1, label=name)
ax.set(xlabel="body mass over plate mass", ylabel="coefficient of restitution")
ax.legend()
plt.show()
