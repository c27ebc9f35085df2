"""Which regressors are past outputs: what makes a model run on its own.

They are found by their values, so that ``lag(V)`` of a formula counts like a lag of an ARX model.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from forgetting.models.layout import Layout
from forgetting.record.samples import Samples

Array = NDArray[np.float64]

DEEPEST = 50
"""Rows that a past output is looked for back."""
LOOKED_AT = 1000
"""Complete rows compared first; a column that agrees on them is compared on all."""


@dataclass(frozen=True)
class Feedback:
    """Columns of phi that are past outputs.

    Attributes
    ----------
    lags : mapping of int to (lag, output)
        By the column of phi.
    outputs : int
        Outputs of the model.
    known : mapping of int to float
        By the lag, of a model with one output: what its coefficient is more than what is estimated.
    of_noise : int
        Coefficients of past noise.
    """

    lags: dict[int, tuple[int, int]]
    outputs: int
    known: dict[int, float] = field(default_factory=dict)
    of_noise: int = 0

    @property
    def deepest(self) -> int:
        """The longest lag, na; 0 without feedback."""
        return max((*self.known, *(lag for lag, _ in self.lags.values())), default=0)

    def model(self, theta: Array) -> Array:
        """A_1 ... A_na as `matrices` has them, with what is known."""
        made = self.matrices(theta)
        for lag, value in self.known.items():
            made[lag - 1, 0, 0] += value
        return made

    def knowing(self, values: Array, left: list[int]) -> Feedback:
        """The same where parameters are `values` (n,) more than is estimated of those `left`."""
        known = {lag: float(values[i]) for i, (lag, _) in self.lags.items() if values[i]}
        lags = {new: self.lags[old] for new, old in enumerate(left) if old in self.lags}
        return Feedback(lags, self.outputs, known, self.of_noise)

    def matrices(self, theta: Array) -> Array:
        """A_1 ... A_na of y(k) = A_1 y(k-1) + ..., (na, m, m), from theta (n, m)."""
        made = np.zeros((self.deepest, self.outputs, self.outputs))
        for column, (lag, source) in self.lags.items():
            made[lag - 1, :, source] = theta[column]
        return made


def feedback(samples: Samples) -> Feedback:
    """Find the columns of phi that equal an output some rows ago wherever they are known.

    Examples
    --------
    >>> import numpy as np
    >>> y = np.arange(5.0)[:, None] ** 2
    >>> phi = np.column_stack([np.ones(5), np.r_[np.nan, y[:-1, 0]]])
    >>> feedback(Samples(phi, y, ("1", "lag(y)"), ("y",), "", None, "")).lags
    {1: (1, 0)}
    """
    if samples.layout is not None:
        return of_layout(samples.layout)
    known = np.flatnonzero(samples.complete)
    first = known[: LOOKED_AT + DEEPEST]
    found: dict[int, tuple[int, int]] = {}
    for column in range(samples.phi.shape[1]):
        for lag in range(1, min(DEEPEST, len(samples.y) - 1) + 1):
            match = [
                j
                for j in range(samples.y.shape[1])
                if all(is_past(samples, rows, column, lag, j) for rows in (first, known))
            ]
            if match:
                found[column] = (lag, match[0])
                break
    return Feedback(found, samples.y.shape[1])


def of_layout(layout: Layout) -> Feedback:
    """The same of a model with coloured noise, whose regressors are filtered: no value tells."""
    return Feedback(
        {place: (place + 1, 0) for place in layout.past_outputs}, 1, of_noise=layout.of_noise
    )


def is_past(samples: Samples, rows: NDArray[np.intp], column: int, lag: int, output: int) -> bool:
    """Whether a column is an output, `lag` rows ago, in these rows."""
    rows = rows[rows >= lag]
    now, then = samples.phi[rows, column], samples.y[rows - lag, output]
    return len(rows) > 1 and np.array_equal(now, then) and not (then == then[0]).all()
