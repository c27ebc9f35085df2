"""What an estimator has found, as a model of which more can be asked."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting.polynomials import PolynomialModel, Structure

Array = NDArray[np.float64]


def identified(
    structure: Structure,
    theta: ArrayLike,
    covariance: Array,
    noise_variance: float,
    labels: tuple[list[str], list[str]],
    *,
    by_lag: bool = False,
    sample_time: float = 1.0,
) -> PolynomialModel:
    """Make the model of an estimate; `labels` are the names of outputs and inputs.

    `by_lag` says that inputs stand in the order of their lags, as those of `ARX` do.
    """
    order = structure.from_lag_order() if by_lag else np.arange(structure.parameters)
    (output,), inputs = labels
    settings: dict[str, Any] = {"sample_time": sample_time, "output_name": output}
    return PolynomialModel.from_parameters(
        structure,
        np.asarray(theta, dtype=np.float64)[order],
        np.asarray(covariance, dtype=np.float64)[np.ix_(order, order)],
        noise_variance,
        input_names=inputs,
        **settings,
    )
