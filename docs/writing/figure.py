"""The figure that every choice has: estimates with their band, and the eigenvalues of P."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

import forgetting as fg
from forgetting.files import whole
from forgetting.plot import weights
from forgetting.plot.style import BLUE, FAINT, GREEN, INK, PURPLE, VERMILLION, styled

from .record import BOTH_SILENT, ONE_SILENT, SAMPLES, Array, record
from .shown import FACTOR, making

PRIOR = 100.0
"""P before the first sample."""
OUTPUTS = ("theta", "covariance")
EXTRA = {"rate": "forgetting_factor", "weighting": "weight", "gate": "gate", "mixer": "weights"}
"""What the third picture of an axis shows; rules have none."""
WORDS = {
    "forgetting_factor": "forgetting factor",
    "weight": "weight of a sample",
    "gate": "what the gate says",
    "weights": "weight of a member",
}


def save(axis: str, about: Mapping[str, Any], path: Path) -> None:
    """Draw the figure of a choice and write it as PNG."""
    shown = record(gross=axis == "weighting")
    run = estimator(axis, about).run(shown.phi, shown.y, outputs=outputs(axis))
    with styled():
        rows = 3 if axis in EXTRA else 2
        figure, axes = plt.subplots(
            rows,
            1,
            figsize=(8.2, 2.0 + 1.75 * rows),
            sharex=True,
            height_ratios=(1.5, 1.2, 1.0)[:rows],
            layout="constrained",
        )
        estimates(axes[0], run, shown.theta)
        if axis in ("weighting", "gate"):
            without(axes[0], axis, shown)
        eigenvalues(axes[1], run)
        if axis in EXTRA:
            extra(axes[2], EXTRA[axis], run)
        finish(axes)
        with whole(path) as written:
            figure.savefig(written, format="png", dpi=150, facecolor="white")
        plt.close(figure)


def estimator(axis: str, about: Mapping[str, Any]) -> Any:
    """An estimator that has this choice, and the usual ones beside it."""
    choice = making(about)
    if axis == "mixer":
        return fg.Bank(2, mixer=choice)
    if axis in ("rule", "rate"):
        rule = choice if axis == "rule" else fg.Exponential(choice)
        return fg.RLS(2, rule=rule, initial_covariance=PRIOR)
    return fg.RLS(2, rule=usual(axis), initial_covariance=PRIOR, **{axis: choice})


def usual(axis: str) -> fg.Rule:
    """The rule under which weightings and gates are shown."""
    return fg.Subspace(FACTOR) if axis == "weighting" else fg.Exponential(FACTOR)


def outputs(axis: str) -> tuple[str, ...]:
    """What a run has to give for the figure."""
    return (*OUTPUTS, EXTRA[axis]) if axis in EXTRA else OUTPUTS


def estimates(ax: Axes, run: Any, truth: Array) -> None:
    """Draw both parameters, what they are, and twice the standard deviation that P says."""
    k = np.arange(SAMPLES)
    spread = 2 * np.sqrt(np.diagonal(run.covariance, axis1=1, axis2=2))
    for column, colour in enumerate((BLUE, VERMILLION)):
        theta = run.theta[:, column]
        low, high = theta - spread[:, column], theta + spread[:, column]
        ax.fill_between(k, low, high, color=colour, alpha=0.2, lw=0)
        ax.plot(k, theta, color=colour, label=f"estimate of θ{'₁₂'[column]}, ± 2 σ")
    ax.plot(k, truth, color=INK, ls="--", lw=0.9, label=["truth", None])
    ax.set_ylim(-8, 34)
    ax.set_ylabel("parameters")


def without(ax: Axes, axis: str, shown: Any) -> None:
    """Draw what the estimates would be without the choice."""
    plain = fg.RLS(2, rule=usual(axis), initial_covariance=PRIOR)
    theta = plain.run(shown.phi, shown.y, outputs=("theta",)).theta
    ax.plot(theta, color=FAINT, lw=1.1, zorder=1, label=[f"without the {axis}", None])


def eigenvalues(ax: Axes, run: Any) -> None:
    """Draw the eigenvalues of P."""
    values = np.linalg.eigvalsh(run.covariance)
    ax.semilogy(values[:, 1], color=VERMILLION, label="largest")
    ax.semilogy(values[:, 0], color=BLUE, label="smallest")
    ax.set_ylim(1e-4, 1e6)
    ax.set_ylabel("eigenvalues of P")


def extra(ax: Axes, name: str, run: Any) -> None:
    """Draw what is of this axis alone."""
    values = getattr(run, name)
    if name == "weights":
        weights(run, ax=ax)
    elif name == "gate":
        ax.plot(values, ".", color=PURPLE, ms=2.5)
        ax.set_yticks([0, 1, 2], [fg.GATE[code] for code in (0, 1, 2)])
        ax.set_ylim(-0.4, 2.4)
    else:
        ax.plot(values, color=GREEN, lw=1.0)
        ax.set_ylim(min(values.min(), 0.95) - 0.02, 1.02)
    ax.set_ylabel(WORDS[name])


def finish(axes: Any) -> None:
    """Shade the silence and explain the lines."""
    for ax in axes:
        for part, alpha in ((ONE_SILENT, 0.35), (BOTH_SILENT, 0.8)):
            ax.axvspan(part.start, part.stop, color="#d9dde4", alpha=alpha, lw=0, zorder=0)
        ax.margins(x=0)
    for part, text in ((ONE_SILENT, "second input silent"), (BOTH_SILENT, "both silent")):
        middle = (part.start + part.stop) / 2
        axes[0].text(middle, 31.5, text, ha="center", va="center", color=FAINT, fontsize=9)
    for ax in axes[:2]:
        ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=4, borderaxespad=0.1)
    axes[-1].set_xlabel("sample")
