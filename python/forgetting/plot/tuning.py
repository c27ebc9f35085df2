"""The error over the forgetting factor, a line for each rule."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.ticker import FixedFormatter, FixedLocator, NullLocator

from forgetting.files import whole
from forgetting.plot.style import FAINT, INK, PALETTE, axes_or_new, literal, styled
from forgetting.tuning import Tuning
from forgetting.tuning.candidate import NOISE, tuned
from forgetting.tuning.runner import Trial
from forgetting.words.rounding import brief

TICKS = (0.5, 0.8, 0.9, 0.98, 0.99, 0.998, 0.999, 0.9998, 0.9999)
STYLES = ("-", "--", ":", "-.")
HIGHEST = 2.0
"""Errors above so many times the least are cut off: what matters lies near the best."""


def factors(trials: Sequence[Trial], best: Trial | None = None, ax: Axes | None = None) -> Axes:
    """Draw the one-step error of each rule over its forgetting factor.

    Rules without a factor, which need no axis, are drawn as level lines at their best.

    Parameters
    ----------
    trials : sequence of Trial
        What was tried for one model; `Tuning.trials`.
    best : Trial, optional
        What was chosen, marked.
    ax : Axes, optional
        Where to draw.
    """
    ax = axes_or_new(ax)
    lines, levels = split_by_rule(trials)
    for number, (name, points) in enumerate(lines.items()):
        x, y = zip(*sorted(points), strict=True)
        style = STYLES[number // len(PALETTE) % len(STYLES)]
        ax.plot(x, y, style, marker=".", label=literal(name))
    for number, (name, error) in enumerate(levels.items()):
        style = STYLES[1 + number % (len(STYLES) - 1)]
        ax.axhline(error, color=FAINT, ls=style, lw=1.1, label=literal(f"{name} {brief(error)}"))
    if best is not None and np.isfinite(best.error):
        ax.axhline(best.error, color=INK, lw=0.8, label=f"chosen {brief(best.error)}")
    label(ax, lines)
    limit(ax, [y for points in lines.values() for _, y in points] + list(levels.values()))
    return ax


def split_by_rule(
    trials: Sequence[Trial],
) -> tuple[dict[str, list[tuple[float, float]]], dict[str, float]]:
    """Memory and error of each rule with a factor; the least error of each without."""
    lines: dict[str, list[tuple[float, float]]] = {}
    levels: dict[str, float] = {}
    for trial in trials:
        rule = trial.candidate.rule
        if not np.isfinite(trial.error):
            continue
        name = None if rule is None else tuned(rule.name)
        value = rule.arguments()[name] if rule is not None and name is not None else None
        word = "the bank" if rule is None else rule.name
        if name == NOISE or name is None:
            levels[word] = min(levels.get(word, np.inf), trial.error)
        elif isinstance(value, float) and value < 1 and trial.stage == "factors":
            lines.setdefault(word, []).append((1 / (1 - value), trial.error))
    return lines, levels


def label(ax: Axes, lines: dict[str, list[tuple[float, float]]]) -> None:
    """Say what the axes are: memory on a logarithmic scale, marked by forgetting factors."""
    ax.set_xscale("log")
    memories = [x for points in lines.values() for x, _ in points]
    if memories:
        ax.set_xlim(min(memories) * 0.9, max(memories) * 1.1)
    ax.xaxis.set_major_locator(FixedLocator([1 / (1 - factor) for factor in TICKS]))
    ax.xaxis.set_major_formatter(FixedFormatter([f"{factor:g}" for factor in TICKS]))
    ax.xaxis.set_minor_locator(NullLocator())
    ax.set_xlabel("forgetting factor (memory 1/(1 − λ) on a logarithmic scale)")
    ax.set_ylabel("one-step RMSE")
    ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


def limit(ax: Axes, errors: Sequence[float]) -> None:
    """Cut off errors far above the least."""
    if errors and max(errors) > HIGHEST * min(errors) > 0:
        ax.set_ylim(0.95 * min(errors), HIGHEST * min(errors))


def save_tuning(found: Tuning, path: str | Path) -> None:
    """Write the picture of what a search tried for the model that it chose, .png, .svg or .pdf."""
    trials = [trial for trial in found.trials if trial.candidate.orders == found.orders]
    save_factors(trials, found.best, "Chosen on the first part of the record", path)


def save_factors(trials: Sequence[Trial], best: Trial | None, title: str, path: str | Path) -> None:
    """Write one picture of `factors`."""
    with styled():
        figure, ax = plt.subplots(figsize=(9, 4.5), layout="constrained")
        factors(trials, best, ax).set_title(title)
        with whole(path) as made:
            figure.savefig(made, dpi=150)
        plt.close(figure)
