"""
Erosion of a metal at an angle
==============================

Grains of quartz of 50 µm hit mild steel, of constant hardness, and a composite, :math:`\\sigma_c = q_c/a`.
The work of indentation grows with the angle between path and surface. The work of friction, which cuts the
surface, has a maximum where a grain slips to the end, near :math:`\\tan 2\\alpha = 2 m_t/(\\mu m (1 + e))`,
the dotted line for steel. Metals erode most at 20° to 30°, brittle solids at 90°.
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

degrees = np.linspace(5, 90, 35)
grain, friction = mdr.Ball(mass=2650 * 4 / 3 * np.pi * 25e-6**3, radius=25e-6), 0.2
quartz = {"E2": 95e9, "nu2": 0.08}
media = {
    "steel": mdr.Medium.from_bodies(210e9, 0.3, **quartz, hardness=2e9),
    "composite": mdr.Medium.from_bodies(7e9, 0.35, **quartz, q_c=2000.0),
}

figure, axes = plt.subplots(1, 2, sharey=True, layout="constrained")
for name, medium in media.items():
    speeds = mdr.at_angle(30.0, np.pi / 2 - np.radians(degrees))
    mass = grain.tangential_mass
    hit = mdr.oblique_impact(
        mdr.Sphere(25e-6),
        medium,
        grain.mass,
        *speeds,
        friction,
        tangential_mass=mass,
        tolerance=1e-3,
    )
    energy = grain.mass * 30.0**2 / 2
    axes[0].plot(degrees, hit.plastic_work / energy, label=name)
    axes[1].plot(degrees, hit.friction_work / energy, label=name)
    if name == "steel":
        steepness = 2 * mass / (friction * grain.mass * (1 + hit.restitution[10]))
        axes[1].axvline(
            np.degrees(np.arctan(steepness)) / 2, linestyle=":", color="gray"
        )
    print(
        f"{name}: friction takes most at {degrees[np.argmax(hit.friction_work)]:.0f}°"
    )
axes[0].set(xlabel="angle of attack (°)", ylabel="plastic work over energy")
axes[1].set(xlabel="angle of attack (°)", ylabel="friction work over energy")
axes[0].legend()
