"""Doubts about numbers that need no model: units, the order of samples, ideal tips."""

import numpy as np

from ...base.remark import Remark, Remedy
from ...show.quantities import engineering
from ...solver.profiles.power import Cone
from .errors import roughness

#: Moduli E* (Pa) of materials, from the softest gels to diamond (1.15 TPa), with a margin.
MODULI = 1.0, 2e12
#: Least moduli (Pa) of unloadings that are not asked about: in general, and where more than a share of the
#: largest depth remains, as of plastics, metals and ceramics.
SOFTEST_OF_UNLOADINGS, SOFTEST_THAT_YIELDS, REMAINS = 1e3, 1e8, 0.25
#: Largest hardness (Pa), twice that of diamond.
HARDEST = 200e9
#: Least hardness over the modulus E*, a hundredth of that of annealed metals, and largest contact radius
#: (m) of measurements that are not asked about.
SOFTEST_OVER_MODULUS, WIDEST = 1e-5, 1e-2
#: Where to look for another unit.
UNITS = Remedy("unit", "depth"), Remedy("unit", "force")


def is_modulus(E_star):
    """Whether a modulus E* (Pa) may be that of a material."""
    return MODULI[0] <= E_star <= MODULI[1]


def doubts(E_star, hardness, remaining=0.0):
    """Remarks on moduli E* and hardnesses (Pa) of unloadings that are those of no material, or of few.

    `remaining` is the share of the largest depth that remains after each.
    """
    E_star, hardness = np.ravel(E_star), np.ravel(hardness)
    soft, stiff = E_star.min(), E_star.max()
    numbers = []
    if not (is_modulus(soft) and is_modulus(stiff)):
        numbers.append(("E*", stiff if is_modulus(soft) else soft))
    if hardness.max() > HARDEST:
        numbers.append(("H", hardness.max()))
    found = [
        f"no material has {symbol} = {_short(value)}: a unit, or the zero of the depth, is wrong"
        for symbol, value in numbers
    ]
    yields = np.ravel(remaining)[int(E_star.argmin()) % np.size(remaining)] > REMAINS
    if is_modulus(soft) and soft < (SOFTEST_THAT_YIELDS if yields else SOFTEST_OF_UNLOADINGS):
        which = " that keep an imprint" if yields else ""
        found.append(f"E* = {_short(soft)} is less than that of nearly all materials{which}")
    return [Remark(text, "units", *UNITS, together=True) for text in found]


def doubts_of_measured(E_star, mean_pressure, radius):
    """Remarks on mean pressures (Pa) and contact radii (m), beside E* (Pa), that are in other units."""
    if not SOFTEST_OVER_MODULUS * E_star <= np.median(mean_pressure) <= HARDEST:
        given = _short(np.median(mean_pressure))
        text = f"no material with E* = {_short(E_star)} has a mean pressure of {given}"
        yield Remark(
            text, "units", Remedy("unit", "mean_pressure"), Remedy("unit", "E_star"), together=True
        )
    if np.median(radius) > WIDEST:
        text = f"a contact radius of {engineering(float(f'{np.median(radius):.3g}'), 'm')} is very large"
        yield Remark(text, "units", Remedy("unit", "radius"))


def _short(value):
    return engineering(float(f"{value:.3g}"), "Pa")


#: Excess of the force after the largest depth over that before it, as a share of its range, that no medium
#: has; least share of samples at which depths turn, and least median step, as a share of their range, of a
#: record without order; least number of samples that tell it.
_REVERSED, _TURNS, _STEPS, _FEW = 0.05, 0.4, 0.1, 10
#: Share of the range of depth, and standard deviations of its noise, within which the depth stays; rise of
#: the force there that no contact has, as a share of its range.
_STAYS, _NOISE, _RISES = 5e-4, 3.0, 0.05
#: Least distance of a sample from both neighbours that no path has, as a share of the range of the middle
#: four fifths; least number of samples that tell it.
_APART, _PATH = 0.5, 20


