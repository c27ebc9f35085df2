"""Models over a record whose noise is not white or whose output is simulated: ARMAX and its kin."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import InvalidInput, structures
from forgetting.models.named import NamedModel
from forgetting.models.orders import Each, in_text
from forgetting.models.signal_origin import first_values
from forgetting.record.dynamics import columns, refuse_repeats, stretches
from forgetting.record.read import Record
from forgetting.record.samples import Samples
from forgetting.record.trace import Trace
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

    def samples(self, phi: Array, y: Array) -> Samples:
        """The linear regression that an estimator was given, (T, n) and (T,)."""
        own = self.signals
        return Samples(
            np.ascontiguousarray(phi),
            y[:, None],
            tuple(own.model.terms(self.inputs, self.output)),
            (self.output,),
            described(self.named, self.output, self.inputs),
            self.record.clock,
            self.record.name,
            found=self.record.found,
            measured=own.y,
            layout=own.model.layout(len(self.inputs)),
            origin=own.model.origin(first_values(np.column_stack([own.inputs, own.output]))),
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
    trust : ndarray, shape (T,)
        What each sample counted, in (0, 1]: less at the start.
    """

    samples: Samples
    theta: Array
    error: Array
    error_without_forgetting: Array
    trust: Array

    def put(self, trace: Trace) -> Trace:
        """The trace of the linear regression with the estimates and errors of the model."""
        theta = self.theta[:, :, np.newaxis]
        return replace(trace, theta=theta, error=self.error, trust=self.trust)

    def back(self, trace: Trace) -> Trace:
        """The trace with P of signals as they are; the variance of the offset changes in place.

        It is exact after each piece of the run, and drawn straight in between.
        """
        origin = self.samples.origin
        if origin is None:
            return trace
        path = zip(self.theta[trace.rows], trace.covariances, strict=True)
        ends = [origin.covariance(theta, each)[-1, -1] for theta, each in path]
        trace.variance[:, -1] = np.interp(np.arange(len(trace.variance)), trace.rows, ends)
        return replace(trace, covariance=origin.covariance(self.theta[-1], trace.covariance))


def learned(
    record: Record,
    outputs: Sequence[str],
    inputs: Sequence[str],
    named: NamedModel,
    offset: bool = True,
    **settings: Any,
) -> Learned:
    """Identify a model of one output over a record; see `recorded`."""
    found = recorded(record, outputs, inputs, named, offset, **settings)
    signals = found.signals

    def course(rule: Any, *names: str) -> dict[str, Array]:
        model = named.make(offset=offset, **settings | {"rule": rule})
        u = signals.inputs if len(inputs) else None
        kept = model.course(u, signals.output, names)
        return {name: kept[name][signals.rows] for name in names}

    kept = course(settings.get("rule", "auto"), "phi", "y", "theta", "error", "scale")
    plain = course("none", "error")
    samples = found.samples(kept["phi"], kept["y"])
    trust = kept["scale"] ** 2
    return Learned(samples, kept["theta"], kept["error"][:, None], plain["error"][:, None], trust)


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
