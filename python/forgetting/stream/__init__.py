"""Lines become estimates as they come: from a pipe, or a file that grows.

`Stream` takes blocks of lines and gives lines back; `forgetting.stream.pump` reads, writes, saves
and stops. What a line means (the model, the clock, a gap, a missing value) is what it means in a
record, told from the lines so far. Needs ``pip install 'forgetting[cli]'``.
"""

from forgetting.stream.settings import Settings
from forgetting.stream.stream import Stream

__all__ = ["Settings", "Stream"]
