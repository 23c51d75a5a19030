"""Erosion of a composite by a stream of particles: damage, its spread, and the time of a million particles.

    python assets/erosion.py --particles 1e7 --workers 2
    python assets/erosion.py --attack

Radii are lognormal, speeds Weibull. The workers draw random numbers chunk by chunk and solve every impact.
They keep only sums and histograms, so that memory does not grow with the number. The script needs
`pip install ".[sweep]" matplotlib`, in the folder of the project.

With `--attack` one particle comes at all angles of attack: plastic and friction work on the composite, and
for comparison on a medium of constant hardness, which returns no energy and has closed forms.
"""

import argparse
import resource
import time
from contextlib import nullcontext

import dask
import dask.array as da
import matplotlib.pyplot as plt
import numpy as np
import xarray as xr

import mdr_core as mdr
from mdr_core import sweep

DENSITY = 2650.0  # quartz, kg/m³
COMPOSITE = {"E_star": 8e9, "q_c": 2000.0}  # 8 GPa, hardness 200 MPa under contacts of 10 µm
QUANTITIES = ("damaged_area", "restitution")
BINS = {"damaged_area": np.linspace(-13, -8, 101), "restitution": np.linspace(0, 1, 101)}


def stream(particles, chunk=10**6, seed=1):
    """The parameters of the particles, lazily: median radius 25 µm, speeds around 30 m/s."""
    random = da.random.default_rng(seed)
    radius = 25e-6 * np.exp(0.4 * random.standard_normal(particles, chunks=chunk))
    speed = 30.0 * random.weibull(2.0, particles, chunks=chunk) + 1e-3
    mass = DENSITY * 4 / 3 * np.pi * radius**3
    given = {"radius": radius, "mass": mass, "speed": speed}
    return COMPOSITE | {name: xr.DataArray(each, dims="particle") for name, each in given.items()}


def planned(particles, chunk):
    """Time (s) on one core, from the second run of a chunk: the first one makes tables."""
    size = min(particles, chunk)
    for _ in range(2):
        start = time.perf_counter()
        hits = sweep.impacts(mdr.Sphere, **stream(size, size), quantities=QUANTITIES)
        dask.compute(statistics(hits), scheduler="synchronous")
    return (time.perf_counter() - start) * particles / size


def statistics(hits):
    """Sums, sums of squares and histograms, lazily: what is kept of a stream."""
    kept = {}
    for name, bins in BINS.items():
        values = hits[name]
        kept[name] = values.mean(), values.std()
        values = np.log10(np.maximum(values, 1e-300)) if name == "damaged_area" else values
        kept["histogram of " + name] = da.histogram(values.data, bins)[0]
    kept["unharmed"] = (hits.damaged_area == 0).mean()
    return kept


def cluster(workers):
    """Worker processes of one thread each, or this process alone."""
    if not workers:
        return nullcontext()
    from dask.distributed import Client

    return Client(n_workers=workers, threads_per_worker=1, dashboard_address=None)


def memory(client):
    """Largest memory so far (GB) of all processes together."""

    def largest():
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6

    return largest() + (sum(client.run(largest).values()) if client else 0.0)


def picture(kept, particles, name):
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2), layout="constrained")
    for axes, (quantity, bins) in zip((left, right), BINS.items(), strict=True):
        share = kept["histogram of " + quantity] / particles / np.diff(bins)
        axes.stairs(share, bins, fill=True)
        axes.set_ylabel("probability density")
    left.set_xlabel("log₁₀ of the damaged area / m²")
    right.set_xlabel("coefficient of restitution")
    figure.suptitle(
        f"{particles:.0e} particles on a composite, radii lognormal, speeds Weibull", fontsize=10
    )
    figure.savefig(name, dpi=110)


