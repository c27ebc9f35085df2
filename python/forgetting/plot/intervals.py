"""One-step errors in their prediction intervals."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from forgetting.analysis import Confidence
from forgetting.plot.style import BLUE, SKY, VERMILLION, labelled


def confidence(found: Confidence, ax: Axes | None = None, row: int = 0, target: int = 0) -> Axes:
    """Draw the one-step errors in their prediction intervals; misses are marked."""
    ax = labelled(ax, "one-step error", "sample")
    error, half = found.error[:, row, target], found.half_width[:, row, target]
    x = np.arange(error.size)
    label = f"{found.level:.0%} interval"
    ax.fill_between(x, -half, half, color=SKY, alpha=0.4, lw=0, label=label)
    ax.plot(x, error, color=BLUE, lw=0.7, label="error")
    missed = found.counted[:, row, target] & (np.abs(error) > half)
    ax.plot(x[missed], error[missed], ".", color=VERMILLION, ms=4, label="outside")
    ax.set_title(f"{found.coverage:.1%} inside")
    ax.legend()
    return ax
