"""Forecasts many steps ahead all along a record, and what their intervals held.

Of a model by arx the estimates of each sample go on by the difference equation; ARMAX and its kin
are run once more. Inputs to come are those of the record. Nothing is forecast across a gap.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import InvalidInput
from forgetting.models.forecasts import Forecasts, aligned, checked
from forgetting.models.foreseen import by_equation, of_signals
from forgetting.models.named import NamedModel
from forgetting.models.orders import Each, Orders
from forgetting.record.dynamics import checked_orders, columns, stretches
from forgetting.record.intervals import without_swollen
from forgetting.record.polynomial import recorded
from forgetting.record.read import Record
from forgetting.record.trace import Trace
from forgetting.record.uncertainty import noise_variance
from forgetting.tuning.signals import Signals
from forgetting.words.errors import RecordError

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Ahead:
    """Forecasts of one output, with how they are told.

    Attributes
    ----------
    output : str
    forecasts : Forecasts
    """

    output: str
    forecasts: Forecasts

    def describe(self) -> list[str]:
        """A sentence for each horizon."""
        level = f"the {self.forecasts.level:.4g} interval"
        return [
            f"Of the forecasts of {self.output} {steps} sample{'s' * (steps > 1)} ahead "
            f"{held['conformal']:.1%} are within {level} that follows their errors, "
            f"{held['noise']:.1%} within that of the noise; root mean square error "
            f"{held['root_mean_square']:.4g}."
            for steps, held in self.forecasts.coverage().items()
        ]

    def to_dict(self) -> dict[str, Any]:
        """Ready for JSON."""
        held = self.forecasts.coverage()
        now = zip(self.forecasts.horizons, self.forecasts.trackers, strict=True)
        each = [{"steps": h, **held[h], "half_width": own.half_width} for h, own in now]
        return {"output": self.output, "level": self.forecasts.level, "horizons": each}


@dataclass(frozen=True)
class Asked:
    """The signals of a record of which forecasts are asked for.

    Attributes
    ----------
    output : str
    horizons : tuple of int
    level : float
    model : Orders or Signals
        Of a model by arx its orders; of another its signals.
    parts : list of (slice, u, y)
        Of a model by arx: the stretches of the record, with their signals.
    """

    output: str
    horizons: tuple[int, ...]
    level: float
    model: Orders | Signals
    parts: list[tuple[slice, Array, Array]]

    def answer(self, trace: Trace) -> Ahead:
        """The forecasts by the estimates of a run."""
        own = self.model
        found = self._by_signals(own) if isinstance(own, Signals) else self._by_arx(own, trace)
        return Ahead(self.output, found)

    def _by_arx(self, orders: Orders, trace: Trace) -> Forecasts:
        noise = noise_variance(without_swollen(trace))[:, 0]
        steps = max(self.horizons)
        parts = [
            by_equation(trace.theta[rows, :, 0], u, y, orders, steps, noise[rows])
            for rows, u, y in self.parts
        ]
        return aligned(parts, self.horizons, self.level)

    def _by_signals(self, own: Signals) -> Forecasts:
        inputs = own.inputs if own.inputs.shape[1] else None
        found = of_signals(own.model, inputs, own.output, max(self.horizons))
        made = aligned([found], self.horizons, self.level)
        nothing = ~np.isin(np.arange(len(own.output)), own.rows)
        gaps, value = np.cumsum(nothing), made.value.copy()
        for i, steps in enumerate(self.horizons):  # not from before a gap, nor from inside
            value[steps:, i][(gaps[steps:] != gaps[:-steps]) | nothing[:-steps]] = np.nan
        rows = own.rows
        return replace(
            made, measured=made.measured[rows], value=value[rows], deviation=made.deviation[rows]
        )


def asked(
    record: Record,
    outputs: Sequence[str],
    inputs: Sequence[str],
    model: tuple[Sequence[Each] | None, NamedModel | None],
    steps: int | Sequence[int],
    level: float | None,
    **settings: Any,
) -> Asked:
    """Forecasts so many samples ahead; `model` is that of `forgetting.record.polynomial.which`.

    `settings` are those of the class of the model.
    """
    arx, named = model
    if level is None:
        raise RecordError("say the level of the intervals about forecasts, such as 0.95")
    if named is None and arx is None:
        raise RecordError(
            "forecasts ahead are of models by arx or by a structure, not by a formula"
        )
    if len(outputs) != 1:
        raise RecordError(f"forecasts ahead are of one output; {len(outputs)} columns are named")
    try:
        horizons = checked(steps, level)
    except InvalidInput as error:
        raise RecordError(str(error)) from None
    if named is not None:
        signals = recorded(record, outputs, inputs, named, **settings).signals
        return Asked(outputs[0], horizons, level, signals, [])
    y, u = columns(record, outputs)[:, 0], columns(record, inputs)
    parts = [(part, u[part], y[part]) for part in stretches(record)]
    return Asked(outputs[0], horizons, level, checked_orders(arx or (), inputs), parts)


def about_intervals(found: Any) -> list[str]:
    """What the intervals of an identification held, in sentences; none without a level."""
    told = found.intervals.describe(found.samples.outputs) if found.intervals else []
    return [*told, *(found.ahead.describe() if found.ahead else [])]