def at_all_angles(radius=25e-6, speed=30.0, friction=0.2, number=90):
    """Plastic and friction work (J) over the angle of attack, of the composite and at constant hardness.

    Without rebound, the point of contact slips until the normal motion ends, or sticks before. With its
    speed W and m_t = 2m/7, W_f = μ m v (W − μ (m/m_t) v/2), at most ½ m_t W². For slip throughout, this is
    largest at tan 2α = 2 m_t/(μ m).
    """
    attack = xr.DataArray(np.radians(np.linspace(1.0, 90.0, number)), dims="attack")
    mass = DENSITY * 4 / 3 * np.pi * radius**3
    v, along = speed * np.sin(attack), (speed * np.cos(attack)).round(9)
    ball = {"mass": mass, "friction": friction, "tangential_mass": 2 * mass / 7}
    hits = sweep.oblique_impacts(
        mdr.Sphere, radius=radius, speed=v, tangential_speed=along, **COMPOSITE, **ball,
        quantities=("plastic_work", "friction_work"),
    )  # fmt: skip
    slides = friction * mass * v * (along - 3.5 * friction * v / 2)
    hits["hard_plastic_work"] = mass * v**2 / 2
    hits["hard_friction_work"] = xr.where(along > 3.5 * friction * v, slides, mass * along**2 / 7)
    return hits.assign_coords(attack=np.degrees(attack.values)) * 1e9


def attack_picture(works, name):
    """Works (nJ) over the angle of attack, as a picture; their maxima in words."""
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.2), layout="constrained", sharex=True)
    for panel, kind in zip(axes, ("plastic_work", "friction_work"), strict=True):
        for medium, key in (("composite", kind), ("constant hardness", "hard_" + kind)):
            best = int(np.argmax(works[key].values))
            print(f"{kind.replace('_', ' ')}, {medium}: at most {float(works[key][best]):.3g} nJ,", end=" ")
            print(f"at {float(works.attack[best]):.0f}°")
            panel.plot(works.attack, works[key], label=medium)
        panel.set(xlabel="angle of attack (°)", ylabel=kind.replace("_", " ") + " (nJ)")
    axes[0].legend()
    figure.savefig(name, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--particles", type=float, default=1e6)
    parser.add_argument("--chunk", type=float, default=1e6)
    parser.add_argument("--workers", type=int, default=0, help="processes; 0 is this one")
    parser.add_argument("--picture", default="erosion.png")
    parser.add_argument("--attack", action="store_true", help="one particle at all angles of attack")
    options = parser.parse_args()
    if options.attack:
        return attack_picture(at_all_angles(), options.picture)
    particles, chunk = int(options.particles), int(min(options.chunk, options.particles))
    with cluster(options.workers) as client:
        given = stream(particles, chunk)
        cost, cores = planned(particles, chunk), max(options.workers, 1)
        each = cost / particles * 1e6
        print(f"planned: {cost / cores:.3g} s on {cores} core(s), {each:.3g} s per 10⁶ each")
        start = time.perf_counter()
        kept = statistics(sweep.impacts(mdr.Sphere, **given, quantities=QUANTITIES))
        with dask.config.set(scheduler=None if client else "synchronous"):
            (kept,) = dask.compute(kept)
        elapsed, used = time.perf_counter() - start, memory(client)
    mean, spread = (float(each) for each in kept["damaged_area"])
    error = spread * particles**0.5
    harmless = float(kept["unharmed"])
    total, (bounce, width) = mean * particles * 1e6, map(float, kept["restitution"])
    print(f"total damaged area {total:.6g} ± {error * 1e6:.1g} mm² of {particles:.3g} particles")
    print(f"restitution {bounce:.4f} ± {width:.4f} from particle to particle, {harmless:.2%} harmless")
    print(f"took {elapsed:.3g} s, {elapsed / particles * 1e6:.3g} s per 10⁶; memory {used:.2f} GB in all")
    print(f"10⁹ particles would take {elapsed / particles * 1e9 / 60:.3g} min")
    picture(kept, particles, options.picture)


if __name__ == "__main__":
    main()
