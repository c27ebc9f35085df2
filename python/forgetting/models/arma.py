"""ARMA: a signal without a measured input, whose noise is not white."""

from __future__ import annotations

from typing import Any

from numpy.typing import ArrayLike

from forgetting.models.polynomial import Polynomial


class ARMA(Polynomial):
    """AutoRegressive Moving Average model, y(k) = a1 y(k-1) + ... + e(k) + c1 e(k-1) + ...

    Parameters
    ----------
    na, nc : int
        Coefficients of A and C.
    offset, rule, method, weighting, gate, initial_covariance, dtype
        As those of `ARMAX`.

    Attributes
    ----------
    theta_ : ndarray, shape (n,)
        Estimate [a, c, offset].
    covariance_, noise_variance_, names_, estimator_, samples_, used_, n_inputs_
        As those of `ARMAX`.

    Examples
    --------
    >>> import numpy as np
    >>> import forgetting as fg
    >>> rng = np.random.default_rng(0)
    >>> y = np.zeros(4000)
    >>> e = rng.normal(size=4000)
    >>> for k in range(1, 4000):
    ...     y[k] = 0.9 * y[k - 1] + e[k] - 0.5 * e[k - 1]
    >>> model = fg.ARMA(na=1, nc=1, rule="none").fit(None, y)
    >>> bool(np.abs(model.theta_ - [0.9, -0.5]).max() < 0.05)
    True
    """

    def __init__(
        self,
        na: int = 1,
        nc: int = 1,
        *,
        offset: bool = False,
        rule: Any = "auto",
        method: str = "prediction_error",
        weighting: Any = None,
        gate: Any = None,
        initial_covariance: ArrayLike | None = None,
        dtype: str = "float64",
    ) -> None:
        self.na = na
        self.nc = nc
        self.offset = offset
        self.rule = rule
        self.method = method
        self.weighting = weighting
        self.gate = gate
        self.initial_covariance = initial_covariance
        self.dtype = dtype
