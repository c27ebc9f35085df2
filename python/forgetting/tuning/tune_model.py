"""`forgetting.tune_model`: the search for arrays, also for the orders of a named structure."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from forgetting._core import InvalidInput
from forgetting.frames.channels import paired
from forgetting.models.lags import Array
from forgetting.models.named import NamedModel
from forgetting.models.orders import Orders
from forgetting.tuning.choose import SHARE, choose
from forgetting.tuning.code import model_code
from forgetting.tuning.problem import Problem
from forgetting.tuning.regression import of_lags
from forgetting.tuning.result import Lines, Tuning
from forgetting.tuning.runner import Progress
from forgetting.tuning.signals import Signals
from forgetting.tuning.structures import ModelOrders, models_of, widest_of


def tune_model(
    u: ArrayLike | None,
    y: ArrayLike,
    model: str,
    *,
    offset: bool = False,
    rules: str | Sequence[str] = "shortlist",
    rates: bool = True,
    priors: bool = True,
    share: float = SHARE,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Tuning:
    """As `tune`, for the orders and the delay of a model by name, too.

    Parameters
    ----------
    u : array_like, shape (T,) or (T, inputs), or None
        Inputs, NaN where missing.
    y : array_like, shape (T,) or (T, 1)
        The output, NaN where missing; of a model that is linear in its parameters several.
    model : str
        Structure (fir, ar, arx, arma, armax, oe or bj) and orders, each a number or a range, as in
        ``"armax:na=1-3,nb=1-3,nc=0-2,nk=1-4"``. Of orders that are not named the usual ones are
        tried.
    offset : bool
        Whether the model has a constant.
    rules, rates, priors, share, threads, progress
        As in `tune`.

    Returns
    -------
    Tuning
        With the model in `orders`; ``found.python`` makes it.

    Raises
    ------
    InvalidInput, ImportError
        As in `tune`, for a model that cannot be read, and for more than 300 models.

    Notes
    -----
    Models whose noise is not white are run as a whole by each estimator that is tried.

    Examples
    --------
    >>> import numpy as np
    >>> import forgetting as fg
    >>> u, e = np.random.default_rng(0).normal(size=(2, 1500))
    >>> y = np.zeros(1500)
    >>> for k in range(2, 1500):
    ...     y[k] = 0.9 * y[k - 1] + u[k - 2] + 0.3 * (e[k] + 0.8 * e[k - 1])
    >>> models = "armax:na=1-2,nb=1,nc=0-1,nk=1-3"
    >>> found = fg.tune_model(u, y, models, rules=["none"], priors=False)
    >>> found.python
    'fg.ARMAX(na=1, nb=1, nc=1, nk=2, rule=fg.NoForgetting())'
    """
    inputs, outputs = paired(u, y)
    models = models_of(model, inputs.shape[1])

    def make(orders: ModelOrders | None) -> Problem:
        if isinstance(orders, NamedModel):
            return signals(orders, inputs, outputs, offset)
        assert isinstance(orders, Orders)
        return of_lags(orders, inputs, outputs, offset)

    return choose(
        make,
        models,
        make(widest_of(models, inputs.shape[1])),
        lambda candidate: Lines(model_code(candidate, offset)),
        rules=rules,
        rates=rates,
        priors=priors,
        share=share,
        threads=threads,
        progress=progress,
    )


def signals(named: NamedModel, inputs: Array, outputs: Array, offset: bool) -> Signals:
    """The signals of a model with coloured noise."""
    if outputs.shape[1] != 1:
        raise InvalidInput(f"y has {outputs.shape[1]} outputs; a model {named.name} has one")
    output = np.ascontiguousarray(outputs[:, 0])
    return Signals(named.make(offset=offset), inputs, output, np.arange(len(output)))
