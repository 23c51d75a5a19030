r"""
Hardness classes of real materials
==================================

The hardness of copper falls with the depth as :math:`H = H_0 \sqrt{1 + h^*/h}` (Nix and Gao 1998, for the
measurements of McElhaney et al.: cold-worked :math:`H_0` = 0.834 GPa, :math:`h^*` = 0.464 µm; (111) single
crystal 0.581 GPa, 1.60 µm). The hardness of fused silica is taken as constant, 9.4 GPa. ``fit_hardness``
compares the power of the radius with the three classes; copper on this scale lies between (a) and (b).
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

tip = mdr.Cone.berkovich()
h = np.geomspace(0.15e-6, 2e-6, 12)
a = h / tip.slope
materials = {
    "copper, cold-worked": (0.834e9 * np.sqrt(1 + 0.464e-6 / h), 130e9),
    "copper, (111)": (0.581e9 * np.sqrt(1 + 1.60e-6 / h), 130e9),
    "fused silica": (np.full(h.size, 9.4e9), 72e9),
}
for name, (hardness, E_star) in materials.items():
    fit = mdr.fit_hardness(tip, hardness, a, E_star=E_star)
    print(f"{name}: {fit.class_.reason}")
    plt.loglog(a * 1e6, hardness / 1e9, "o-", label=f"{name}: slope {fit.class_.slope:.2f}")
plt.plot(a * 1e6, 4 * a[0] / a, "k--", label="class (b): slope −1")
plt.gca().set(xlabel="contact radius a (µm)", ylabel="hardness (GPa)")
plt.legend()
