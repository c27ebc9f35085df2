"""Models over a record whose noise is not white or whose output is simulated: ARMAX and its kin."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting.models.text import CLASSES, parse
from forgetting.record.dynamics import CONSTANT, columns, refuse_repeats, stretches
from forgetting.record.read import Record
from forgetting.record.samples import Samples
from forgetting.record.trace import Trace
from forgetting.words.errors import RecordError

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Learned:
    """A record as a model with coloured noise saw it.

    Attributes
    ----------
    samples : Samples
        The linear regression that the estimator was given, with the outputs as they were measured.
    theta : ndarray, shape (T, n)
        Estimate after each sample, stable, with the constant of signals as they are.
    error : ndarray, shape (T, 1)
        One-step errors, NaN where the sample was left out.
    error_without_forgetting : ndarray, shape (T, 1)
        Those of the same model that never forgets.
    """

    samples: Samples
    theta: Array
    error: Array
    error_without_forgetting: Array

    def put(self, trace: Trace) -> Trace:
        """The trace of the linear regression with the estimates and errors of the model."""
        return replace(trace, theta=self.theta[:, :, np.newaxis], error=self.error)

    def blur(self, trace: Trace) -> Trace:
        """The trace without a variance of the offset.

        The estimator knows that of signals measured from their first values; what it is of signals
        as they are hangs on all other parameters, too.
        """
        variance = trace.variance.copy()
        variance[:, [name == CONSTANT for name in self.samples.regressors]] = np.nan
        return replace(trace, variance=variance)


def learned(
    record: Record,
    outputs: Sequence[str],
    inputs: Sequence[str],
    model: str,
    offset: bool = True,
    **settings: Any,
) -> Learned:
    """Identify a model such as ``"armax:na=2,nb=2,nc=1,nk=1"`` of one output over a record.

    Across a gap of the clock the model runs on its own predictions, and samples whose lags cross it
    are left out. `settings` are those of the class: rule, gate, initial_covariance, dtype.
    """
    name, orders = parse(model)
    if len(outputs) != 1:
        raise RecordError(f"a model {name} has one output; {len(outputs)} columns are named")
    refuse_repeats(outputs, inputs)
    fitted = CLASSES[name](**orders, offset=offset, **settings)
    y, u = columns(record, outputs), columns(record, inputs)
    rows = with_gaps(stretches(record), len(y), fitted.reach_of(len(inputs)))
    padded = np.vstack([np.hstack([y, u]), np.full((1, 1 + len(inputs)), np.nan)])[rows]
    signals = padded[:, 1:] if inputs else None, padded[:, 0]
    kept = fitted.course(*signals, ("phi", "y", "theta", "error"))
    never = CLASSES[name](**orders, offset=offset, **settings | {"rule": "none"})
    plain = never.course(*signals, "error")["error"]
    own = rows < len(y)
    samples = Samples(
        np.ascontiguousarray(kept["phi"][own]),
        kept["y"][own, None],
        tuple(fitted.terms(inputs, outputs[0])),
        tuple(outputs),
        described(name, orders, outputs[0], inputs),
        record.clock,
        record.name,
        found=record.found,
        measured=y,
    )
    return Learned(samples.check(), kept["theta"][own], kept["error"][own, None], plain[own, None])


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


def described(name: str, orders: dict[str, Any], output: str, inputs: Sequence[str]) -> str:
    """The model in words.

    Examples
    --------
    >>> described("oe", {"nb": [2, 1], "nf": 1}, "T", ["u", "v"])
    'OE(nb=2/1, nf=1) of T on u, v'
    """
    each = {
        order: "/".join(map(str, value)) if isinstance(value, list) else value
        for order, value in orders.items()
    }
    words = f"{name.upper()}({', '.join(f'{order}={value}' for order, value in each.items())})"
    return f"{words} of {output}" + (f" on {', '.join(inputs)}" if inputs else "")
