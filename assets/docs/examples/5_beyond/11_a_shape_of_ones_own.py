"""
Your own shape
==============

Height, reduced height and its slope are enough. This shape is the sum of a cone and a
paraboloid. Its reduced height is the sum of their reduced heights, because the
transform (Popov 2015, Eq. (3)) is linear.
"""

from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr


@dataclass(frozen=True)
class Pencil(mdr.Profile):
    slope: float
    radius: float  # m

    def height_at(self, r):
        return self.slope * r + r**2 / (2 * self.radius)

    def reduced_at(self, x):
        return np.pi / 2 * self.slope * x + x**2 / self.radius

    def reduced_slope_at(self, x):
        return np.pi / 2 * self.slope + 2 * x / self.radius


medium = mdr.Medium(E_star=95e9, q_c=100.0)
depth = np.append(np.linspace(0, 40e-9, 100), np.linspace(40e-9, 37e-9, 20))
for shape in (Pencil(0.1, 1e-6), mdr.Cone(0.1), mdr.Paraboloid(1e-6)):
    force = mdr.indent(shape, medium, depth).force
    plt.plot(depth * 1e9, force * 1e6, label=type(shape).__name__)
plt.gca().set(xlabel="d (nm)", ylabel="F (µN)")
plt.legend()
plt.show()
