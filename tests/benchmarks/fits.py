"""Errors of fits of simulated measurements, their standard errors, and their cost.

    python -m tests.benchmarks.fits

writes the tables to assets/fits.md and prints them.
"""

from pathlib import Path
from time import process_time

import numpy as np

import mdr_core as mdr

from ..shapes import name

TABLE = Path(__file__).parents[2] / "assets" / "fits.md"
RADII = np.linspace(0.0, 4e-7, 60)
PROFILES = (mdr.Cone(0.3), mdr.Paraboloid(1e-7), mdr.Sphere(2e-7), mdr.Sampled(RADII, RADII**2 / 4e-7))
NAMES = ("E_star", "q_c", "contact_point")


def curves(profile, media, depth_noise, seed=0):
    """Depths, forces and true values: 15 nm deep and back, 0.4 % force noise, unknown first contact."""
    random, depth = np.random.default_rng(seed), np.concatenate([np.linspace(-2e-9, 15e-9, 225)] * 2)
    depth[225:] = depth[224::-1]
    E = 10 ** random.uniform(9, 11, media)
    q = 2 / np.pi * E * 15e-9 * 10 ** random.uniform(-1.4, -0.1, media)
    force = mdr.indent(
        profile, mdr.Medium(E[:, None], q[:, None]), np.broadcast_to(depth, (media, 450))
    ).force
    noise = random.normal(size=(2, *force.shape))
    force = force + 4e-3 * force.max(axis=1, keepdims=True) * noise[0]
    return depth + 3e-9 + depth_noise * noise[1], force, {"E_star": E, "q_c": q, "contact_point": 3e-9}


def row(profile, depth_noise, media):
    """Cells of one profile: relative errors of E* and q_c, widths of pulls, time of a fit."""
    depth, force, truth = curves(profile, media, depth_noise)
    start = process_time()
    fit = mdr.fit_indentation(profile, depth, force, depth_noise=depth_noise)
    time = (process_time() - start) / media
    deviations = {n: fit.to_dict()[n] - truth[n] for n in NAMES}
    errors = [np.abs(deviations[n] / truth[n]) for n in ("E_star", "q_c")]
    pulls = [np.std(deviations[n] / fit.standard_errors[n]) for n in NAMES]
    cells = [f"{100 * np.median(error):.2g} / {100 * np.max(error):.2g} %" for error in errors]
    noise = f"{depth_noise * 1e9:g} nm" if depth_noise else "none"
    return name(profile), noise, *cells, *(f"{p:.2f}" for p in pulls), f"{1e3 * time:.2g} ms"


def table(media=40):
    """The table as Markdown."""
    head = ("profile", "depth noise", "E*, median / worst", "q_c, median / worst")
    rows = [(*head, *(f"pulls {n}" for n in ("E*", "q_c", "z₀")), "CPU a fit"), ["---"] * 8]
    rows += [row(profile, noise, media) for profile in PROFILES for noise in (0.0, 1e-10)]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in rows)


if __name__ == "__main__":
    text = (
        "# Fits of simulated measurements\n\n"
        "Of 40 random media a row: E* over two decades, d_c over 1.3, pressed 15 nm deep and back, 450 "
        "samples, 0.4 % noise of the force, first contact unknown. Pulls are deviations over the standard "
        "errors that a fit gives: their standard deviation is to be 1, and is known to 11 % from 40.\n\n"
        f"{table()}\n\nMade by `python -m tests.benchmarks.fits`.\n"
    )
    TABLE.write_text(text, encoding="utf-8")
    print(text)
