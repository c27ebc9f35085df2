"""Pictures of the analysis on Matplotlib axes: axes in (or made), the same axes out.

Matplotlib is imported when something is drawn. Colours are those of Okabe and Ito (2008),
which people with any colour vision can tell apart.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from matplotlib.axes import Axes

    from .conditions import Conditions
    from .confidence import Confidence
    from .content import Content
    from .excitation import Excitation
    from .excited import Excited
    from .guarantee import Guarantee
    from .spectrum import Spectrum
    from .stability import Stability
    from .ultimate_bound import UltimateBound
    from .windup import Windup

BLUE, VERMILLION, GREEN = "#0072b2", "#d55e00", "#009e73"
ORANGE, PURPLE, SKY = "#e69f00", "#cc79a7", "#56b4e9"
PALETTE = (BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY)
FAINT = "#6b7280"
#: A bound further beyond the range of the axes than this factor would flatten what they show.
NEAR = 1e3


def excitation(found: Excitation, ax: Axes | None = None) -> Axes:
    """Draw the extreme information of each window, the threshold, and where it fails."""
    ax = _axes(ax, "information in a window", "first sample of the window")
    floor = found.beta * 1e-18 + np.finfo(float).tiny
    ax.semilogy(np.maximum(found.largest, floor), color=BLUE, label="largest")
    ax.semilogy(np.maximum(found.smallest, floor), color=GREEN, label="smallest")
    ax.axhline(max(found.threshold, floor), color=FAINT, ls="--", lw=0.9, label="threshold")
    unexcited = found.smallest <= found.threshold
    _shade(ax, np.arange(unexcited.size), unexcited, "not excited")
    ax.legend()
    return ax


def content(
    found: Excitation | Content, ax: Axes | None = None, names: Sequence[str] | None = None
) -> Axes:
    """Draw what each sample says along each direction, on a logarithmic colour scale.

    Directions go from most (bottom) to least informed (top); `names` labels them.
    """
    ax = _axes(ax, "direction", "sample")
    values = found.content
    if not found.content.size or not values.max() > 0:
        return ax
    levels = np.log10(np.maximum(values, values.max() * 1e-12))
    image = ax.imshow(levels.T, aspect="auto", origin="lower", cmap="cividis", interpolation="none")
    ax.set_yticks(range(values.shape[1]), labels=names)
    ax.figure.colorbar(image, ax=ax, label="log10 of the content")
    return ax


def spectrum(found: Spectrum, ax: Axes | None = None, names: Sequence[str] | None = None) -> Axes:
    """Draw the power of each regressor over frequency."""
    ax = _axes(ax, "mean square", "cycles per sample")
    for index, power in enumerate(found.power.T):
        label = f"regressor {index}" if names is None else names[index]
        colour = PALETTE[index % len(PALETTE)]
        ax.semilogy(found.frequencies, np.maximum(power, 1e-300), color=colour, label=label)
    top = float(found.power.max())
    if top > 0:
        ax.set_ylim(bottom=top * 1e-12)
    ax.legend()
    return ax


def conditions(found: Conditions, ax: Axes | None = None) -> Axes:
    """Draw the extreme eigenvalues of P with the bounds a and b found, and where A1 fails."""
    ax = _axes(ax, "eigenvalues of P", "sample")
    record, known = found.record, found.constants
    x = record.first + np.arange(record.samples)
    prior, before = (np.linalg.eigvalsh(item) for item in (record.prior, record.before))
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
    ax = _axes(ax, "decrease of V per squared error", "first sample of the window")
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
    ax = _axes(ax, "norm of the error", "sample")
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


def confidence(found: Confidence, ax: Axes | None = None, row: int = 0, target: int = 0) -> Axes:
    """Draw the one-step errors in their prediction intervals; misses are marked."""
    ax = _axes(ax, "one-step error", "sample")
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


def windup(found: Windup, ax: Axes | None = None) -> Axes:
    """Draw how far the variance of silent directions has grown, and where that is windup."""
    ax = _axes(ax, "growth since last informed", "sample")
    ax.semilogy(found.samples, found.path, color=BLUE)
    ax.axhline(found.factor, color=VERMILLION, ls="--", lw=0.9, label="windup above")
    _shade(ax, found.samples, found.path > found.factor, "windup")
    ax.legend()
    return ax


def rank(found: Excited, ax: Axes | None = None, x: Any = None) -> Axes:
    """Draw how many directions the last samples excite; `x` has a value for each sample."""
    ax = _axes(ax, "directions", "sample")
    at = _at(found.samples, x)
    ax.step(at, found.rank, where="mid", color=GREEN)
    ax.fill_between(at, found.rank, step="mid", color=GREEN, alpha=0.15, lw=0)
    ax.set_ylim(0, found.parameters * 1.08)
    few = range(found.parameters + 1)
    ax.set_yticks(few if found.parameters < 4 else [0, found.parameters])
    ax.set_title(f"Directions of {found.parameters} that the last {found.window} samples excite")
    return ax


def excited(
    found: Excited,
    ax: Axes | None = None,
    names: Sequence[str] | None = None,
    x: Any = None,
    most: int = 24,
) -> Axes:
    """Draw a bar for each parameter while the last samples tell of it; the first `most` of them."""
    shown = min(found.parameters, most)
    labels = [f"parameter {i}" for i in range(shown)] if names is None else list(names[:shown])
    bars = dict(zip(labels, found.told.T[:shown], strict=True))
    return strips(bars, ax, _at(found.samples, x), dict.fromkeys(labels, BLUE))


def strips(
    bars: Mapping[str, Any],
    ax: Axes | None = None,
    x: Any = None,
    colours: Mapping[str, str] | None = None,
) -> Axes:
    """Draw bars above one another where something holds: its name, and a bool a sample.

    Bins of a long record are filled when it holds anywhere in them.
    """
    ax = _axes(ax, "", "sample")
    for place, (label, where) in enumerate(bars.items()):
        where = np.asarray(where, dtype=bool)
        at, held = _binned(np.arange(len(where)) if x is None else x, where)
        colour = VERMILLION if colours is None else colours[label]
        ax.fill_between(at, place - 0.32, place + 0.32, where=held, step="post", color=colour, lw=0)
    ax.set_yticks(range(len(bars)), labels=list(bars))
    ax.set_ylim(len(bars) - 0.45, -0.55)
    ax.grid(visible=False, axis="y")
    return ax


def bounds(found: Guarantee, ax: Axes) -> Axes:
    """Draw the bounds that the rule guarantees, where they are near what the axes show."""
    low, high = ax.get_ylim()
    for value, colour, label in (
        (found.upper, VERMILLION, "guaranteed upper bound"),
        (found.lower, BLUE, "guaranteed lower bound"),
    ):
        if value is not None and low / NEAR < value < high * NEAR:
            ax.axhline(value, color=colour, ls="--", lw=1.0, label=label)
    return ax


def _at(samples: Any, x: Any) -> Any:
    return samples if x is None else np.asarray(x)[samples]


def _binned(x: Any, where: Any, most: int = 1200) -> tuple[Any, Any]:
    """At most about `most` bins with their edges; True where it is anywhere in the bin."""
    x = np.asarray(x)
    step = max(1, -(-len(where) // most))
    starts = np.arange(0, len(where), step)
    held = np.logical_or.reduceat(where, starts) if len(where) else where
    last = x[-1:] + (x[-1:] - x[-2:-1]) if len(x) > 1 else x[-1:]
    return np.concatenate([x[starts], last]), np.append(held, held[-1:])


def _axes(ax: Axes | None, ylabel: str, xlabel: str) -> Axes:
    """Return `ax`, or new axes, labelled."""
    if ax is None:
        from matplotlib import pyplot as plt

        ax = plt.subplots(figsize=(9, 3), layout="constrained")[1]
    ax.set_xlabel(xlabel)
    ax.set_ylabel(ylabel)
    return ax


def _shade(ax: Axes, x: Any, where: Any, label: str) -> None:
    """Shade the stretches of x where a condition is met."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], where, [False]]).astype(np.int8)))
    for number, (start, stop) in enumerate(edges.reshape(-1, 2)):
        name = label if number == 0 else None
        ax.axvspan(x[start], x[stop - 1], color=ORANGE, alpha=0.25, lw=0, label=name)
