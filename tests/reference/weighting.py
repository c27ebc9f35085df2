"""Robust weights w of a sample: Gamma_k becomes Gamma_k / w.

r is the length of the whitened innovation L^-1 (y - phi theta), Gamma = L L^T, before any weight;
with several targets, the longest of them (they share one factor, hence one weight).

huber      w = min(1, c / r), w(0) = 1                               c > 0, default 1.345
student_t  w = min(1, (nu + p) / (nu + r^2))                         nu > 0, default 4

A weight above 1 (an EM step has one for r^2 < p) would trust a sample more than its Gamma says.

One sample moves theta by K e with K = Pbar phi^T (Gamma/w + phi Pbar phi^T)^-1, so
|K e|_i <= w r |(Pbar phi^T L^-T)_i|, and w r <= c (huber), for student_t its largest value over
r >= sqrt p: (nu + p)/(2 sqrt nu) if nu >= p, else sqrt p.
"""

from __future__ import annotations

from .linalg import Matrix, Real, columns, dot


def length(innovation: Matrix) -> Real:
    """Largest Euclidean length over the targets."""
    return max(dot(c, c) for c in columns(innovation)).sqrt().mid()


class Huber:
    def __init__(self, threshold: float) -> None:
        self.threshold = Real(threshold)

    def weight(self, innovation: Matrix) -> Real:
        r = length(innovation)
        return (self.threshold / r).mid() if r > self.threshold else Real(1)


class StudentT:
    def __init__(self, degrees: float) -> None:
        self.degrees = Real(degrees)

    def weight(self, innovation: Matrix) -> Real:
        r = length(innovation)
        weight = (self.degrees + innovation.nrows()) / (self.degrees + r * r)
        return weight.mid() if weight < 1 else Real(1)


class Equal:
    """w = 1."""

    def weight(self, innovation: Matrix) -> Real:
        return Real(1)


WEIGHTINGS = {"equal": Equal, "huber": Huber, "student_t": StudentT}
CASES = {
    "equal": [{}],
    "huber": [{"threshold": 1.345}, {"threshold": 0.1}],
    "student_t": [{"degrees": 4.0}, {"degrees": 0.5}],
}
