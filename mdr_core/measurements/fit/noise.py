"""Tests whether residuals are independent noise of many samples, as standard errors assume.

They may follow a curve, have outliers, be correlated over a large part of the curve, or be few.
"""

from dataclasses import replace

import numpy as np

from ...base.remark import Remark, Remedy
from ...show.quantities import engineering
from ..common.errors import SIGNIFICANT, autocorrelation, roughness
from .parameters import BACKGROUND, CLASSES, symbols

#: Size of the residuals due to rounding, as a share of the range of force.
EXACT = 1e-7
#: Largest root mean square of correlated residuals over the range of force if the model fits: for elastic
#: media, and for media that yield, whose unloading is a small part of the curve.
_MISFIT, _MISFIT_YIELDING = 0.05, 0.01
#: The same for elastic media with residuals above a multiple of the noise of neighbours and with a strong
#: correlation, for example on a layer or beyond the range of a sensor. Interference of light stays below.
_SYSTEMATIC, _ABOVE_NOISE, _CORRELATED = 0.003, 5.0, 0.9
#: Smallest number of samples in the lower half of the depth for a comparison of E*.
_HALF = 10
#: Smallest deviation of an outlier from its neighbours, in standard deviations by the lower quartile, and
#: smallest number of samples for this test. The quartile of absolute normal deviations is 0.3186.
_OUTLIER, _ENOUGH = 6.0, 30
#: Above this modulus (Pa), a medium that is not elastic probably yields. Below it, the medium may stick or
#: flow, or be in a liquid.
_YIELDS = 1e9
#: Smallest excess of samples in contact over parameters for reliable errors.
_SPARE = 3
#: Smallest significant noise of the depth, as a share of the depth recovered on unloading; E* changes by
#: about this share. The recovered depth counts above the second number, a share of the largest force.
_COUNTS, _LOADED = 1e-3, 0.05
#: Number of blocks of correlated residuals below which the errors of a medium that yields are too small.
_BLOCKS = 20


def tests_of_noise(solved, i):
    """Yield remarks on the residuals of curve i of a `Solution`."""
    for check in (_depth_noise, _misfit, _few):
        yield from check(solved, i)
    size = np.sqrt(np.mean(solved.deviation[i] ** 2))
    # Smaller residuals are due to rounding.
    if size > EXACT * solved.curves.load[i, 0]:
        yield from _outliers(solved, i)
        yield from _blocks(solved, i)


def depth_noise_of(depth, force):
    """Return the noise (m) of depths (N,) that go back and forth, and the number of reversals.

    Noise that counts as new largest depths changes E* by about its share of the recovered depth. Below a
    thousandth, the change is smaller than the errors of the model, and both results are 0.
    """
    steps, noise = np.diff(depth), roughness(depth[None])[0, 0]
    reversals = np.count_nonzero(steps[1:] * steps[:-1] < 0)
    last = int(np.argmax(depth))
    loaded = depth[last:][force[last:] > _LOADED * force.max()]
    recovered = np.ptp(np.append(depth[last], loaded))
    # On unloading alone the first depth is the largest.
    unloading = depth[last] - depth[0] < 5 * noise
    counts = reversals > max(4, 0.05 * steps.size) and noise > _COUNTS * recovered and not unloading
    return (float(noise), reversals) if counts else (0.0, 0)


def _depth_noise(solved, i):
    """Yield a remark on noisy depths that the fit takes as exact, in a medium with memory."""
    depth, curves = solved.curves.depth[i], solved.curves
    noise, reversals = depth_noise_of(depth, curves.force[i])
    if reversals and not (curves.depth_noise or curves.held_elastic):
        text = (
            f"the depth goes back and forth at {reversals} of {depth.size - 1} samples, and its noise of "
            f"about {engineering(noise, 'm')} counts as new largest depths: E* is biased"
        )
        yield Remark(text, "noise", Remedy("give", "depth_noise", float(f"{noise:.2g}")))


