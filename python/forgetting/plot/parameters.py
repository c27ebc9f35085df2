"""A parameter over time with its band."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from forgetting.plot import thinning
from forgetting.plot.style import BLUE, axes_or_new, literal
from forgetting.plot.timeline import label_time, timeline
from forgetting.record.identification import Identification
from forgetting.words.rounding import with_unit

Array = NDArray[np.float64]

WIDTHS = 50_000
"""Rows, or up to twice as many, of which the typical width of a band is taken."""


def parameter(
    found: Identification,
    index: int,
    output: int = 0,
    ax: Axes | None = None,
    color: str = BLUE,
    label: str | None = None,
) -> Axes:
    """Draw one parameter and its ± 2 standard errors.

    The vertical range follows the estimate once it has settled, not the first samples, in which the
    band is as wide as the initial covariance.

    Parameters
    ----------
    found : Identification
        What `forgetting.record.identify` returned.
    index, output : int
        Which regressor, of which output.
    ax : Axes, optional
        Where to draw.
    color, label : str, optional
        For drawing several identifications into one picture.
    """
    ax = axes_or_new(ax)
    x, time_label = timeline(found)
    theta = found.theta[:, index, output]

    def spread(rows: slice) -> Array:
        return 2 * found.standard_error_of(index, output, rows)

    ax.fill_between(
        *thinning.band(x, lambda rows: around(theta[rows], spread(rows))),
        color=color,
        alpha=0.18,
        lw=0,
    )
    ax.plot(*thinning.line(x, theta), color=color, label=label)
    few = slice(len(theta) // 10, None, max(1, len(theta) // WIDTHS))
    low, high = settled_range(theta[len(theta) // 10 :], spread(few))
    if high > low:
        ax.set_ylim(low, high)
    prefix = f"{found.samples.outputs[output]}: " if len(found.samples.outputs) > 1 else ""
    name, of = found.samples.regressors[index], found.samples.outputs[output]
    ax.set_title(literal(prefix + with_unit(name, found.unit(of, name))))
    label_time(ax, x, time_label)
    return ax


def around(theta: Array, spread: Array) -> tuple[Array, Array]:
    """Lower and upper limit of a band."""
    return theta - spread, theta + spread


def settled_range(theta: Array, spread: Array) -> tuple[float, float]:
    """Vertical range that shows settled estimates and a good part of their band."""
    low, high = float(theta.min()), float(theta.max())
    known = spread[np.isfinite(spread)]
    width = float(np.median(known)) if len(known) else 0.0
    # A band that explodes (windup) must not flatten the estimate itself into a line.
    width = min(width, 2 * (high - low)) if high > low else width
    margin = 0.08 * (high - low) + 1.2 * width
    return low - margin, high + margin
