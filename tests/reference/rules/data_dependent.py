"""Data-dependent updating (Dasgupta & Huang 1987). GF-RLS V-D, (45)-(46).

Noise with e^T e <= gamma^2 (whitened; ``noise_bound`` = gamma). The truth lies in the ellipsoid
{t : |t - theta_k|^2_R <= sigma_k^2}, sigma_0 = ``initial_radius``. With (w_i, c_i) the eigenvalues
of S = phi P phi^T and the errors in its eigenvectors (c_i^2: mean over the targets),

    sigma_{k+1}^2 = (1 - mu) sigma^2 + mu gamma^2
                    - mu (1 - mu) sum_i c_i^2 / (1 - mu + mu w_i)

is convex in mu. mu_k minimises it over [0, a], a = ``largest_weight``:
mu = 0 (the sample is skipped) if sigma^2 + |e|^2 <= gamma^2, else the root of

    gamma^2 - sigma^2 - sum_i c_i^2 ((1 - mu)^2 - w_i mu^2) / (1 - mu + mu w_i)^2 = 0,

or a where the left side is still <= 0 at a. For p = 1, with e != 0: b = (gamma^2 - sigma^2)/e^2,
c = 1 + b (S - 1); mu = a if c <= 0, else min(a, (1 - b)/2 if S = 1 else (1 - sqrt(S/c))/(1 - S)).

    F = mu R with Gamma = I / mu  (the printed (50), lambda_k = (1-mu_k) mu_{k-1} / mu_k with
    Gamma = I, is undefined at mu = 0 and improper when mu falls fast)
    published: P_{k+1}^-1 = (1 - mu) P_k^-1 + mu phi^T phi (45), theta + mu P_{k+1} phi^T e (46)
"""

from __future__ import annotations

from collections.abc import Callable

from ..eigen import eigen_symmetric
from ..gf_rls import Measurement
from ..linalg import Matrix, Real, diagonal, identity, inverse, symmetric, trace, transpose
from ..step import Rule, Step
from .form import PublishedForm

RATED = False
BISECTIONS = 250
STILL = Real(2) ** -240
"""Of the largest weight: a step that is shorter is of rounding alone."""


class Dense(Rule):
    def __init__(
        self, n: int, noise_bound: float, largest_weight: float, initial_radius: float
    ) -> None:
        self.bound, self.limit = Real(noise_bound) ** 2, Real(largest_weight)
        self.radius = Real(initial_radius) ** 2
        self.weight = Real(0)
        self.after_radius = self.radius

    def skips(self, step: Step) -> bool:
        spread, vectors = eigen_symmetric(step.spread)
        turned = transpose(vectors) * step.error
        squares = [sum(x * x for x in row) / step.targets for row in turned.tolist()]
        slope = _slope(self.bound - self.radius, spread, squares)
        self.weight = _root(slope, self.limit)
        mu = self.weight
        gained = sum(c / (1 - mu + mu * w) for w, c in zip(spread, squares, strict=True))
        self.after_radius = (
            (1 - mu) * self.radius + mu * self.bound - mu * (1 - mu) * gained
        ).mid()
        return self.weight == 0

    def measurement(self, step: Step, y: Matrix) -> Measurement:
        return Measurement(step.phi, y, diagonal([1 / self.weight] * step.rows).mid())

    def forgetting(self, step: Step) -> Matrix:
        return (self.weight * step.information).mid()

    def after(self, step: Step, covariance: Matrix) -> None:
        self.radius = self.after_radius


def _slope(margin: Real, spread: list[Real], squares: list[Real]) -> Callable[[Real], Real]:
    """d sigma_{k+1}^2 / d mu, with margin = gamma^2 - sigma^2."""

    def slope(mu: Real) -> Real:
        pull = Real(0)
        for w, c in zip(spread, squares, strict=True):
            pull += c * ((1 - mu) ** 2 - w * mu**2) / (1 - mu + mu * w) ** 2
        return (margin - pull).mid()

    return slope


def _root(slope: Callable[[Real], Real], limit: Real) -> Real:
    """Zero of the non-decreasing slope on [0, limit], or the end that it points to."""
    if slope(Real(0)) >= 0:
        return Real(0)
    if slope(limit) <= 0:
        return limit
    low, high = Real(0), limit
    for _ in range(BISECTIONS):
        middle = ((low + high) / 2).mid()
        low, high = (low, middle) if slope(middle) > 0 else (middle, high)
    return low


class Published(PublishedForm):
    def __init__(
        self,
        theta: Matrix,
        covariance: Matrix,
        noise_bound: float,
        largest_weight: float,
        initial_radius: float,
    ) -> None:
        super().__init__(theta, covariance)
        self.bound, self.limit = Real(noise_bound) ** 2, Real(largest_weight)
        self.radius = Real(initial_radius) ** 2

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        error = (y - phi * self.theta).mid()
        spread = (phi * self.covariance * transpose(phi)).mid()
        square = trace(transpose(error) * error) / error.ncols()
        if self.radius + square <= self.bound:
            return
        mu = self._weight(spread, error, square)
        inner = inverse((1 - mu) * identity(phi.nrows()) + mu * spread)
        gained = trace(transpose(error) * inner * error) / error.ncols()
        self.radius = ((1 - mu) * self.radius + mu * self.bound - mu * (1 - mu) * gained).mid()
        before = inverse(self.covariance)
        self.covariance = symmetric(inverse((1 - mu) * before + mu * transpose(phi) * phi))
        self.theta = (self.theta + mu * self.covariance * transpose(phi) * error).mid()

    def _weight(self, spread: Matrix, error: Matrix, square: Real) -> Real:
        if spread.nrows() > 1:
            return _matrix_root(self.bound - self.radius, spread, error, self.limit)
        if square == 0:
            return self.limit
        s, b = spread[0, 0], (self.bound - self.radius) / square
        c = (1 + b * (s - 1)).mid()
        if c <= 0:
            return self.limit
        free = (1 - b) / 2 if s == 1 else (1 - (s / c).sqrt()) / (1 - s)
        return free.mid() if free < self.limit else self.limit


def _matrix_root(margin: Real, spread: Matrix, error: Matrix, limit: Real) -> Real:
    """The same root for p > 1 without eigenvectors, by the Illinois method."""
    one = identity(spread.nrows())

    def slope(mu: Real) -> Real:
        inner = inverse((1 - mu) * one + mu * spread) * error
        pull = transpose(inner) * ((1 - mu) ** 2 * one - mu**2 * spread) * inner
        return (margin - trace(pull) / error.ncols()).mid()

    low, high = Real(0), limit
    at_low, at_high = slope(low), slope(high)
    if at_high <= 0:
        return limit
    mu, moved = low, 0
    for _ in range(BISECTIONS):
        before, mu = mu, ((low * at_high - high * at_low) / (at_high - at_low)).mid()
        value = slope(mu)
        if value == 0 or abs(mu - before) < STILL * limit:
            break
        # an end that stays twice counts half, so that it is left at last
        if value > 0:
            high, at_high, at_low = mu, value, at_low / 2 if moved > 0 else at_low
        else:
            low, at_low, at_high = mu, value, at_high / 2 if moved < 0 else at_high
        moved = 1 if value > 0 else -1
    return mu


def cases(n: int) -> list[dict[str, object]]:
    """A bound that most samples meet, and one that cuts the noise and reaches the limit."""
    return [
        {"noise_bound": 0.5, "largest_weight": 0.5, "initial_radius": 1.0},
        {"noise_bound": 0.05, "largest_weight": 0.1, "initial_radius": 0.2},
    ]
