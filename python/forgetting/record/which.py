"""What the model of a record is: a formula, ARX orders, or a structure by its name."""

from __future__ import annotations

from collections.abc import Sequence

from forgetting._core import InvalidInput
from forgetting.models.named import NamedModel
from forgetting.models.orders import Each
from forgetting.record.dynamics import dynamics
from forgetting.record.names import clean
from forgetting.record.read import Record
from forgetting.record.samples import Samples
from forgetting.words.errors import RecordError


def which(
    formula: str | None, arx: Sequence[Each] | None, model: str | None
) -> tuple[Sequence[Each] | None, NamedModel | None]:
    """What the model is: ARX orders, or a model that is not linear in its parameters, or neither.

    Examples
    --------
    >>> which(None, None, "fir:nb=3"), which(None, None, "oe:nb=1,nf=1,nk=1")[0]
    (((0, 3, 0), None), None)
    """
    if model is None:
        return arx, None
    if formula is not None or arx is not None:
        raise RecordError("say the model once: as a model, by arx, or by a formula")
    try:
        named = NamedModel.parse(model)
        orders = named.arx
    except InvalidInput as error:
        raise RecordError(str(error)) from None
    return (None, named) if orders is None else ((orders.na, orders.nb, orders.nk), None)


def build(
    record: Record,
    formula: str | None,
    outputs: list[str],
    inputs: list[str],
    arx: Sequence[Each] | None,
    offset: bool = True,
) -> Samples:
    """Choose between a formula and ARX, and refuse half of one with half of the other."""
    if formula is not None:
        if outputs or inputs or arx is not None:
            raise RecordError("say the model by a formula, or by output, input and arx; not both")
        # Imported here: a program that only wants ARX need not have formulaic.
        from forgetting.record.regression import regression

        return regression(record, formula)
    if arx is None or not outputs:
        raise RecordError("say the model: a formula, or output columns with ARX orders na,nb,nk")
    return dynamics(record, outputs, inputs, arx, offset)


def listed(names: str | Sequence[str]) -> list[str]:
    """One name or several, as a list; numbers name columns, too."""
    several = isinstance(names, Sequence) and not isinstance(names, str)
    return [clean(name) for name in (names if several else [names])]
