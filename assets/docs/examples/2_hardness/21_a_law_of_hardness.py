r"""
A law of hardness of one's own
==============================

Nix and Gao's size effect, :math:`H_0\sqrt{1 + h^*/h}`, under a cone of slope s, with the depth h = s a of
the contact; copper: 0.581 GPa and 1.6 µm. ``curve_fit`` finds them in a curve that is made, with noise.
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


def force(d, E, H0, h):
    return mdr.indent(
        tip, mdr.Medium(1e9 * E, hardness=NixGao(1e9 * H0, h / tip.slope * 1e-6)), d
    ).force


tip, d = (
    mdr.Cone.berkovich(),
    np.append(np.linspace(1e-8, 2e-6, 200), np.linspace(2e-6, 1.96e-6, 40)),
)
made = force(d, 130, 0.581, 1.6) * (
    1 + 0.005 * np.random.default_rng(1).standard_normal(d.size)
)
found, errors = curve_fit(
    force, d, made, (100, 1, 1), bounds=(0.01, 1e3), x_scale=(100, 1, 1)
)
print(
    "E* (GPa), H₀ (GPa), h* (µm):",
    found.round(3),
    "±",
    np.sqrt(np.diag(errors)).round(3),
)
print(
    mdr.impact(
        tip,
        mdr.Medium(130e9, hardness=NixGao(0.581e9, 1.6e-6 / tip.slope)),
        1e-9,
        [0.1, 1, 10],
    )
)
plt.axes(xlabel="depth (µm)", ylabel="force (mN)")
plt.plot(d * 1e6, made * 1e3, "k.", d * 1e6, force(d, *found) * 1e3, "r")
