"""A model whose regressors need what it made of earlier samples: ARMAX and its kin.

Each estimator makes regressors of its own, so that all of the model is run again for each.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import RLS, NumericalRange
from forgetting.choices import AXES
from forgetting.models.polynomial import Polynomial
from forgetting.tuning.problem import Array, Mask

SAMPLE = re.compile(r"\bsample (\d+)")


@dataclass(frozen=True)
class Signals:
    """Inputs and an output, NaN where a value is missing; see `forgetting.tuning.problem`.

    Attributes
    ----------
    model : Polynomial
        The structure; nothing of it is fitted.
    inputs : ndarray, shape (S, inputs)
        With as many rows of nothing between separate stretches as lags reach.
    output : ndarray, shape (S,)
    rows : ndarray of int, shape (T,)
        Which of these are rows of the record.
    """

    model: Polynomial
    inputs: Array
    output: Array
    rows: NDArray[np.int64]

    @property
    def y(self) -> Array:
        """The output as it was measured, (T, 1)."""
        return self.output[self.rows, None]

    @cached_property
    def parameters(self) -> int:
        """Number n of parameters."""
        return int(self.model.at_rest(self.inputs.shape[1]).parameters)

    @property
    def complete(self) -> Mask:
        """Samples of which all lags were measured, (T,)."""
        return np.asarray(~np.isnan(self.plain["error"]), dtype=np.bool_)

    @cached_property
    def plain(self) -> dict[str, Array]:
        """What the model that never forgets is given and what it does: see `learn`."""
        never = RLS(self.parameters, rule=AXES["rule"].make("none"))
        return self.learn(never, ("phi", "y", "error"))

    def learn(
        self, estimator: Any, outputs: tuple[str, ...], stop: int | None = None
    ) -> dict[str, Array]:
        """Outputs of `Polynomial.course`, by name, on the rows before `stop`.

        Raises
        ------
        forgetting.NumericalRange
            When the estimator ran out of the range of numbers.
        """
        own = self.rows[:stop]
        last = int(own[-1]) + 1 if len(own) else 0
        model = self.model.at_rest(self.inputs.shape[1])
        try:
            kept = model.learn(estimator, self.inputs[:last], self.output[:last], outputs)
        except NumericalRange as error:
            raise NumericalRange(self._in_rows(str(error))) from None
        return {name: np.asarray(kept[name])[own] for name in outputs}

    def _in_rows(self, message: str) -> str:
        """Turn "sample 3" of the signals into a row of the record, which is counted from 1."""
        return SAMPLE.sub(
            lambda found: f"row {int(np.searchsorted(self.rows, int(found[1]))) + 1}", message, 1
        )

    def errors(self, estimator: Any, stop: int | None = None, follows: bool = True) -> Array:
        """See `Problem`."""
        found = self.learn(estimator, ("error",), stop)["error"]
        return np.asarray(found, dtype=np.float64)[:, None]

    def mean_squares(self, stop: int) -> Array:
        """See `Problem`; of the regressors of the model that never forgets."""
        return np.asarray(np.nanmean(np.square(self.plain["phi"][:stop]), axis=0))

    def part(self, rows: slice) -> Signals:
        """See `Problem`; the model starts at rest there."""
        own = self.rows[rows]
        whole = slice(int(own[0]), int(own[-1]) + 1)
        inputs, output = self.inputs[whole], self.output[whole]
        return replace(self, inputs=inputs, output=output, rows=own - own[0])
