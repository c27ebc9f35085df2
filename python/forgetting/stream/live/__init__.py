"""One page on this machine that shows a stream as it goes: parameters, bands, errors, alarms."""

from forgetting.stream.live.events import Events
from forgetting.stream.live.server import Server

__all__ = ["Events", "Server"]
