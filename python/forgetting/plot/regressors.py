"""Regressors: their information in windows and along directions, their power over frequency."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from forgetting.analysis import Content, Excitation, Spectrum
from forgetting.plot.bars import shade
from forgetting.plot.style import BLUE, FAINT, GREEN, ORANGE, PALETTE, labelled, literal


def excitation(found: Excitation, ax: Axes | None = None) -> Axes:
    """Draw the extreme information of each window, the threshold, and where it fails."""
    ax = labelled(ax, "information in a window", "first sample of the window")
    floor = found.beta * 1e-18 + np.finfo(float).tiny
    ax.semilogy(np.maximum(found.largest, floor), color=BLUE, label="largest")
    ax.semilogy(np.maximum(found.smallest, floor), color=GREEN, label="smallest")
    ax.axhline(max(found.threshold, floor), color=FAINT, ls="--", lw=0.9, label="threshold")
    unexcited = found.smallest <= found.threshold
    shade(ax, np.arange(unexcited.size), unexcited, ORANGE, "not excited")
    ax.legend()
    return ax


def content(
    found: Excitation | Content, ax: Axes | None = None, names: Sequence[str] | None = None
) -> Axes:
    """Draw each sample's content along each direction, on a logarithmic colour scale.

    Directions go from most (bottom) to least informed (top); `names` labels them.
    """
    ax = labelled(ax, "direction", "sample")
    values = found.content
    if not found.content.size or not values.max() > 0:
        return ax
    levels = np.log10(np.maximum(values, values.max() * 1e-12))
    image = ax.imshow(levels.T, aspect="auto", origin="lower", cmap="cividis", interpolation="none")
    labels = None if names is None else list(map(literal, names))
    ax.set_yticks(range(values.shape[1]), labels=labels)
    ax.figure.colorbar(image, ax=ax, label="log10 of the content")
    return ax


def spectrum(found: Spectrum, ax: Axes | None = None, names: Sequence[str] | None = None) -> Axes:
    """Draw the power of each regressor over frequency."""
    ax = labelled(ax, "mean square", "cycles per sample")
    for index, power in enumerate(found.power.T):
        label = f"regressor {index}" if names is None else literal(names[index])
        colour = PALETTE[index % len(PALETTE)]
        ax.semilogy(found.frequencies, np.maximum(power, 1e-300), color=colour, label=label)
    top = float(found.power.max())
    if top > 0:
        ax.set_ylim(bottom=top * 1e-12)
    ax.legend()
    return ax
