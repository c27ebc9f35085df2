"""Which members of a bank are believed when."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from forgetting import InvalidInput, Run
from forgetting.plot import thinning
from forgetting.plot.style import labelled, literal

DARK, BRIGHT = 0.05, 0.95
"""The part of the colour map that is used: its ends are too dark and too bright beside others."""


def weights(run: Run, labels: Sequence[str] | None = None, ax: Axes | None = None) -> Axes:
    """Draw how far each member of a bank is believed, sample by sample, one on top of the other.

    The first member is the lowest and darkest one; in `Bank` it is that with the longest memory, so
    that brightness shows which memory fits when. Of a long record the mean of every stretch that a
    screen can show is drawn.

    Parameters
    ----------
    run : Run
        What ``bank.run(..., outputs=["weights"])`` returned, for T samples and K members.
    labels : sequence of str, length K, optional
        A name for each member, for the legend; without it there is none.
    ax : Axes, optional
        Where to draw.

    Raises
    ------
    InvalidInput
        If the run has no weights, or there are not as many labels as members.

    Examples
    --------
    >>> import numpy as np
    >>> import forgetting as fg
    >>> from forgetting import plot
    >>> phi = np.random.default_rng(1).normal(size=(200, 2))
    >>> run = fg.Bank(2).run(phi, phi @ [1.0, 2.0], outputs=["weights"])
    >>> plot.weights(run).get_ylabel()
    'weight of a member'
    """
    if run.weights is None:
        raise InvalidInput("run.weights = None, allowed: a run of a Bank with outputs=['weights']")
    count = run.weights.shape[1]
    if labels is not None and len(labels) != count:
        raise InvalidInput(f"labels has {len(labels)} names, allowed: one for each of {count}")
    ax = labelled(ax, "weight of a member", "sample")
    parts = list(thinning.stretches(len(run.weights), thinning.POINTS))
    means = np.array([np.nanmean(run.weights[part], axis=0) for part in parts]).T
    x = np.array([part.start for part in parts])
    colours = plt.get_cmap("viridis")(np.linspace(DARK, BRIGHT, count))
    names = None if labels is None else list(map(literal, labels))
    ax.stackplot(x, means, colors=colours, labels=names or (), lw=0)
    ax.set_ylim(0, 1)
    ax.margins(x=0)
    if names:
        ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), reverse=True)
    return ax
