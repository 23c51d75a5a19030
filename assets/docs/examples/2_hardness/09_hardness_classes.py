r"""
Classes of hardness
===================

The hardness of many metals falls with the depth of a sharp tip as :math:`H = H_0 \sqrt{1 + h^*/h}` (the
form of Nix and Gao 1998); the hardness of a glass is nearly constant. The numbers here are made up, not
measured. ``fit_hardness`` compares the power of the radius with the three classes, and finds both metals
between (a) and (b), closer to (b) for a larger :math:`h^*`.
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

tip = mdr.Cone.berkovich()
h = np.geomspace(0.15e-6, 2e-6, 12)
a = h / tip.slope
materials = {
    "made metal, h* = 0.5 µm": (0.8e9 * np.sqrt(1 + 0.5e-6 / h), 130e9),
    "made metal, h* = 2 µm": (0.5e9 * np.sqrt(1 + 2e-6 / h), 130e9),
    "made glass": (np.full(h.size, 9e9), 70e9),
}
for name, (mean_pressure, E_star) in materials.items():
    fit = mdr.fit_hardness(tip, mean_pressure, a, E_star=E_star)
    print(f"{name}: {fit.class_of_hardness.reason}")
    plt.loglog(
        a * 1e6,
        mean_pressure / 1e9,
        "o-",
        label=f"{name}: slope {fit.class_of_hardness.slope:.2f}",
    )
plt.plot(a * 1e6, 4 * a[0] / a, "k--", label="class (b): slope −1")
plt.gca().set(xlabel="contact radius a (µm)", ylabel="hardness (GPa)")
plt.legend()
