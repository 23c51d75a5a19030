"""
Repeated impacts
================

A body hits the same spot repeatedly at the same speed. Each impact makes the imprint
deeper by a smaller amount, and the coefficient of restitution rises. ``plastic_depth``
passes the imprint to the next impact.
"""

import matplotlib.pyplot as plt

import mdr_core as mdr

cone, medium = mdr.Cone(slope=0.3), mdr.Medium(E_star=95e9, q_c=100.0)
depth, imprints, restitutions = 0.0, [], []
for _ in range(30):
    hit = mdr.impact(cone, medium, mass=1e-12, speed=0.5, plastic_depth=depth)
    depth = hit.plastic_depth
    imprints.append(depth * 1e9)
    restitutions.append(hit.restitution)

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
left.plot(range(1, 31), imprints, "o")
left.set(xlabel="impact", ylabel="plastic depth (nm)")
right.plot(range(1, 31), restitutions, "o")
right.set(xlabel="impact", ylabel="coefficient of restitution")
plt.show()
