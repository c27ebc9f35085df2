"""Which coefficients `ARMA`, `ARMAX`, `OE` and `BJ` have, for so many inputs; no data needed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import InvalidInput, SignalModel
from forgetting.models.layout import Layout
from forgetting.models.orders import an_order, per_input
from forgetting.models.signal_origin import SignalOrigin

Array = NDArray[np.float64]


class PolynomialStructure:
    """The orders of a model of polynomials, and what follows from them."""

    na: int = 0
    nb: int | Sequence[int] = 0
    nc: int = 0
    nd: int = 0
    nf: int | Sequence[int] = 0
    nk: int | Sequence[int] = 0
    offset: bool = False
    method: str = "prediction_error"

    def terms(self, inputs: Sequence[str], output: str = "y") -> list[str]:
        """What each coefficient stands at, for inputs of these names.

        Examples
        --------
        >>> import forgetting as fg
        >>> fg.ARMAX(na=1, nb=1, nc=1).terms(["u"])
        ['y(k-1)', 'u(k-1)', 'e(k-1)']
        """
        orders = self._orders(len(inputs))
        each = list(zip(inputs, orders["inputs"], strict=True))
        names = [f"{output}(k-{lag})" for lag in range(1, orders["na"] + 1)]
        for name, (nb, _, nk) in each:
            names += [f"{name}(k-{lag})" if lag else f"{name}(k)" for lag in range(nk, nk + nb)]
        names += [f"e(k-{lag})" for lag in range(1, orders["nc"] + 1)]
        names += [f"v(k-{lag})" for lag in range(1, orders["nd"] + 1)]
        for name, (_, nf, _) in each:
            names += [f"w[{name}](k-{lag})" for lag in range(1, nf + 1)]
        return names + ["offset"] * self.offset

    def reach_of(self, inputs: int) -> int:
        """`reach` for so many inputs."""
        nb, nk = per_input("nb", self.nb, inputs), per_input("nk", self.nk, inputs)
        lags = [delay + order - 1 for delay, order in zip(nk, nb, strict=True)]
        return max(self.na, *lags, 0)

    def at_rest(
        self,
        inputs: int,
        fixed: Mapping[int, float] | None = None,
        prior: Mapping[int, float] | None = None,
    ) -> SignalModel:
        """What makes regressors of so many inputs and an output, before the first sample.

        What is known of parameters goes by their places, see `SignalModel`.
        """
        return SignalModel(
            **self._orders(inputs),
            constant=self.offset,
            method=self.method,
            fixed=fixed,
            prior=prior,
        )

    def origin(
        self,
        first: Array,
        fixed: Mapping[int, float] | None = None,
        prior: Mapping[int, float] | None = None,
    ) -> SignalOrigin | None:
        """What `at_rest` measures from, by the first values of all inputs and the output, (i + 1,).

        None, as zero is the origin, without a constant or where something is known of it.
        """
        layout = self.layout(len(first) - 1)
        place = layout.end
        if not self.offset or place in (fixed or {}) or place in (prior or {}):
            return None
        return SignalOrigin.of(first, layout, fixed)

    def layout(self, inputs: int) -> Layout:
        """Where the parameters of each polynomial stand, for so many inputs."""
        orders = self._orders(inputs)
        each = [(nb, nf) for nb, nf, _ in orders["inputs"]]
        return Layout.of(orders["na"], each, orders["nc"] + orders["nd"])

    def _orders(self, inputs: int) -> dict[str, Any]:
        has_inputs = np.any(np.asarray(self.nb) != 0)
        if bool(has_inputs) != (inputs > 0):
            raise InvalidInput(
                f"nb is {self.nb} but u has {inputs} input(s); nb = 0 goes with u = None"
            )
        each = [per_input(name, getattr(self, name), inputs) for name in ("nb", "nf", "nk")]
        scalars = {name: an_order(name, getattr(self, name)) for name in ("na", "nc", "nd")}
        return scalars | {"inputs": list(zip(*each, strict=True))}
