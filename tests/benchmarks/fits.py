"""What fits of simulated measurements miss, how their errors fare, and what they cost.

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
TIPS = (mdr.Cone(0.3), mdr.Paraboloid(1e-7), mdr.Sphere(2e-7), mdr.Sampled(RADII, RADII**2 / 4e-7))
NAMES = ("E_star", "q_c", "contact_point")


def curves(tip, media, depth_noise, seed=0):
    """Depths, forces and truths: 15 nm deep and out, 0.4 % noise of the force, unknown first contact."""
    random, depth = np.random.default_rng(seed), np.concatenate([np.linspace(-2e-9, 15e-9, 225)] * 2)
    depth[225:] = depth[224::-1]
    E = 10 ** random.uniform(9, 11, media)
    q = 2 / np.pi * E * 15e-9 * 10 ** random.uniform(-1.4, -0.1, media)
    force = mdr.indent(tip, mdr.Medium(E[:, None], q[:, None]), np.broadcast_to(depth, (media, 450))).force
    noise = random.normal(size=(2, *force.shape))
    force = force + 4e-3 * force.max(axis=1, keepdims=True) * noise[0]
    return depth + 3e-9 + depth_noise * noise[1], force, (E, q, np.full(media, 3e-9))


def row(tip, depth_noise, media):
    """Cells of one tip: relative misses of E* and q_c, widths of pulls, time of a fit."""
    depth, force, truth = curves(tip, media, depth_noise)
    start = process_time()
    fit = mdr.fit_indentation(tip, depth, force, depth_noise=depth_noise)
    spent = (process_time() - start) / media
    found = fit.medium.E_star, fit.medium.q_c, fit.contact_point
    misses = [np.abs(f / t - 1) for f, t in zip(found[:2], truth[:2], strict=True)]
    pulls = [np.std((f - t) / fit.standard_errors[n]) for n, f, t in zip(NAMES, found, truth, strict=True)]
    cells = [f"{100 * np.median(m):.2g} / {100 * np.max(m):.2g} %" for m in misses]
    noise = f"{depth_noise * 1e9:g} nm" if depth_noise else "none"
    return name(tip), noise, *cells, *(f"{p:.2f}" for p in pulls), f"{1e3 * spent:.2g} ms"


def table(media=40):
    """The table as Markdown."""
    head = ("tip", "depth noise", "E*, median / worst", "q_c, median / worst")
    rows = [(*head, *(f"pulls {n}" for n in ("E*", "q_c", "z₀")), "CPU a fit"), ["---"] * 8]
    rows += [row(tip, noise, media) for tip in TIPS for noise in (0.0, 1e-10)]
    return "\n".join(f"| {' | '.join(each)} |" for each in rows)


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
