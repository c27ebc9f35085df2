"""What a model makes of rows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting.models.signal_origin import SignalOrigin
from forgetting.stream.rows import Array, Flags


@dataclass(frozen=True)
class Seen:
    """What a model that makes its regressors from its own estimates knows of T rows.

    Attributes
    ----------
    measured, error : ndarray, shape (T, 1)
        The output and its one-step error, NaN where the row was left out.
    trust : ndarray, shape (T,)
        What each row counts, in (0, 1]: less at the start.
    theta : ndarray, shape (T, n)
        Estimate after each row, with the constant of signals as they are, of the parameters that
        are estimated.
    outputs : dict of str to ndarray
        What the estimator told of each row, see `Learner.wanted`.
    origin : SignalOrigin or None
        What it measures its signals from; None without a constant.
    refused : ndarray of bool, shape (T,)
        Rows that were left out because they would have left the range of numbers.
    reason : str
        What was said of the first of them.
    """

    measured: Array
    error: Array
    trust: Array
    theta: Array
    outputs: dict[str, NDArray[Any]]
    origin: SignalOrigin | None
    refused: Flags
    reason: str = ""


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
        return Samples(missing_else(self.phi, rows), missing_else(self.y, rows))


def missing_else(values: Array, rows: Flags) -> Array:
    """The values in the rows that are marked, NaN in the others."""
    found = np.full((len(rows), values.shape[1]), np.nan)
    found[rows] = values
    return found
