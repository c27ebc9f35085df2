"""ARMAX and its kin, batch by batch: regressors that follow from the estimates so far.

The model runs an estimator of its own, as the regressor of a row needs the estimate of the row
before. The estimator of the stream takes the same samples and is the same to the last bit; it is
the one that is asked for all else.
"""

from __future__ import annotations

import base64
from collections.abc import Sequence
from typing import Any

import numpy as np

import forgetting as fg
from forgetting._core import SignalModel
from forgetting.models.named import NamedModel
from forgetting.models.signal_origin import first_values
from forgetting.record.dynamics import refuse_repeats
from forgetting.record.identify import estimator_for
from forgetting.stream.rows import Array, Flags
from forgetting.stream.running import SAMPLE
from forgetting.stream.samples import Samples, Seen
from forgetting.words.errors import RecordError

KEPT = ("phi", "y", "theta", "error")


class Signals:
    """A model of one output whose noise is coloured; see `forgetting.stream.model.Model`.

    Parameters
    ----------
    outputs, inputs : sequence of str
    named : NamedModel
    offset : bool
    rule, **settings
        Of the estimator: rule, gate, initial_covariance and dtype.
    """

    def __init__(
        self,
        outputs: Sequence[str],
        inputs: Sequence[str],
        named: NamedModel,
        offset: bool,
        rule: Any,
        **settings: Any,
    ) -> None:
        if len(outputs) != 1:
            raise RecordError(
                f"a model {named.name} has one output; {len(outputs)} columns are named"
            )
        refuse_repeats(outputs, inputs)
        self.form = named.make(offset=offset)
        self.model = self.form.at_rest(len(inputs))
        self.estimator = estimator_for(self.model.parameters, rule, **settings)
        self.outputs, self.inputs = tuple(outputs), tuple(inputs)
        self.columns = self.outputs + self.inputs
        self.regressors = tuple(self.form.terms(inputs, outputs[0]))
        self.constant: int | None = None  # the model measures from its first values by itself
        self.reach = max(self.form.reach_of(len(inputs)), 1)
        self.first = np.full(len(self.columns), np.nan)
        """First values of the output and the inputs."""
        self.theta = np.zeros(len(self.regressors))

    def samples(self, values: Array, gap: Flags) -> Samples:
        """See `Model`."""
        here, before = np.flatnonzero(gap), self.theta
        rows = np.insert(np.arange(len(values)), np.repeat(here, self.reach), len(values))
        self.first = np.where(np.isnan(self.first), first_values(values), self.first)
        nothing = np.full((1, values.shape[1]), np.nan)
        kept, refused, reason = self._learn(np.vstack([values, nothing])[rows])
        own = rows < len(values)
        found = {name: each[own] for name, each in kept.items()}
        if len(values):
            self.theta = found["theta"][-1]
        seen = Seen(
            values[:, :1],
            found["error"][:, None],
            found["theta"],
            before,
            self.form.origin(np.roll(self.first, -1)),
            refused[own],
            reason,
        )
        return Samples(np.ascontiguousarray(found["phi"]), found["y"][:, None], seen)

    def _learn(self, signals: Array) -> tuple[dict[str, Array], Flags, str]:
        """Learn row by row; one that leaves the range of numbers counts as missing."""
        refused, reason = np.zeros(len(signals), dtype=bool), ""
        pieces: list[dict[str, Any]] = []
        at, size = 0, len(signals)
        while at < len(signals) or not pieces:
            stop = min(at + size, len(signals))
            y, u = signals[at:stop, 0].copy(), np.ascontiguousarray(signals[at:stop, 1:])
            try:
                pieces.append(self.model.learn(self.estimator, u, y, KEPT))
            except (fg.NumericalRange, fg.InvalidInput) as error:
                place = SAMPLE.search(str(error))
                if place is None:
                    raise
                wrong = at + int(place[1])
                refused[wrong], reason = True, reason or str(error)[place.end() :]
                signals[wrong], size = np.nan, wrong + 1 - at
                continue
            at, size = stop, 2 * size
        return {name: np.concatenate([p[name] for p in pieces]) for name in KEPT}, refused, reason

    def state(self) -> dict[str, Any]:
        """See `Model`."""
        return {
            "model": base64.b64encode(self.model.to_bytes()).decode(),
            "estimator": base64.b64encode(self.estimator.to_bytes()).decode(),
            "first": self.first.tolist(),
            "theta": self.theta.tolist(),
        }

    def restore(self, state: dict[str, Any]) -> None:
        """See `Model`."""
        self.model = SignalModel.from_bytes(base64.b64decode(state["model"]))
        self.estimator = type(self.estimator).from_bytes(base64.b64decode(state["estimator"]))
        self.first, self.theta = np.array(state["first"]), np.array(state["theta"])
