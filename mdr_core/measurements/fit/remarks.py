"""Remarks on a fitted curve: parameters that the data do not determine, and deviations from the model."""

from itertools import chain

import numpy as np

from ...base.remark import KINDS, Remark, Remedy
from ...show.quantities import engineering
from ..common.doubts import UNITS, is_modulus, of_ideal_tip, out_of_order, saturated
from ..common.errors import SIGNIFICANT, roughness
from .nested import nested_tests
from .noise import tests_of_noise
from .parameters import TOGETHER, symbols

#: Kinds of remarks that show that the model does not fit, and that first contact may be wrong by more than
#: its error.
DOUBTS = {"units", "order", "no contact", "undetermined", "tilt", "drag", "drift", "misfit", "noise"}
#: Kinds of remarks that require parameters at a minimum, with their errors.
_OF_MINIMUM = {"tilt", "drag", "drift", "misfit", "unloading", "outliers", "errors", "vague", "creep"}
#: Largest relative error of a determined E*, in general and from loading alone.
_VAGUE, _VAGUE_LOADING = 0.2, 0.01
#: Relative error above which a parameter is not determined at all.
_NOT_AT_ALL = 10.0
#: Number of standard errors below which one of several constants of the hardness may be 0.
_TOLD = 2.0
#: Largest range of depth (m), and smallest share of the variance of the force explained by a contact.
_LONGEST, _EXPLAINED = 1e-3, 0.75
#: Smallest explained share that exceeds noise, and smallest ratio of the unexplained shares that implies
#: other columns.
_SEEN, _BENT = 0.25, 1.1
#: Largest ranges of depth (m) of indentations, in general and usually in soft media, and largest modulus
#: (Pa) of very soft media. Contact radius over the radius of the tip above which depths are in another
#: unit.
_ENORMOUS, _LARGE, _SOFTEST, _BEYOND_TIP = 1.0, 1e-2, 1e3, 10.0
_SWAPPED, _NO_CONTACT = "depth and force are swapped", "this record shows no contact"
#: Smallest distance between measured and modelled pull-off for a remark, as a share of the range of depth.
_PULL_OFF = 0.02


def remarks_of(solved):
    """Return the remarks on each curve of a `Solution`."""
    checks = (
        _units, _order, _saturated, _ambiguous, _adhesion, of_tension, _undetermined, tests_of_noise,
        nested_tests, _tip,
    )  # fmt: skip
    return [
        _consistent([*chain(*(check(solved, i) for check in checks))], _not_at_all(solved, i))
        for i in range(len(solved.rows))
    ]


def _not_at_all(solved, i):
    """Return the names of parameters in whose direction the residuals do not change."""
    errors = solved.errors(i)
    if _sees_no_yield(solved, i, errors):
        return []
    return [name for name, error in errors.items() if error == np.inf and name != "work_of_adhesion"]


def _sees_no_yield(solved, i, errors):
    return solved.elastic[i] and any(name in errors for name in solved.curves.constants)


def _consistent(remarks, undetermined):
    """Remove remarks that others make void, for example because there is no minimum."""
    made = {remark.kind for remark in remarks}
    void = set(_OF_MINIMUM) if undetermined else set()
    # A tilt, a drag or a drift may hide the contact.
    if {"tilt", "drag", "drift"} & (made - void):
        void |= {"no contact"}
    # These remarks are more specific.
    if {"misfit", "noise"} & (made - void):
        void |= {"unloading", "errors"}
    return [remark for remark in remarks if remark.kind not in void]


def by_importance(remarks):
    """Sort remarks in the order of `KINDS`."""
    return tuple(sorted(remarks, key=lambda remark: list(KINDS).index(remark.kind)))


def missing(used, samples):
    """Yield a remark on omitted samples, if there are any."""
    if used < samples:
        text = f"{samples - used} of {samples} samples have no number and are left out"
        yield Remark(text, "left out")


