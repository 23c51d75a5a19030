"""Families of made curves that deviate from the model in one respect, for tests and a table."""

from dataclasses import dataclass

import numpy as np

import mdr_core as mdr

#: Samples of a curve, and the noise of the force as a share of the largest one.
SAMPLES, NOISE = 600, 4e-3


@dataclass(frozen=True)
class Kind:
    """A medium pressed by a tip from the first of three depths (m) to the second and back to the third."""

    tip: mdr.Cone | mdr.Paraboloid
    medium: mdr.Medium
    depths: tuple[float, float, float]
    duration: float
    options: dict


CONE = mdr.Cone.berkovich()
KINDS = {
    "gel, elastic": Kind(
        mdr.Paraboloid(1e-5), mdr.Medium(1e4), (-2e-6, 1e-6, -2e-6), 2.0, {"q_c": np.inf, "baseline": None}
    ),
    "glass, class (a)": Kind(
        CONE, mdr.Medium(70e9, hardness=10e9), (-20e-9, 600e-9, 300e-9), 60.0, {"hardness": None}
    ),
    "metal, class (b)": Kind(CONE, mdr.Medium(70e9, q_c=8e3), (-20e-9, 600e-9, 400e-9), 60.0, {}),
}
#: Families and the sizes of the deviation: see `curve`.
FAMILIES = {
    "clean": (0.0,),
    "tilt": (0.002, 0.01, 0.03),
    "retract": (0.005, 0.02),
    "drift": (0.003, 0.02),
    "creep": (0.003, 0.02),
    "correlated noise": (3, 10, 40),
    "outliers": (0.02, 0.1),
    "few samples": (8, 12, 30),
}
SAYS = {
    "clean": "0.4 % noise of the force, 600 samples",
    "tilt": "force changes by {} of the largest one over the largest depth",
    "retract": "force of the retract larger by {}",
    "drift": "depth drifts by {} of the largest one",
    "creep": "piezo creeps on the retract by {} of the largest depth a decade of time",
    "correlated noise": "noise correlated over {} samples",
    "outliers": "{} of the samples off by 15 standard deviations to one side",
    "few samples": "{} samples",
}


def curve(kind, family, size, seed, noise=NOISE):
    """Depth (m), force (N) and time (s) of one made curve, from a first contact at 100 nm."""
    count = int(size) if family == "few samples" else SAMPLES
    share, random = np.linspace(0.0, 1.0, count), np.random.default_rng(seed)
    depth = np.interp(share, [0.0, 0.5, 1.0], kind.depths)
    largest, retract = kind.depths[1], share > 0.5
    true = depth
    if family == "drift":
        true = depth - size * largest * share
    if family == "creep":
        true = depth + size * largest * np.log10(1 + np.maximum(share - 0.5, 0.0) / 0.01)
    force = mdr.indent(kind.tip, kind.medium, true).force.copy()
    top = force.max()
    if family == "tilt":
        force += size * top * depth / largest
    if family == "retract":
        force[retract] *= 1 + size
    deviates = random.normal(size=count)
    if family == "correlated noise":
        memory = np.exp(-1 / size)
        for i in range(1, count):
            deviates[i] = memory * deviates[i - 1] + np.sqrt(1 - memory**2) * deviates[i]
    if family == "outliers":
        deviates += 15.0 * (random.random(count) < size)
    return depth + 1e-7, force + noise * top * deviates, kind.duration * share


def fits(kind, family, size, seeds):
    """The fits of curves of these seeds."""
    depth, force, time = (
        np.array(each) for each in zip(*(curve(kind, family, size, seed) for seed in seeds), strict=True)
    )
    return mdr.fit_indentation(kind.tip, depth, force, time=time, **kind.options)


def covered(kind, fit):
    """Whether E* is within two standard errors."""
    return np.abs(fit.medium.E_star - kind.medium.E_star) < 2 * fit.standard_errors["E_star"]


def told(fit):
    """The kinds of the remarks on each curve."""
    return [{remark.kind for remark in each.remarks} for each in fit]


def visible(kind, family, size):
    """Standard deviations of noise by which the curve without noise deviates from its own fit.

    No test sees a deviation more clearly than at so many standard deviations (Neyman and Pearson).
    """
    if family in ("clean", "correlated noise", "outliers", "few samples"):
        return None
    depth, force, time = curve(kind, family, size, 0, noise=0.0)
    fit = mdr.fit_indentation(kind.tip, depth, force, time=time, **kind.options)
    return float(np.sqrt(np.sum(fit.residuals**2)) / (NOISE * force.max()))
