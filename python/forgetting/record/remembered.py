"""What the samples that the estimator remembers excite, all along a record."""

from __future__ import annotations

import numpy as np

from forgetting.analysis import Excited
from forgetting.analysis.excited import excited_by
from forgetting.record.moved import Moved
from forgetting.record.trace import USED, Trace


def remembered(samples: Moved, trace: Trace) -> Excited:
    """Excitation within the memory, at least 2 n samples and at most a quarter of the record."""
    used = trace.skipped == USED
    forgotten = 0.0
    if used.any():
        forgotten = 1.0 - float(np.median(trace.forgetting_factor[used]))
        if trace.memory is not None:
            forgotten = 1.0 / max(float(np.median(trace.memory[used])), 1.0)
    total, n = len(samples), samples.parameters
    longest = max(1, min(total, max(2 * n, total // 4)))
    memory = np.ceil(1 / max(forgotten, 1e-9))
    window = int(np.clip(memory, min(2 * n, longest), longest))
    return excited_by(samples.information, total, window)
