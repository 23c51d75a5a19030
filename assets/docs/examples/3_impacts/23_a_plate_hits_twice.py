"""
A plate hits twice
==================

A steel ball of 12.7 mm hits the laminate of Sun and Chen (200 mm × 200 mm × 2.69 mm)
at 3 m/s. Without edges the ball nearly stops. With edges the waves come back, and the
plate hits the ball a second time. The restitution is then 0.18 instead of 0.03.
"""

import matplotlib.pyplot as plt

import mdr_core as mdr

stiffness = {"D11": 131.42, "D12": 3.867, "D22": 77.28, "D66": 8.922}
stiffness |= {"mass_per_area": 4.25}
structures = {
    "without edges": mdr.Structure.laminate(**stiffness, edge=0.1),
    "simply supported": mdr.Structure.supported_plate(0.2, 0.2, **stiffness),
}
ball, medium = mdr.Sphere(6.35e-3), mdr.Medium.from_bodies(210e9, 0.3, 7.9e9, 0.0)

figure, axes = plt.subplots(2, 1, figsize=(7, 6), sharex=True, layout="constrained")
force, way = axes
for (name, structure), color in zip(structures.items(), ("0.6", "C0"), strict=True):
    hit = mdr.impact(ball, medium, mass=8.537e-3, speed=3.0, structure=structure)
    motion, label = hit.motion(1000), f"{name}: e = {hit.restitution:.2f}"
    time, plate = motion.time * 1e6, motion.deflection * 1e6
    force.plot(time, motion.force, color, label=label)
    way.plot(time, motion.depth * 1e6 + plate, color, label="ball")
    way.plot(time, plate, color, ls="--", label="plate")
force.set(ylabel="force (N)")
force.legend()
way.set(xlabel="time (µs)", ylabel="displacement (µm)")
way.legend(ncols=2)
plt.show()