def _units(solved, i):
    """Yield a remark on swapped or reversed columns, a record without contact, or other units."""
    curves, values = solved.curves, solved.values_and_states[0]
    if _is_enormous(solved, i):
        reached = engineering(np.ptp(curves.depth[i]), "m")
        text = f"the depths of this record cover {reached}, too much for an indentation by this tip"
        columns = curves.depth[i], curves.force[i]
        swapped = _shares_of_others(*columns).get(_SWAPPED, 0.0) >= max(
            _EXPLAINED, _share_of_contact(*columns)
        )
        yield _in_other_units(text, _SWAPPED if swapped else "")
        return
    if "E_star" not in curves.free:
        return
    depth, force, E = curves.depth[i], curves.force[i], values["E_star"][i, 0]
    sum_of_squares = np.sum(solved.deviation[i] ** 2)
    variance = np.sum((force - force.mean()) ** 2)
    line = variance * (1 - np.corrcoef(depth, force)[0, 1] ** 2)
    straight = not curves.adhesive and line < 1.1 * sum_of_squares
    plausible = is_modulus(E)
    if plausible and not straight:
        return
    shares, own = _shares_of_others(depth, force), _share_of_contact(depth, force)
    least = max(_EXPLAINED, own)
    swapped = not plausible and shares.get(_SWAPPED, 0.0) >= least
    cause = _SWAPPED if swapped else max(shares, key=shares.get)
    other = shares[cause] >= least
    unexplained = sum_of_squares > (1 - _EXPLAINED) * variance
    bent = other and 1 - own > _BENT * (1 - shares[cause])
    if straight and (unexplained or bent):
        text = "a straight line fits the force as well as an indentation"
        if other:
            yield _in_other_units(text, cause)
        elif not _contact_is_seen(depth, force):
            yield Remark(f"{text}: {_NO_CONTACT}", "no contact")
    elif not plausible:
        small = E < 1.0 and np.ptp(depth) < _LONGEST
        text = f"no material has E* = {engineering(E, 'Pa')}"
        if small and not swapped and not _contact_is_seen(depth, force):
            yield Remark(f"{text}: {_NO_CONTACT}", "no contact")
        else:
            yield _in_other_units(text, _SWAPPED if swapped else "")


def _in_other_units(text, cause):
    """Return a remark on impossible values, with their cause in columns or signs, or else on the units."""
    if not cause:
        return Remark(text, "units", *UNITS, together=True)
    columns = (Remedy("give", "columns"),)
    remedy = columns if cause == _SWAPPED else [each for each in UNITS if each.what in cause]
    return Remark(f"{text}: {cause}", "units", *remedy)


def _is_enormous(solved, i):
    """Whether depths are obviously not in m."""
    profile, values = solved.curves.profile, solved.values_and_states[0]
    reached = float(np.ptp(solved.curves.depth[i]))
    radius = profile.radius_at(np.minimum(reached, profile.known_depth))
    soft = reached > _LARGE and values["E_star"][i, 0] < _SOFTEST
    return reached > _ENORMOUS or soft or bool(radius > _BEYOND_TIP * profile.body_radius)


def _order(solved, i):
    """Yield remarks on samples that are not in the order of measurement, if the order matters."""
    curves = solved.curves
    if not curves.held_elastic or curves.adhesive:
        yield from out_of_order(curves.depth[i], curves.force[i])


def _saturated(solved, i):
    """Yield a remark on a depth at the limit of its sensor."""
    return saturated(solved.curves.depth[i], solved.curves.force[i])


def _shares_of_others(depth, force):
    """Return `_share_of_contact` for swapped columns and reversed signs, by the assumed error."""
    others = {
        "the depth has the wrong sign, it must be positive into the medium": (-depth, force),
        "the force has the wrong sign, it must be positive in compression": (depth, -force),
        "depth and force have the wrong sign": (-depth, -force),
    }
    if np.ptp(force) < _LONGEST and 1.0 < np.ptp(depth) / np.ptp(force) ** 2 < 1e13:
        others[_SWAPPED] = force, depth
    return {cause: _share_of_contact(*pair) for cause, pair in others.items()}


def _pressed(depth):
    """Return the loading, or the unloading if the record begins near its largest depth, as a slice."""
    top = int(np.argmax(depth))
    return slice(top + 1) if top > depth.size / 4 else slice(top, None)


def _share_of_contact(depth, force):
    """Return the share of the variance of the force explained by (depth − z₀)^(3/2) with the best z₀."""
    part = _pressed(depth)
    depth, deviation = depth[part], force[part] - force[part].mean()
    points = np.linspace(depth.min(), depth.max(), 50)[:-1, None]
    columns = np.maximum(depth - points, 0.0) ** 1.5
    columns -= columns.mean(axis=1, keepdims=True)
    product = np.maximum(columns @ deviation, 0.0)
    power = np.sum(columns**2, axis=1) * (deviation @ deviation)
    return np.max(product**2 / np.maximum(power, 1e-300))


