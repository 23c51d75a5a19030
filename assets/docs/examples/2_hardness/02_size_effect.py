r"""
Size effect and first yield
===========================

The mean pressure under a sphere follows Hertz up to first yield and reaches a maximum.
Then it falls as :math:`q_c/a` with the contact radius: small contacts are harder.
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

medium = mdr.Medium.from_bodies(E1=78e9, nu1=0.42, q_c=100.0)  # gold
for radius in (50e-9, 200e-9, 800e-9):
    sphere, d_c = mdr.Paraboloid(radius=radius), medium.critical_depth
    path = mdr.indent(sphere, medium, np.geomspace(0.1, 100, 200) * d_c)
    first, label = mdr.indent(sphere, medium, d_c), f"R = {radius * 1e9:g} nm"
    (line,) = plt.loglog(
        path.contact_radius * 1e9, path.mean_pressure / 1e9, label=label
    )
    dot, color = (
        (first.contact_radius * 1e9, first.mean_pressure / 1e9),
        line.get_color(),
    )
    plt.plot(*dot, "o", color=color)

a = np.geomspace(5e-9, 500e-9, 20)
plt.plot(a * 1e9, medium.q_c / a / 1e9, "k--", label="q_c/a")
plt.xlabel("contact radius a (nm)")
plt.ylabel("mean pressure (GPa)")
plt.ylim(0.1, 30)
plt.legend(title="dots: first yield")
plt.show()
