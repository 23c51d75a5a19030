"""Errors of fits of simulated measurements, their standard errors and cost, and fits of measured curves.

    python -m tests.benchmarks.fits

writes the tables to assets/fits.md and prints them.
"""

from pathlib import Path
from time import process_time

import numpy as np

import mdr_core as mdr
from mdr_core.show.report import with_error

from ..measurements.fit import families
from ..measurements.fit.test_fit import AFM, HERTZ, REFERENCE, measured, pulls
from ..measurements.fit.test_fit_in_time import fit_of, in_time
from ..measurements.fit.test_fit_of_classes import BERKOVICH, BOUNDS, OUT, E, made, real
from ..shapes import name
from . import remarks, unloadings

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
        profile, mdr.Medium(E[:, None], q_c=q[:, None]), np.broadcast_to(depth, (media, 450))
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


def pulls_row(profile, constants, fits=1000):
    """Cells of one medium: mean and standard deviation of the pulls of each parameter."""
    force, depth = made(profile, constants, fits, seed=1), np.tile(OUT + 3e-9, (fits, 1))
    fit = mdr.fit_indentation(profile, depth, force, **dict.fromkeys(constants))
    found = pulls(fit, E_star=E, contact_point=3e-9, **constants)
    cells = [found.get(n) for n in ("E_star", "hardness", "q_c", "f_c", "contact_point")]
    texts = ["" if pull is None else f"{pull.mean():+.2f}, {pull.std():.2f}" for pull in cells]
    return name(profile), " + ".join(constants), *texts


def verdict_row(file):
    """Cells of a measured curve that yields: misfits of each class, verdict, E* and H of class (a)."""
    fit = mdr.fit_indentation(BERKOVICH, *real(file), hardness=None)
    misfits = [f"{100 * each.misfit:.2f} %" for each in fit.classes.values()]
    (line,) = (each for each in repr(fit).splitlines() if "class of hardness" in each)
    errors = fit.standard_errors
    texts = [with_error(getattr(fit.medium, n), errors[n], "Pa") for n in ("E_star", "hardness")]
    return file, *misfits, line.split("hardness", 1)[1].split(":")[0].strip(), *texts


def tables_of_classes():
    """Two tables as Markdown: pulls of simulated curves, and measured curves that yield."""
    head = "profile", "constants", *(f"{n}: mean, width" for n in ("E*", "H", "q_c", "f_c", "z₀"))
    media = {"hardness": 0.4e9}, {"f_c": 2e-5}, {"hardness": 0.3e9, "q_c": 60.0}
    simulated = markdown(head, [pulls_row(profile, medium) for profile in PROFILES[:2] for medium in media])
    head = "curve", "(a)", "(b)", "(c)", "class", "E* of (a)", "H of (a)"
    return simulated, markdown(head, map(verdict_row, BOUNDS))


def coverage_row(family, size, seeds):
    """Cells of a family of simulated curves, by kind of medium: coverage, remarks, visibility, bias."""
    text = families.SAYS[family].format(f"{100 * size:g} %" if size < 1 else size)
    cells = []
    for kind in families.KINDS.values():
        fit = families.fits(kind, family, size, range(seeds))
        told = np.mean([bool(each) for each in families.told(fit)])
        errors = fit.standard_errors["E_star"]
        known = np.isfinite(errors)
        bias = np.median(((fit.medium.E_star - kind.medium.E_star) / errors)[known])
        visible = families.visible(kind, family, size)
        seen = "" if visible is None else f", {visible:.1f} σ"
        covered = np.mean(families.covered(kind, fit)[known])
        cells.append(f"{100 * covered:.0f} %, {bias:+.1f}, {100 * told:.0f} %{seen}")
    return text, *cells


def coverage_table(seeds=100):
    """The table as Markdown."""
    rows = [
        coverage_row(family, size, seeds) for family, sizes in families.FAMILIES.items() for size in sizes
    ]
    return markdown(("curves", *families.KINDS), rows)