def _contact_is_seen(depth, force):
    """Whether the force grows with depth, or varies more at large depths than elsewhere."""
    part = _pressed(depth)
    fifths = np.array_split(force[part][np.argsort(depth[part])], 5)
    *others, last = (np.std(fifth) for fifth in fifths)
    return _share_of_contact(depth, force) > _SEEN or last > 2 * np.median(others)


def _ambiguous(solved, i):
    """Yield remarks on parameters at a bound, and on a second minimum."""
    curves, sum_of_squares = solved.curves, np.sum(solved.minimum.residual[i] ** 2)
    for name, at_bound in zip(curves.free, solved.minimum.at_bound[i], strict=False):
        if at_bound and name == "eta":
            yield Remark("the viscosity is 0 within the noise", "constant", Remedy("hold", name, 0.0))
        elif at_bound and name not in TOGETHER:
            yield Remark(
                f"{symbols([name])} is at the bound of its range", "undetermined", Remedy("hold", name)
            )
    noise = 1.0 if solved.noise_known else solved.reduced_chi_square[i]
    if solved.rival_squares[i] - sum_of_squares <= SIGNIFICANT**2 * noise:
        rival = curves.rows([i]).values(solved.rival[[i]])
        E, point = engineering(rival["E_star"][0, 0], "Pa"), engineering(rival["contact_point"][0, 0], "m")
        remedy = Remedy("hold", "contact_point"), Remedy("hold", "E_star")
        yield Remark(f"E* = {E} with contact at {point} fits about as well", "undetermined", *remedy)


def _adhesion(solved, i):
    """Yield remarks on a poorly determined work of adhesion, and on a pull-off at another depth."""
    curves, (values, state) = solved.curves, solved.values_and_states
    if not curves.adhesive:
        return
    force = (curves.force - curves.background(values))[i]
    noise = curves.sigma[i] * (1.0 if solved.noise_known else np.sqrt(solved.reduced_chi_square[i]))
    error = solved.errors(i).get("work_of_adhesion", 0.0)
    if error > _VAGUE:
        cause = "" if np.any(force < -SIGNIFICANT * noise) else "; there is no tension beyond the noise"
        text = f"the forces in contact hardly determine w ({_share(error)}{cause})"
        yield Remark(text, "adhesion", Remedy("hold", "work_of_adhesion", 0.0 if cause else None))
    depth = curves.depth[i]
    lost = [_depth_of_loss(depth, held) for held in (curves.contact[i], state.live_interval.length[i] > 0)]
    if abs(lost[1] - lost[0]) > _PULL_OFF * np.ptp(depth):
        measured, model, difference = (engineering(z, "m") for z in (*lost, lost[1] - lost[0]))
        yield Remark(
            f"contact is lost at z = {measured} in the data and at {model} in the model (difference "
            f"{difference}): a soft cantilever loses contact earlier, or adhesion differs between "
            "approach and retraction",
            "adhesion",
        )


def _share(error):
    """Return a text on the accuracy of a number with a relative error."""
    return f"to {100 * error:.2g} %" if error < _NOT_AT_ALL else "not at all"


def _depth_of_loss(depth, contact):
    """Return the depth (m) of the last loss of contact, or of the last sample if contact is not lost."""
    losses = np.flatnonzero(contact[:-1] & ~contact[1:])
    return depth[losses[-1] + 1] if losses.size else depth[-1]


def _undetermined(solved, i):
    """Yield remarks on parameters that the data do not determine."""
    _, state = solved.values_and_states
    errors = solved.errors(i)
    constants = [name for name in solved.curves.constants if name in errors]
    if _sees_no_yield(solved, i, errors):
        text = f"no yield is visible beyond the noise: {_hardest(solved, i)}"
        yield Remark(text, "constant", Remedy("class", "elastic"))
        return
    if len(constants) > 1:
        yield from _constants(solved, i, constants)
    unloading = np.count_nonzero((state.live_interval.length[i] > 0) & ~state.loading[i])
    error, hold = errors.get("E_star", 0.0), Remedy("hold", "E_star")
    if solved.curves.held_elastic:
        if _VAGUE < error < np.inf:
            yield Remark(f"the data hardly determine E* ({_share(error)})", "vague", hold)
    elif unloading < 2 and error > _VAGUE_LOADING:
        text = f"loading alone hardly determines E* ({_share(error)})"
        yield Remark(text, "vague", Remedy("part", "all"), hold)
    elif error > _VAGUE:
        recovered = "critical depth" if solved.curves.constants == ("q_c",) else "recovered depth"
        text = (
            f"the unloading hardly determines E* ({_share(error)}): only {unloading} samples are within "
            f"the {recovered} of {engineering(state.cap[i, -1], 'm')}"
        )
        yield Remark(text, "vague", hold)
    for name in _not_at_all(solved, i):
        text = (
            f"the data do not determine {symbols([name])}, or a parameter correlated with it: the "
            "residuals have no minimum, because they do not change in one direction"
        )
        yield Remark(text, "undetermined", Remedy("hold", name))


