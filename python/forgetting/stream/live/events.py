"""What the page is told: the last of the rows ten times a second, and every alarm."""

from __future__ import annotations

import json
import math
import threading
import time
from collections import deque
from typing import Any

import numpy as np

from forgetting.record.units import parameter_unit
from forgetting.stream.output import Batch, Output
from forgetting.stream.stream import Stream
from forgetting.words.rounding import with_unit

INTERVAL = 0.1
"""Seconds between two events at least."""
KEPT = 600
"""Events that a page is shown when it opens."""
ALARMS = 100
"""Alarms that it is shown then."""


class Events:
    """Gathers what every block brought, and tells it at a rate that a page can draw.

    Parameters
    ----------
    stream : Stream
        Whose names and alarms are told.
    """

    def __init__(self, stream: Stream) -> None:
        self.stream = stream
        self.news = threading.Condition()
        self.count = 0
        """Events so far."""
        self.kept: deque[tuple[int, str]] = deque(maxlen=KEPT)
        self.alarms: deque[tuple[int, dict[str, Any]]] = deque(maxlen=ALARMS)
        """Alarms, each with the event that told it."""
        self.latest: Batch | None = None
        self.new_alarms: list[dict[str, Any]] = []
        self.low, self.high = math.inf, -math.inf
        self.told_at = 0.0

    def take(self, output: Output) -> None:
        """Take what a block brought."""
        with self.news:
            for batch in output.batches:
                self._take(batch)
            self.tell()

    def _take(self, batch: Batch) -> None:
        self.latest = batch
        alarms = [alarm.to_dict() for alarm in batch.alarms]
        self.new_alarms = (self.new_alarms + alarms)[-ALARMS:]
        errors = batch.found.error[:, 0]
        if not np.isnan(errors).all():
            self.low = min(self.low, float(np.nanmin(errors)))
            self.high = max(self.high, float(np.nanmax(errors)))

    def tell(self) -> None:
        """Make an event of what is new, unless the one before is too young; `news` is held."""
        now = time.monotonic()
        if self.latest is None or now - self.told_at < INTERVAL:
            return
        self.told_at = now
        self.count += 1
        self.alarms += [(self.count, alarm) for alarm in self.new_alarms]
        self.kept.append((self.count, json.dumps(self._event(self.latest))))
        self.latest, self.new_alarms = None, []
        self.low, self.high = math.inf, -math.inf
        self.news.notify_all()

    def _event(self, batch: Batch) -> dict[str, Any]:
        found, rows = batch.found, batch.rows
        told = rows.texts[-1] if rows.texts is not None else None
        if rows.texts is None and rows.timed[-1]:
            told = rows.ticks[-1].item()
        errors = found.standard_errors
        return {
            "row": batch.first + len(rows) - 1,
            "time": told,
            "measured": number(batch.y[-1, 0]),
            "prediction": number(found.prediction[-1, 0]),
            "error": [number(self.low), number(self.high)],
            "theta": [number(value) for value in found.theta[-1].T.reshape(-1)],
            "standard_errors": None
            if errors is None
            else [number(value) for value in errors[-1].T.reshape(-1)],
            "alarms": self.new_alarms,
            "active": self.stream.watch.active(),
            "counts": str(self.stream.tally),
        }

    def after(self, count: int, timeout: float) -> list[tuple[int, str]]:
        """Events after the first `count`, waiting for one if there is none."""
        deadline = time.monotonic() + timeout
        with self.news:
            while True:
                # A row that came too soon after an event is told by whoever waits for the next.
                self.tell()
                rest = deadline - time.monotonic()
                if self.count > count or rest <= 0:
                    return [each for each in self.kept if each[0] > count]
                self.news.wait(min(rest, INTERVAL))

    def beginning(self, first: int) -> dict[str, Any]:
        """What a page must know before event `first`: names, and the alarms told before it."""
        model, form = self.stream.model, self.stream.form
        units = {} if form is None else form.units
        several = len(model.outputs) > 1
        names = [
            with_unit(f"{output}: {name}" if several else name, parameter_unit(output, name, units))
            for output in model.outputs
            for name in model.regressors
        ]
        with self.news:
            before = [alarm for count, alarm in self.alarms if count < first]
        return {
            "parameters": names,
            "outputs": [with_unit(output, units.get(output)) for output in model.outputs],
            "model": f"{', '.join(model.outputs)} on {', '.join(model.regressors)}",
            "alarms": before,
        }


def number(value: Any) -> float | None:
    """A number for JSON, None where it is not finite."""
    return float(value) if math.isfinite(value) else None
