"""When each row was measured: the time column, found and read, and its gaps."""

from forgetting.record.clock.clock import Clock
from forgetting.record.clock.find import find_clock
from forgetting.record.clock.gap import gap_of

__all__ = ["Clock", "find_clock", "gap_of"]
