"""Doubts about numbers without a model: units, the order of samples, ideal tips."""

import numpy as np

from ...base.remark import Remark, Remedy
from ...show.quantities import engineering
from ...solver.profiles.power import Cone
from .errors import roughness

#: Moduli E* (Pa) of materials, from the softest gels to diamond (1.15 TPa), with a margin.
MODULI = 1.0, 2e12
#: Smallest moduli (Pa) of unloadings without a remark: in general, and for plastics, metals and ceramics.
#: More than a share `REMAINS` of the largest depth remains in the latter.
SOFTEST_OF_UNLOADINGS, SOFTEST_THAT_YIELDS, REMAINS = 1e3, 1e8, 0.25
#: Largest hardness (Pa), twice the hardness of diamond.
HARDEST = 200e9
#: Smallest hardness over the modulus E*, a hundredth of the ratio of annealed metals, and largest contact
#: radius (m) of measurements without a remark.
SOFTEST_OVER_MODULUS, WIDEST = 1e-5, 1e-2
#: Remedies for a wrong unit.
UNITS = Remedy("unit", "depth"), Remedy("unit", "force")


def is_modulus(E_star):
    """Whether a material can have the modulus E* (Pa)."""
    return MODULI[0] <= E_star <= MODULI[1]


def doubts(E_star, hardness, remaining=0.0):
    """Return remarks on moduli E* and hardnesses (Pa) of unloadings that no or few materials have.

    `remaining` is the share of the largest depth that remains after each unloading.
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
        found.append(f"E* = {_short(soft)} is less than that of almost all materials{which}")
    return [Remark(text, "units", *UNITS, together=True) for text in found]


def doubts_of_measured(E_star, mean_pressure, radius):
    """Yield remarks on mean pressures (Pa), E* (Pa) and contact radii (m) with a likely wrong unit."""
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


#: Largest excess of unloading force over loading force of a medium, as a share of the force range. Smallest
#: share of turning samples and smallest median step, as a share of the depth range, of a shuffled record.
#: Smallest number of samples for these tests.
_REVERSED, _TURNS, _STEPS, _FEW = 0.05, 0.4, 0.1, 10
#: A constant depth stays within a share of the depth range, or within some standard deviations of its
#: noise. The third number is the largest rise of the force there, as a share of the force range.
_STAYS, _NOISE, _RISES = 5e-4, 3.0, 0.05
#: Largest distance of a sample from both neighbours, as a share of the range of the middle four fifths of
#: the samples; smallest number of samples for this test.
_APART, _PATH = 0.5, 20


def out_of_order(depth, force):
    """Yield a remark on a shuffled record, or on a reversed record, whose loading looks like unloading."""
    if depth.size < _FEW:
        return
    steps = np.diff(depth)
    turns = np.mean(steps[1:] * steps[:-1] < 0)
    if turns > _TURNS and np.median(np.abs(steps)) > _STEPS * np.ptp(depth):
        text = "depths go up and down from sample to sample, like a shuffled record"
        yield Remark(f"{text}: give the samples in the order in which they were measured", "order")
    elif _rise_after(depth, force) > _REVERSED * np.ptp(force):
        text = "forces are larger after the largest depth than before it, like a reversed record"
        yield Remark(f"{text}: give the samples in the order in which they were measured", "order")


def saturated(depth, force):
    """Yield a remark on a force that rises at constant largest depth, for example at a sensor limit."""
    if depth.size < _FEW:
        return
    width = max(_STAYS * np.ptp(depth), _NOISE * roughness(depth[None])[0, 0])
    top = np.flatnonzero(depth >= depth.max() - width)
    rise = force[top].max() - force[top[0]]
    # The force of a contact rises less within this width than over ten widths of depth before.
    before = force[top[0]] - force[np.argmax(depth >= depth.max() - 10 * width)]
    if rise > max(_RISES * np.ptp(force), before):
        share, place = 100 * rise / np.ptp(force), engineering(depth.max(), "m")
        text = f"the force rises by {share:.2g} % while the depth stays at {place}, unlike in a contact"
        yield Remark(
            f"{text}: the depth is at the limit of its sensor", "misfit", Remedy("part", "loading")
        )


def _rise_after(depth, force):
    """Return the mean force (N) after the largest depth minus the mean force before it, at equal depths."""
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
    """Yield a remark on single samples far from both neighbours, such as placeholders of missing values."""
    if depth.size < _PATH:
        return
    counts = {name: _count_apart(values) for name, values in (("depth", depth), ("force", force))}
    found = " and ".join(f"{count} samples of the {name}" for name, count in counts.items() if count)
    if found:
        text = (
            f"{found} are more than half the range away from both neighbours, like placeholders of missing "
        )
        yield Remark(f"{text}values: leave them out", "outliers")


def _count_apart(values):
    before, after = values[1:-1] - values[:-2], values[1:-1] - values[2:]
    least = np.where(before * after > 0, np.minimum(np.abs(before), np.abs(after)), 0.0)
    return np.count_nonzero(least > _APART * np.ptp(np.quantile(values, [0.1, 0.9])))


#: Contact depth (m) below which the rounding of a real tip counts. A cap of radius R shortens a cone of
#: slope s by δ = R(√(1 + s²) − 1). At a contact depth h_c the area is (1 + δ/h_c)² times that of the cone.
#: For a Berkovich tip with s = 0.358 and R = 0.05 … 0.3 µm, H is 3 to 20 % too large at 200 nm, and E* half
#: as much. A sharp AFM tip with s = 2 and R = 10 nm has the same errors.
_BLUNT = 200e-9


def of_ideal_tip(profile, contact_depth, held=False):
    """Yield a remark on small contact depths (m) under an ideal cone; NaN means no contact depth.

    `held` says whether the first contact of the fit is held. A fitted first contact absorbs the rounding:
    with R = 0.3 µm and a depth of 100 nm, E* is within 2 % and z₀ is wrong by 20 nm. With the true z₀, E*
    is wrong by 37 %.
    """
    depths = np.ravel(contact_depth)
    small = depths[depths < _BLUNT]
    if not small.size or not isinstance(profile, Cone):
        return
    least = engineering(small.min(), "m")
    where = f"{small.size} contact depths from {least}" if small.size > 1 else f"a contact depth of {least}"
    text = (
        f"an ideal tip at {where}: real tips are rounded, so the hardness is too large by up to a fifth at "
        "200 nm, E* by half as much, and both by more at smaller depths"
    )
    yield Remark(text, "tip", Remedy("give", "profile"), *[Remedy("free", "contact_point")] * held)
