"""
A real AFM curve
================

The approach of an AFM force–distance curve of a gel (afmformats, MIT licence), fitted
with a nominal paraboloid of 10 µm. ``q_c=inf`` keeps the medium elastic; first contact
and the baseline are fitted.
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

data = np.genfromtxt(mdr.example("gel.csv"), delimiter=",", names=True)
approach = data["retract"] == 0
depth, force = 1e-9 * data["depth_nm"][approach], 1e-9 * data["force_nN"][approach]
fit = mdr.fit_indentation(
    mdr.Paraboloid(radius=1e-5), depth, force, q_c=np.inf, baseline=None
)
print(fit)

figure, (top, bottom) = plt.subplots(
    2, 1, sharex=True, layout="constrained", height_ratios=[3, 1], figsize=(6, 6)
)
top.plot(depth * 1e6, force * 1e9, ".", markersize=3, label="measured")
top.plot(depth * 1e6, (force - fit.residuals) * 1e9, label="fit")
top.axvline(fit.contact_point * 1e6, color="gray", linestyle=":", label="first contact")
top.set(ylabel="F (nN)")
top.legend()
bottom.plot(depth * 1e6, fit.residuals * 1e9)
bottom.set(xlabel="measured depth (µm)", ylabel="residual (nN)")
plt.show()
