"""Samples of a profile: convex samples nearest to measured heights, and samples of an area function."""

import numpy as np
import scipy

from ...base import check
from ...base.remark import Remark

#: Sizes (m) of units of length.
LENGTHS = {"m": 1.0, "mm": 1e-3, "µm": 1e-6, "nm": 1e-9, "pm": 1e-12, "Å": 1e-10, "cm": 1e-2}
#: Misfit of a convex profile, over the noise and over the height, above which samples have another shape.
#: Noise averaged over five neighbours looks 2.9 times smaller.
_MISFIT, _SHARE = 4.0, 0.005
#: Mean square of the autocorrelation of residuals above which they are waves; least number of samples and
#: lags for it. Noise averaged over five neighbours has no autocorrelation at these lags.
_WAVY, _ENOUGH_FOR_WAVES, _LAGS = 0.15, 50, range(6, 26)
#: Least number of samples with a known noise.
_ENOUGH = 8
#: Share of the height above which a change of an area function is more than rounding.
_REPAIRED = 1e-6
#: Largest height in the unit of the coefficients: 1 mm for nm.
_HIGHEST = 1e6
#: Share of the height below which an area function need not grow; and largest radius of a tip over its
#: height, or height over radius.
_BLUNT, _WIDEST = 0.05, 100.0


def length_unit(unit):
    """Return the size (m) of a unit of length with a given name."""
    check.one_of("unit", unit, (*LENGTHS, "um"))
    return LENGTHS["µm" if unit == "um" else unit]


def _in_words(length):
    """Return a length (m) with two digits as text."""
    length = float(f"{length:.2g}")
    name = next((name for name in ("m", "mm", "µm", "nm") if length >= LENGTHS[name]), "pm")
    return f"{length / LENGTHS[name]:.4g} {name}"


def axis_of_symmetry(r, z):
    """Return the radius (m) of the axis of noisy samples on both sides, near the lowest sample."""
    order = np.argsort(r, kind="stable")
    r, z, width = r[order], z[order], np.ptp(r)
    lowest = np.clip(r[np.argmin(z)], r[0] + 0.2 * width, r[-1] - 0.2 * width)
    axes = lowest + 0.1 * width * np.linspace(-1, 1, 41)
    distance = np.linspace(0, min(axes[0] - r[0], r[-1] - axes[-1]), 400)
    sides = (np.interp(axes[:, None] + side * distance, r, z) for side in (1, -1))
    # The difference of the sides grows as a square; with noise it has many minima.
    a, b, _ = np.polyfit(axes - lowest, np.mean(np.subtract(*sides) ** 2, axis=1), 2)
    return float(lowest + np.clip(-b / (2 * a), axes[0] - lowest, axes[-1] - lowest)) if a > 0 else lowest


def convex_fit(r, z):
    """Return radii and heights (m) of the convex polygon nearest to samples at r (m), on one or both sides.

    Each side alone must be near a convex polygon: waves on one side would look like noise of the other.
    """
    fit = _nearest_convex(np.abs(r), z)
    for side in (r >= 0, r <= 0):
        if np.count_nonzero(side) >= _ENOUGH:
            x, y = np.abs(r[side]), z[side]
            vertices, heights = fit if side.all() else _nearest_convex(x, y)
            _refuse_misfit(x, y - np.interp(x, vertices, heights), np.ptp(y))
    return fit


