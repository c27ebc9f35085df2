"""One picture of windup: a gain and its standard error under two rules, nights without input."""

from __future__ import annotations

from pathlib import Path

from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from forgetting.files import whole
from forgetting.plot.bars import shade
from forgetting.plot.style import BLUE, FAINT, VERMILLION, legend_above, styled
from forgetting.plot.timeline import label_time, timeline
from forgetting.record import Identification

NIGHT, DAY = 5.0, 50.0
"""Irradiance below which it is night, and above which the measured gain is worth a dot (W/m²)."""


def windup(exponential: Identification, subspace: Identification, rows: slice) -> Figure:
    """Draw the first parameter and its standard error under both rules.

    Parameters
    ----------
    exponential, subspace : Identification
        The model power = (gain + slope · warmth) · sun under two rules.
    rows : slice
        The stretch of the record to draw.
    """
    x, _ = timeline(subspace)
    x, sun, power = x[rows], subspace.samples.phi[rows, 0], subspace.samples.y[rows, 0]
    figure, (certainty, estimate) = plt.subplots(
        2, 1, figsize=(9.4, 5.2), sharex=True, height_ratios=(1, 1.1), layout="constrained"
    )
    for ax in (certainty, estimate):
        shade(ax, x, sun < NIGHT, FAINT)
    lit = sun > DAY
    estimate.plot(x[lit], power[lit] / sun[lit], ".", color=FAINT, ms=4, label="power / irradiance")
    for found, colour, name in (
        (exponential, VERMILLION, "exponential forgetting"),
        (subspace, BLUE, "subspace forgetting"),
    ):
        gain, error = found.theta[rows, 0, 0], found.claimed_standard_error[rows, 0, 0]
        certainty.plot(x, error, color=colour, label=name, lw=2)
        estimate.fill_between(x, gain - 2 * error, gain + 2 * error, color=colour, alpha=0.2, lw=0)
        estimate.plot(x, gain, color=colour, lw=1.8)
    finish(certainty, estimate)
    label_time(estimate, x, "shaded: night, no input")
    figure.align_ylabels()
    return figure


def finish(certainty: Axes, estimate: Axes) -> None:
    """Scales and words."""
    certainty.set_yscale("log")
    certainty.set_ylim(0.03, 1e5)
    certainty.set_title("Solar array: standard error of its gain")
    certainty.set_ylabel("W per W/m²")
    legend_above(certainty, 2)
    estimate.set_ylim(-2.5, 14.5)
    estimate.set_title("Estimate ± 2 standard errors")
    estimate.set_ylabel("gain (W per W/m²)")
    legend_above(estimate, 1)


def save_windup(
    exponential: Identification, subspace: Identification, rows: slice, path: Path
) -> None:
    """Write the picture as PNG."""
    with styled():
        figure = windup(exponential, subspace, rows)
        with whole(path) as made:
            figure.savefig(made, dpi=160, facecolor="white")
        plt.close(figure)
