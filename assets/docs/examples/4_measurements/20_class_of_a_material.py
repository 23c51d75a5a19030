"""
Which class is my material?
===========================

Fused silica under a Berkovich tip (micromechanics, MIT licence), loaded
and unloaded. A fit with a constant hardness, class (a), misses the force by a third of
a percent. A fit with a hardness :math:`q_c/a`, class (b), misses it by five times as
much. ``fit.classes`` has the fit of each class alone. The report lists the classes that
the curve does not rule out, and the assumptions.

The modulus and the hardness belong to the model. Its contact sinks in like an elastic
contact, and is smaller than the contact of Oliver and Pharr. Instruments report Oliver
and Pharr's hardness.
"""

import matplotlib.pyplot as plt
import numpy as np

import mdr_core as mdr

data = np.genfromtxt(mdr.example("silica.csv"), delimiter=",", names=True)
depth, force = 1e-9 * data["depth_nm"], 1e-3 * data["force_mN"]
top = np.argmax(force)
low = force[top:] < 0.12 * force[top]
stop = top + np.argmax(low)  # before the hold at the end, for the drift
part = slice(np.argmax(force > 0.005 * force[top]), stop)
depth, force, tip = depth[part], force[part], mdr.Cone.berkovich()

fit = mdr.fit_indentation(tip, depth, force, hardness=None)
print(fit)
rows = {"sharex": True, "layout": "constrained", "height_ratios": [3, 2]}
figure, (upper, lower) = plt.subplots(2, 1, **rows)
upper.plot(depth * 1e6, force * 1e3, "k.", markersize=2, label="measured")
for letter, free in (("a", "hardness"), ("b", "q_c"), ("c", "f_c")):
    label = f"class ({letter}): {100 * fit.classes[letter].misfit:.2g} %"
    other = mdr.fit_indentation(tip, depth, force, **{free: None})
    upper.plot(depth * 1e6, (force - other.residuals) * 1e3, label=label)
    lower.plot(depth * 1e6, other.residuals * 1e3)
upper.set(ylabel="F (mN)")
upper.legend()
lower.set(xlabel="measured depth (µm)", ylabel="residual (mN)")
plt.show()
