r"""
Erosion of a metal at an angle
==============================

Grains of quartz of 50 µm hit mild steel, of constant hardness, and a composite,
:math:`\sigma_c = q_c/a`. The work of indentation grows with the angle between path and
surface. The work of friction cuts the surface. It has a maximum where a grain slips to
the end, near :math:`\tan 2\alpha = 2 m_t/(\mu m (1 + e))`, the dotted line for steel.
Metals erode most at 20° to 30°, brittle solids at 90°.
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

degrees, speed, friction, radius = np.linspace(5, 90, 35), 30.0, 0.2, 25e-6
grain = mdr.Ball(mass=2650 * 4 / 3 * np.pi * radius**3, radius=radius)
quartz = {"E2": 95e9, "nu2": 0.08}
media = {
    "steel": mdr.Medium.from_bodies(210e9, 0.3, **quartz, hardness=2e9),
    "composite": mdr.Medium.from_bodies(7e9, 0.35, **quartz, q_c=2000.0),
}
speeds = mdr.at_angle(speed, np.pi / 2 - np.radians(degrees))
energy, rotates = grain.mass * speed**2 / 2, {"tangential_mass": grain.tangential_mass}

figure, (normal, along) = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
for name, medium in media.items():
    given = mdr.Sphere(radius), medium, grain.mass, *speeds, friction
    hit = mdr.oblique_impact(*given, **rotates, tolerance=1e-3)
    normal.plot(degrees, hit.plastic_work / energy, label=name)
    style = "--" if name == "composite" else "-"
    along.plot(degrees, hit.friction_work / energy, style, label=name)
    most = degrees[np.argmax(hit.friction_work)]
    print(f"{name}: friction takes most at {most:.0f}°")
    if name == "steel":
        e, share = hit.restitution[10], grain.tangential_mass / grain.mass
        angle = np.degrees(np.arctan(2 * share / (friction * (1 + e)))) / 2
        along.axvline(angle, linestyle=":", color="gray", label="slip to the end")
normal.set(xlabel="angle of attack (°)", ylabel="plastic work over energy")
along.set(xlabel="angle of attack (°)", ylabel="friction work over energy")
normal.legend()
along.legend()
plt.show()
