"""Remarks on a fitted curve: parameters that the data do not determine, and deviations from the model."""

from itertools import chain

import numpy as np

from ..medium import critical_depth
from ..results.quantities import engineering
from .least_squares import SIGNIFICANT, SINGULAR, autocorrelation, roughness

#: All kinds of remarks, the most important first.
KINDS = (
    "units", "adhesion", "bound", "frame", "second minimum", "undetermined", "misfit", "jitter", "loading",
    "vague", "contact", "class", "elastic", "hardly yields", "noisy", "inviscid", "missing",
)  # fmt: skip
#: Relative error of E* above which it counts as not determined, in general and from loading alone.
_VAGUE, _VAGUE_LOADING = 0.2, 0.01
#: Samples at which contact differs from that of the model, as a share of those in contact.
_OTHER_CONTACT = 0.05
#: Root mean square of correlated residuals over the range of force above which the model does not fit, of
#: elastic media and of those that yield, whose unloading is a small part of the curve.
_MISFIT, _MISFIT_YIELDING = 0.05, 0.01


def remarks_of(solved):
    """Remarks on each curve of `SolvedCurves`: a sentence by its kind, the same for all curves."""
    checks = _ambiguous, _adhesion, _undetermined, _jitter, _class_b, _misfit
    curves = range(len(solved.rows))
    return [dict(chain.from_iterable(check(solved, i) for check in checks)) for i in curves]


def by_importance(remarks):
    """Remarks in the order of `KINDS`."""
    return dict(sorted(remarks.items(), key=lambda item: KINDS.index(item[0].partition(":")[0])))


def missing(count, samples):
    """A remark on samples that are left out."""
    return {"missing": f"left out: {count} of {samples} samples, without a number"} if count else {}


def _ambiguous(solved, i):
    """A modulus of no material, parameters at a bound, a second minimum, a frame like the medium."""
    problem, squares = solved.problem, np.sum(solved.residual[i] ** 2)
    E = solved.values_and_states[0]["E_star"][i, 0]
    if not 1.0 <= E <= 1e13 and "E_star" in problem.free:
        text = f"E* = {engineering(E, 'Pa')} is that of no material: give depth in m and force in N"
        yield "units", text
    for name, at_bound in zip(problem.free, solved.at_bound[i], strict=False):
        if at_bound and name == "eta":
            yield "inviscid", "no viscosity within the noise: η = 0; hold eta = 0"
        elif at_bound:
            yield f"bound:{name}", f"{name} is at the bound of its search: hold it, or check the data"
    noise = 1.0 if solved.noise_known else solved.reduced_chi_square[i]
    if solved.rival_squares[i] - squares <= SIGNIFICANT**2 * noise:
        rival, _ = problem.rows([i]).parameters(solved.rival[[i]])
        E, point = engineering(rival["E_star"][0, 0], "Pa"), engineering(rival["contact_point"][0, 0], "m")
        text = f"E* = {E} with contact at {point} fits about as well: hold contact_point or E_star"
        yield "second minimum", text
    if {"E_star", "frame_compliance"} <= set(problem.free):
        pair = [problem.free.index(name) for name in ("E_star", "frame_compliance")]
        block = solved.covariance[i][np.ix_(pair, pair)]
        correlation = block[0, 1] / max(np.sqrt(block[0, 0] * block[1, 1]), 1e-300)
        if abs(correlation) > 0.9:
            yield (
                "frame",
                f"E* and frame_compliance are nearly one parameter (correlation {correlation:.3f}): hold "
                "frame_compliance",
            )


def _adhesion(solved, i):
    """A work of adhesion that is hardly determined, and contact at other samples than in the model."""
    problem, (values, state) = solved.problem, solved.values_and_states
    if not problem.adhesive:
        return
    force = (problem.force - problem.background(values))[i]
    noise = problem.sigma[i] * (1.0 if solved.noise_known else np.sqrt(solved.reduced_chi_square[i]))
    column = problem.free.index("work_of_adhesion") if "work_of_adhesion" in problem.free else None
    error = 0.0 if column is None else np.sqrt(solved.covariance[i, column, column])
    if error > _VAGUE:
        cause = "" if np.any(force < -SIGNIFICANT * noise) else "; there is no tension beyond the noise"
        share = f"to {100 * error:.2g} %" if error < np.inf else "not at all"
        yield (
            "adhesion",
            f"the forces in contact hardly determine w ({share}{cause}): hold work_of_adhesion",
        )
    differs = problem.contact[i] != (state.live_interval.length[i] > 0)
    others = np.count_nonzero(differs & (np.abs(force - state.force[i]) > SIGNIFICANT * noise))
    if others > max(2, _OTHER_CONTACT * np.count_nonzero(problem.contact[i])):
        yield (
            "contact",
            f"{others} samples have contact where the model has none, or none where it has: a soft "
            "cantilever loses it earlier, or adhesion differs between approach and retract",
        )


