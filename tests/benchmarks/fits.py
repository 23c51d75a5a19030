"""Errors of fits of simulated measurements, their standard errors and cost, and fits of measured curves.

    python -m tests.benchmarks.fits

writes the tables to assets/fits.md and prints them.
"""

from pathlib import Path
from time import process_time

import numpy as np

import mdr_core as mdr
from mdr_core.fit.report import with_error

from ..fit.test_fit import AFM, HERTZ, REFERENCE, measured, silica
from ..fit.test_fit_in_time import fit_of, in_time
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
    head = (*head, *(f"pulls {n}" for n in ("E*", "q_c", "z₀")), "CPU a fit")
    return markdown(head, [row(profile, noise, media) for profile in PROFILES for noise in (0.0, 1e-10)])


def markdown(head, rows):
    return "\n".join(f"| {' | '.join(cells)} |" for cells in (head, ["---"] * len(head), *rows))


def approach_row(curve, model):
    """Cells of the approach of a measured curve: E* of the fit and of the reference."""
    fit = mdr.fit_indentation(HERTZ[model], *measured(curve, "approach"), q_c=np.inf, baseline=None)
    reference = REFERENCE[curve]["approach"][model]["E_star"]
    error = with_error(fit.medium.E_star, fit.standard_errors["E_star"], "Pa")
    deviation = f"{abs(fit.medium.E_star / reference - 1):.0e}"
    return curve, name(HERTZ[model]), error, f"{reference / 1e3:.4g} kPa", deviation, f"{fit.block_length}"


def both_segments_row(curve):
    """Cells of approach and retract in time: residuals over the range of force, and parameters."""
    fits = [fit_of(curve, **dict.fromkeys(free)) for free in ((), ("drag",), ("drag", "eta"))]
    keys = "rms_elastic_no_drag", "rms_elastic", "rms"
    cells = []
    for fit, key in zip(fits, keys, strict=True):
        rms = np.sqrt(np.mean(fit.residuals**2)) / np.ptp(fit.force)
        cells.append(f"{100 * rms:.2f} % ({100 * REFERENCE[curve]['in_time'][key]:.2f} %)")
    values = fits[-1].to_dict()
    for parameter, unit in (("E_star", "Pa"), ("eta", "Pa·s"), ("drag", "N·s/m")):
        cells.append(with_error(values[parameter], values[f"{parameter}_error"], unit))
    return curve, str(in_time(curve)[0].size), *cells, f"{fits[-1].block_length}"


def measured_tables():
    """Two tables as Markdown: approaches, and both segments in time."""
    head = "curve", "profile", "E*", "E*, reference", "deviation", "samples in a block"
    approaches = markdown(head, [approach_row(curve, model) for curve in AFM for model in HERTZ])
    head = "curve", "samples", "elastic", "and drag", "and viscosity", "E*", "η", "ζ", "samples in a block"
    return approaches, markdown(head, [both_segments_row(curve) for curve in AFM[:2]])


def silica_sentence():
    """E* of fused silica from loading, hold and unloading, beside that of Oliver and Pharr."""
    depth, force, _ = silica()
    fit = mdr.fit_indentation(mdr.Cone.berkovich(), depth, force)
    error = with_error(fit.medium.E_star, fit.standard_errors["E_star"], "Pa")
    rms = 100 * np.sqrt(np.mean(fit.residuals**2)) / np.ptp(force)
    return (
        f"Fused silica under a perfect Berkovich pyramid, with yield: E* = {error}, residuals {rms:.1f} %; "
        f"the analysis of Oliver and Pharr gives {REFERENCE['silica']['reduced_modulus_GPa']:.1f} GPa. Its "
        "hardness does not depend on the contact radius, class (a), whereas the model is class (b)."
    )


TEXT = """# Fits of simulated measurements

Of 40 random media a row: E* over two decades, d_c over 1.3, pressed 15 nm deep and back, 450 samples, \
0.4 % noise of the force, first contact unknown. Pulls are deviations over the standard errors that a fit \
gives: their standard deviation is to be 1, and is known to 11 % from 40.

{}

## Measured curves

AFM curves of gels and tissue (`tests/data`). Their tips are nominal: a paraboloid of 10 µm, a cone of 25° \
half-angle. The approach alone, elastic, against fits of nanite with the same weights; standard errors are \
block-wise.

{}

Approach and retract at once, as about 150 means or more, from half a depth before contact on, under the \
paraboloid: root mean square of the residuals over the range of force, elastic, with a drag in proportion \
to the rate, and with a viscosity of the medium besides; in brackets a search by brute force. Parameters \
are those of the last fit.

{}

{}

Made by `python -m tests.benchmarks.fits`.
"""

if __name__ == "__main__":
    text = TEXT.format(table(), *measured_tables(), silica_sentence())
    TABLE.write_text(text, encoding="utf-8")
    print(text)
