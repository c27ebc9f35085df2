"""What some lines brought: lines to be written, and the numbers behind them."""

from __future__ import annotations

from dataclasses import dataclass, field

from forgetting.stream.estimates import Estimates
from forgetting.stream.rows import Array, Rows
from forgetting.stream.watch import Alarm


@dataclass(frozen=True)
class Batch:
    """Some rows and what they brought, for who looks at the stream from beside."""

    first: int
    rows: Rows
    y: Array
    found: Estimates
    alarms: list[Alarm]


@dataclass
class Output:
    """What some lines brought.

    Attributes
    ----------
    lines : list of bytes
        Lines to be written.
    batches : list of Batch
    """

    lines: list[bytes] = field(default_factory=list)
    batches: list[Batch] = field(default_factory=list)

    @property
    def alarms(self) -> list[Alarm]:
        """What began or ended."""
        return [alarm for batch in self.batches for alarm in batch.alarms]


def with_alarms(lines: list[bytes], alarms: list[Alarm], first: int) -> list[bytes]:
    """Lines, with every alarm behind the row at which it begins or ends."""
    if not alarms:
        return lines
    made: list[bytes] = []
    at = 0
    for alarm in alarms:
        stop = alarm.row - first + 1
        made += [*lines[at:stop], alarm.line()]
        at = stop
    return made + lines[at:]
