"""Whether one-step errors follow from their own past: whiteness, by test and by size of effect.

Errors of a right model cannot be predicted. The size of the effect is the share of their variance
that a linear prediction from their own past explains (Yule-Walker, by Levinson's recursion); the
test is that of Ljung and Box (1978) at several lags, with the degrees of freedom that estimated
output lags take (Box and Pierce 1970).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from forgetting.extras import extra

from .finding import Finding

Array = NDArray[np.float64]

ORDER = 20
"""Past errors that a prediction may use, at most a tenth of the record."""
LAGS = (1, 2, 5, 10, 20)
"""Lags up to which the test sums, those below a quarter of the record."""
WRONG = 0.95
"""Share of the variance from which on the model is wrong: correlations of 0.975 a sample."""
NOTICED = 0.05
"""Share from which on standard errors are off by a quarter: correlations of 0.22 a sample."""
CHANCE = 1e-3
"""Probability below which chance is ruled out."""
FEWEST = 20
"""Errors without which nothing is said."""


@dataclass(frozen=True)
class OwnPast:
    """What the past of errors says of them.

    Attributes
    ----------
    share : float
        Part of their variance that their past explains, in [0, 1].
    correlation : float
        Correlation of neighbours.
    probability : float
        Of correlations at least this large by chance, by the test; NaN without SciPy.
    samples : int
        Errors judged.
    prediction : ndarray, shape (order,)
        Coefficients of the prediction, the latest error first.
    """

    share: float
    correlation: float
    probability: float
    samples: int
    prediction: Array


def own_past(errors: Array, output_lags: int = 0) -> OwnPast | None:
    """Measure how far errors follow from their own past; None if there are too few.

    Parameters
    ----------
    errors : ndarray, shape (T,)
        In order; NaN where there is none.
    output_lags : int
        Estimated coefficients of past outputs.

    Examples
    --------
    >>> import numpy as np
    >>> noise = np.random.default_rng(0).normal(size=5000)
    >>> found = own_past(np.convolve(noise, 0.9 ** np.arange(100), "valid"))
    >>> round(found.correlation, 1), round(found.share, 1)
    (0.9, 0.8)
    """
    there = np.isfinite(errors)
    count = int(there.sum())
    if count < FEWEST or not np.any(errors[there]):
        return None
    order = max(1, min(ORDER, count // 10))
    covariances, pairs = lagged(np.where(there, errors, 0.0), there, order)
    correlations = covariances / covariances[0]
    prediction, left = levinson(correlations)
    share = 1 - left * (count - 1) / max(count - order - 1, 1)
    return OwnPast(
        share=float(np.clip(share, 0.0, 1.0)),
        correlation=float(correlations[1]),
        probability=ljung_box(correlations, pairs, count, output_lags),
        samples=count,
        prediction=prediction,
    )


def lagged(errors: Array, there: NDArray[np.bool_], order: int) -> tuple[Array, Array]:
    """Mean products of errors 0 to `order` apart, and how many there are of each."""
    total, marks = len(errors), there.astype(np.float64)
    sums, pairs = np.zeros(order + 1), np.zeros(order + 1)
    for lag in range(min(order, total - 1) + 1):
        sums[lag] = errors[lag:] @ errors[: total - lag]
        pairs[lag] = marks[lag:] @ marks[: total - lag]
    # shrunk a little with the lag, as the sums over a finite record are: no prediction is unstable
    shrunk = 1 - np.arange(order + 1) / total
    return sums / np.maximum(pairs, 1.0) * shrunk, pairs


def levinson(correlations: Array) -> tuple[Array, float]:
    """Best linear prediction from the past, and the share of the variance that it leaves."""
    order = len(correlations) - 1
    prediction, left = np.zeros(order), 1.0
    for step in range(order):
        ahead = correlations[step + 1] - prediction[:step] @ correlations[step:0:-1]
        reflection = ahead / left
        if not abs(reflection) < 1:  # gaps can make the correlations those of no process
            break
        prediction[:step] -= reflection * prediction[:step][::-1]
        prediction[step] = reflection
        left *= 1 - reflection**2
    return prediction, left


def ljung_box(correlations: Array, pairs: Array, count: int, output_lags: int) -> float:
    """Probability of such correlations by chance: the smallest of the lags, times their number."""
    tail = extra("scipy.special", "a test of residuals").chdtrc
    statistics = ljung_box_statistics(correlations, pairs, count)
    found = []
    for lag in LAGS:
        if lag <= output_lags or lag >= min(len(correlations), max(count // 4, 2)):
            continue
        found.append(tail(lag - output_lags, statistics[lag - 1]))
    return float(min(1.0, min(found) * len(found))) if found else 1.0


def ljung_box_statistics(correlations: Array, pairs: Array, count: int) -> Array:
    """Q up to lag 1, 2, ..., from the correlations of lag 0, 1, ... and how many made them."""
    terms = np.square(correlations[1:]) * (count + 2.0) / np.maximum(pairs[1:], 1.0) * count
    return np.asarray(np.cumsum(terms))


def whiteness(found: OwnPast | None, of: str, output_lags: int = 0) -> Finding | None:
    """Judge errors by what their past says of them; `of` names the output."""
    if found is None:
        return None
    share, certain = found.share, not found.probability > CHANCE
    figure = (
        f"{share:.0%} of the variance of the one-step errors of {of} follows from their own past "
        f"(correlation of neighbours {found.correlation:.2f}, {found.samples} errors)"
    )
    more = "Raise na and nb" if output_lags else "Add past outputs or inputs to the model"
    if share >= WRONG and certain:
        return Finding(
            "residuals",
            "wrong",
            f"The model is wrong: {figure}.",
            f"{more}; it lacks the dynamics of {of}.",
        )
    if share >= NOTICED and certain:
        return Finding(
            "residuals",
            "warning",
            f"The errors are correlated: {figure}.",
            f"{more}, or take the noise for correlated.",
        )
    return Finding("residuals", "good", f"The one-step errors of {of} are white: {figure}.")
