"""Fits of each class of hardness alone, and the classes that a measured curve distinguishes.

All classes have equally many parameters. With sums of squares S₁ and S₂ of their residuals and n
independent samples, the likelihoods of two classes differ by the factor (S₂/S₁)^(n/2). n is the number of
samples over the number of samples in a block of correlated residuals.
"""

from dataclasses import dataclass

import numpy as np

from ...base import check
from ...base.check import Array
from ...solver.contact.integrals import integrals
from ...solver.impacts.scaling import HardnessClass
from ...solver.medium.medium import Medium
from .depth_noise import turning_points_of
from .parameters import BACKGROUND, CLASSES
from .solution import problems, solved

#: Smallest n ln(S₂/S₁) that distinguishes two classes: the square of three standard deviations.
_TOLD = 9.0
#: Largest misfit of the best class, with correlated residuals, if this class describes the curve.
_NONE = 0.01


@dataclass(frozen=True, eq=False)
class ClassFit:
    """Fit with the hardness of one class alone, for one or many curves.

    `misfit` is the root mean square of the residuals over the largest force, or over the range of the force
    if a part of the background (baseline, tilt, drag) is free. `medium` is the fitted medium.
    `block_length` is the number of samples over which residuals are correlated.
    """

    misfit: Array
    medium: Medium
    block_length: Array


def fits_of_classes(profile, measured, held, depth_noise):
    """Return the `ClassFit` of each class that the profile supports, by its letter.

    `held` are the values (R,) of held parameters by name; constants of the hardness are ignored.
    """
    others = {name: value for name, value in held.items() if name not in CLASSES.values()}
    zero = np.zeros(len(measured.depth))
    fits = {}
    for letter, free in CLASSES.items():
        if free == "hardness" and not integrals(profile).convex:
            continue
        constants = {name: zero for name in CLASSES.values() if name != free}
        fits[letter] = _fit(profile, measured, others | constants, depth_noise)
    return fits


def _fit(profile, measured, held, depth_noise):
    noise_known = measured.force_noise is not None or depth_noise > 0
    solutions = [
        solved(*problem, noise_known) for problem in problems(profile, measured, held, depth_noise)
    ]
    order = np.argsort(np.concatenate([solution.rows for solution in solutions]))
    index = 0 if measured.single else slice(None)
    media = [vars(solution.medium()) for solution in solutions]
    misfits = [_misfit(solution) for solution in solutions]
    lengths = [solution.block_length for solution in solutions]

    def joined(groups):
        return check.frozen(np.concatenate(groups)[order][index])

    medium = {name: joined([each[name] for each in media]) for name in ("E_star", *CLASSES.values())}
    return ClassFit(joined(misfits), Medium(**medium), joined(lengths))


def _misfit(solution):
    """Return the root mean square of the residuals over a force that is equal for all classes (R,)."""
    curves, (values, _) = solution.curves, solution.values_and_states
    force = curves.load[:, 0]
    # A fitted background differs between the classes, and may be much larger than the record.
    if not set(BACKGROUND) & set(curves.free):
        force = np.max(np.abs(curves.force - curves.background(values)), axis=1)
    return np.sqrt(np.mean(solution.deviation**2, axis=1)) / force


def class_of_hardness(fits, samples, free):
    """Return the `HardnessClass` of one curve with a number of samples from its `fits_of_classes`.

    Classes within three standard deviations are possible. The best class describes the curve if its misfit
    is within 1 %, or its residuals are not correlated. `free` are the names of the free parameters.
    """
    best = min(fits, key=lambda letter: fits[letter].misfit)
    least = max(fits[best].misfit, np.finfo(float).tiny)
    independent = samples / fits[best].block_length
    possible = (
        letter for letter, fit in fits.items() if independent * 2 * np.log(fit.misfit / least) < _TOLD
    )
    describes = fits[best].misfit <= _NONE or fits[best].block_length == 1
    misfits = ", ".join(f"({letter}) {100 * fit.misfit:.3g} %" for letter, fit in fits.items())
    whole = "range of the force" if set(BACKGROUND) & set(free) else "largest force"
    reason = f"misfit {misfits} of the {whole}"
    return HardnessClass(best, tuple(possible), bool(describes), reason)


def fit_again(fits, found, free):
    """Yield a row of a report if the curve excludes the fitted class.

    `found` is the `HardnessClass`, and `free` are the names of the free parameters.
    """
    taken = [letter for letter, name in CLASSES.items() if name in free]
    if len(taken) != 1 or not set(taken) <= set(fits):
        return
    best = found.best
    if taken[0] not in found.possible:
        misfits = (f"{100 * fits[letter].misfit:.3g} %" for letter in (taken[0], best))
        text = (
            f"the curve is not of the fitted class ({taken[0]}): fit again with {CLASSES[best]}=None, "
            f"class ({best}); misfit {' against '.join(misfits)}"
        )
        yield "another class", text


def rows_on_class(found, depth, force, depth_noise):
    """Yield rows of a report on one curve: its `HardnessClass` and the assumptions."""
    yield "class of hardness", f"{found}: {found.reason}"
    turns, starts = turning_points_of(depth, force, depth_noise)
    record = f"this record has {len(starts)} loadings" * (len(starts) > 1)
    if not turns:
        record = "this record has no unloading"
    presumed = "a known tip that is not worn, one loading without pop-ins and one unloading"
    yield "assumed for the class", f"{presumed}; {record}" if record else presumed
