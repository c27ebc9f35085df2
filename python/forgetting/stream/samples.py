"""What a model makes of rows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forgetting.models.signal_origin import SignalOrigin
from forgetting.stream.rows import Array, Flags


@dataclass(frozen=True)
class Seen:
    """What a model that makes its regressors from its own estimates knows of T rows.

    Attributes
    ----------
    measured, error : ndarray, shape (T, 1)
        The output and its one-step error, NaN where the row was left out.
    theta : ndarray, shape (T, n)
        Estimate after each row, with the constant of signals as they are.
    before : ndarray, shape (n,)
        That of the row before.
    origin : SignalOrigin or None
        What it measures its signals from; None without a constant.
    refused : ndarray of bool, shape (T,)
        Rows that were left out because they would have left the range of numbers.
    reason : str
        What was said of the first of them.
    """

    measured: Array
    error: Array
    theta: Array
    before: Array
    origin: SignalOrigin | None
    refused: Flags
    reason: str = ""

    def spread(self, rows: Flags) -> Seen:
        """For more rows, of which only those that are marked brought something."""
        latest = np.cumsum(rows)
        return Seen(
            missing_else(self.measured, rows),
            missing_else(self.error, rows),
            np.vstack([self.before, self.theta])[latest],
            self.before,
            self.origin,
            np.concatenate([[False], self.refused])[np.where(rows, latest, 0)],
            self.reason,
        )


@dataclass(frozen=True)
class Samples:
    """Regressors and outputs of T rows, as an estimator takes them.

    Attributes
    ----------
    phi : ndarray, shape (T, n)
    y : ndarray, shape (T, m)
        NaN where something is missing.
    seen : Seen or None
        Of a model that makes its regressors from its own estimates; y is then what makes it linear
        in the parameters.
    """

    phi: Array
    y: Array
    seen: Seen | None = None

    def spread(self, rows: Flags) -> Samples:
        """For more rows, of which only those that are marked are samples."""
        seen = None if self.seen is None else self.seen.spread(rows)
        return Samples(missing_else(self.phi, rows), missing_else(self.y, rows), seen)


def missing_else(values: Array, rows: Flags) -> Array:
    """The values in the rows that are marked, NaN in the others."""
    found = np.full((len(rows), values.shape[1]), np.nan)
    found[rows] = values
    return found
