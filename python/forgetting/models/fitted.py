"""What a model can say only once it has seen data."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting._core import InvalidInput
from forgetting.frames.channels import channels
from forgetting.models.constructor import Constructor

Array = NDArray[np.float64]


class Fitted(Constructor):
    """A model that `fit` gives an estimator, and what is asked of it before and after."""

    estimator_: Any

    def _check_is_fitted(self) -> None:
        if not hasattr(self, "estimator_"):
            name = type(self).__name__
            raise InvalidInput(f"this {name} has seen no data; call fit or partial_fit first")

    def _learned(self, name: str, where: str = "estimator_") -> Any:
        # AttributeError (not InvalidInput), so that hasattr(model, "theta_") is False before fit.
        if not hasattr(self, "estimator_"):
            raise AttributeError(f"{name} exists after fit or partial_fit")
        return getattr(self, where)


def inputs_of_run(u: ArrayLike | int) -> Array:
    """Inputs (T, inputs) of a run; (T, 0) where u is the number T of samples."""
    return np.empty((u, 0)) if isinstance(u, int) else channels("u", u)
