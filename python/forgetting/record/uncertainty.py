"""Noise variance, and the standard errors that P of a rule claims.

With s = phi P phi' (P after forgetting, before measuring; the leverage of the sample) a one-step
error has variance sigma² (1 + s), so e² / (1 + s) estimates the noise variance sigma² from one
sample. The running estimate is their plain mean,

    sigma²_k = mean of e_j² / (1 + s_j) over the used samples j <= k but the first n
    standard error of theta_i after sample k = sqrt(sigma²_k P_ii,k)

with n the number of regressors: the first n errors show the initial guess, not the noise. Skipped
samples (missing, or in the dead zone) do not enter, as they do not enter P. Where a model counts
its first samples less, as ARMAX does while its noise model is a guess, so does the mean.

Why the mean does not forget, although the rule does: in a quiet stretch (zero input, zero error) an
estimate with the rule's memory falls as lambda^k, exactly as fast as P of exponential forgetting
grows, and the standard error would hide the windup; with a directional rule it would shrink for
parameters about which the stretch says nothing. So the noise level is one number that the whole
record up to here supports, and P alone carries the memory.

What the number means: P of a forgetting rule is the covariance of parameters that drift as that
rule assumes (a random walk whose step covariance is what `forget` adds to P; Lai and Bernstein
2024), under white noise. If the parameters do not drift at all, it is an upper bound: with
exponential forgetting the true variance is then about half of it. How they drift on a record, and
whether its noise is white, is estimated in `forgetting.record.drift`, which the printed ± comes
from.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from forgetting.record.trace import USED, Trace

Array = NDArray[np.float64]


def noise_variance(trace: Trace) -> Array:
    """Running noise variance of each output, (T, m); NaN until n + 1 samples were used."""
    used = trace.skipped == USED
    counted = (used & (np.cumsum(used) > trace.theta.shape[1]))[:, None]
    # in place: as long as the record, and so never there twice
    mean = trace.error**2
    mean /= 1.0 + trace.leverage[:, None]
    trust = np.float64(1.0) if trace.trust is None else trace.trust[:, None]
    mean *= trust
    mean[~counted[:, 0]] = 0.0
    np.cumsum(mean, axis=0, out=mean)
    count = np.cumsum(np.where(counted, trust, 0.0), axis=0)
    with np.errstate(invalid="ignore"):
        mean /= count  # 0/0 before the first
    return mean


def standard_errors(variance: Array, noise_variance: Array) -> Array:
    """Standard errors of parameters by their variances in P, as it was after the same samples."""
    return np.asarray(np.sqrt(variance * noise_variance))