def _hardest(solved, i):
    """Return a text on the smallest possible hardness of a curve without yield."""
    values, state = solved.values_and_states
    depth = state.depth[i].max()
    if solved.curves.constants == ("q_c",):
        least = engineering(depth, "m")
        return f"q_c = ∞ means a critical depth above about {least}; press deeper"
    radius = solved.curves.profile.radius_at(np.minimum(depth, solved.curves.profile.known_depth))
    least = engineering(2 * values["E_star"][i, 0] * depth / (np.pi * radius), "Pa")
    return f"the medium is elastic, and its hardness at the largest contact radius is above about {least}"


def _constants(solved, i, names):
    """Yield a remark on one of several constants of the hardness that may be 0."""
    values = dict(zip(solved.curves.free, solved.minimum.x[i], strict=False))
    shares = {name: values[name] / solved.errors(i)[name] for name in names}
    name = min(shares, key=shares.get)
    if shares[name] < _TOLD:
        text = (
            f"the data do not distinguish {symbols(names)}: {symbols([name])} is {shares[name]:.2g} times "
            "its standard error"
        )
        yield Remark(text, "constant", Remedy("hold", name, 0.0))


def _tip(solved, i):
    """Yield a remark on a small contact under an ideal tip with a held first contact."""
    curves, (_, state) = solved.curves, solved.values_and_states
    largest = min(float(state.depth[i].max()), curves.profile.known_depth)
    if "contact_point" not in curves.free and largest > 0:
        height = curves.profile.height_at(curves.profile.radius_at(np.array([largest])))
        yield from of_ideal_tip(curves.profile, height, held=True)


#: Number of samples of a mean, and smallest numbers of samples of a branch and of its part in the air.
_MEAN, _BRANCH, _AIR = 5, 40, 20
#: Smallest significant tension, in standard deviations of the air and as a share of the range of force.
#: Noise that is correlated over a fifteenth of a curve reaches 1.3 %. E* changes by about this share.
_SIGNIFICANT, _LEAST = 4.0, 0.02


def tension(depth, force):
    """Return the largest tension (N) of approach or retract: force in the air minus the lowest force, or 0.

    A drag does not count, because a branch and its air have the same rate. A viscous medium does not count,
    because it only presses.
    """
    top, found = int(np.argmax(depth)), 0.0
    for branch in (force[top::-1], force[top:]):
        if branch.size < _BRANCH:
            continue
        means = np.convolve(branch, np.full(_MEAN, 1 / _MEAN), "valid")
        low = int(np.argmin(means))
        beyond = branch[low + _MEAN :]
        air = beyond[beyond.size // 4 :]
        if air.size < _AIR:
            continue
        level = np.median(air)
        scatter = max(1.4826 * np.median(np.abs(air - level)), roughness(branch[None])[0, 0])
        if level - means[low] > max(_SIGNIFICANT * scatter, _LEAST * np.ptp(force)):
            found = max(found, float(level - means[low]))
    return found


def of_tension(solved, i):
    """Yield a remark on an adhesion that the fit of an elastic medium neglects."""
    curves = solved.curves
    if curves.adhesive or not curves.held_elastic or "E_star" not in curves.free:
        return
    found = remark_on_tension(curves.depth[i], curves.force[i], solved.errors(i)["E_star"])
    if found is None:
        return
    # On a soft gel, adhesion may act on the retract alone.
    retracts = bool(curves.depth.shape[1] - np.argmax(curves.depth[i]) > _BRANCH)
    yield Remark(found.text, found.kind, *found.remedy, *[Remedy("part", "loading")] * retracts)


def remark_on_tension(depth, force, error):
    """Return a remark on the tension of a curve, or None if the relative error of E* covers it."""
    largest = tension(depth, force)
    share = largest / (np.ptp(force) - largest)
    # E* changes by about this share. The error of a deviating curve may already include it.
    if share <= error:
        return None
    pull = engineering(float(f"{largest:.2g}"), "N")
    text = (
        f"the force falls {pull} below the force in the air, {100 * share:.2g} % of the largest force: "
        "neglected adhesion changes E* by about as much"
    )
    return Remark(text, "adhesion", Remedy("free", "work_of_adhesion"))
