"""A cheap windup alarm for a live estimator that keeps P = U D Uᵀ, O(n) beside an update.

For each column u_j of U (unit upper triangular), before the measurement,

    w_j = φ̄ u_j,   share_j = w_j² d_j       (both are by-products of Bierman's update)
    informed:  share_j >= share / window     m_j <- d_j       (after the update)
    silent:    otherwise                     m_j <- min(m_j, d_j)
    alarm:     silent and d_j > factor m_j, along u_j
"""

import numpy as np


def factor_ud(P):
    """P = U D Uᵀ from the Cholesky factor of the matrix read backwards."""
    flipped = np.linalg.cholesky(P[..., ::-1, ::-1])[..., ::-1, ::-1]
    root = np.diagonal(flipped, axis1=-2, axis2=-1)
    return flipped / root[..., None, :], root**2


def live_alarms(trajectory, window, factor=10.0, share=0.1):
    """Alarm (T,) of the cheap rule along a record of one row a sample."""
    U, d_prior = factor_ud(trajectory.prior)
    _, d_after = factor_ud(trajectory.after)
    held = factor_ud(trajectory.before[0])[1].copy()
    alarm = np.zeros(trajectory.samples, dtype=bool)
    for k in range(trajectory.samples):
        told = (trajectory.phibar[k] @ U[k]) ** 2
        informed = told.max(axis=0) * d_prior[k] >= share / window
        alarm[k] = (~informed & (d_after[k] > factor * held)).any()
        held = np.where(informed, d_after[k], np.minimum(held, d_after[k]))
    return alarm
