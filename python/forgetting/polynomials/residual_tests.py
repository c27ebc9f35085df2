"""Whether the errors of a model are white and independent of its inputs, lag by lag.

Errors that can be predicted from earlier errors want another model of the noise (more of A, C or
D). Errors that can be predicted from earlier inputs want another model of the system (more of B or
F, or another delay). Errors that agree with *later* inputs are feedback: the inputs were chosen
after the outputs, and output error and Box-Jenkins models are then biased.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from forgetting._core import InvalidInput
from forgetting.extras import extra
from forgetting.judgement import Judgement
from forgetting.judgement.finding import judgement
from forgetting.judgement.inputs import explained, inputs, whitened
from forgetting.judgement.residuals import lagged, ljung_box_statistics, own_past, whiteness
from forgetting.polynomials.estimate import Array, quantile

LAGS = 25
"""Lags that are looked at, at most a quarter of the errors."""

SMALLEST = 1e-12
"""Probability below which only that is said."""


@dataclass(frozen=True, eq=False)
class ResidualTests:
    """Correlations of one-step errors with themselves and with the inputs.

    Attributes
    ----------
    lags : ndarray of int, shape (M,)
        1, 2, ..., M.
    autocorrelation : ndarray, shape (M,)
        Of the errors, at these lags.
    ljung_box, p_value : ndarray, shape (M,)
        The statistic of Ljung and Box up to each lag, and the probability of one at least as large
        for white errors; NaN up to the number of parameters that were fitted.
    cross_lags : ndarray of int, shape (2M + 1,)
        -M ... M.
    cross_correlation : ndarray, shape (inputs, 2M + 1)
        Of the error at k + lag with the input at k. A positive lag: the error follows the input.
    cross_error : ndarray, shape (inputs,)
        Standard deviation of these where error and input are independent, whatever their spectra.
    input_p_value : ndarray, shape (inputs,)
        The probability of errors that follow the input of 1 to 10 samples before as much as these,
        were they independent. It is on the safe side where the model was fitted to the same data.
    samples : int
        Errors that are known.
    judgement : Judgement
        Both in words, by the size of the effect.
    """

    lags: NDArray[np.int64]
    autocorrelation: Array
    ljung_box: Array
    p_value: Array
    cross_lags: NDArray[np.int64]
    cross_correlation: Array
    cross_error: Array
    input_p_value: Array
    samples: int
    judgement: Judgement
    inputs: tuple[str, ...] = ()
    output: str = "y"

    def band(self, level: float = 0.95) -> float:
        """Half of the band that holds each autocorrelation of white errors; `level` in (0, 1)."""
        return float(quantile(level) / np.sqrt(self.samples))

    def cross_band(self, level: float = 0.95) -> Array:
        """The same of the cross-correlations, by input, (inputs,)."""
        return np.asarray(quantile(level) * self.cross_error)

    def __str__(self) -> str:
        """The judgement in sentences, and the probabilities."""
        last = f"white up to lag {self.lags[-1]}: {written(self.p_value[-1])}"
        shares = zip(self.inputs, self.input_p_value, strict=True)
        of_inputs = [f"independent of {name}: {written(p)}" for name, p in shares]
        return "\n".join([*self.judgement.sentences(), last, *of_inputs])


def written(probability: float) -> str:
    """A probability as one reads it; the smallest are not told apart."""
    return f"p = {probability:.2g}" if probability >= SMALLEST else f"p < {SMALLEST:g}"


def residual_tests(
    errors: Array, signals: Array, names: Sequence[str], output: str, lags: int | None, fitted: int
) -> ResidualTests:
    """Test errors (T,) against themselves and signals (T, inputs); NaN where missing.

    `fitted` is the number of parameters of A, C and D that were estimated from the same data.
    """
    known = np.isfinite(errors)
    count = int(known.sum())
    lags = number_of_lags(lags, count)
    filled = np.where(known, errors, 0.0)
    covariances, pairs = lagged(filled, known, lags)
    own = covariances / (covariances[0] or 1.0)
    statistics = ljung_box_statistics(own, pairs, count)
    p_value = np.full(lags, np.nan)
    freedom = np.arange(1, lags + 1) - fitted
    tail = extra("scipy.special", "a test of residuals").chdtrc
    p_value[freedom > 0] = tail(freedom[freedom > 0], statistics[freedom > 0])
    of = [across(filled, known, signal, lags, own) for signal in signals.T]
    past = own_past(errors, fitted)
    white = errors if past is None else whitened(errors, past.prediction)
    movements = list(zip(names, signals.T, strict=True))
    return ResidualTests(
        lags=np.arange(1, lags + 1),
        autocorrelation=own[1:],
        ljung_box=statistics,
        p_value=p_value,
        cross_lags=np.arange(-lags, lags + 1),
        cross_correlation=np.array([r for r, _ in of]).reshape(-1, 2 * lags + 1),
        cross_error=np.array([error for _, error in of]),
        input_p_value=np.array([explained(white, signal)[1] for signal in signals.T]),
        samples=count,
        judgement=judgement([whiteness(past, output, fitted), inputs(white, movements, output)]),
        inputs=tuple(names),
        output=output,
    )


def number_of_lags(given: int | None, count: int) -> int:
    """The number of lags asked for, checked, or `LAGS`."""
    most = count // 4
    if most < 1:
        raise InvalidInput(f"{count} errors are known, allowed: at least 4 for a test of residuals")
    lags = min(LAGS, most) if given is None else given
    if not 1 <= lags <= most or lags != int(lags):
        raise InvalidInput(
            f"lags = {given!r}, allowed: a whole number in [1, {most}], a quarter of the errors"
        )
    return int(lags)


def across(
    errors: Array, known: NDArray[np.bool_], signal: Array, lags: int, own: Array
) -> tuple[Array, float]:
    """Cross-correlations (2 lags + 1,) of errors with a signal, and their standard deviation.

    For independent processes it is √(Σ ρ_e(k) ρ_u(k) / T). The terms are weighed by
    1 - |k|/(lags + 1), so that the sum cannot be negative.
    """
    moved = signal - signal.mean()
    size = np.sqrt((errors @ errors) * (moved[known] @ moved[known]))
    if not size > 0:
        return np.zeros(2 * lags + 1), 0.0
    total = len(errors)
    later = [errors[lag:] @ moved[: total - lag] for lag in range(lags + 1)]
    sooner = [errors[: total - lag] @ moved[lag:] for lag in range(lags, 0, -1)]
    of_signal, _ = lagged(moved, np.ones(total, bool), lags)
    weights = 1 - np.arange(lags + 1) / (lags + 1)
    terms = weights * own * of_signal / of_signal[0]
    spread = np.sqrt(max(2 * terms.sum() - terms[0], 0.0) / known.sum())
    return np.array([*sooner, *later]) / size, float(spread)
