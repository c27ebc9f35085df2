"""Windup, and what the samples inform about: what P and the regressors tell."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .finding import Finding

Array = NDArray[np.float64]
Direction = NDArray[np.floating[Any]]
Names = Sequence[str]
Marks = NDArray[np.bool_]

COLLINEAR = 1e-6
"""Smallest singular value, relative to the largest, of regressors scaled to length 1."""
UNLEARNED = 0.1
"""Share of the initial variance in P above which a parameter counts as not learned."""
LASTING = 1000.0
"""Growth of P beyond which information ends the alarm, but not the doubt."""
BOUNDED = "Take a rule with a bounded covariance, such as subspace, or the bank."


def regressors(information: Array, silent: Marks, names: Names) -> Finding | None:
    """Judge which parameters no sample tells of, or tells apart.

    Parameters
    ----------
    information : (n, n)
        Σ φᵀφ of the complete samples.
    silent : (n,) bool
        Regressors that are zero in all of them.
    names : sequence of n str
    """
    together = inseparable(information, silent)
    words, advice = [], []
    if silent.any():
        words.append(
            f"Not excited: {listing(chosen(names, silent))}; the regressor is zero in every "
            f"complete sample, so the value shown is only the initial one."
        )
        advice.append("Leave it out, or record while it moves.")
    if together.any():
        words.append(
            f"Not told apart: {listing(chosen(names, together))}; their regressors are "
            f"proportional or add up to one another in this record, so only a combination of them "
            f"is known."
        )
        advice.append("Leave out all but one of them, or record while they move apart.")
    if not words:
        return None
    return Finding("regressors", "warning", " ".join(words), " ".join(advice))


def inseparable(information: Array, silent: Marks) -> Marks:
    """Mark regressors that take part in an (almost) zero combination, (n,)."""
    marked = np.zeros(len(information), dtype=bool)
    loud = np.flatnonzero(~silent)
    if len(loud) < 2:
        return marked
    lengths = np.sqrt(np.diagonal(information)[loud])
    # The Gram matrix has squared singular values; rounding (1e-16) allows no finer look.
    gram = information[np.ix_(loud, loud)] / np.outer(lengths, lengths)
    squares, directions = np.linalg.eigh(gram)
    null = directions[:, squares < COLLINEAR**2 * squares[-1] + 1e-15 * len(squares)]
    marked[loud] = (np.abs(null) > 0.05).any(axis=1)
    return marked


def windup(flags: NDArray[np.bool_], growth: float = 1.0, along: str = "") -> Finding:
    """Judge where P grew without information.

    Parameters
    ----------
    flags : (T,) bool
        Samples at which the monitor saw windup.
    growth : float
        At the end, how many times the variance of the weakest direction is what it was when it was
        last informed; 1 if it is informed.
    along : str
        That direction in words.
    """
    rows = np.flatnonzero(flags)
    there = f" of {along}" if along else ""
    if not len(rows) and growth <= LASTING:
        return Finding("windup", "good", "No windup: P did not grow without information.")
    if not len(rows):
        text = f"The variance{there} is still {growth:.3g} times what it was when informed."
        return Finding("windup", "warning", text, "Wait for excitation before using it.")
    text = (
        f"Windup: the rule kept forgetting while the input did not excite, in {len(rows)} samples, "
        f"first in row {rows[0] + 1}"
    )
    if flags[-1]:
        return Finding("windup", "wrong", f"{text}, and still at the end.", BOUNDED)
    if growth > LASTING:
        still = f"the variance{there} is still {growth:.3g} times what it was before"
        return Finding("windup", "wrong", f"{text}; {still}.", BOUNDED)
    return Finding("windup", "warning", f"{text}, but not at the end.", BOUNDED)


def excitation(names: Names, share: Array, silent_now: NDArray[np.bool_], memory: int) -> Finding:
    """Judge whether every parameter is known, and informed about at the end.

    Parameters
    ----------
    names : sequence of n str
    share : (n,)
        Smallest variance in P that each parameter has had, as a share of the initial one. NaN for
        those that are judged elsewhere.
    silent_now : (n,) bool
        Parameters that the samples remembered at the end do not inform about.
    memory : int
        How many samples those are.
    """
    weak = share > UNLEARNED
    if weak.any():
        texts = [
            f"{name} (variance in P never below {part:.3g} times the initial one)"
            for name, part in zip(chosen(names, weak), share[weak], strict=True)
        ]
        return Finding(
            "excitation",
            "warning",
            f"Weakly excited: {listing(texts)}.",
            "Excite more, remember longer, or leave out what cannot be learned.",
        )
    if silent_now.any():
        return Finding(
            "excitation",
            "warning",
            f"Not excited at the end: the last {memory} samples do not inform about "
            f"{listing(chosen(names, silent_now))}; the value shown is that of before.",
            "Use it as the last known value.",
        )
    return Finding("excitation", "good", "All parameters were excited.")


def strong(parts: Direction) -> NDArray[np.intp]:
    """The parameters that make up most of a direction."""
    size = np.abs(parts)
    return np.flatnonzero(size > 0.3 * size.max())


def involved(parts: Direction, names: Names) -> str:
    """A direction by the names of its parameters."""
    named = [names[i] for i in strong(parts)]
    return named[0] if len(named) == 1 else "the combination of " + " and ".join(named)


def chosen(names: Names, where: NDArray[np.bool_]) -> list[str]:
    """The names that are marked."""
    return [name for name, marked in zip(names, where, strict=True) if marked]


def listing(names: Sequence[str]) -> str:
    """Join names as a person would, at most eight of them."""
    shown = list(names[:8])
    if len(names) > 8:
        return ", ".join(shown) + f" and {len(names) - 8} more"
    return shown[0] if len(shown) == 1 else ", ".join(shown[:-1]) + " and " + shown[-1]
