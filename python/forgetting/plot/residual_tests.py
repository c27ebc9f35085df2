"""Correlations of residuals with themselves and with the inputs, beside their bands."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from numpy.typing import NDArray

from forgetting._core import InvalidInput
from forgetting.plot.style import BLUE, INK, SKY, VERMILLION, axes_or_new, literal
from forgetting.polynomials import ResidualTests
from forgetting.polynomials.residual_tests import written


def residual_tests(found: ResidualTests, level: float = 0.99) -> Sequence[Axes]:
    """Draw all correlations below one another: with themselves, then with each input."""
    rows = 1 + len(found.inputs)
    size = (9, 2.2 * rows)
    axes = plt.subplots(rows, figsize=size, layout="constrained", squeeze=False)[1][:, 0]
    autocorrelation(found, level, axes[0])
    for i, ax in enumerate(axes[1:]):
        cross_correlation(found, i, level, ax)
    return list(axes)


def autocorrelation(found: ResidualTests, level: float = 0.99, ax: Axes | None = None) -> Axes:
    """Draw the correlations of the residuals, and the band in which those of white noise are.

    Parameters
    ----------
    found : ResidualTests
    level : float
        Share of the correlations of white noise inside the band, in (0, 1).
    ax : Axes, optional
        Where to draw.
    """
    ax = axes_or_new(ax)
    bars(ax, found.lags, found.autocorrelation, found.band(level))
    ax.set_xlabel("lag [samples]")
    words = f"Ljung–Box up to lag {found.lags[-1]}: {written(found.p_value[-1])}"
    ax.set_title(f"residuals of {literal(found.output)}; {words}")
    return ax


def cross_correlation(
    found: ResidualTests, input: int = 0, level: float = 0.99, ax: Axes | None = None
) -> Axes:
    """Draw the correlations of the residuals with an input, and the band of independent ones.

    Bars out of the band at lags > 0 are dynamics that the model lacks; at lags < 0 the input was
    chosen after the output.
    """
    ax = axes_or_new(ax)
    if not 0 <= input < len(found.inputs):
        raise InvalidInput(f"input = {input}, allowed: 0 to {len(found.inputs) - 1}")
    band = float(found.cross_band(level)[input])
    bars(ax, found.cross_lags, found.cross_correlation[input], band)
    ax.axvline(0, color=INK, lw=0.6)
    ax.set_xlabel("lag of the residual behind the input [samples]")
    words = f"up to 10 samples before: {written(found.input_p_value[input])}"
    ax.set_title(
        f"residuals of {literal(found.output)} with {literal(found.inputs[input])}; {words}"
    )
    return ax


def bars(ax: Axes, lags: NDArray[np.int64], values: NDArray[np.float64], band: float) -> None:
    """Bars from zero, those out of the band in another colour."""
    ax.axhspan(-band, band, color=SKY, alpha=0.3, lw=0)
    outside = np.abs(values) > band
    for chosen, color in ((~outside, BLUE), (outside, VERMILLION)):
        ax.vlines(lags[chosen], 0, values[chosen], color=color, lw=2)
    ax.axhline(0, color=INK, lw=0.8)
    ax.set_ylabel("correlation")
    ax.set_ylim(*np.array([-1, 1]) * max(1.15 * float(np.abs(values).max()), 1.5 * band))
