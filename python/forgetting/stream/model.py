"""What stands on the right side of a model, row by row: the constant last, lags across batches."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from forgetting.models.lags import names, regressors
from forgetting.record.dynamics import CONSTANT, checked_orders, refuse_repeats
from forgetting.record.names import clean
from forgetting.stream.form import Form
from forgetting.words.errors import RecordError

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


class Model(Protocol):
    """Makes regressors of values.

    Attributes
    ----------
    columns : tuple of str
        What it reads, in the order in which it takes values.
    outputs, regressors : tuple of str
        What it explains, and by what; a parameter carries the name of its regressor.
    constant : int or None
        The regressor that is the constant 1.
    """

    columns: tuple[str, ...]
    outputs: tuple[str, ...]
    regressors: tuple[str, ...]
    constant: int | None

    def samples(self, values: Array, gap: Flags) -> tuple[Array, Array]:
        """Regressors (T, n) and outputs (T, m) of rows that go on from those before.

        Parameters
        ----------
        values : ndarray, shape (T, c)
        gap : ndarray of bool, shape (T,)
            Rows with a gap before them: what lies before it is missing in their lags.
        """
        ...

    def state(self) -> dict[str, Any]:
        """The rows that lags still reach."""
        ...

    def restore(self, state: dict[str, Any]) -> None:
        """Go on from a saved state."""
        ...


class History:
    """The last rows, and the stretch between gaps that each belongs to."""

    def __init__(self, reach: int, columns: int) -> None:
        self.reach = reach
        self.values = np.empty((0, columns))
        self.stretch: NDArray[np.int64] = np.empty(0, dtype=np.int64)

    def behind(self, values: Array, gap: Flags) -> tuple[Array, NDArray[np.int64], int]:
        """Rows with those before them, their stretches, and how many were before."""
        before = len(self.values)
        latest = int(self.stretch[-1]) if before else 0
        stretch = np.concatenate([self.stretch, latest + np.cumsum(gap)])
        together = np.vstack([self.values, values])
        start = max(len(together) - self.reach, 0)
        self.values, self.stretch = together[start:].copy(), stretch[start:].copy()
        return together, stretch, before

    def state(self) -> dict[str, Any]:
        """As `restore` takes it; stretches count from that of the last row."""
        latest = self.stretch[-1] if len(self.stretch) else 0
        return {"values": self.values.tolist(), "stretch": (self.stretch - latest).tolist()}

    def restore(self, state: dict[str, Any]) -> None:
        """Go on from a saved state."""
        self.values = np.array(state["values"], dtype=np.float64).reshape(-1, self.values.shape[1])
        self.stretch = np.array(state["stretch"], dtype=np.int64)


class Dynamics:
    """An ARX model of named columns; with the orders 0, 1, 0 a regression without lags."""

    def __init__(
        self, outputs: Sequence[str], inputs: Sequence[str], arx: Sequence[int], offset: bool
    ) -> None:
        self.orders = checked_orders(arx, inputs)
        refuse_repeats(outputs, inputs)
        self.outputs, self.inputs = tuple(outputs), tuple(inputs)
        self.columns = self.outputs + self.inputs
        labels = tuple(names(outputs, inputs, self.orders))
        self.constant = len(labels) if offset else None
        self.regressors = (*labels, CONSTANT) if offset else labels
        self.history = History(self.orders.reach, len(self.columns))

    def samples(self, values: Array, gap: Flags) -> tuple[Array, Array]:
        """See `Model`."""
        together, stretch, before = self.history.behind(values, gap)
        y, u = together[:, : len(self.outputs)], together[:, len(self.outputs) :]
        phi = regressors(u, y, self.orders)
        for lag in range(1, self.orders.reach + 1):
            across = np.flatnonzero(stretch[lag:] != stretch[:-lag]) + lag
            phi[across[:, None], self._columns_of(lag)] = np.nan
        if self.constant is not None:
            phi = np.column_stack([phi, np.where(np.isnan(phi).any(axis=1), np.nan, 1.0)])
        return phi[before:], y[before:]

    def _columns_of(self, lag: int) -> list[int]:
        """Places of the regressors with this lag."""
        outputs, inputs, orders = len(self.outputs), len(self.inputs), self.orders
        found: list[int] = []
        if lag <= orders.na:
            found += range((lag - 1) * outputs, lag * outputs)
        if orders.nk <= lag < orders.nk + orders.nb:
            first = orders.na * outputs + (lag - orders.nk) * inputs
            found += range(first, first + inputs)
        return found

    def state(self) -> dict[str, Any]:
        """See `Model`."""
        return self.history.state()

    def restore(self, state: dict[str, Any]) -> None:
        """See `Model`."""
        self.history.restore(state)


def make_model(
    form: Form,
    formula: str | None,
    outputs: Sequence[str],
    inputs: Sequence[str],
    arx: Sequence[int] | None,
    offset: bool,
) -> Model:
    """The model of a stream with these columns.

    Raises
    ------
    RecordError
        When a column is not there, or half of one model stands with half of another.
    """
    if formula is not None:
        if outputs or inputs or arx is not None:
            raise RecordError("say the model by a formula, or by output, input and arx; not both")
        # Imported here: a program that only wants ARX need not have formulaic.
        from forgetting.stream.formula import Regression

        return Regression(formula, form)
    if not outputs:
        raise RecordError("say the model: a formula, or output columns, with inputs or ARX orders")
    orders = (0, 1, 0) if arx is None else arx
    return Dynamics(named(form, outputs), named(form, inputs), orders, offset)


def named(form: Form, given: Sequence[str]) -> list[str]:
    """Columns, each given by itself or several with commas between them."""
    found: list[str] = []
    for name in map(clean, given):
        parts = [name] if name in form.names else name.split(",")
        found += [form.column(part.strip()) for part in parts]
    return found
