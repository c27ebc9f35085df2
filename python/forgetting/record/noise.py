"""The noise that priors are weighed against, where nobody says it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting.record.courses import start
from forgetting.record.moved import Moved
from forgetting.words.errors import RecordError


def refuse_functions(rule: Any, gate: Any) -> None:
    """Refuse to find the noise by a run more of an estimator that calls functions of the user's."""
    if "<" in f"{rule!r} {gate!r}":
        raise RecordError("a prior beside a function of yours needs the noise, such as noise=0.1")


def noise_of(errors: NDArray[np.float64], samples: Moved) -> float:
    """The root mean square of errors (T, 1) after the start."""
    learning = start(samples)
    late = samples.complete & (np.cumsum(samples.complete) > learning)
    noise = float(np.sqrt(np.nanmean(errors[late] ** 2))) if late.any() else float("nan")
    if not noise > 0:
        raise RecordError("the record does not tell the noise; a prior needs it, such as noise=0.1")
    return noise
