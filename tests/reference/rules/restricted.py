"""Restricted exponential forgetting (Kulhavy & Karny 1984; Kulhavy 1987; Bittanti, Bolzern & Campi
1990). GF-RLS V-I, (67)-(73). Measures first, then forgets.

One row, s = phi P phi^T, mu = lambda_k:
    theta_{k+1} = theta + P phi^T e / (1 + s)                                           (68)
    P_{k+1}^-1 = P_k^-1 + b phi^T phi,  b = mu - (1 - mu)/s  (s > 0),  b = 1  (s = 0)    (67), (69)
equal to P_{k+1} = P+ + ((1 - mu)/(mu s+)) P+ phi^T phi P+ with s+ = s/(1 + s): an inflation along
the gain only, so P_{k+1} > 0 although b may be negative.

Several rows (derived): P_{k+1} = P+ + ((1 - mu)/mu) P+ V (V^T P+ V)^-1 V^T P+, with V the
orthonormal basis of the numerical row space of phi (as in ``oblique_projection``); V = phi^T/|phi|
gives the one-row form. phi = 0: nothing is forgotten.

Embedded (E1) with X_{k+1} = (P+_k)^-1 and
    G_{k+1} = (1 - mu_k) V (V^T P+_k V)^-1 V^T  =  (1 - mu_k)(1 + 1/s_k) phi_k^T phi_k  (one row),
(73) conditioned on s_k of the same sample (its printed index is one too high). Always proper.
"""

from __future__ import annotations

from ..linalg import Matrix, Real, identity, inverse, symmetric, transpose
from ..step import MeasureThenForget, Step
from .form import PublishedForm, gain, measured
from .oblique_projection import pseudo_inverse, row_space

RATED = True


class Dense(MeasureThenForget):
    def __init__(self, n: int) -> None:
        super().__init__(n)

    def after(self, step: Step, covariance: Matrix) -> None:
        if step.rows == 1:
            s = step.spread[0, 0]
            weight = (1 - step.factor) * (1 + 1 / s) if s > 0 else Real(0)
            self.pending = (weight * (transpose(step.phi) * step.phi)).mid()
            return
        v, _ = row_space(step.phi)
        if v.ncols() == 0:
            self.pending = Matrix(step.parameters, step.parameters)
            return
        gram = inverse((transpose(v) * covariance * v).mid())
        self.pending = ((1 - step.factor) * (v * gram * transpose(v))).mid()


class Published(PublishedForm):
    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        p = self.covariance
        self.theta = (self.theta + gain(p, phi) * (y - phi * self.theta)).mid()
        spread = (phi * p * transpose(phi)).mid()
        if phi.nrows() == 1:
            s = spread[0, 0]
            b = factor - (1 - factor) / s if s > 0 else Real(1)
            self.covariance = symmetric(inverse(inverse(p) + b * transpose(phi) * phi))
            return
        after = measured(p, phi)
        if max(spread[i, i] for i in range(phi.nrows())) > 0:
            # phi P+ phi^T = S - S (I + S)^-1 S
            width = spread - spread * inverse(identity(phi.nrows()) + spread) * spread
            reach = (after * transpose(phi)).mid()
            lost = reach * pseudo_inverse(symmetric(width)) * transpose(reach)
            after = symmetric(after + (1 - factor) / factor * lost)
        self.covariance = after


def cases(n: int) -> list[dict[str, object]]:
    return [{}]
