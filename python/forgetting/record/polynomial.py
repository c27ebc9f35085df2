"""Models over a record whose noise is not white or whose output is simulated: ARMAX and its kin."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import InvalidInput, structures
from forgetting.models.named import NamedModel
from forgetting.models.orders import in_text
from forgetting.models.signal_origin import first_values
from forgetting.record.dynamics import columns, refuse_repeats, stretches
from forgetting.record.known import Known
from forgetting.record.read import Record
from forgetting.record.samples import Samples
from forgetting.tuning.signals import Signals
from forgetting.words.errors import RecordError

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Recorded:
    """The columns of a record as the signals of a model.

    Attributes
    ----------
    record : Record
    output : str
    inputs : sequence of str
    named : NamedModel
    signals : Signals
        Across a gap of the clock the model runs on its own predictions, and samples whose lags
        cross it are left out.
    """

    record: Record
    output: str
    inputs: Sequence[str]
    named: NamedModel
    signals: Signals

    def samples(self, phi: Array, y: Array, known: Known | None = None) -> Samples:
        """The linear regression that an estimator was given, (T, n) and (T,)."""
        own, known = self.signals, known or Known()
        terms = own.model.terms(self.inputs, self.output)
        fixed, prior = known.places(terms)
        first = first_values(np.column_stack([own.inputs, own.output]))
        return Samples(
            np.ascontiguousarray(phi),
            y[:, None],
            tuple(terms[i] for i in known.left(terms)),
            (self.output,),
            described(self.named, self.output, self.inputs),
            self.record.clock,
            self.record.name,
            found=self.record.found,
            measured=own.y,
            layout=own.model.layout(len(self.inputs)).without(fixed),
            origin=own.model.origin(first, fixed, prior),
        ).check()

    def plain_samples(self) -> Samples:
        """That of the model that never forgets."""
        plain = self.signals.plain
        return self.samples(plain["phi"], plain["y"])


def recorded(
    record: Record,
    outputs: Sequence[str],
    inputs: Sequence[str],
    named: NamedModel,
    offset: bool = True,
    **settings: Any,
) -> Recorded:
    """Find the signals of a model of one output in a record.

    `settings` are those of the class: rule, gate, initial_covariance, dtype.
    """
    if len(outputs) != 1:
        raise RecordError(f"a model {named.name} has one output; {len(outputs)} columns are named")
    refuse_repeats(outputs, inputs)
    made = named.make(offset=offset, **settings)
    y, u = columns(record, outputs), columns(record, inputs)
    try:
        made.at_rest(len(inputs))  # refuses orders that are too large
        rows = with_gaps(stretches(record), len(y), made.reach_of(len(inputs)))
    except InvalidInput as error:
        raise RecordError(str(error)) from None
    padded = np.vstack([np.hstack([y, u]), np.full((1, 1 + len(inputs)), np.nan)])[rows]
    own = np.flatnonzero(rows < len(y))
    signals = Signals(made, np.ascontiguousarray(padded[:, 1:]), padded[:, 0].copy(), own)
    return Recorded(record, outputs[0], inputs, named, signals)


def with_gaps(parts: Sequence[slice], total: int, reach: int) -> NDArray[np.int64]:
    """Row numbers with as many rows of nothing, numbered `total`, in each gap as lags reach.

    Examples
    --------
    >>> with_gaps([slice(0, 2), slice(2, 4)], total=4, reach=2)
    array([0, 1, 4, 4, 2, 3])
    """
    nothing = np.full(max(reach, 1), total)
    each = [np.arange(total)[part] for part in parts]
    return np.concatenate([rows for part in each for rows in (nothing, part)][1:])


def described(named: NamedModel, output: str, inputs: Sequence[str]) -> str:
    """The model in words.

    Examples
    --------
    >>> described(NamedModel.parse("oe:nb=2/1,nf=1"), "T", ["u", "v"])
    'OE(nb=2/1, nf=1, nk=1) of T on u, v'
    """
    made = named.make()
    orders = {order: getattr(made, order) for order in structures()[named.name][1]}
    each = (f"{order}={in_text(value)}" for order, value in orders.items())
    words = f"{named.name.upper()}({', '.join(each)})"
    return f"{words} of {output}" + (f" on {', '.join(inputs)}" if inputs else "")
