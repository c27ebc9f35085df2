"""The conditions of the theorems over time, and what follows from them."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from forgetting.analysis import Conditions, Stability, UltimateBound
from forgetting.plot.style import BLUE, FAINT, PURPLE, VERMILLION, labelled


def conditions(found: Conditions, ax: Axes | None = None) -> Axes:
    """Draw the extreme eigenvalues of P with the bounds a and b found, and where A1 fails."""
    ax = labelled(ax, "eigenvalues of P", "sample")
    trajectory, known = found.trajectory, found.constants
    x = trajectory.first + np.arange(trajectory.samples)
    prior, before = (np.linalg.eigvalsh(item) for item in (trajectory.prior, trajectory.before))
    ax.semilogy(x, prior[:, -1], color=VERMILLION, label="largest, after forgetting")
    ax.semilogy(x, np.where(before[:, 0] > 0, before[:, 0], np.nan), color=BLUE, label="smallest")
    for name, colour in (("b", VERMILLION), ("a", BLUE)):
        if known.get(name, 0.0) > 0:
            firm = found["A2" if name == "b" else "A3"].verdict == "holds"
            ax.axhline(known[name], color=colour, ls="--" if firm else ":", lw=0.9, label=name)
    failing = found["A1"].sample
    if failing is not None:
        ax.axvline(failing, color=PURPLE, lw=1.2, label="A1 fails")
    ax.legend()
    return ax


def stability(found: Stability, ax: Axes | None = None) -> Axes:
    """Draw the decrease of V over each window, seen and guaranteed."""
    ax = labelled(ax, "decrease of V per squared error", "first sample of the window")
    if found.observed is None or found.decrease is None:
        ax.set_title("no decrease is guaranteed")
        return ax
    ax.semilogy(np.maximum(found.observed, 1e-300), color=BLUE, label="seen, at least")
    ax.axhline(found.decrease, color=VERMILLION, ls="--", label="guaranteed, c_N")
    ax.set_ylim(bottom=found.decrease / 10)
    ax.legend()
    return ax


def ultimate_bound(found: UltimateBound, ax: Axes | None = None) -> Axes:
    """Draw the error seen with the corrected bound and the printed one."""
    ax = labelled(ax, "norm of the error", "sample")
    if found.error is not None:
        ax.semilogy(np.maximum(found.error, 1e-300), color=BLUE, label="seen")
    for value, colour, label in (
        (found.bound, VERMILLION, "bound"),
        (found.printed, FAINT, "as printed (not a bound)"),
    ):
        if np.isfinite(value) and value > 0:
            ax.axhline(value, color=colour, ls="--", label=label)
    if ax.get_legend_handles_labels()[0]:
        ax.legend()
    return ax
