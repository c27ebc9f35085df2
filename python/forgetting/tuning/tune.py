"""`forgetting.tune` and `forgetting.tune_arx`: the search for arrays."""

from __future__ import annotations

from collections.abc import Sequence

from numpy.typing import ArrayLike

from forgetting._core import InvalidInput
from forgetting.frames.channels import channels, paired
from forgetting.models.orders import Orders
from forgetting.tuning.candidate import Candidate
from forgetting.tuning.choose import SHARE, choose
from forgetting.tuning.code import estimator_code, model_code
from forgetting.tuning.orders import USUAL_NA, order_grid, widest
from forgetting.tuning.problem import Problem
from forgetting.tuning.regression import Regression, of_lags
from forgetting.tuning.result import Lines, Tuning
from forgetting.tuning.runner import Progress
from forgetting.tuning.structures import ModelOrders


def tune(
    phi: ArrayLike,
    y: ArrayLike,
    *,
    rules: str | Sequence[str] = "shortlist",
    rates: bool = True,
    priors: bool = True,
    share: float = SHARE,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Tuning:
    """Choose rule, forgetting factor, rate and prior by the one-step error; say whether it pays.

    Everything is chosen on the first part of the record and reported on the rest, which no choice
    has seen, beside `Bank`, no forgetting and the last value.

    Parameters
    ----------
    phi : array_like, shape (T, n)
        Regressors; NaN where missing: such a sample is left out.
    y : array_like, shape (T,) or (T, m)
        Outputs, in any unit; several share phi and the settings.
    rules : str or sequence of str
        "shortlist", "all" that say how much they forget by one number, or registry names.
    rates : bool
        Whether variable rates are tried, too.
    priors : bool
        Whether priors are tried beside the one that follows the data.
    share : float
        Of the complete samples, those in the first part; between 0 and 1.
    threads : int, optional
        How many runs go side by side; one for each core if not given.
    progress : callable, optional
        Called with (runs done, runs expected).

    Returns
    -------
    Tuning
        `rule` and `initial_covariance` for `RLS`, `python` (a line that runs), `verdicts()`,
        errors, tests and all that was tried.

    Raises
    ------
    InvalidInput
        When an argument is out of range, or a part has too few samples.
    ImportError
        Without SciPy, which the test needs.

    Notes
    -----
    About a hundred runs over the first part. What is not the default (a rate, a threshold, a prior)
    is proposed only where it lowers the error on the first part by 0.5 %.

    Examples
    --------
    >>> import numpy as np
    >>> import forgetting as fg
    >>> random = np.random.default_rng(0)
    >>> phi = random.normal(size=(1500, 2))
    >>> theta = np.cumsum(0.1 * random.normal(size=(1500, 2)), axis=0)
    >>> found = fg.tune(phi, (phi * theta).sum(axis=1) + 0.1 * random.normal(size=1500))
    >>> found.rest.errors["tuned"] < found.rest.errors["no_forgetting"]
    True
    >>> estimator = eval(found.python)
    """
    outputs = channels("y", y)
    table = channels("phi", phi)
    if len(table) != len(outputs):
        raise InvalidInput(f"phi has {len(table)} rows and y has {len(outputs)}; they must match")
    problem = Regression(table, outputs, (table, outputs))

    def say(candidate: Candidate) -> Lines:
        return Lines(estimator_code(candidate, table.shape[1], outputs.shape[1]))

    return choose(
        lambda orders: problem,
        [None],
        problem,
        say,
        rules=rules,
        rates=rates,
        priors=priors,
        share=share,
        threads=threads,
        progress=progress,
    )


def tune_arx(
    u: ArrayLike | None,
    y: ArrayLike,
    *,
    na: int | Sequence[int] = USUAL_NA,
    nb: int | Sequence[int] | None = None,
    nk: int | Sequence[int] | None = None,
    rules: str | Sequence[str] = "shortlist",
    rates: bool = True,
    priors: bool = True,
    share: float = SHARE,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Tuning:
    """As `tune`, for the orders and the delay of an ARX model, too.

    Parameters
    ----------
    u : array_like, shape (T,) or (T, inputs), or None
        Inputs, NaN where missing.
    y : array_like, shape (T,) or (T, outputs)
        Outputs, NaN where missing.
    na, nb, nk : int or sequence of int
        What is tried; nb from 1 to 4 and nk from 0 to 3 if not given and there is an input.
    rules, rates, priors, share, threads, progress
        As in `tune`.

    Returns
    -------
    Tuning
        Also with `orders`.

    Raises
    ------
    InvalidInput, ImportError
        As in `tune`, and for more than 300 models.

    Examples
    --------
    >>> import numpy as np
    >>> import forgetting as fg
    >>> random = np.random.default_rng(0)
    >>> u, y = random.normal(size=900), np.zeros(900)
    >>> for k in range(2, 900):
    ...     y[k] = 0.8 * y[k - 1] + 0.5 * u[k - 2] + 0.01 * random.normal()
    >>> fg.tune_arx(u, y, rates=False).orders
    Orders(na=1, nb=1, nk=2)
    """
    inputs, outputs = paired(u, y)
    models = order_grid(na, nb, nk, inputs.shape[1])

    def make(orders: ModelOrders | None) -> Problem:
        assert isinstance(orders, Orders)
        return of_lags(orders, inputs, outputs)

    return choose(
        make,
        models,
        make(widest(models, inputs.shape[1])),
        lambda candidate: Lines(model_code(candidate)),
        rules=rules,
        rates=rates,
        priors=priors,
        share=share,
        threads=threads,
        progress=progress,
    )
