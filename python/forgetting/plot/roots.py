"""Poles and zeros in the z plane, in their confidence ellipses."""

from __future__ import annotations

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import Circle, Ellipse
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from forgetting.plot.style import BLUE, FAINT, VERMILLION, legend_above
from forgetting.polynomials import PolynomialModel, Roots
from forgetting.polynomials.estimate import quantile

LINE = 6.0
"""Width of the line that is the interval of a real root, in points."""


def poles_and_zeros(
    model: PolynomialModel,
    input: int | str = 0,
    level: float = 0.95,
    ax: Axes | None = None,
) -> Axes:
    """Draw the poles (crosses) and zeros (rings) from one input beside the unit circle.

    Parameters
    ----------
    model : PolynomialModel
    input : int or str
        Number or name of an input, or "noise".
    level : float
        Probability that each ellipse holds its root, in (0, 1).
    ax : Axes, optional
        Where to draw.
    """
    if ax is None:
        ax = plt.subplots(figsize=(4.5, 4.5), layout="constrained")[1]
    ax.add_patch(Circle((0, 0), 1, fill=False, color=FAINT, lw=1))
    ax.axhline(0, color=FAINT, lw=0.6)
    ax.axvline(0, color=FAINT, lw=0.6)
    for found, marker, color, label in (
        (model.poles(input), "x", BLUE, "poles"),
        (model.zeros(input), "o", VERMILLION, "zeros"),
    ):
        z = found.value
        ax.plot(z.real, z.imag, marker, color=color, mfc="none", ms=7, mew=1.6, label=label)
        for ellipse in ellipses(found, level, color):
            ax.add_patch(ellipse)
    ax.set_aspect("equal", adjustable="datalim")
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(MaxNLocator(5))
    ax.set_xlabel("real")
    ax.set_ylabel("imaginary")
    legend_above(ax, 2)
    return ax


def ellipses(found: Roots, level: float, color: str) -> list[Ellipse]:
    """The confidence ellipses of roots; none where the covariance is not known or infinite."""
    made = []
    for z, covariance in zip(found.value, found.covariance, strict=True):
        if np.isfinite(covariance).all():
            made.append(ellipse(z, covariance, level, color, plane=abs(z.imag) > 0))
    return made


def ellipse(
    z: complex, covariance: NDArray[np.float64], level: float, color: str, plane: bool
) -> Ellipse:
    """That of one root; of a real root a line, as it stays real."""
    squared = -2 * np.log(1 - level) if plane else quantile(level) ** 2
    values, vectors = np.linalg.eigh(covariance)
    width, height = 2 * np.sqrt(squared * np.maximum(values[::-1], 0.0))
    angle = np.degrees(np.arctan2(vectors[1, 1], vectors[0, 1]))
    edge = {"lw": 0 if plane else LINE, "capstyle": "butt"}
    return Ellipse((z.real, z.imag), width, height, angle=angle, color=color, alpha=0.3, **edge)
