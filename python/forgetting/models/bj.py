"""BJ: inputs and noise with poles of their own."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from numpy.typing import ArrayLike

from forgetting.models.polynomial import Polynomial


class BJ(Polynomial):
    """Box-Jenkins model, y = sum of B/F u + C/D e: inputs and noise have poles of their own.

    w(k) = f1 w(k-1) + ... + b1 u(k-nk) + ... for each input, and
    v(k) = d1 v(k-1) + ... + e(k) + c1 e(k-1) + ... for what is left of y.

    Parameters
    ----------
    nb : int or sequence of int
        Coefficients of B, one order for all inputs or one for each.
    nc, nd : int
        Coefficients of C and D: those of the noise.
    nf : int or sequence of int
        Coefficients of F, one order for all inputs or one for each.
    nk : int or sequence of int
        Delay of each input in samples; with 1, the default, u(k-1) is the newest that acts on y(k).
    offset, rule, method, weighting, gate, initial_covariance, dtype
        As those of `ARMAX`.

    Attributes
    ----------
    theta_ : ndarray, shape (n,)
        Estimate [b of each input, c, d, f of each input, offset].
    covariance_, noise_variance_, names_, estimator_, samples_, used_, n_inputs_
        As those of `ARMAX`.

    Examples
    --------
    >>> import numpy as np
    >>> import forgetting as fg
    >>> rng = np.random.default_rng(0)
    >>> u, e = rng.normal(size=(2, 4000))
    >>> w, v = np.zeros((2, 4000))
    >>> for k in range(1, 4000):
    ...     w[k] = 0.9 * w[k - 1] + u[k - 1]
    ...     v[k] = 0.7 * v[k - 1] + e[k] + 0.5 * e[k - 1]
    >>> model = fg.BJ(nb=1, nc=1, nd=1, nf=1, rule="none").fit(u, w + v)
    >>> bool(np.abs(model.theta_ - [1.0, 0.5, 0.7, 0.9]).max() < 0.06)
    True
    """

    def __init__(
        self,
        nb: int | Sequence[int] = 1,
        nc: int = 1,
        nd: int = 1,
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
        self.nc = nc
        self.nd = nd
        self.nf = nf
        self.nk = nk
        self.offset = offset
        self.rule = rule
        self.method = method
        self.weighting = weighting
        self.gate = gate
        self.initial_covariance = initial_covariance
        self.dtype = dtype
