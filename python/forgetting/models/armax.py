"""ARMAX: inputs, and noise that is not white."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from numpy.typing import ArrayLike

from forgetting.models.polynomial import Polynomial


class ARMAX(Polynomial):
    """AutoRegressive Moving Average model with eXogenous inputs.

    y(k) = a1 y(k-1) + ... + b1 u(k-nk) + ... + e(k) + c1 e(k-1) + ..., e white. Where the
    noise of an equation is not white, `ARX` is biased: this model says what colour it has.

    Parameters
    ----------
    na : int
        Coefficients of A: past outputs.
    nb : int or sequence of int
        Coefficients of B, one order for all inputs or one for each.
    nc : int
        Coefficients of C: past noise.
    nk : int or sequence of int
        Delay of each input in samples; with 1, the default, u(k-1) is the newest that acts on y(k).
    offset : bool, default False
        Whether there is a constant: for data that are not deviations from an operating point.
    rule : str or Rule, default "auto"
        Forgetting rule, by name or as an object such as ``fg.Subspace(0.98)``; "auto" mixes rules
        of all speeds, see `forgetting.Bank`.
    method : {"prediction_error", "extended_least_squares"}
        Whether the estimator is given the gradient of the prediction (Ljung 1999, section 10.3), or
        what the prediction is made of, which costs less and converges only where C is close to 1.
    weighting, gate : optional
        As those of `RLS`.
    initial_covariance : float or array_like, optional
        P before the first sample, in units of 1/phi². If not given it follows the data, and units
        do not matter.
    dtype : str
        "float64" or "float32", the precision of the estimator.

    Attributes
    ----------
    theta_, covariance_, noise_variance_ : ndarray, ndarray, float
        Estimate [a, b of each input, c, offset],
        P and the variance of e; the product of the latter two is the covariance of the estimate.
    names_ : list of str
        What each coefficient stands at, such as "y(k-1)".
    estimator_ : RLS or Bank
        The estimator itself.
    samples_, used_, n_inputs_ : int
        Rows seen since `fit`, how many of them were used, and the number of inputs.

    Examples
    --------
    >>> import numpy as np
    >>> import forgetting as fg
    >>> rng = np.random.default_rng(0)
    >>> u, e = rng.normal(size=(2, 4000))
    >>> y = np.zeros(4000)
    >>> for k in range(1, 4000):
    ...     y[k] = 0.9 * y[k - 1] + u[k - 1] + e[k] - 0.8 * e[k - 1]
    >>> model = fg.ARMAX(na=1, nb=1, nc=1, rule="none").fit(u, y)
    >>> bool(np.abs(model.theta_ - [0.9, 1.0, -0.8]).max() < 0.05)
    True
    >>> float(np.round(fg.ARX(na=1, nb=1, nk=1, rule="none").fit(u, y).theta_[0], 1)) < 0.9
    True
    """

    def __init__(
        self,
        na: int = 1,
        nb: int | Sequence[int] = 1,
        nc: int = 1,
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
        self.na = na
        self.nb = nb
        self.nc = nc
        self.nk = nk
        self.offset = offset
        self.rule = rule
        self.method = method
        self.weighting = weighting
        self.gate = gate
        self.initial_covariance = initial_covariance
        self.dtype = dtype
