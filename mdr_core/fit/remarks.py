"""What a fitted curve does not tell, and where it is not as the model has it, in words."""

import numpy as np

from ..quantities import engineering
from .curve import critical_depth
from .least_squares import autocorrelation, roughness

#: Relative error of E* beyond which it counts as not told.
_VAGUE = 0.1
#: Standard errors beyond which a trend is one.
_SURE = 4.0


def remarks_of(curves, state, values, residual, jacobian, covariance, elastic, known):
    """For each curve pairs of a kind of remark and its sentence."""
    shares = np.sqrt(np.einsum("rpp->rp", covariance))
    found = []
    for i in range(len(residual)):
        one = curves.rows(np.array([i]))
        errors = dict(zip(curves.free, shares[i].tolist(), strict=True))
        back = np.count_nonzero((state.live_interval.length[i] > 0) & ~state.own[i])
        d_c = float(critical_depth(values)[i, 0])
        said = [
            *_told(
                errors, back, d_c, bool(elastic[i] == 2), bool(elastic[i] == 1), float(state.depth[i].max())
            ),
            *_jitter(one),
            *_class_b(one, state, i, residual[i], jacobian[i], d_c),
            *_misfit(residual[i], known, len(jacobian[i][0]), float(one.load[0, 0]), one, i),
        ]
        found.append(tuple(said))
    return found


def _told(errors, back, d_c, elastic, alike, deepest):
    """What the data do not tell."""
    if elastic and "q_c" in errors:
        yield (
            "elastic",
            f"nothing has yielded within the noise: q_c = ∞ stands for a critical depth of more than about "
            f"{engineering(deepest, 'm')}; press deeper",
        )
        return
    if alike and "q_c" in errors:
        yield (
            "hardly yields",
            "an elastic medium fits about as well: that it yields, and q_c, is hardly told; press deeper",
        )
    if back < 2 and "E_star" in errors:
        yield (
            "loading",
            f"loading alone hardly tells E* (here to {100 * errors['E_star']:.2g} %): record the "
            "unloading, or hold E_star",
        )
    elif errors.get("E_star", 0.0) > _VAGUE:
        yield (
            "vague",
            f"the unloading hardly tells E* (to {100 * errors['E_star']:.2g} %): within the critical depth "
            f"of {engineering(d_c, 'm')} there are {back} samples; record more of them, or hold "
            "E_star",
        )
    for name, error in errors.items():
        if error == np.inf and not (elastic and name == "q_c"):
            yield "untold " + name, f"the data do not tell {name}: hold it, or one that it goes with"


def _jitter(curve):
    """Depths that go back and forth although they are taken for exact."""
    if curve.depth_noise:
        return
    steps = np.diff(curve.depth[0])
    turned = np.count_nonzero(steps[1:] * steps[:-1] < 0)
    if turned > max(4, 0.05 * steps.size):
        size = float(roughness(curve.depth)[0, 0])
        yield (
            "jitter",
            f"the depth goes back and forth at {turned} of {steps.size} samples, and each time counts as "
            f"depth once reached: E* comes out too small; give depth_noise, about {engineering(size, 'm')}",
        )


def _class_b(curve, state, i, residual, jacobian, d_c):
    """Whether what is recovered depends on the depth, by one more parameter: d_c (1 + γ (D − D̄)/D̄).

    Tried by one linear step on the residuals: −∂F/∂d_p is that by the largest depth so far.
    """
    if curve.turns.shape[1] < 2 or d_c == np.inf:
        return
    deepest = state.live_interval.lower[i] + d_c
    unloaded = ~state.own[i] & (state.live_interval.length[i] > 0) | ~state.own[i] & (state.memory[i] < 0)
    if not unloaded.any():
        return
    mean = float(np.mean(deepest[unloaded]))
    change = np.where(unloaded, state.memory[i] * d_c * (deepest / mean - 1), 0.0)
    column = change / curve.noise(state.slope[i])[0]
    rest = jacobian
    if curve.depth_noise:
        # The turning depths would take the trend for themselves; they are known as well as one sample.
        rest = np.vstack([jacobian, _pins(curve, jacobian.shape[1])])
        column, residual = (np.append(part, np.zeros(curve.peaks)) for part in (column, residual))
        column[-curve.peaks :] = 0.0
    basis, s, _ = np.linalg.svd(rest, full_matrices=False)
    basis = basis[:, s > 1e-11 * s[0]] if s.size else basis
    left = column - basis @ (basis.T @ column)
    power = float(left @ left)
    if power <= 1e-12 * float(column @ column):
        return
    spread = float(residual @ residual) / max(residual.size - rest.shape[1] - 1, 1)
    trend = float(left @ residual) / power
    error = np.sqrt(spread / power)
    if abs(trend) > _SURE * error and abs(trend) > 0.05:
        yield (
            "class",
            f"the recovered depth {'grows' if trend > 0 else 'falls'} with depth (about as its power "
            f"{trend:+.2g} ± {error:.1g}), where hardness ∝ 1/radius keeps it: not class (b)",
        )


def _pins(curve, width):
    """Rows that hold each turning depth by the noise of a sample, in scaled parameters."""
    pins = np.zeros((curve.peaks, width))
    np.fill_diagonal(pins[:, width - curve.peaks :], float(curve.length[0, 0]) / curve.depth_noise)
    return pins


def _misfit(residual, known, parameters, load, curve, i):
    """Residuals that are not noise."""
    freedom = max(residual.size - parameters, 1)
    alike, chi = float(autocorrelation(residual)), float(residual @ residual) / freedom
    size = np.sqrt(chi) * float(np.median(curve.sigma)) / load
    if size < 1e-7:
        return
    if alike > max(0.3, _SURE / np.sqrt(freedom)):
        yield (
            "misfit",
            f"the residuals ({100 * size:.2g} % of the force) are no noise, neighbours go together "
            f"({alike:.2f}): not class (b), or not this tip; errors are larger than they say",
        )
    elif known and chi > 1 + 6 * np.sqrt(2 / freedom):
        yield "noisy", f"χ² is {chi:.3g} per degree of freedom: the noise is larger than was given"