TEXT = """# Fits of simulated measurements

Each row has 40 random media: E* over two decades and d_c over 1.3. The tip goes 15 nm deep and back, \
with 450 samples, 0.4 % noise of the force and unknown first contact. Pulls are deviations over the \
standard errors of the fit. Their standard deviation should be 1; 40 media determine it to 11 %.

{}

## Measured curves

AFM curves of gels and tissue (`tests/data`). Their tips are nominal: a paraboloid of 10 µm, a cone of \
25° half-angle. Elastic fits of the approach alone are compared with fits of nanite with the same \
weights. Standard errors are block-wise.

{}

These fits use approach and retract together, averaged to about 150 samples or more, from half a depth \
before contact, under the paraboloid. The table gives the root mean square of the residuals over the \
range of force. The fits are elastic, with a drag in proportion to the rate, and also with a viscosity \
of the medium. Results of a brute-force search are in brackets. Parameters belong to the last fit.

{}

## Classes of hardness

Pulls of 1000 simulated curves of each medium, 60 nm deep and back to 25 nm, with 200 samples, 0.4 % \
noise of the force and unknown first contact. The mean is known to 0.03, the width to 2 %.

{}

Fused silica and quartz, NiAl (with a pop-in) and steel under a Berkovich tip (`silica.csv`, \
`tests/data`), as a cone of slope 0.358. The fits use 0.5 % of the largest force to 12 % on unloading. \
The table gives the residuals of a fit of each class alone, as root mean square over the largest force, \
and the class in the report. For silica, Oliver and Pharr's analysis by micromechanics gives {:.1f} \
GPa.

{}

## Coverage of the errors on curves that deviate from the model

Each cell has 100 simulated curves with 0.4 % noise of the force, with times and without a hold. The \
gel (E* 10 kPa) is under a ball of 10 µm, from 2 µm above to 1 µm deep and back. The glass (70 GPa, H \
10 GPa) and the metal (70 GPa, q_c 8 kN/m) are under a Berkovich tip, 600 nm deep and back to 300 and \
400 nm. A cell gives the share of curves with E* within two standard errors (nominally 95 %, known to 2 \
to 5 %), the median deviation in standard errors, and the share with a remark. The last number is the \
deviation of the curve from its best fit, in standard deviations of the noise. No test of the curve \
could detect more.

{}

A remark reports deviations above 3.3 standard deviations if E* is off by more than its error; {:.1f} % \
of 1200 clean curves have such a remark. If less than 80 % are covered, the other deviations are close \
to the limit of detection, or below it:

- **A drift of a medium that yields** looks like another E*, and is hardly visible without a hold. Hold \
the force, and subtract the drift. Over two minutes 0.1 nm/s changes the E* of a metal by some per \
cent.
- **Noise correlated over a fifteenth of a curve or more**: errors are up to twice too small. A remark \
counts the blocks. In a fifth of the curves the residuals look less correlated than the noise, because \
the fit takes a part of it.
- **Scales**: a spring constant, a sensitivity, a depth scale, a radius or an area function with an \
error of p % makes E* wrong by p/2 to 2p %. The residuals are those of a perfect fit. A scaled retract \
without its approach has the same effect.
- **A smooth deviation of the shape of the tip, or of the class of hardness**, of the size of the noise.

## Faults of unloadings

Each row has 60 simulated records, evaluated by `oliver_pharr` without times. The tips are Berkovich, a \
cone, a rounded cone, a paraboloid and a sphere. The media have E* over 2.3 decades and are elastic or \
of class (a) or (b). Records are 0.13 to 1.3 µm deep, with 100 to 1000 samples of the loading and of \
the unloading and a noise of 0 to 0.2 % of the force. All are random. Good records begin at 0, in long \
air, at 0.9 or 21 % of the depth, or have a hold. *Little air* is 6 to 18 samples, 2.5 % to 15 % of the \
depth. *No air* is a depth that is 0 at 1.5 to 20 % of the force. *Preload* is 1 to 5 % of the force at \
depth 0. *Lift-off* is a preload of 0.1 to 1 %; the tip is then lifted into the air before the loading. \
*Creep* is logarithmic or in proportion to the force, 15 to 80 % of the rate of the unloading. *Units* \
are depths or forces 10³ or 10⁶ times too large or small. A record is *right* if E* and H are within 3 \
% or two standard errors of the values without the fault. It is *said* if a remark doubts them, and \
*silent* otherwise.

{}

Three faults are silent. The first is a force that begins at once, for example with a hardness in \
proportion to 1/a, after air of a few samples. The second is creep that leaves m below 1.5 and equal in \
all parts. The third is units in which the modulus is that of another material. Of the real records of \
micromechanics, 58 without air (fused silica, quartz, NiAl and glass) keep their numbers and errors. \
Remarks report creep in two more records of NiAl. One record begins with 64 nm of air: its E* is 158 \
GPa instead of 147, and the E* of the others is 152 to 165.

## Remarks, and how often they are right

The table counts each kind of remark, and the share of cases in which it is right. A remark is right if \
its effect is in the curve, or if E* of a fit is off by more than two standard errors. The simulated \
cases are 6 of each family above, and curves with one effect each. These effects are samples without a \
number, a noise that is given too small, other units, another sign or order, noise alone, a drag, \
adhesion, a noisy depth, loading alone, a drift in a hold, and a hardness of another class. Others are \
unloadings with air, a hold, creep, cycles, a measured stiffness, other units, and round tips evaluated \
as ideal tips. Further cases are files, area functions and hardnesses over radii. The measured cases \
are three AFM curves of gels and a cell as a paraboloid and a cone, two of them in time. Silica, \
quartz, NiAl and steel are fitted as each class, as elastic, and with two constants, and their \
unloadings with and without times (`tests/data`, `silica.csv`).

{}

The kind *no unloading* belongs to errors and to results without a number to quote.

Made by `python -m tests.benchmarks.fits`.
"""

if __name__ == "__main__":
    simulated, verdicts = tables_of_classes()
    modulus = REFERENCE["silica"]["reduced_modulus_GPa"]
    alarms = [
        np.mean([bool(t) for t in families.told(families.fits(kind, "clean", 0.0, range(400)))])
        for kind in families.KINDS.values()
    ]
    coverage = coverage_table(), 100 * np.mean(alarms)
    text = TEXT.format(
        table(),
        *measured_tables(),
        simulated,
        modulus,
        verdicts,
        *coverage,
        unloadings.table(),
        remarks.table(),
    )
    TABLE.write_text(text, encoding="utf-8")
    print(text)
