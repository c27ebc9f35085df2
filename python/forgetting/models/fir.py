"""FIR: a response that dies out, without feedback."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from numpy.typing import ArrayLike

from forgetting.models.arx import ARX


class FIR(ARX):
    """Finite Impulse Response model, y(k) = b1 u(k-nk) + ... + noise.

    Parameters
    ----------
    nb, nk : int or sequence of int
        Coefficients of each input, and the delay of the newest in samples.
    offset, rule, weighting, gate, initial_covariance, dtype
        As those of `ARX`, which this is without past outputs.

    Attributes
    ----------
    theta_, covariance_, estimator_, samples_, used_, names_
        As those of `ARX`.

    Examples
    --------
    >>> import numpy as np
    >>> import forgetting as fg
    >>> u = np.random.default_rng(0).normal(size=300)
    >>> y = np.convolve(u, [0.5, 0.3, 0.1])[:300]
    >>> np.round(fg.FIR(nb=3, rule="none").fit(u, y).theta_, 4)
    array([0.5, 0.3, 0.1])
    """

    def __init__(
        self,
        nb: int | Sequence[int] = 1,
        nk: int | Sequence[int] = 0,
        rule: Any = "auto",
        initial_covariance: ArrayLike | None = None,
        dtype: str = "float64",
        *,
        offset: bool = False,
        weighting: Any = None,
        gate: Any = None,
    ) -> None:
        settings = {"offset": offset, "weighting": weighting, "gate": gate}
        super().__init__(0, nb, nk, rule, initial_covariance, dtype, **settings)
