"""Standard errors of fits, and noise and correlation of measured values."""

import numpy as np

#: A singular value below this share of the largest value leaves a combination of parameters undetermined.
SINGULAR = 1e-11
#: Number of standard errors above which a trend or a correlation is significant.
SIGNIFICANT = 4.0


def covariances(jacobian, variance):
    """Return covariances of scaled parameters (R, P, P): variance ∞, covariance 0 for undetermined ones."""
    _, s, vt = np.linalg.svd(jacobian, full_matrices=False)
    largest = np.maximum(s[:, :1], 1e-150)
    singular = s <= SINGULAR * largest
    root = vt / np.maximum(s, 1e-14 * largest)[..., None]
    root = np.where(singular[..., None], 0.0, root)
    covariance = np.einsum("rkp,rkq->rpq", root, root) * np.reshape(variance, (-1, 1, 1))
    # Scaled parameters are about 1.
    wide = np.einsum("rpp->rp", covariance) > 30.0**2
    undetermined = wide | np.any(singular[..., None] & (np.abs(vt) > 1e-3), axis=1)
    covariance[undetermined[:, :, None] | undetermined[:, None, :]] = 0.0
    np.einsum("rpp->rp", covariance)[undetermined] = np.inf
    return covariance


def roughness(values):
    """Return the standard deviation (R, 1) of the noise of smooth rows; 0 for few samples.

    The third differences of a row give its noise.
    """
    if values.shape[1] < 8:
        return np.zeros((len(values), 1))
    # The median of absolute normal deviations is 0.6745, the variance of third differences 20.
    differences = np.median(np.abs(np.diff(values, 3, axis=1)), axis=1, keepdims=True)
    return differences / (0.6745 * np.sqrt(20.0))


def autocorrelation(residual):
    """Return the correlation of residuals with their neighbours along the last axis, 0 for noise."""
    power = np.sum(residual**2, axis=-1)
    return np.sum(residual[..., 1:] * residual[..., :-1], axis=-1) / np.maximum(power, 1e-300)


def autocorrelations(residual):
    """Return the correlation of residuals (N,) with the residuals 0 to N − 1 samples later."""
    count = residual.size
    products = np.fft.irfft(np.abs(np.fft.rfft(residual, 2 * count)) ** 2, 2 * count)[:count]
    return products / max(products[0], 1e-300)


def block_length(residual):
    """Return the number of samples over which residuals (N,) are correlated, 1 for noise.

    It is the first lag at which the autocorrelation is not positive, at most a fifth of the samples.
    """
    correlation = autocorrelations(residual)
    if not np.any(correlation[1:2] > SIGNIFICANT / np.sqrt(residual.size)):
        return 1
    return min(int(np.argmax(correlation <= 0)) or residual.size, max(residual.size // 5, 1))


def block_factors(residual, jacobian, length):
    """Return standard errors with correlated over those with independent residuals, at least 1 (P,).

    The variance of a parameter is the sum of (1 − k/length) ψ_i ψ_j r_i r_j over all pairs of samples at a
    distance k = |i − j| < `length`, with the influence ψ of a residual r on the parameter (Newey & West,
    Econometrica 55, 1987, 703). This is the mean square of sums over overlapping blocks. It is too small if
    few blocks determine a parameter. A second estimate has the mean of r_i r_j over all pairs instead and
    is not too small. The larger estimate counts.
    """
    u, s, vt = np.linalg.svd(jacobian, full_matrices=False)
    influence = (u * np.where(s > SINGULAR * s[0], 1 / np.maximum(s, 1e-300), 0.0)) @ vt
    single = np.maximum(np.sum(influence**2, axis=0), 1e-300)
    sums = np.cumsum(np.pad(influence * residual[:, None], ((length, length), (0, 0))), axis=0)
    blocks = np.sum((sums[length:] - sums[:-length]) ** 2, axis=0) / length / np.mean(residual**2)
    products = np.fft.irfft(np.abs(np.fft.rfft(influence, 2 * len(u), axis=0)) ** 2, 2 * len(u), axis=0)
    weights = (2 - 2 * np.arange(length) / length) * autocorrelations(residual)[:length]
    weights[0] = 1.0
    return np.sqrt(np.maximum(1.0, np.maximum(blocks, weights @ products[:length]) / single))