def _misfit(solved, i):
    """Yield a remark on residuals that are not noise, or larger than the given noise."""
    curves, residual = solved.curves, solved.minimum.residual[i]
    degrees_of_freedom, chi = solved.minimum.degrees_of_freedom, solved.reduced_chi_square[i]
    correlation = autocorrelation(residual[solved.orders[i]])
    size = np.sqrt(np.mean(solved.deviation[i] ** 2)) / curves.load[i, 0]
    largest = _MISFIT if curves.held_elastic else _MISFIT_YIELDING
    systematic = curves.held_elastic and not curves.adhesive and size > _SYSTEMATIC
    if systematic and correlation > _CORRELATED:
        noise = roughness(solved.deviation[[i]])[0, 0] / curves.load[i, 0]
        largest = min(largest, max(_SYSTEMATIC, _ABOVE_NOISE * noise))
    if size > largest and correlation > max(0.3, SIGNIFICANT / np.sqrt(degrees_of_freedom)):
        letters = [letter for letter, name in CLASSES.items() if name in curves.constants]
        of_class = f"of class {' + '.join(f'({letter})' for letter in letters)}"
        text = (
            f"the residuals ({100 * size:.2g} % of the force) are systematic (correlation of neighbours "
            f"{correlation:.2f}): the medium is not {'elastic' if curves.held_elastic else of_class}, or "
            "the tip has another profile"
        )
        timeless = curves.time is None and not curves.adhesive
        remedy = *_other_class(solved, i, letters), *[Remedy("give", "time")] * timeless
        text += ", or there is a drag or a drift" * timeless
        if ratio := _whole_over_lower_half(solved, i):
            text += f". E* of the whole curve is {ratio:.3g} times E* of the lower half of the depth"
        yield Remark(text, "misfit", *remedy)
    elif solved.noise_known and chi > 1 + 6 * np.sqrt(2 / degrees_of_freedom) and size > EXACT:
        text = (
            f"χ² per degree of freedom is {chi:.3g}: the residuals ({100 * size:.2g} % of the force) are "
            "larger than the given noise"
        )
        yield Remark(text, "noise")


def _whole_over_lower_half(solved, i):
    """Return E* of an elastic medium over E* of the samples up to half the depth, None if unknown."""
    curves = solved.curves.rows([i])
    if not curves.held_elastic or curves.adhesive or curves.depth_noise or "E_star" not in curves.free:
        return None
    values = curves.values(solved.minimum.x[[i]])
    begin = values["contact_point"][0, 0]
    part = curves.depth[0] <= (begin + curves.top[0, 0]) / 2
    if np.count_nonzero(part & (curves.depth[0] > begin)) < _HALF:
        return None
    columns = {name: getattr(curves, name)[:, part] for name in ("depth", "force", "sigma", "rate")}
    time = None if curves.time is None else curves.time[:, part]
    lower = replace(curves, **columns, time=time)
    found = lower.values(lower.search(lower.scaled(values)).x)
    return float((values["E_star"] / found["E_star"])[0, 0])


def _other_class(solved, i, letters):
    """Return remedies with another class of hardness to try instead of a class that does not fit."""
    if solved.curves.held_elastic:
        stiff = solved.values_and_states[0]["E_star"][i, 0] > _YIELDS
        return (Remedy("class", "a"),) if stiff else ()
    return (Remedy("class", "b" if letters == ["a"] else "a"),) if len(letters) == 1 else ()


def _outliers(solved, i):
    """Yield a remark on samples far from both neighbours with most of the squares of the residuals."""
    residual = solved.minimum.residual[i][~solved.curves.left_out[i]]
    if residual.size < _ENOUGH or solved.curves.adhesive:
        return
    distance = residual[1:-1] - (residual[:-2] + residual[2:]) / 2
    size = np.abs(distance)
    far = size > _OUTLIER * np.quantile(size, 0.25) / 0.3186
    if np.sum(distance[far] ** 2) > 0.5 * np.sum(residual**2):
        # Both neighbours of an outlier are half as far from their neighbours.
        single = np.count_nonzero(far & (size > 0.6 * size.max()))
        text = (
            f"about {single} of {residual.size} samples are outliers, more than {_OUTLIER:g} standard "
            "deviations from their neighbours, and shift E* by more than its error: leave them out"
        )
        yield Remark(text, "outliers")


def _blocks(solved, i):
    """Yield a remark on noise that is correlated over a large part of a curve with yield."""
    curves, length = solved.curves, solved.block_length[i]
    count = curves.depth.shape[1]
    elastic = curves.held_elastic or solved.elastic[i]
    if 1 < length < count < _BLOCKS * length and not elastic:
        text = (
            f"neighbouring residuals are correlated over {length} of {count} samples: the standard errors "
            "are estimated from few blocks, and may be too small by up to a factor of two"
        )
        yield Remark(text, "errors")


def _few(solved, i):
    """Yield a remark on too few samples in contact for standard errors."""
    _, state = solved.values_and_states
    count = np.count_nonzero(state.live_interval.length[i] > 0)
    names = [name for name in solved.curves.free if name not in BACKGROUND]
    if names and count < len(names) + _SPARE:
        text = f"only {count} samples are in contact for {symbols(names)}"
        yield Remark(f"{text}: the standard errors are uncertain; record more", "errors")
