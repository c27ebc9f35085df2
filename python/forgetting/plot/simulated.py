"""What was measured beside what a model says of it."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike

from forgetting.frames.channels import channels
from forgetting.plot import thinning
from forgetting.plot.style import BLUE, FAINT, axes_or_new, legend_above, literal
from forgetting.polynomials import PolynomialModel
from forgetting.words.rounding import with_unit


def simulated(
    model: PolynomialModel,
    u: ArrayLike | None,
    y: ArrayLike,
    steps: int | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw the output and the free run of a model, or its prediction, and how well it fits.

    Parameters
    ----------
    model : PolynomialModel
    u, y, steps
        As those of `PolynomialModel.fit_percent`.
    ax : Axes, optional
        Where to draw.
    """
    ax = axes_or_new(ax)
    measured: Any = channels("y", y)[:, 0]
    made = np.asarray(model.predict(u, y, steps)).reshape(-1)
    time = model.sample_time * np.arange(len(measured))
    what = "free run" if steps is None else f"predicted {steps} ahead"
    ax.plot(*thinning.line(time, measured), color=FAINT, lw=2.4, alpha=0.55, label="measured")
    ax.plot(*thinning.line(time, made), color=BLUE, lw=1.1, label=what)
    ax.set_xlabel("time")
    ax.set_ylabel(literal(with_unit(model.output_name, model.output_unit or None)))
    ax.set_title(f"fit {model.fit_percent(u, y, steps):.1f} %")
    legend_above(ax, 2)
    return ax
