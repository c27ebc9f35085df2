"""OE: an output whose noise is that of the sensor alone."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from numpy.typing import ArrayLike

from forgetting.models.polynomial import Polynomial


class OE(Polynomial):
    """Output Error model, y(k) = w(k) + e(k) with w(k) = f1 w(k-1) + ... + b1 u(k-nk) + ...

    The noise is that of the sensor alone; of all models it is the one that simulates best.

    Parameters
    ----------
    nb, nf : int or sequence of int
        Coefficients of B and F, one order for all inputs or one for each.
    nk : int or sequence of int
        Delay of each input in samples; with 1, the default, u(k-1) is the newest that acts on y(k).
    offset, rule, method, weighting, gate, initial_covariance, dtype
        As those of `ARMAX`.

    Attributes
    ----------
    theta_ : ndarray, shape (n,)
        Estimate [b of each input, f of each input, offset].
    covariance_, noise_variance_, names_, estimator_, samples_, used_, n_inputs_
        As those of `ARMAX`.

    Examples
    --------
    >>> import numpy as np
    >>> import forgetting as fg
    >>> rng = np.random.default_rng(0)
    >>> u, e = rng.normal(size=(2, 4000))
    >>> w = np.zeros(4000)
    >>> for k in range(1, 4000):
    ...     w[k] = 0.9 * w[k - 1] + u[k - 1]
    >>> model = fg.OE(nb=1, nf=1, rule="none").fit(u, w + e)
    >>> bool(np.abs(model.theta_ - [1.0, 0.9]).max() < 0.05)
    True
    """

    def __init__(
        self,
        nb: int | Sequence[int] = 1,
        nf: int | Sequence[int] = 1,
        nk: int | Sequence[int] = 1,
        *,
        offset: bool = False,
        rule: Any = "auto",
        method: str = "prediction_error",
        weighting: Any = None,
        gate: Any = None,
        initial_covariance: ArrayLike | None = None,
        dtype: str = "float64",
    ) -> None:
        self.nb = nb
        self.nf = nf
        self.nk = nk
        self.offset = offset
        self.rule = rule
        self.method = method
        self.weighting = weighting
        self.gate = gate
        self.initial_covariance = initial_covariance
        self.dtype = dtype
