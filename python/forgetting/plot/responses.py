"""Responses of a model in time and over frequency, in their confidence bands."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from forgetting._core import InvalidInput
from forgetting.plot.style import FAINT, PALETTE, axes_or_new, literal
from forgetting.polynomials import FrequencyResponse, TimeResponse

DECIBEL = 20.0


def time_response(
    *found: TimeResponse,
    labels: Sequence[str] = (),
    level: float = 0.95,
    ax: Axes | None = None,
) -> Axes:
    """Draw step or impulse responses, each in its confidence band.

    Parameters
    ----------
    *found : TimeResponse
        One or more; those of a model at several times show how it changed.
    labels : sequence of str, optional
        What each is called.
    level : float
        Of the bands, in (0, 1).
    ax : Axes, optional
        Where to draw.
    """
    ax = axes_or_new(ax)
    for k, (each, label) in enumerate(zip(found, named(found, labels), strict=True)):
        color = PALETTE[k % len(PALETTE)]
        ax.plot(each.time, each.value, color=color, drawstyle="steps-post", label=label)
        ax.fill_between(each.time, *each.band(level), color=color, alpha=0.2, lw=0, step="post")
    ax.axhline(0, color=FAINT, lw=0.8)
    ax.set_xlabel("time")
    finish(ax, found, labels)
    return ax


def frequency_response(
    *found: FrequencyResponse,
    labels: Sequence[str] = (),
    level: float = 0.95,
    axes: Sequence[Axes] | None = None,
) -> Sequence[Axes]:
    """Draw a Bode diagram: gain in decibel above phase in degrees, in their confidence bands.

    Parameters
    ----------
    *found : FrequencyResponse
        One or more.
    labels : sequence of str, optional
        What each is called.
    level : float
        Of the bands, in (0, 1).
    axes : sequence of two Axes, optional
        Where to draw.

    Returns
    -------
    sequence of two Axes
    """
    if axes is None:
        axes = plt.subplots(2, figsize=(9, 5), sharex=True, layout="constrained")[1]
    gain, phase = axes
    for k, (each, label) in enumerate(zip(found, named(found, labels), strict=True)):
        color = PALETTE[k % len(PALETTE)]
        of_gain = [DECIBEL * np.log10(x) for x in (each.magnitude, *each.magnitude_band(level))]
        of_phase = [np.degrees(x) for x in (each.phase, *each.phase_band(level))]
        for ax, (value, low, high) in ((gain, of_gain), (phase, of_phase)):
            ax.semilogx(each.frequency, value, color=color, label=label)
            ax.fill_between(each.frequency, low, high, color=color, alpha=0.2, lw=0)
    gain.set_ylabel("gain [dB]")
    phase.set_ylabel("phase [°]")
    phase.set_xlabel("frequency [rad per unit of time]")
    finish(gain, found, labels)
    return axes


def named(
    found: Sequence[TimeResponse | FrequencyResponse], labels: Sequence[str]
) -> Sequence[str]:
    """What the curves are called: as asked for, or by what they are."""
    if not found or (labels and len(labels) != len(found)):
        raise InvalidInput(
            f"{len(found)} responses and {len(labels)} labels are given, "
            f"allowed: at least one response, and no labels or one for each"
        )
    return [literal(each) for each in labels or [response.title for response in found]]


def finish(
    ax: Axes, found: Sequence[TimeResponse | FrequencyResponse], labels: Sequence[str]
) -> None:
    """Title and legend: one curve needs only a title."""
    if len(found) == 1 and not labels:
        ax.set_title(literal(found[0].title))
        return
    titles = {each.title for each in found}
    if labels and len(titles) == 1:
        ax.set_title(literal(titles.pop()))
    ax.legend()
