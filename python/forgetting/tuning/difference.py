"""Whether one of two forecasts is better by more than chance.

F. X. Diebold, R. S. Mariano, *Comparing predictive accuracy*, Journal of Business & Economic
Statistics 13(3), 1995, with the correction for small samples of D. Harvey, S. Leybourne,
P. Newbold, *Testing the equality of prediction mean squared errors*, International Journal of
Forecasting 13(2), 1997, and the quantiles of Student's t that they advise.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting._core import InvalidInput
from forgetting.extras import extra

Array = NDArray[np.float64]

LEVEL = 0.05
"""Probability of calling chance a difference."""
FEWEST = 8
"""Samples below which no variance over several lags can be estimated."""


@dataclass(frozen=True)
class Difference:
    """Two sequences of losses compared.

    Attributes
    ----------
    ratio : float
        Root mean loss of the first over that of the second.
    statistic : float
        Negative where the first has the smaller loss; Student's t with `samples` − 1 degrees of
        freedom where both are equally good.
    p_value : float
        Probability of a statistic as large or larger, of either sign, by chance.
    lags : int
        Over how many lags the differences were taken as correlated.
    samples : int
        Number of losses of each.
    """

    ratio: float
    statistic: float
    p_value: float
    lags: int
    samples: int

    @property
    def beyond_chance(self) -> bool:
        """Whether the difference is more than chance, at the level of 5 %."""
        return self.p_value < LEVEL

    def words(self, other: str) -> str:
        """The difference to `other` as a sentence."""
        if self.beyond_chance:
            size = f"{self.size()} than that of {other}"
            return f"The error is {size}, more than chance ({self.test()})."
        return (
            f"No difference to {other} beyond chance: the error is {self.size()} ({self.test()})."
        )

    def size(self) -> str:
        """How much smaller or larger the error is."""
        if self.ratio == 1:
            return "the same"
        word = "smaller" if self.ratio < 1 else "larger"
        times = max(self.ratio, 1 / self.ratio) if self.ratio > 0 else math.inf
        if times >= 2:
            return f"{times:.{1 if times < 10 else 0}f} times {word}"
        return f"{100 * abs(self.ratio - 1):.2g} % {word}"

    def test(self) -> str:
        """How the difference was tested."""
        return f"Diebold-Mariano p = {self.p_value:.2g}, {self.lags} lags"


def difference(loss: ArrayLike, other: ArrayLike, lags: int | None = None) -> Difference:
    """Compare two sequences of losses of one-step forecasts of the same samples.

    Parameters
    ----------
    loss, other : array_like, shape (T,)
        Losses, such as squared errors, in order of time, T ≥ 8.
    lags : int, optional
        Over how many lags the differences are taken as correlated, 0 to T/4; chosen from them if
        not given.

    Raises
    ------
    InvalidInput
        When the shapes differ, a loss is not finite, there are fewer than 8, or for such `lags`.
    ImportError
        Without SciPy.

    Notes
    -----
    The differences d_k of the losses have the variance of their mean V = (γ₀ + 2 Σ w_j γ_j)/T over
    L = `lags` with the weights w_j = 1 − j/(L + 1) of Bartlett's window. If not given, L is the
    larger of the cube root of T and the length that D. W. K. Andrews (*Econometrica* 59, 1991,
    (6.2) and (6.4)) found best for a d_k that is autoregressive of first order; at most T/4. The
    correction takes h = L + 1.

    Examples
    --------
    >>> random = np.random.default_rng(0)
    >>> noise = random.normal(size=(2, 500))
    >>> found = difference(noise[0] ** 2, 1.5 * noise[1] ** 2)
    >>> found.beyond_chance, found.lags
    (True, 8)
    >>> print(found.words("the other"))
    The error is 12 % smaller than that of the other, more than chance (Diebold-Mariano p = 0.0028,
    8 lags).
    """
    first, second = _checked(loss, other)
    change = first - second
    total = len(change)
    lags = window(change) if lags is None else lags
    if not 0 <= lags <= total // 4:
        raise InvalidInput(f"lags = {lags}, allowed: 0 to {total // 4}, a quarter of the samples")
    variance = long_run_variance(change, lags) / total
    h = lags + 1
    correction = math.sqrt((total + 1 - 2 * h + h * (h - 1) / total) / total)
    mean = float(change.mean())
    if variance > 0:
        statistic = correction * mean / math.sqrt(variance)
    else:
        statistic = math.copysign(math.inf, mean) if mean else 0.0
    tail = extra("scipy.special", "the test of a difference").stdtr(total - 1, -abs(statistic))
    ratio = math.sqrt(first.mean() / second.mean()) if second.any() else math.inf
    return Difference(
        ratio if first.any() or second.any() else 1.0, statistic, 2 * float(tail), lags, total
    )


def window(change: Array) -> int:
    """How many lags to take: Andrews' length for Bartlett's window, at least the cube root of T."""
    total = len(change)
    centred = change - change.mean()
    power = float(centred[:-1] @ centred[:-1])
    slope = float(centred[1:] @ centred[:-1]) / power if power > 0 else 0.0
    slope = min(max(slope, -0.97), 0.97)
    alpha = 4 * slope**2 / ((1 - slope) ** 2 * (1 + slope) ** 2)
    best = math.ceil(1.1447 * (alpha * total) ** (1 / 3))
    least = math.ceil(round(total ** (1 / 3), 9))  # 8 of 512, which rounding makes 8.000...1
    return int(min(max(best, least), total // 4))


def long_run_variance(change: Array, lags: int) -> float:
    """The variance of the mean, times T, of a correlated sequence; Bartlett's window."""
    centred = change - change.mean()
    total = len(centred)
    covariances = [float(centred[j:] @ centred[: total - j]) / total for j in range(lags + 1)]
    weighted = sum((1 - j / (lags + 1)) * covariances[j] for j in range(1, lags + 1))
    return covariances[0] + 2 * weighted


def _checked(loss: ArrayLike, other: ArrayLike) -> tuple[Array, Array]:
    first, second = np.asarray(loss, dtype=np.float64), np.asarray(other, dtype=np.float64)
    if first.ndim != 1 or first.shape != second.shape or len(first) < FEWEST:
        raise InvalidInput(
            f"loss has shape {first.shape} and other {second.shape}; "
            f"both must be (T,), T >= {FEWEST}"
        )
    if not (np.isfinite(first).all() and np.isfinite(second).all()):
        raise InvalidInput("loss or other is not finite; every loss must be a finite number")
    return first, second