def _nearest_convex(r, z):
    """Return radii and heights (m) of the convex polygon nearest to samples at radii r ≥ 0 (m).

    It is z₀ + Σ bₖ (r − ρₖ)₊ with bends bₖ ≥ 0 at kinks ρₖ from the axis outward, by non-negative least
    squares.
    """
    radii = np.unique(r)
    # At most 200 kinks; a kink at the last radius would have no samples outside it.
    kinks = np.unique(np.append(0.0, radii[:-1][:: max(1, -(-radii.size // 200))]))
    ramps = np.maximum(r[:, None] - kinks, 0.0) / radii[-1]
    # Two columns for the height at the axis, which has either sign.
    columns = np.column_stack([np.ones_like(r), -np.ones_like(r), ramps])
    size = np.ptp(z) or 1.0
    _, _, *bends = scipy.optimize.nnls(columns, (z - z.mean()) / size)[0]
    bends = np.array(bends) * size / radii[-1]
    if not np.any(bends > 0):
        raise check.MDRError(
            "the height z does not increase with the radius r: change the sign of z, or take FlatPunch"
        )
    used = (bends > 0) | (kinks == 0)
    kinks, bends = kinks[used], bends[used]
    vertices = np.append(kinks, radii[-1])
    return vertices, np.maximum(vertices[:, None] - kinks, 0.0) @ bends


def _refuse_misfit(r, residual, height):
    """Raise an error if residuals (m) are a curve instead of noise: no convex profile is near the samples.

    The third differences show only the noise; for a wave of eight or more samples they are a tenth. Waves
    of any length have an autocorrelation, even with noise.
    """
    order = np.argsort(r, kind="stable")
    residual = residual[order] - np.mean(residual)
    miss = np.std(residual)
    if miss <= _SHARE * height:
        return
    noise = np.sqrt(np.mean(np.diff(residual, 3) ** 2) / 20)
    if miss > _MISFIT * noise or (residual.size >= _ENOUGH_FOR_WAVES and _correlation(residual) > _WAVY):
        miss = _in_words(miss)
        worst = _in_words(r[order][np.argmax(np.abs(residual))])
        raise check.MDRError(
            f"the nearest convex profile misses the samples by {miss} (rms, most at r = {worst}), more "
            "than noise: the tip is wavy or concave, so that the contact would not be compact; smooth "
            "the samples, or leave out samples outside the convex part"
        )


def _correlation(residual):
    """Return the mean square of the autocorrelation of residuals: a²/2 for waves with variance share a."""
    residual = residual / np.sqrt(np.sum(residual**2))
    return np.mean([np.dot(residual[lag:], residual[:-lag]) ** 2 for lag in _LAGS])


def area_samples(coefficients, height, samples, limit, unit, from_depth=None):
    """Return radii and heights (m) of a profile with A(h) = Σ Cᵢ h^(2/2ⁱ), and remarks.

    A is in unit², h in `unit`. Below `from_depth` (m), if given, the tip is a cone. The remarks report
    differences between the profile and the area function.
    """
    coefficients = check.finite_array("area coefficients", coefficients).ravel()
    height = check.positive_number("height", height, unit="m")
    samples = check.positive_number("samples", samples)
    size = length_unit(unit)
    if size < 1.0 and height > _HIGHEST * size:
        raise check.MDRError(
            f"height = {height:g} m is {height / size:.3g} {unit}, and must be at most {_HIGHEST:g} "
            f"{unit}: give the height in m, for example {1000 * size:g}"
        )
    if not 2 <= samples <= limit or samples % 1:
        raise check.MDRError(f"samples = {samples:g} must be a whole number from 2 to {limit}")
    if from_depth is not None:
        from_depth = check.positive_number("from_depth", from_depth, unit="m")
        bad, depth = from_depth > height / 2, np.asarray(from_depth)
        check.raise_if("from_depth", depth, bad, f"is above half of the height, {height:g} m", unit="m")
    h = height * np.geomspace(1e-4, 1.0, int(samples) - 1)
    powers = 2.0 / 2.0 ** np.arange(coefficients.size)
    area = size**2 * ((h[:, None] / size) ** powers @ coefficients)
    advice = f"A must be positive and grow with h: check the coefficients and their unit, {unit}"
    back = (np.diff(area, prepend=0.0) <= 0) | (area <= 0)
    least = _BLUNT * height if from_depth is None else from_depth
    first = int(np.searchsorted(h, from_depth)) if from_depth else 0
    # Below its calibration a function may fall; there the tip is a cone.
    first = max(first, int(np.flatnonzero(back)[-1]) + 1 if back.any() else 0)
    falls, every = back & (h > least), (h, area)
    advice += _usable_from(*every) if falls.any() else ""
    check.raise_if("area A(h)", area, falls, "does not grow", unit="m²", advice=advice)
    h, radius = h[first:], np.sqrt(area[first:] / np.pi)
    wide = radius[-1] / height
    if not 1 / _WIDEST < wide < _WIDEST:
        raise check.MDRError(
            f"area coefficients: at height = {height:g} m the radius is {radius[-1]:.3g} m; their ratio "
            f"{wide:.2g} must be between {1 / _WIDEST:g} and {_WIDEST:g}: check the unit of the "
            f"coefficients, {unit}"
        )
    r, h = np.append(0.0, radius), np.append(0.0, h)
    z = _convex(r, h)
    far = _is_far(z, h)
    bound = "belongs to a part of the tip that is concave by more than 3 %"
    advice = "the contact would not be compact" + (_usable_from(*every) if far.any() else "")
    check.raise_if("area function: height", h, far, bound, unit="m", advice=advice)
    remarks = [_repaired(z, h)] if np.any(np.abs(z - h) > _REPAIRED * h[-1]) else []
    if first:
        below = _in_words(h[1])
        why = "is not used" if from_depth else "does not grow"
        text = f"the area function {why} below a height of {below}: the tip is a cone there"
        remarks.append(Remark(text, "changed"))
    return r, z, tuple(remarks)


def _convex(r, h):
    """Return the heights (m) of the convex profile nearest to heights at radii (m)."""
    slopes = scipy.optimize.isotonic_regression(np.diff(h) / np.diff(r), weights=np.diff(r)).x
    return np.append(0.0, np.cumsum(slopes * np.diff(r)))


def _is_far(z, h):
    """Whether heights z (m) of a profile differ by more than 3 % from heights h of an area function."""
    return np.abs(z - h) > 0.03 * np.maximum(h, 0.1 * h[-1])


def _usable_from(h, area):
    """Return words for the least height (m) from which areas (m²) are convex; empty if there is none."""
    for k in range(0, int(np.searchsorted(h, h[-1] / 2)), max(1, h.size // 200)):
        radius = np.sqrt(np.maximum(area[k:], 0.0) / np.pi)
        if radius[0] > 0 and np.all(np.diff(radius) > 0):
            z = np.append(0.0, h[k:])
            if not _is_far(_convex(np.append(0.0, radius), z), z).any():
                return (
                    f"; from_depth={h[k]:.3g} uses it from the least contact depth (m) at which it is valid"
                )
    return ""


def _repaired(z, h):
    """Return the remark on the largest changes of the heights of an area function."""
    change = np.abs(z - h)
    share = change[1:] / h[1:]
    most, place, worst = (_in_words(x) for x in (change.max(), h[change.argmax()], h[1 + share.argmax()]))
    text = (
        f"the area function is concave in parts: heights were changed by up to {most} (at {place}), or "
        f"{100 * share.max():.2g} % (at {worst}), to make the tip convex"
    )
    return Remark(text, "changed")
