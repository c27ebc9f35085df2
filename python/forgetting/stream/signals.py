"""ARMAX and its kin, batch by batch: regressors that follow from the estimates so far.

The regressor of a row needs the estimate of the row before, so that the model itself gives rows to
the estimator of the stream, one by one, and keeps what it tells of them.
"""

from __future__ import annotations

import base64
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

import forgetting as fg
from forgetting._core import SignalModel
from forgetting.models.named import NamedModel
from forgetting.models.signal_origin import first_values
from forgetting.record.dynamics import refuse_repeats
from forgetting.record.known import Known
from forgetting.stream.learner import Learner
from forgetting.stream.rows import Array, Flags
from forgetting.stream.running import SAMPLE
from forgetting.stream.samples import Samples, Seen
from forgetting.words.errors import RecordError

KEPT = ("phi", "y", "theta", "error", "scale")


class Signals:
    """A model of one output whose noise is coloured; see `forgetting.stream.model.Model`.

    Parameters
    ----------
    outputs, inputs : sequence of str
    named : NamedModel
    offset : bool
    """

    learner: Learner

    def __init__(
        self, outputs: Sequence[str], inputs: Sequence[str], named: NamedModel, offset: bool
    ) -> None:
        if len(outputs) != 1:
            raise RecordError(
                f"a model {named.name} has one output; {len(outputs)} columns are named"
            )
        refuse_repeats(outputs, inputs)
        self.form = named.make(offset=offset)
        self.outputs, self.inputs = tuple(outputs), tuple(inputs)
        self.columns = self.outputs + self.inputs
        self.regressors = tuple(self.form.terms(inputs, outputs[0]))
        self.constant: int | None = None  # the model measures from its first values by itself
        self.reach = max(self.form.reach_of(len(inputs)), 1)
        self.first = np.full(len(self.columns), np.nan)
        """First values of the output and the inputs."""

    def begin(self, known: Known, learner: Learner) -> None:
        """Start at rest, with what is known of the parameters and with whom learns the others."""
        self.places, self.left = known.places(self.regressors), known.left(self.regressors)
        self.model = self.form.at_rest(len(self.inputs), *self.places)
        self.learner = learner

    def samples(self, values: Array, gap: Flags, repeated: Flags | None = None) -> Samples:
        """See `Model`; a row that is repeated brings nothing, and no lag sees it."""
        asleep = np.zeros(len(values), dtype=bool) if repeated is None else repeated
        here = np.flatnonzero(gap & ~asleep)
        rows = np.insert(np.arange(len(values)), np.repeat(here, self.reach), len(values))
        now = first_values(values[~asleep])
        self.first = np.where(np.isnan(self.first), now, self.first)
        nothing = np.full((1, values.shape[1]), np.nan)
        kept, refused, reason = self._learn(
            np.vstack([values, nothing])[rows], np.append(asleep, False)[rows]
        )
        own = rows < len(values)
        found = {name: each[own] for name, each in kept.items()}
        seen = Seen(
            np.where(asleep[:, None], np.nan, values[:, :1]),
            found.pop("error")[:, None],
            found.pop("scale") ** 2,
            np.ascontiguousarray(found.pop("theta")[:, self.left]),
            found,
            self.form.origin(np.roll(self.first, -1), *self.places),
            refused[own],
            reason,
        )
        return Samples(np.ascontiguousarray(found.pop("phi")), found.pop("y")[:, None], seen)

    def _learn(self, signals: Array, asleep: Flags) -> tuple[dict[str, Array], Flags, str]:
        """Learn row by row; one that leaves the range of numbers counts as missing."""
        refused, reason = np.zeros(len(signals), dtype=bool), ""
        pieces: list[dict[str, Any]] = []
        at, size = 0, len(signals)
        while at < len(signals) or not pieces:
            ahead = np.flatnonzero(asleep[at:] != asleep[at : at + 1])
            alike = int(ahead[0]) if len(ahead) else len(signals) - at
            stop = at + min(size, alike, self.learner.most)
            if at < len(signals) and asleep[at]:
                pieces.append(self._pass(stop - at))
                at = stop
                continue
            y, u = signals[at:stop, 0].copy(), np.ascontiguousarray(signals[at:stop, 1:])
            try:
                pieces.append(self._take(u, y))
            except (fg.NumericalRange, fg.InvalidInput) as error:
                place = SAMPLE.search(str(error))
                if place is None:
                    raise
                wrong = at + int(place[1])
                refused[wrong], reason = True, reason or str(error)[place.end() :]
                signals[wrong], size = np.nan, wrong + 1 - at
                continue
            at, size = stop, max(2 * size, 1)
        return {n: np.concatenate([p[n] for p in pieces]) for n in pieces[0]}, refused, reason

    def _take(self, u: Array, y: Array) -> dict[str, NDArray[Any]]:
        """What rows brought, by the names of outputs."""
        own = self.learner
        names = (*KEPT, *own.wanted)
        kept = self.model.learn(own.estimator, u, y, names, bounds=own.bounds)
        return {name: kept[name] for name in names}

    def _pass(self, count: int) -> dict[str, NDArray[Any]]:
        """What as many rows bring that the model is not shown."""
        own, n = self.learner, len(self.left)
        phi, y = np.full((count, n), np.nan), np.full(count, np.nan)
        dtype = np.dtype(own.estimator.dtype)
        taken = phi.astype(dtype), y.astype(dtype)
        run = own.estimator.run(*taken, outputs=own.wanted, missing="skip")
        theta = np.tile(self.model.theta, (count, 1))
        outputs = {name: getattr(run, name) for name in own.wanted}
        return {"phi": phi, "y": y, "theta": theta, "error": y, "scale": y, **outputs}

    def state(self) -> dict[str, Any]:
        """See `Model`."""
        return {
            "model": base64.b64encode(self.model.to_bytes()).decode(),
            "first": self.first.tolist(),
        }

    def restore(self, state: dict[str, Any]) -> None:
        """See `Model`."""
        self.model = SignalModel.from_bytes(base64.b64decode(state["model"]))
        self.first = np.array(state["first"])
