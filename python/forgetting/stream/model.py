"""What a stream asks of a model: regressors of rows that go on from those before."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

from forgetting.models.named import NamedModel
from forgetting.record.names import clean
from forgetting.stream.dynamics import Dynamics
from forgetting.stream.form import Form
from forgetting.stream.rows import Array, Flags
from forgetting.stream.samples import Samples
from forgetting.stream.settings import Settings
from forgetting.stream.signals import Signals
from forgetting.words.errors import RecordError


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

    def samples(self, values: Array, gap: Flags) -> Samples:
        """Regressors (T, n) and outputs (T, m) of rows that go on from those before.

        Parameters
        ----------
        values : ndarray, shape (T, c)
        gap : ndarray of bool, shape (T,)
            Rows with a gap before them: what lies before it is missing in their lags.
        """
        ...

    def state(self) -> dict[str, Any]:
        """The rows that lags still reach, or what else the next row needs."""
        ...

    def restore(self, state: dict[str, Any]) -> None:
        """Go on from a saved state."""
        ...


def make_model(form: Form, own: Settings) -> Model:
    """The model of a stream with these columns.

    Raises
    ------
    RecordError
        When a column is not there, or half of one model stands with half of another.
    """
    if own.formula is not None:
        if own.output or own.input or own.arx is not None:
            raise RecordError("say the model by a formula, or by output, input and arx; not both")
        # Imported here: a program that only wants ARX need not have formulaic.
        from forgetting.stream.formula import Regression

        return Regression(own.formula, form)
    if not own.output:
        raise RecordError("say the model: a formula, or output columns, with inputs or ARX orders")
    outputs, inputs = named(form, own.output), named(form, own.input)
    if own.model is not None:
        return Signals(outputs, inputs, NamedModel.parse(own.model), own.offset)
    orders = (0, 1, 0) if own.arx is None else own.arx
    return Dynamics(outputs, inputs, orders, own.offset)


def named(form: Form, given: Sequence[str]) -> list[str]:
    """Columns, each given by itself or several with commas between them."""
    found: list[str] = []
    for name in map(clean, given):
        parts = [name] if name in form.names else name.split(",")
        found += [form.column(part.strip()) for part in parts]
    return found
