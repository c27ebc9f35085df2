"""What rows of a stream brought."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting.stream.rows import Array, Flags


@dataclass(frozen=True)
class Estimates:
    """What T rows brought.

    Attributes
    ----------
    theta : ndarray, shape (T, n, m)
    error, prediction : ndarray, shape (T, m)
    standard_errors : ndarray, shape (T, n, m), or None
        None where they were not asked for.
    noise_variance : ndarray, shape (T, m)
    skipped : ndarray of uint8, shape (T,)
        See `forgetting.SKIPPED`.
    refused : ndarray of bool, shape (T,)
        Rows that were left out because they would have left the range of numbers.
    others : dict of str to ndarray
        Further outputs of the estimator's `run`, by name.
    """

    theta: Array
    error: Array
    prediction: Array
    standard_errors: Array | None
    noise_variance: Array
    skipped: NDArray[np.uint8]
    refused: Flags
    others: dict[str, NDArray[Any]]
