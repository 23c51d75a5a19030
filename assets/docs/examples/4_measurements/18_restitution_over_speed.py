"""
A medium from restitution over speed
====================================

``scipy.optimize.curve_fit`` fits e(v), simulated coefficients of restitution over speed
with a scatter of 0.005. They determine two combinations of E*, q_c and η. With E* held
at half or at twice its value, another q_c and η (both as E*^(2/3) under a cone) fit
equally well: the three curves coincide. Only the contact times distinguish them.
"""

import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import curve_fit

import mdr_core as mdr

tip, mass, speed = mdr.Cone(slope=0.3), 1e-6, np.geomspace(0.3, 10.0, 15)
simulated = mdr.impact(tip, mdr.Medium(E_star=1e10, q_c=2e4, eta=3e3), mass, speed)
scatter = 0.005 * np.random.default_rng(1).normal(size=speed.size)
measured = simulated.restitution + scatter


def restitution(speed, log_q_c, log_eta):
    medium = mdr.Medium(E_star, q_c=np.exp(log_q_c), eta=np.exp(log_eta))
    return mdr.impact(tip, medium, mass, speed).restitution


figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
for E_star, width in ((5e9, 6), (1e10, 3.5), (2e10, 1)):
    start = np.log([1.5e-6 * E_star, 2e-7 * E_star])
    fitted, covariance = curve_fit(restitution, speed, measured, start)
    q_c, eta = np.exp(fitted)
    rms = np.std(restitution(speed, *fitted) - measured)
    error = np.sqrt(covariance[0, 0])
    constants = f"q_c {q_c:.3g} N/m ± {error:.1%}, η {eta:.3g} Pa·s"
    print(f"E* {E_star:.0e} Pa: {constants}, rms {rms:.6f}")
    hit = mdr.impact(tip, mdr.Medium(E_star, q_c=q_c, eta=eta), mass, speed)
    label = f"E* {E_star / 1e9:g} GPa, q_c {q_c / 1e3:.1f} kN/m"
    left.semilogx(speed, hit.restitution, lw=width, label=label)
    label = f"E* {E_star / 1e9:g} GPa, η {eta / 1e3:.1f} kPa·s"
    right.semilogx(speed, hit.contact_time * 1e6, label=label)
left.semilogx(speed, measured, "k.", label="simulated, with scatter")
left.set(xlabel="speed (m/s)", ylabel="coefficient of restitution")
right.set(xlabel="speed (m/s)", ylabel="contact time (µs)", ylim=(0, None))
left.legend()
right.legend()
plt.show()
