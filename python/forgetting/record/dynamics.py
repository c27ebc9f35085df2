"""ARX models over a record."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from forgetting.models.lags import Array, names, regressors
from forgetting.models.orders import Each, Orders
from forgetting.record.columns import numbers
from forgetting.record.read import Record
from forgetting.record.samples import Samples
from forgetting.words.errors import RecordError

CONSTANT = "offset"
"""What the constant of an ARX model is called."""


def dynamics(
    record: Record,
    outputs: Sequence[str],
    inputs: Sequence[str],
    arx: Sequence[Each],
    offset: bool = True,
) -> Samples:
    """Build the samples of y(k) = phi(k) theta for named outputs and inputs.

    Parameters
    ----------
    record : Record
        The measured record. A missing cell, or a gap of its clock (see `forgetting.record.read`),
        is a gap; samples whose lags cross it are NaN.
    outputs, inputs : sequence of str
        Column names; several outputs share one regressor.
    arx : sequence of three
        Orders na, nb, nk; nb and nk may be sequences, with an order for each input.
    offset : bool
        Whether the last regressor is the constant 1, for data that are not deviations from rest.
    """
    if not outputs:
        raise RecordError("an ARX model needs at least one output column")
    orders = checked_orders(arx, inputs)
    refuse_repeats(outputs, inputs)
    y = columns(record, outputs)
    u = columns(record, inputs)
    phi = np.vstack([regressors(u[part], y[part], orders) for part in stretches(record)])
    cut = int((np.isnan(phi) & ~np.isnan(regressors(u, y, orders))).any(axis=1).sum())
    model = f"ARX({orders}) of {', '.join(outputs)}"
    model += f" on {', '.join(inputs)}" if inputs else ""
    labels = tuple(names(outputs, inputs, orders))
    if offset:
        phi = np.column_stack([phi, np.where(np.isnan(phi).any(axis=1), np.nan, 1.0)])
        labels += (CONSTANT,)
    return Samples(
        phi, y, labels, tuple(outputs), model, record.clock, record.name, cut, record.found
    ).check()


def checked_orders(arx: Sequence[Each], inputs: Sequence[str]) -> Orders:
    """Check the orders against the inputs given."""
    if len(arx) != 3:
        raise RecordError(f"ARX orders are na,nb,nk, three whole numbers; got {len(arx)}")
    try:
        orders = Orders.of(arx)
    except ValueError as error:
        raise RecordError(str(error)) from None
    if orders.nb and not inputs:
        raise RecordError(f"nb is {orders.nb} but no input is named; use nb = 0 without input")
    if inputs and not orders.nb:
        raise RecordError(f"nb is 0 but {len(inputs)} input column(s) are named")
    try:
        orders.input_lags(len(inputs))
    except ValueError as error:
        raise RecordError(f"{error}: {', '.join(inputs)}") from None
    return orders


def refuse_repeats(outputs: Sequence[str], inputs: Sequence[str]) -> None:
    """Refuse a column named twice: its parameters could not be separated."""
    named = [*outputs, *inputs]
    for name in named:
        if named.count(name) > 1:
            raise RecordError(f"column {name!r} is named twice among outputs and inputs")


def columns(record: Record, names: Sequence[str]) -> Array:
    """Stack named columns as (T, c)."""
    table = [numbers(record.frame, name, record.name) for name in names]
    return np.column_stack(table) if table else np.empty((len(record.frame), 0))


def stretches(record: Record) -> list[slice]:
    """Slices of the record between gaps of its clock."""
    if record.clock is None:
        return [slice(None)]
    cuts = np.flatnonzero(np.diff(record.clock.segments())) + 1
    edges = [0, *cuts.tolist(), len(record.frame)]
    return [slice(start, stop) for start, stop in pairwise(edges)]
