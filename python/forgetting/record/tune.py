"""Choose the settings and the orders of a model of a measured record."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from forgetting.models.named import NamedModel
from forgetting.models.orders import Orders
from forgetting.record.missing import Words
from forgetting.record.origin import origin
from forgetting.record.polynomial import recorded
from forgetting.record.read import Record, read
from forgetting.record.samples import Samples
from forgetting.record.usage import Usage
from forgetting.record.which import build, listed
from forgetting.tuning import structures
from forgetting.tuning.choose import SHARE, choose
from forgetting.tuning.orders import USUAL_NA, order_grid
from forgetting.tuning.problem import Problem
from forgetting.tuning.regression import Regression
from forgetting.tuning.result import Tuning
from forgetting.tuning.runner import Progress
from forgetting.tuning.structures import ModelOrders, widest_of
from forgetting.words.errors import RecordError

if TYPE_CHECKING:
    from narwhals.typing import IntoDataFrame

OrderRanges = Sequence["int | Sequence[int]"]


def tune(
    record: str | Path | IntoDataFrame | Record,
    *,
    formula: str | None = None,
    output: str | Sequence[str] = (),
    input: str | Sequence[str] = (),
    arx: OrderRanges | None = None,
    model: str | None = None,
    offset: bool = True,
    rules: str | Sequence[str] = "shortlist",
    rates: bool = True,
    priors: bool = True,
    share: float = SHARE,
    time: str | None = None,
    gap: str | float | None = None,
    missing: str | float | Words = (),
    part: str | None = None,
    encoding: str | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Tuning:
    """Choose rule, forgetting factor, rate, prior and orders; see `forgetting.tune`.

    The estimators are those of `forgetting.record.identify`, which the lines of the result call.

    Parameters
    ----------
    record, time, gap, missing, part, encoding
        See `forgetting.record.read`.
    formula, output, input, offset
        The model, see `forgetting.record.identify`.
    arx : sequence of three, optional
        Orders na, nb, nk, each a number or several to try; without it na and nb from 1 to 4 and nk
        from 0 to 3 are tried, where outputs are named.
    model : str, optional
        In the place of `arx` a structure and its orders, each a number or a range, such as
        ``"armax:na=1-3,nb=1-3,nc=0-2,nk=1-4"``; see `forgetting.tune_model`.
    rules, rates, priors, share, threads, progress
        See `forgetting.tune`.

    Returns
    -------
    Tuning

    Raises
    ------
    RecordError
        When the file, a column, a cell or the model is at fault.
    forgetting.InvalidInput
        When an argument is out of range, or a part has too few samples.

    Examples
    --------
    >>> import numpy as np, pandas as pd
    >>> random = np.random.default_rng(0)
    >>> x = random.normal(size=600)
    >>> table = pd.DataFrame({"x": x, "y": np.cumsum(0.1 * random.normal(size=600)) * x})
    >>> found = tune(table, formula="y ~ 0 + x", rules=["none", "exponential"], rates=False)
    >>> found.rule.name, found.rest.error("tuned") < found.rest.error("no_forgetting")
    ('exponential', True)
    """
    source = read(record, time, gap=gap, missing=missing, part=part, encoding=encoding)
    outputs, inputs = listed(output), listed(input)
    models = models_of(formula, outputs, inputs, arx, model)
    given = [each for each in models if each is not None]

    def samples(orders: Orders | None) -> Samples:
        lags = None if orders is None else (orders.na, orders.nb, orders.nk)
        return build(source, formula, outputs, inputs, lags, offset)

    def make(orders: ModelOrders | None) -> Problem:
        if isinstance(orders, NamedModel):
            return recorded(source, outputs, inputs, orders, offset).signals
        return problem(samples(orders))

    widest = widest_of(given, len(inputs)) if given else None
    covering = None if isinstance(widest, NamedModel) else samples(widest)
    usage = Usage(
        path=str(record) if isinstance(record, str | Path) else None,
        formula=formula,
        outputs=outputs,
        inputs=inputs,
        offset=offset,
        time=time,
        gap=gap,
        missing=[missing] if isinstance(missing, str | float | int) else list(missing),
        part=part,
        encoding=encoding,
    )
    return choose(
        make,
        models,
        make(widest) if covering is None else problem(covering),
        usage.lines,
        rules=rules,
        rates=rates,
        priors=priors,
        share=share,
        threads=threads,
        progress=progress,
        outputs=outputs if covering is None else covering.outputs,
    )


def problem(samples: Samples) -> Problem:
    """The samples as the search takes them."""
    return Regression(samples.phi, samples.y, origin(samples).moved(samples).rows(slice(None)))


def models_of(
    formula: str | None,
    outputs: list[str],
    inputs: list[str],
    arx: OrderRanges | None,
    model: str | None,
) -> Sequence[ModelOrders | None]:
    """The models to try; [None] where a formula says the model."""
    if model is not None and (formula is not None or arx is not None):
        raise RecordError("say the model once: as a model, by arx, or by a formula")
    if formula is not None:
        if arx is not None:
            raise RecordError("say the model by a formula, or by output, input and arx; not both")
        return [None]
    if not outputs:
        raise RecordError("say the model: a formula, or output columns, with ARX orders or without")
    if model is not None:
        return structures.models_of(model, len(inputs))
    if arx is None:
        return order_grid(USUAL_NA, None, None, len(inputs))
    if len(arx) != 3:
        raise RecordError(f"ARX orders are na,nb,nk, each one or several; got {len(arx)}")
    return order_grid(arx[0], arx[1], arx[2], len(inputs))
