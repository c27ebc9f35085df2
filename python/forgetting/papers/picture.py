"""Figures of the papers, each drawn by one short function."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from forgetting.files import whole
from forgetting.plot.style import BLUE, FAINT, VERMILLION, styled

from .claim import SEEDS

WIDTH = 7.2
"""Inches: two columns of a journal."""


@dataclass(frozen=True)
class Picture:
    """A figure that has not been drawn yet; call it inside ``styled()`` to draw.

    Attributes
    ----------
    name : str
        File name without suffix.
    source : str
        Paper and figure number.
    caption : str
        What is to be seen, settings included.
    """

    name: str
    source: str
    caption: str
    draw: Callable[..., Figure]

    def __call__(self, seeds: int = SEEDS) -> Figure:
        """Draw; `seeds` is for the figures of many noise realisations."""
        if "seeds" in inspect.signature(self.draw).parameters:
            return self.draw(seeds)
        return self.draw()

    @property
    def module(self) -> str:
        """Where it is drawn, ``vdf.example09``."""
        return self.draw.__module__.split("papers.")[-1]


def picture(name: str, source: str, caption: str) -> Callable[[Callable[..., Figure]], Picture]:
    """Turn a function that draws into a `Picture`."""

    def make(draw: Callable[..., Figure]) -> Picture:
        return Picture(name, source, caption, draw)

    return make


def pictures(module: ModuleType) -> list[Picture]:
    """The pictures of a module, in the order of its text."""
    return [item for item in vars(module).values() if isinstance(item, Picture)]


def save(each: Picture, folder: Path, seeds: int = SEEDS) -> list[Path]:
    """Draw and write as PNG (200 dots an inch) and SVG."""
    with styled():
        figure = each(seeds)
        paths = [folder / f"{each.name}.{suffix}" for suffix in ("png", "svg")]
        for path in paths:
            metadata = {"Date": None} if path.suffix == ".svg" else None
            with whole(path) as made:
                figure.savefig(made, dpi=200, metadata=metadata)
        plt.close(figure)
    return paths


def panels(rows: int, columns: int, titles: Iterable[str], height: float = 2.3) -> list[Axes]:
    """Axes of a new figure, row by row, each with its letter and title."""
    _, axes = plt.subplots(
        rows, columns, figsize=(WIDTH, height * rows), squeeze=False, layout="constrained"
    )
    found = list(axes.ravel())
    for letter, title, ax in zip("abcdefghijkl", titles, found, strict=False):
        ax.set_title(f"{letter})  {title}" if len(found) > 1 else title)
    return found


def figure_of(axes: list[Axes]) -> Figure:
    """The figure of these axes."""
    return axes[0].get_figure(root=True)  # type: ignore[return-value]


def group(
    ax: Axes, k: ArrayLike, values: ArrayLike, color: str, label: str, width: float = 1.1
) -> None:
    """Draw several curves of one kind in one colour, with one entry in the legend."""
    lines = ax.plot(k, np.asarray(values), color=color, linewidth=width)
    lines[0].set_label(label)


def two_groups(ax: Axes, k: ArrayLike, values: ArrayLike, informed: int, words: str) -> None:
    """Eigenvalues on a log axis: those of informed directions and the others.

    `values` (m, n) has the uninformed ones first, as the eigenvalues of P, descending, do.
    """
    every = np.asarray(values)
    silent = every.shape[1] - informed
    group(ax, k, every[:, silent:], BLUE, f"{informed} informed")
    if silent:
        group(ax, k, every[:, :silent], VERMILLION, f"{silent} not informed")
    ax.set_yscale("log")
    ax.set_ylabel(words)


def legend_below(ax: Axes, columns: int = 2, drop: float = 0.28) -> None:
    """Put the legend under the axis label, `drop` heights of the axes down, clear of the data."""
    ax.legend(
        loc="upper center",
        bbox_to_anchor=(0.5, -drop),
        ncols=columns,
        fontsize=8,
        handlelength=1.5,
        columnspacing=1.2,
    )


def wide(ax: Axes) -> None:
    """Let the axes take the whole of their row."""
    place = ax.get_subplotspec()
    if place is not None:
        ax.set_subplotspec(place.get_gridspec()[place.rowspan.start, :])


def bound(ax: Axes, level: float | ArrayLike, label: str, style: str = "--") -> None:
    """A horizontal bound."""
    for number, value in enumerate(np.atleast_1d(np.asarray(level, dtype=float))):
        ax.axhline(value, color=FAINT, linestyle=style, label=label if number == 0 else None)
