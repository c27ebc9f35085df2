"""Which parameters the record never excited, or no longer excites at its end, in plain words."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from forgetting.record.samples import Samples
from forgetting.record.trace import DEAD_ZONE, HELD, Trace

Array = NDArray[np.float64]

COLLINEAR = 1e-6
"""Smallest singular value, relative to the largest, of regressors scaled to length 1."""

UNLEARNED = 0.1
"""Share of the initial variance in P above which a parameter counts as not learned."""


def verdicts(samples: Samples, trace: Trace, initial_variance: Array) -> list[str]:
    """Write in sentences which parameters the record determines.

    Parameters
    ----------
    samples, trace
        The problem and its run.
    initial_variance : ndarray, shape (n,)
        Diagonal of the initial covariance.
    """
    names = np.array(samples.regressors)
    phi = samples.phi[samples.complete]
    silent = np.array(~phi.any(axis=0))
    sentences = []
    if silent.any():
        sentences.append(
            f"Not excited: {listing(names[silent])}; the regressor is zero in every complete "
            f"sample, so the value shown is only the initial one."
        )
    together = inseparable(phi, silent)
    if together.any():
        sentences.append(
            f"Not told apart: {listing(names[together])}; their regressors are proportional or add "
            f"up to one another in this record, so only a combination of them is known."
        )
    share = trace.variance[-1] / initial_variance
    if trace.windup.any():
        sentences.append(windup(trace))
    weak = (share > UNLEARNED) & ~silent & ~together
    if weak.any():
        sentences.append(
            f"Weakly excited at the end: {shares(names[weak], share[weak])}. The record's last "
            f"samples say little about that; excite longer, or raise the initial covariance."
        )
    idle = int((trace.skipped == DEAD_ZONE).sum())
    if idle:
        sentences.append(
            f"{idle} samples carried less information than the rule's threshold; they were neither "
            f"learned nor forgotten, and the estimates were held."
        )
    held = int((trace.skipped == HELD).sum())
    if held:
        sentences.append(
            f"{held} samples were held by the gate: neither learned from nor forgotten for."
        )
    return sentences or ["All parameters were excited."]


def windup(trace: Trace) -> str:
    """Describe forgetting that went on without excitation."""
    rows = np.flatnonzero(trace.windup)
    end = "and still at the end" if trace.windup[-1] else "but not at the end"
    return (
        f"Windup: the rule kept forgetting while the input did not excite, in {len(rows)} samples, "
        f"first in row {rows[0] + 1}, {end}. A rule with a bounded covariance, such as subspace, "
        f"avoids this."
    )


def shares(names: Array, share: Array) -> str:
    """Each parameter with its variance as a share of the initial one."""
    texts = [
        f"{name} (variance in P {part:.3g} times the initial one)"
        for name, part in zip(names, share, strict=True)
    ]
    return listing(texts)


def inseparable(phi: Array, silent: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Mark regressors that take part in an (almost) zero combination, (n,)."""
    marked = np.zeros(phi.shape[1], dtype=bool)
    columns = phi[:, ~silent]
    if columns.shape[1] < 2:
        return marked
    scaled = columns / np.linalg.norm(columns, axis=0)
    # The Gram matrix has squared singular values; rounding (1e-16) allows no finer look.
    squares, directions = np.linalg.eigh(scaled.T @ scaled)
    null = directions[:, squares < COLLINEAR**2 * squares[-1] + 1e-15 * len(squares)]
    marked[np.flatnonzero(~silent)] = (np.abs(null) > 0.05).any(axis=1)
    return marked


def listing(names: Sequence[str] | Array) -> str:
    """Join names as a person would, at most eight of them."""
    shown = [str(name) for name in names[:8]]
    if len(names) > 8:
        return ", ".join(shown) + f" and {len(names) - 8} more"
    return shown[0] if len(shown) == 1 else ", ".join(shown[:-1]) + " and " + shown[-1]
