"""
The chain and the integral
==========================

``impact`` solves one scalar equation of motion. ``chain_impact`` follows each spring
and dashpot of the 1D foundation separately. They share only the profile and the
medium, so that each checks the other.
"""

import matplotlib.pyplot as plt

import mdr_core as mdr

ball, polymer = mdr.Paraboloid(radius=2e-3), mdr.Medium(E_star=4e6, q_c=200.0, eta=30.0)
hit = mdr.impact(ball, polymer, mass=1e-4, speed=0.5)
chain = mdr.chain_impact(ball, polymer, mass=1e-4, speed=0.5, tolerance=1e-4)
for name in ("restitution", "max_depth", "contact_time", "viscous_work"):
    one, other = getattr(hit, name), getattr(chain, name)
    print(f"{name:13} {one:.8e}   {other:.8e}   {other / one - 1:+.1e}")

motion, steps = hit.motion(200), chain.motion(40)
plt.plot(motion.time * 1e3, motion.force, label="impact")
plt.plot(steps.time * 1e3, steps.force, "o", label="chain_impact")
plt.gca().set(xlabel="t (ms)", ylabel="F (N)")
plt.legend()
plt.show()
