r"""
Classes of hardness
===================

The hardness of many metals falls with the depth of a sharp tip as
:math:`H = H_0 \sqrt{1 + h^*/h}` (the form of Nix and Gao 1998). The hardness of a glass
is nearly constant. The numbers here are simulated. ``fit_hardness`` compares the power
of the radius with the three classes. It finds both metals between (a) and (b), and
closer to (b) for a larger :math:`h^*`.
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

tip = mdr.Cone.berkovich()
h = np.geomspace(0.15e-6, 2e-6, 12)
a = h / tip.slope
materials = {
    "glass": (np.full(h.size, 9e9), 70e9),
    "metal, h* = 2 µm": (0.5e9 * np.sqrt(1 + 2e-6 / h), 130e9),
    "metal, h* = 0.5 µm": (0.8e9 * np.sqrt(1 + 0.5e-6 / h), 130e9),
}
figure, ax = plt.subplots(layout="constrained")
for name, (mean_pressure, E_star) in materials.items():
    fit = mdr.fit_hardness(tip, mean_pressure, a, E_star=E_star)
    found = fit.class_of_hardness
    print(f"simulated {name}: {found.reason}")
    label = f"{name}: slope {round(found.slope, 2) + 0.0:.2f}"
    ax.loglog(a * 1e6, mean_pressure / 1e9, "o-", label=label)
ax.plot(a * 1e6, 4 * a[0] / a, "k--", label="class (b): slope −1")
ax.set(xlabel="contact radius a (µm)", ylabel="hardness (GPa)", ylim=(0.25, 30))
ax.set_xticks([0.5, 1, 2, 5], ["0.5", "1", "2", "5"])
ax.set_xticks([], minor=True)
ax.legend(title="simulated", loc="upper right", ncols=2)
plt.show()
