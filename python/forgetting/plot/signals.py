"""Output, prediction and one-step error."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from forgetting.plot import thinning
from forgetting.plot.style import BLUE, FAINT, INK, VERMILLION, axes_or_new, legend_above, literal
from forgetting.plot.timeline import label_time, timeline
from forgetting.record.identification import Identification
from forgetting.record.scores import started
from forgetting.words.rounding import with_unit

Array = NDArray[np.float64]


def prediction(found: Identification, output: int = 0, ax: Axes | None = None) -> Axes:
    """Draw one output and its one-step prediction.

    Parameters
    ----------
    found : Identification
        What `forgetting.record.identify` returned.
    output : int
        Which output, when there are several.
    ax : Axes, optional
        Where to draw.
    """
    ax = axes_or_new(ax)
    x, label = timeline(found)
    name = found.samples.outputs[output]
    ax.plot(
        *thinning.line(x, found.samples.as_measured[:, output]),
        color=FAINT,
        lw=2.4,
        alpha=0.55,
        label="measured",
        solid_capstyle="round",
    )
    ax.plot(
        *thinning.line(x, found.prediction[:, output]),
        color=BLUE,
        lw=1.1,
        label="predicted one step ahead",
    )
    typical = percentiles(settled(found, found.prediction, output), (1, 99))
    limit_to(ax, np.concatenate([found.samples.as_measured[:, output], typical]))
    ax.set_ylabel(literal(with_unit(name, found.unit(name))))
    label_time(ax, x, label)
    legend_above(ax, 2)
    return ax


def error(found: Identification, output: int = 0, ax: Axes | None = None) -> Axes:
    """Draw the one-step error of an output, measured minus predicted, and its RMS."""
    ax = axes_or_new(ax)
    x, label = timeline(found)
    rms = found.scores.model[output]
    ax.axhline(0, color=INK, lw=0.8)
    ax.axhspan(-rms, rms, color=VERMILLION, alpha=0.12, lw=0, label=f"± RMSE, {rms:.4g}")
    ax.plot(*thinning.line(x, found.trace.error[:, output]), color=VERMILLION, lw=0.9)
    typical = 1.15 * percentiles(np.abs(settled(found, found.trace.error, output)), (99.9,))
    limit_to(ax, np.concatenate([typical, -typical]))
    name = found.samples.outputs[output]
    ax.set_ylabel(literal(with_unit(f"error of {name}", found.unit(name))))
    label_time(ax, x, label)
    legend_above(ax, 1)
    return ax


def settled(found: Identification, values: Array, output: int) -> Array:
    """Leave out the start, when the estimate is only its initial guess."""
    return np.asarray(values[started(found.samples), output])


def percentiles(values: Array, shares: tuple[float, ...]) -> Array:
    """Percentiles of the known values; none without values."""
    known = values[np.isfinite(values)]
    return np.percentile(known, shares) if len(known) else known


def limit_to(ax: Axes, values: Array) -> None:
    """Fit the vertical range to some of the values; the others run out of the picture."""
    known = values[np.isfinite(values)]
    if len(known) and known.max() > known.min():
        margin = 0.06 * (known.max() - known.min())
        ax.set_ylim(known.min() - margin, known.max() + margin)
