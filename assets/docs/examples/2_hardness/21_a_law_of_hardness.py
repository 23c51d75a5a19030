r"""
Your own law of hardness
========================

The size effect of Nix and Gao is :math:`H_0\sqrt{1 + h^*/h}`. Under a cone of slope s
the depth of the contact is h = s a. ``curve_fit`` finds the constants of copper,
0.581 GPa and 1.6 µm, in a simulated curve with noise.
"""

from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import curve_fit

import mdr_core as mdr


@dataclass(frozen=True)
class NixGao(mdr.HardnessLaw):
    H0: float
    a_star: float

    def at(self, a):
        return self.H0 * np.sqrt(1 + self.a_star / a)

    def rate(self, a):
        return -(self.H0**2) * self.a_star / (2 * a**2 * self.at(a))


def metal(E, H0, h):  # GPa, GPa, µm
    return mdr.Medium(1e9 * E, hardness=NixGao(1e9 * H0, 1e-6 * h / tip.slope))


def force(d, *constants):
    return mdr.indent(tip, metal(*constants), d).force


tip = mdr.Cone.berkovich()
d = np.append(np.linspace(1e-8, 2e-6, 200), np.linspace(2e-6, 1.96e-6, 40))
noise = 0.005 * np.random.default_rng(1).standard_normal(d.size)
simulated, start = force(d, 130, 0.581, 1.6) * (1 + noise), (100, 1, 1)
found, errors = curve_fit(force, d, simulated, start, bounds=(0.01, 1e3), x_scale=start)
errors = np.sqrt(np.diag(errors))
print("E* (GPa), H₀ (GPa), h* (µm):", found.round(3), "±", errors.round(3))
print(mdr.impact(tip, metal(130, 0.581, 1.6), mass=1e-9, speed=[0.1, 1, 10]))

figure, (curve, law) = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
curve.plot(d * 1e6, simulated * 1e3, "k.", markersize=3, label="simulated, with noise")
curve.plot(d * 1e6, force(d, *found) * 1e3, "r", label="fit")
curve.set(xlabel="depth (µm)", ylabel="force (mN)")
curve.legend()
a = np.geomspace(5e-8, 5e-6, 100)
law.semilogx(a * 1e6, metal(*found).hardness_at(a) / 1e9, "r")
law.set(xlabel="contact radius a (µm)", ylabel="hardness σ_c (GPa)")
plt.show()
