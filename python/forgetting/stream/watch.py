"""Alarms: windup, parameters that nothing excites, and changes, each when it begins and ends.

- windup: what the estimator itself reports of each row (`forgetting.Update.windup`).
- unexcited: a monitored estimator that remembers 100 samples runs on the same rows. A parameter is
  not excited when its regressor has been too small for two of the monitor's blocks, or when it
  takes part in a direction that nothing informs: an input that stands still cannot be told from the
  constant, nor two inputs that go together from one another. The estimator forgets towards very
  little information, cyclically, so that P grows where nothing informs, and stays bounded.
- change: see `forgetting.record.changes`.

None of them depends on units, nor on how lines are grouped.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

import forgetting as fg
from forgetting.record.changes import FACTOR, TEST, Detector
from forgetting.stream.rows import Array, Flags
from forgetting.stream.running import run_all

EVERY = 50
"""Rows after which the monitor is asked; the block of 100 samples' memory."""
LITTLE = 1e-6
"""Information that is left where nothing informs, in units of one typical sample."""
PART = 0.3
"""Share of the largest part of a direction from which on a parameter takes part in it, as in
`forgetting.Health.describe`."""


@dataclass(frozen=True)
class Alarm:
    """Something begins or ends.

    Attributes
    ----------
    kind : str
        "windup", "unexcited" or "change".
    begins : bool
    row : int
        Counted from 1, in the whole stream.
    parameter : str or None
        The parameter that nothing excites.
    """

    kind: str
    begins: bool
    row: int
    parameter: str | None = None

    def to_dict(self) -> dict[str, Any]:
        """As JSON shows it."""
        told = {"alarm": self.kind, "state": "begins" if self.begins else "ends", "row": self.row}
        return told if self.parameter is None else told | {"parameter": self.parameter}

    def line(self) -> bytes:
        """As a line of JSON."""
        return json.dumps(self.to_dict(), ensure_ascii=False).encode() + b"\n"

    def __str__(self) -> str:
        of = f" {self.parameter}" if self.parameter is not None else ""
        return f"alarm: {self.kind}{of} {'begins' if self.begins else 'ends'} at row {self.row}"


class Watch:
    """Looks at every row beside the estimator."""

    def __init__(self, names: Sequence[str], outputs: int) -> None:
        self.names = tuple(names)
        n = len(self.names)
        self.changes = Detector(n, outputs)
        gauge = fg.CyclicResetting(FACTOR, information=LITTLE)
        self.gauge = fg.RLS(n, rule=gauge, targets=outputs, monitor=True)
        self.rows = 0
        self.winding_up = False
        self.silent: set[str] = set()

    def take(self, phi: Array, y: Array, windup: Flags) -> list[Alarm]:
        """Take rows, in the order of time; what begins or ends in them, in that order."""
        found = [*self._windup(windup), *self._changes(phi, y), *self._excitation(phi, y)]
        self.rows += len(phi)
        return sorted(found, key=lambda alarm: alarm.row)

    def _windup(self, flags: Flags) -> Iterator[Alarm]:
        before = np.concatenate([[self.winding_up], flags[:-1]])
        for place in np.flatnonzero(flags != before).tolist():
            yield Alarm("windup", bool(flags[place]), self.rows + place + 1)
        if len(flags):
            self.winding_up = bool(flags[-1])

    def _changes(self, phi: Array, y: Array) -> Iterator[Alarm]:
        brought = run_all(self.changes.estimator, phi, y, TEST).outputs
        for place, begins in self.changes.take(*(brought[name] for name in TEST)):
            yield Alarm("change", begins, self.rows + place + 1)

    def _excitation(self, phi: Array, y: Array) -> Iterator[Alarm]:
        at = 0
        while at < len(phi):
            stop = min(at + EVERY - (self.rows + at) % EVERY, len(phi))
            run_all(self.gauge, phi[at:stop], y[at:stop], ())
            at = stop
            if (self.rows + at) % EVERY == 0:
                yield from self._look(self.rows + at)

    def _look(self, row: int) -> Iterator[Alarm]:
        """Ask the monitor which parameters nothing informs."""
        watched = self.gauge.watched()
        assert watched is not None
        quiet = watched["since_excited"] >= 2 * watched["block"]
        if not watched["informed"]:
            parts = np.abs(watched["direction"]) / np.sqrt(watched["least_variances"])
            quiet |= parts > PART * parts.max()
        for name, silent in zip(self.names, quiet.tolist(), strict=True):
            if silent == (name in self.silent):
                continue
            (self.silent.add if silent else self.silent.remove)(name)
            yield Alarm("unexcited", silent, row, name)

    def active(self) -> list[str]:
        """What has begun and not ended, in words."""
        words = ["windup"] if self.winding_up else []
        words += ["change"] if self.changes.changing else []
        return words + [f"unexcited {name}" for name in self.names if name in self.silent]

    def state(self) -> dict[str, Any]:
        """As `restore` takes it."""
        return {
            "test": base64.b64encode(self.changes.estimator.to_bytes()).decode(),
            "gauge": base64.b64encode(self.gauge.to_bytes()).decode(),
            "rows": self.rows,
            "winding_up": self.winding_up,
            "silent": sorted(self.silent),
            "changing": self.changes.changing,
            "steady": self.changes.steady,
        }

    def restore(self, state: dict[str, Any]) -> None:
        """Go on from a saved state."""
        self.changes.estimator = fg.RLS.from_bytes(base64.b64decode(state["test"]))
        self.gauge = fg.RLS.from_bytes(base64.b64decode(state["gauge"]))
        self.rows, self.winding_up = state["rows"], state["winding_up"]
        self.silent = set(state["silent"])
        self.changes.changing, self.changes.steady = state["changing"], state["steady"]
