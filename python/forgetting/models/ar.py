"""AR: a signal that follows its own past."""

from __future__ import annotations

from typing import Any

from numpy.typing import ArrayLike

from forgetting.models.arx import ARX


class AR(ARX):
    """AutoRegressive model, y(k) = a1 y(k-1) + ... + noise; `fit(None, y)`.

    Parameters
    ----------
    na : int
        Past outputs.
    offset, rule, weighting, gate, initial_covariance, dtype
        As those of `ARX`, which this is without inputs.

    Attributes
    ----------
    theta_, covariance_, estimator_, samples_, used_, names_
        As those of `ARX`.

    Examples
    --------
    >>> import numpy as np
    >>> import forgetting as fg
    >>> y = 0.9 ** np.arange(50)
    >>> np.round(fg.AR(na=1, rule="none").fit(None, y).theta_, 4)
    array([0.9])
    """

    def __init__(
        self,
        na: int = 1,
        rule: Any = "auto",
        initial_covariance: ArrayLike | None = None,
        dtype: str = "float64",
        *,
        offset: bool = False,
        weighting: Any = None,
        gate: Any = None,
    ) -> None:
        settings = {"offset": offset, "weighting": weighting, "gate": gate}
        super().__init__(na, 0, 0, rule, initial_covariance, dtype, **settings)
