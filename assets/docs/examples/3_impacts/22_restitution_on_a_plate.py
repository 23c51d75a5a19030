"""
Restitution on a plate
======================

Steel balls of 10 mm hit carbon-fibre plates of 1 to 32 mm at 0.1 to 10 m/s. Bending
waves carry energy away. Without yield the restitution depends only on
λ = m^(3/5) (k² v)^(1/5)/Z, with k = 4/3 E* √R. All plates are on Zener's curve (1941),
of s″ + (1 + λ d/dτ) s^(3/2) = 0. With yield the curves separate.
"""

import matplotlib.pyplot as plt
import numpy as np
from scipy.integrate import solve_ivp

import mdr_core as mdr

ball, mass, E_star = mdr.Paraboloid(radius=5e-3), 4.1e-3, 10e9
speed, k = np.geomspace(0.1, 10.0, 25), 4 / 3 * E_star * np.sqrt(ball.radius)
hard = mdr.Medium(E_star, hardness=5e8)
media = {"no yield": mdr.Medium(E_star), "hardness 0.5 GPa": hard}


def zener(lam):
    def slope(_, state):
        s = max(state[0], 0.0)
        return state[1], -(s**1.5) - 1.5 * lam * s**0.5 * state[1]

    # After the contact, where s < 0, there is no force, and the velocity stays.
    return -solve_ivp(slope, (0, 60), (0, 1), rtol=1e-9, atol=1e-12).y[1, -1]


figure, axes = plt.subplots(1, 2, figsize=(9, 4), sharey=True, layout="constrained")
for ax, (title, medium) in zip(axes, media.items(), strict=True):
    lam = np.geomspace(5e-3, 2.3, 60)
    ax.semilogx(lam, [zener(each) for each in lam], "k", lw=5, alpha=0.3, label="Zener")
    for h in (1e-3, 2e-3, 4e-3, 8e-3, 16e-3, 32e-3):
        plate = mdr.Structure.plate(thickness=h, E=50e9, nu=0.3, density=1600.0)
        hit = mdr.impact(ball, medium, mass, speed, structure=plate)
        lam = mass**0.6 * (k**2 * speed) ** 0.2 / plate.impedance
        ax.semilogx(lam, hit.restitution, label=f"{h * 1e3:g} mm")
    ax.set(xlabel="λ", ylabel="coefficient of restitution", title=title)
axes[1].legend()
plt.show()