def _undetermined(solved, i):
    """Parameters that the data do not determine."""
    values, state = solved.values_and_states
    errors = dict(zip(solved.problem.free, np.sqrt(np.diag(solved.covariance[i])).tolist(), strict=True))
    if solved.elastic[i] and "q_c" in errors:
        largest = engineering(state.depth[i].max(), "m")
        yield (
            "elastic",
            "nothing has yielded within the noise: q_c = ∞ stands for a critical depth of more than about "
            f"{largest}; press deeper",
        )
        return
    if solved.hardly_yields[i]:
        text = "an elastic medium fits about as well: yield and q_c are hardly determined; press deeper"
        yield "hardly yields", text
    unloading = np.count_nonzero((state.live_interval.length[i] > 0) & ~state.loading[i])
    error = errors.get("E_star", 0.0)
    if solved.problem.memoryless:
        if _VAGUE < error < np.inf:
            yield "vague", f"the data hardly determine E* (to {100 * error:.2g} %): hold E_star"
    elif unloading < 2 and error > _VAGUE_LOADING:
        yield (
            "loading",
            f"loading alone hardly determines E* (here to {100 * error:.2g} %): record the unloading, or "
            "hold E_star",
        )
    elif error > _VAGUE:
        d_c = engineering(critical_depth(values["E_star"], values["q_c"])[i, 0], "m")
        yield (
            "vague",
            f"the unloading hardly determines E* (to {100 * error:.2g} %): there are {unloading} samples "
            f"within the critical depth of {d_c}; record more of them, or hold E_star",
        )
    for name, error in errors.items():
        if error == np.inf and name != "work_of_adhesion":
            text = f"the data do not determine {name}: hold it, or a parameter that it is correlated with"
            yield f"undetermined:{name}", text


def _jitter(solved, i):
    """Depths that go back and forth although they are taken as exact: without memory they may."""
    depth = solved.problem.depth[[i]]
    steps = np.diff(depth[0])
    reversals = np.count_nonzero(steps[1:] * steps[:-1] < 0)
    noise = roughness(depth)[0, 0]
    # On unloading alone the first depth is the largest.
    unloading = depth[0].max() - depth[0, 0] < 5 * noise
    exact = not (solved.problem.depth_noise or solved.problem.memoryless)
    if exact and not unloading and reversals > max(4, 0.05 * steps.size):
        yield (
            "jitter",
            f"the depth goes back and forth at {reversals} of {steps.size} samples, and its noise counts "
            f"as new largest depths: E* is biased; give depth_noise, about {engineering(noise, 'm')}",
        )


def _class_b(solved, i):
    """Whether the recovered depth depends on depth: one more parameter γ of d_c (1 + γ (D − D̄)/D̄).

    Tested by one linear step on the residuals, with −∂F/∂d_p the derivative by the largest depth so far.
    """
    problem, (values, state) = solved.problem, solved.values_and_states
    d_c = critical_depth(values["E_star"], values["q_c"])[i, 0]
    memory_slope, jacobian, residual = state.memory_slope[i], solved.jacobian[i], solved.residual[i]
    unloading = ~state.loading[i] & ((state.live_interval.length[i] > 0) | (memory_slope < 0))
    if problem.turning_points.shape[1] < 2 or d_c == np.inf or not unloading.any():
        return
    depth = state.live_interval.lower[i] + d_c
    mean = np.mean(depth[unloading])
    change = np.where(unloading, memory_slope * d_c * (depth / mean - 1), 0.0)
    column = change / problem.noise(state.slope)[i]
    if problem.depth_noise:
        # Free turning depths would absorb the trend; each is known about as well as one sample.
        count, width = problem.free_turning_points, jacobian.shape[1]
        pins = np.eye(count, width, width - count) * problem.length[i] / problem.depth_noise
        jacobian = np.vstack([jacobian, pins])
        column, residual = (np.append(values, np.zeros(count)) for values in (column, residual))
    basis, s, _ = np.linalg.svd(jacobian, full_matrices=False)
    basis = basis[:, s > SINGULAR * s[:1]]
    independent = column - basis @ (basis.T @ column)
    power = independent @ independent
    if power <= 1e-12 * (column @ column):
        return
    variance = residual @ residual / max(residual.size - jacobian.shape[1] - 1, 1)
    trend, error = independent @ residual / power, np.sqrt(variance / power)
    if abs(trend) > max(SIGNIFICANT * error, 0.05):
        yield (
            "class",
            f"the recovered depth {'grows' if trend > 0 else 'falls'} with depth (about as its power "
            f"{trend:+.2g} ± {error:.1g}), whereas it is constant for hardness ∝ 1/radius: not class (b)",
        )


def _misfit(solved, i):
    """Residuals that are not noise."""
    problem, residual = solved.problem, solved.residual[i]
    freedom, chi = max(residual.size - solved.x.shape[1], 1), solved.reduced_chi_square[i]
    correlation = autocorrelation(residual[solved.orders[i]])
    _, state = solved.values_and_states
    size = np.sqrt(np.mean((residual * problem.noise(state.slope)[i]) ** 2)) / problem.load[i, 0]
    largest = _MISFIT if problem.memoryless else _MISFIT_YIELDING
    if size > largest and correlation > max(0.3, SIGNIFICANT / np.sqrt(freedom)):
        cause = "not an elastic medium" if problem.memoryless else "not class (b)"
        held = [name for name in ("drag", "eta", "tilt") if name not in problem.free]
        times = " (with the times of the samples)" * ("drag" in held)
        remedy = f"; free {', '.join(held)}{times}, if measured in a liquid or on a gel" * bool(held)
        yield (
            "misfit",
            f"the residuals ({100 * size:.2g} % of the force) follow a curve (correlation of neighbours "
            f"{correlation:.2f}): {cause}, or another profile{remedy}",
        )
    elif solved.noise_known and chi > 1 + 6 * np.sqrt(2 / freedom) and size > 1e-7:
        yield (
            "noisy",
            f"χ² per degree of freedom is {chi:.3g}: the residuals ({100 * size:.2g} % of the force) are "
            "larger than the noise that is given",
        )