def out_of_order(depth, force):
    """Remarks on a record that is shuffled, or runs backwards, so that its loading looks like unloading."""
    if depth.size < _FEW:
        return
    steps = np.diff(depth)
    turns = np.mean(steps[1:] * steps[:-1] < 0)
    if turns > _TURNS and np.median(np.abs(steps)) > _STEPS * np.ptp(depth):
        text = "depths go up and down from sample to sample, as in a shuffled record"
        yield Remark(f"{text}: give the samples in the order in which they were measured", "order")
    elif _rise_after(depth, force) > _REVERSED * np.ptp(force):
        text = "forces are larger after the largest depth than before it, as in a reversed record"
        yield Remark(f"{text}: give the samples in the order in which they were measured", "order")


def saturated(depth, force):
    """Yields a remark on a force that rises at the largest depth, as where the depth is at its limit."""
    if depth.size < _FEW:
        return
    width = max(_STAYS * np.ptp(depth), _NOISE * roughness(depth[None])[0, 0])
    top = np.flatnonzero(depth >= depth.max() - width)
    rise = force[top].max() - force[top[0]]
    # A contact has less over a tenth of the depths before.
    before = force[top[0]] - force[np.argmax(depth >= depth.max() - 10 * width)]
    if rise > max(_RISES * np.ptp(force), before):
        share, place = 100 * rise / np.ptp(force), engineering(depth.max(), "m")
        text = f"the force rises by {share:.2g} % while the depth stays at {place}, which no contact does"
        yield Remark(
            f"{text}: the depth is at the limit of its sensor", "misfit", Remedy("part", "loading")
        )


def _rise_after(depth, force):
    """Mean force (N) after the largest depth less that before it, at the same depths."""
    top = int(np.argmax(depth))
    parts = slice(top + 1), slice(top, None)
    least = max(depth[part].min() for part in parts)
    if least == depth[top]:
        return 0.0
    common = np.linspace(least, depth[top], 50)
    before, after = (
        np.interp(common, depth[part][order], force[part][order])
        for part in parts
        for order in [np.argsort(depth[part], kind="stable")]
    )
    return float(np.mean(after - before))


def apart(depth, force):
    """A remark on single samples far from both neighbours, as numbers that stand for missing ones."""
    if depth.size < _PATH:
        return
    counts = {name: _count_apart(values) for name, values in (("depth", depth), ("force", force))}
    found = " and ".join(f"{count} samples of the {name}" for name, count in counts.items() if count)
    if found:
        text = (
            f"{found} are more than half of its range away from both neighbours, as numbers that stand for "
        )
        yield Remark(f"{text}missing ones: leave them out", "outliers")


def _count_apart(values):
    before, after = values[1:-1] - values[:-2], values[1:-1] - values[2:]
    least = np.where(before * after > 0, np.minimum(np.abs(before), np.abs(after)), 0.0)
    return np.count_nonzero(least > _APART * np.ptp(np.quantile(values, [0.1, 0.9])))


#: Contact depth (m) below which the rounding of a real tip counts. A cap of radius R takes the depth
#: δ = R(√(1 + s²) − 1) off a cone of slope s, and the area at a contact depth h_c is (1 + δ/h_c)² times
#: that of the cone: under Berkovich's s = 0.358 and R = 0.05 … 0.3 µm, H is 3 to 20 % too large at 200 nm,
#: E* half as much. So it is under a sharp tip of an AFM, s = 2 and R = 10 nm.
_BLUNT = 200e-9


def of_ideal_tip(profile, contact_depth, held=False):
    """Yields a remark on contact depths (m) under an ideal cone, if they are small; NaN is none.

    `held` says whether it is of a fit with first contact held. A fitted one takes the rounding up: with
    R = 0.3 µm and 100 nm of depth E* is then within 2 %, z₀ 20 nm off; with the right z₀ it is 37 % off.
    """
    depths = np.ravel(contact_depth)
    small = depths[depths < _BLUNT]
    if not small.size or not isinstance(profile, Cone):
        return
    least = engineering(small.min(), "m")
    where = (
        f"{small.size} contact depths from {least} on" if small.size > 1 else f"a contact depth of {least}"
    )
    text = (
        f"an ideal tip at {where}: real ones are rounded, so that the hardness is too large by up to a "
        "fifth at 200 nm, E* by half as much, and more at less depth"
    )
    yield Remark(text, "tip", Remedy("give", "profile"), *[Remedy("free", "contact_point")] * held)
