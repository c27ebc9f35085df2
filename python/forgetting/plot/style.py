"""One look for all pictures."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import matplotlib as mpl
from cycler import cycler
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

BLUE, VERMILLION, GREEN = "#0072b2", "#d55e00", "#009e73"
ORANGE, PURPLE, SKY = "#e69f00", "#cc79a7", "#56b4e9"
PALETTE = (BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY)
INK, FAINT, GRID = "#1f2430", "#6b7280", "#d9dde4"
"""Text, secondary lines and grid; the HTML report swaps them for its light or dark theme."""

RC: dict[str, Any] = {
    "axes.edgecolor": FAINT,
    "axes.grid": True,
    "axes.labelcolor": INK,
    "axes.labelsize": 9.5,
    "axes.prop_cycle": cycler(color=PALETTE),
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlecolor": INK,
    "axes.titlelocation": "left",
    "axes.titlesize": 10.5,
    "axes.titleweight": "bold",
    "axes.axisbelow": True,
    "axes.formatter.useoffset": False,
    "figure.dpi": 110,
    "font.size": 9.5,
    "grid.color": GRID,
    "grid.linewidth": 0.7,
    "legend.frameon": False,
    "legend.fontsize": 9,
    "legend.labelcolor": INK,
    "lines.linewidth": 1.3,
    "lines.solid_joinstyle": "round",
    "svg.fonttype": "none",
    "svg.hashsalt": "forgetting",
    "text.color": INK,
    "xtick.color": FAINT,
    "xtick.labelcolor": INK,
    "ytick.color": FAINT,
    "ytick.labelcolor": INK,
}


@contextmanager
def styled() -> Iterator[None]:
    """Use the look inside a ``with`` block; the user's own settings come back after it.

    A letter that the font lacks is drawn as a box, without a warning a letter.
    """
    settings: Any = RC
    with mpl.rc_context(settings), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing from")
        yield


def literal(name: str) -> str:
    """A name as Matplotlib must get it to show it letter by letter.

    Between two dollar signs it would read mathematics, and a label that begins with an underscore
    would be left out of a legend.

    Examples
    --------
    >>> print(literal("cost in $ or US$"), literal("_x"), sep=",")
    cost in \\$ or US\\$, _x
    """
    return (" " if name.startswith("_") else "") + name.replace("$", r"\$")


def axes_or_new(ax: Axes | None) -> Axes:
    """Return `ax`, or new axes in a new figure."""
    return plt.subplots(figsize=(9, 3), layout="constrained")[1] if ax is None else ax


def labelled(ax: Axes | None, ylabel: str, xlabel: str) -> Axes:
    """Return `ax`, or new axes, with these labels."""
    ax = axes_or_new(ax)
    ax.set_xlabel(xlabel)
    ax.set_ylabel(ylabel)
    return ax


def legend_above(ax: Axes, entries: int) -> None:
    """Put the legend above the axes on the right, where it hides no data."""
    ax.legend(
        loc="lower right",
        bbox_to_anchor=(1.0, 1.0),
        ncols=entries,
        borderaxespad=0.1,
        handlelength=1.6,
        columnspacing=1.4,
    )
