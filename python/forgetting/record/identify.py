"""Identify a model from a measured record."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

import forgetting as fg
from forgetting.models.named import NamedModel
from forgetting.models.orders import Each
from forgetting.prediction import check_level
from forgetting.record.ahead import asked
from forgetting.record.feedback import Feedback
from forgetting.record.half_life import with_time
from forgetting.record.identification import Identification
from forgetting.record.judge import Judged, judge, settled
from forgetting.record.known import Bounds, Known
from forgetting.record.learned import Learned, learned
from forgetting.record.limits import Limits
from forgetting.record.linear import Linear
from forgetting.record.missing import Words
from forgetting.record.moved import Moved
from forgetting.record.noise import noise_of, refuse_functions
from forgetting.record.origin import constants, origin
from forgetting.record.read import Record, read
from forgetting.record.release import release
from forgetting.record.remembered import remembered
from forgetting.record.scores import score
from forgetting.record.trace import Progress, errors_of, run
from forgetting.record.which import build, listed, which
from forgetting.words.errors import RecordError

if TYPE_CHECKING:
    from narwhals.typing import IntoDataFrame


def identify(
    record: str | Path | IntoDataFrame | Record | Callable[[], Record],
    *,
    formula: str | None = None,
    output: str | Sequence[str] = (),
    input: str | Sequence[str] = (),
    arx: Sequence[Each] | None = None,
    model: str | None = None,
    offset: bool = True,
    rule: Any = "auto",
    half_life: Any = None,
    by_clock: bool = False,
    gate: Any = None,
    initial_covariance: ArrayLike | None = None,
    dtype: str = "float64",
    bounds: Bounds | None = None,
    fixed: Mapping[str, float] | None = None,
    prior: Mapping[str, tuple[float, float]] | None = None,
    noise: float | None = None,
    feed_back: bool = False,
    level: float | None = None,
    ahead: int | Sequence[int] | None = None,
    time: str | None = None,
    gap: str | float | None = None,
    missing: str | float | Words = (),
    progress: Progress | None = None,
) -> Identification:
    """Identify a regression or an ARX model recursively over a whole record.

    Parameters
    ----------
    record : path, data frame, Record or callable
        See `forgetting.record.read`.
    formula : str, optional
        A regression such as ``"power ~ 0 + sun + sun:warmth"``; ``lag(x, k)`` is x, k rows ago.
    output, input : str or sequence of str, optional
        Columns of an ARX model; several outputs share one regressor.
    arx : sequence of three, optional
        Orders na, nb, nk of the ARX model; nb and nk may be sequences, an order for each input.
    model : str, optional
        In the place of `arx` a structure and its orders, such as ``"armax:na=2,nb=2,nc=1,nk=1"``;
        also fir, ar, arx, arma, oe and bj, see `forgetting.ARMAX` and its neighbours. What is said
        of excitation and windup is said of the gradients of the prediction.
    rule : str or Rule
        Forgetting rule; "auto" mixes rules of all speeds, see `forgetting.Bank`.
    half_life : float, str or duration, optional
        In the place of the rule's forgetting factor: after this time half of what is known is
        forgotten. A number counts samples, "10min" or a duration counts by the clock, whatever the
        steps between samples; one gap forgets ten half-lives at most.
    by_clock : bool
        Whether forgetting counts time in place of samples, also of the bank: a sample that comes
        after three usual steps of the clock is forgotten for like three.
    gate : str, Gate or callable, optional
        Whether a sample is used; see `forgetting.gates`.
    initial_covariance : float or array_like, optional
        P before the first sample: scalar, (n,) diagonal or (n, n), in units of 1/regressor². If not
        given it follows the data, and a model with a constant is measured from the first sample: no
        prediction depends on the units of the columns or on where they have their zero.
    offset : bool
        Whether an ARX model has a constant.
    dtype : str
        "float64" or "float32".
    bounds : mapping of str to (float or None, float or None), optional
        Smallest and largest value of parameters, by the names of their regressors, as in
        ``{"R0": (0, None)}``. Estimates outside are moved inside by `forgetting.bounded`; errors
        and predictions are those of the estimator, which does not know of bounds, but for
        `feed_back`.
    fixed : mapping of str to float, optional
        Values of parameters that are known exactly: their part is taken from the output.
    prior : mapping of str to (float, float), optional
        A value and the standard deviation with which it is known before the first sample. It is
        forgotten like what samples said.
    noise : float, optional
        Standard deviation of the noise, which priors are weighed against; if not given, the root
        mean square one-step error of the same model without the priors.
    feed_back : bool, default False
        Whether the estimator goes on from estimates that were moved into `bounds`; of a rule, as
        the bank mixes several.
    level : float, optional
        Between 0 and 1: intervals about one-step predictions, see `Identification.intervals`.
    ahead : int or sequence of int, optional
        With a level, of a model of one output by its columns: how many samples ahead to forecast
        all along the record, see `Identification.ahead`.
    time, gap, missing
        The clock, its gaps, and what stands for missing values; see `forgetting.record.read`.
    progress : callable, optional
        Called with (rows done, rows in all) while the estimator runs.

    Returns
    -------
    Identification

    Raises
    ------
    RecordError
        When the file, a column, a cell or the model is at fault.
    forgetting.InvalidInput
        When a parameter of the estimator is out of range.
    forgetting.NumericalRange
        When a rule without a bounded covariance ran out of the range of numbers.

    Notes
    -----
    A sample with a missing value in a regressor or output is skipped and counted. A lag that
    crosses a missing cell or a gap of the clock is missing. A model without lags needs no clock.

    Examples
    --------
    >>> import numpy as np, pandas as pd
    >>> x = np.sin(np.arange(200.0))
    >>> found = identify(pd.DataFrame({"x": x, "y": 3 * x + 1}), formula="y ~ x")
    >>> found.parameters["value"].round(2).tolist()
    [1.0, 3.0]
    >>> found.used, found.missing
    (200, 0)
    """
    known = Known(bounds or {}, fixed or {}, prior or {}, noise, feed_back)
    if level is not None:
        check_level(level)
    source = read(record, time, gap=gap, missing=missing)
    columns = listed(output), listed(input)
    arx, named = which(formula, arx, model)
    own: Linear | Learned
    chosen: dict[str, Any] = {}
    if named is None:
        own = Linear.of(build(source, formula, *columns, arx, offset), known)
    elif half_life is not None or by_clock:
        raise RecordError(f"the model {model} forgets by samples; leave out what counts time")
    else:
        chosen = {"offset": offset, "rule": rule, "gate": gate, "dtype": dtype}
        chosen["initial_covariance"] = initial_covariance
        own = learned(source, *columns, named, known=known, **chosen)
    question = None
    if ahead is not None:
        refuse_known(known, named)
        question = asked(source, *columns, (arx, named), ahead, level, **chosen)
    known, samples, past = own.known, own.samples, own.past
    del record, source  # the table, which nobody else may hold, is as large as what is made of it
    release(len(samples.y))
    rule, time_of = with_time(rule, half_life, by_clock, samples)
    settings: dict[str, Any] = {
        "targets": samples.y.shape[1],
        "initial_covariance": initial_covariance,
        "dtype": dtype,
    }
    moves = initial_covariance is None and not known.of_constant(samples)
    seen = own.seen
    here = origin(seen, moves=moves)
    moved = here.moved(seen)

    def fresh() -> Any:
        return estimator_for(samples.phi.shape[1], rule, gate=gate, **settings)

    if known.prior and known.noise is None:
        refuse_functions(rule, gate)
        known = replace(known, noise=noise_of(errors_of(fresh(), moved, time_of), moved))
    estimator = fresh()
    initial = np.asarray(estimator.covariance, dtype=np.float64)
    teach = partial(known.teach, regressors=samples.regressors)
    known.refuse_bank(estimator)
    teach(estimator)
    within = known.limits_from_priors(samples.regressors)
    limits = Limits(*within, here)
    fed_back = within if known.feed_back else None
    trace = own.put(run(estimator, moved, progress, time_of, own.hold(limits), fed_back))
    units = np.ones(len(initial)) if estimator.units is None else estimator.units
    plain = own.never_forgetting(moved, settings, teach)
    alone = None
    if not (known.fixed or known.prior):
        alone = errors_without_inputs(moved, past, rule, gate, settings, time_of)
    scores = score(samples, trace.error, plain, alone)
    excited = remembered(moved, trace)
    judged = Judged(
        samples=moved,
        trace=trace,
        scores=score(samples, trace.error, plain, alone, settled(trace)),
        feedback=past,
        excited=excited,
        initial_variance=np.diag(initial) / np.square(units),
        health=estimator.health() if isinstance(estimator, fg.RLS) else None,
    )
    judgement = judge(judged)  # before the trace is changed
    trace = own.back(trace, here, limits)
    answer = None if question is None else question.answer(trace)
    return Identification(
        samples=samples,
        trace=trace,
        rule=rule_of(estimator, rule),
        scores=scores,
        judgement=judgement,
        excited=excited,
        initial_covariance=initial,
        units=np.asarray(units, dtype=np.float64),
        settings=settings,
        members=estimator.members if isinstance(estimator, fg.Bank) else [],
        known=known,
        level=level,
        ahead=answer,
    )


def refuse_known(known: Known, named: NamedModel | None) -> None:
    """Refuse forecasts where what is known of parameters would not count in them."""
    if known.fixed or (named is not None and known):
        raise RecordError(
            "forecasts ahead do not take fixed values, nor of a model with coloured noise what "
            "else is known; leave out one of the two"
        )


def errors_without_inputs(
    samples: Moved,
    past: Feedback,
    rule: Any,
    gate: Any,
    settings: dict[str, Any],
    time: NDArray[np.float64] | None,
) -> NDArray[np.float64] | None:
    """One-step errors (T, m) of the same rule on past outputs and the constant alone.

    None where that is the model itself, where there are no past outputs, where the rule has
    settings for each parameter, where a function of the user's would be called once more, or where
    the model makes its regressors as it goes.
    """
    constant = constants(samples)
    kept = [i for i in range(samples.parameters) if i in past.lags or constant[i]]
    refused = "<" in f"{rule!r} {gate!r}" or samples.samples.is_pseudolinear
    if not past.lags or len(kept) == samples.parameters or refused:
        return None
    try:
        estimator = estimator_for(len(kept), rule, gate=gate, **settings)
    except fg.InvalidInput:
        return None
    return errors_of(estimator, replace(samples, columns=kept), time)


def estimator_for(parameters: int, rule: Any, **settings: Any) -> Any:
    """The estimator of a rule, monitored; the default bank for the rule "auto"."""
    if isinstance(rule, str) and rule == "auto":
        return fg.Bank(parameters, **settings)
    return fg.RLS(parameters, rule=rule, monitor=True, **settings)


def rule_of(estimator: Any, rule: Any) -> Any:
    """The rule that was asked for as an object; of a bank the one most believed at the end."""
    if isinstance(estimator, fg.Bank):
        return estimator.members[int(np.argmax(estimator.weights))]
    return estimator.rule if isinstance(rule, str) else rule
