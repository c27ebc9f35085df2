"""Does a bound drift? The trend of a positive series, with its significance.

A finite record always has a largest and a smallest eigenvalue. A bound differs from
the end of a climb in that the extremes stop moving. The second half of the record is
cut into blocks longer than the memory of the estimator where the record allows it, the
extreme of each block is taken, and Kendall's rank test asks whether their order could be
chance; the slope is Theil and Sen's median of all pairs.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from forgetting.extras import extra

from .validation import numbers, real, refuse

#: Share of the record, at its end, in which the trend is looked for (the start is transient).
TAIL = 0.5
#: Most and fewest blocks the tail is cut into; 8 in perfect order have a chance of 5e-5.
BLOCKS, FEWEST = 20, 8
#: Memories a block should hold, for the extremes of two blocks to be nearly independent.
MEMORIES = 2.0
#: A trend is significant under this probability of chance ...
LEVEL = 0.01
#: ... and a drift when it also moves the bound by this factor over the tail.
FACTOR = 1.25


@dataclass(frozen=True)
class Trend:
    """Trend of a bound. See `trend`.

    Attributes
    ----------
    slope : float
        Change of the natural logarithm per sample.
    significance : float
        Probability that blocks without a trend order themselves as much (two-sided).
    factor : float
        exp(slope x samples in the tail).
    blocks : int
        Blocks compared; under 8 the record is too short to tell.
    """

    slope: float
    significance: float
    factor: float
    blocks: int

    @property
    def decidable(self) -> bool:
        """True when the record is long enough to tell."""
        return self.blocks >= FEWEST

    @property
    def rises(self) -> bool:
        """True when the series drifts upwards."""
        return self.decidable and self.significance < LEVEL and self.factor > FACTOR

    @property
    def falls(self) -> bool:
        """True when the series drifts downwards."""
        return self.decidable and self.significance < LEVEL and self.factor < 1 / FACTOR

    def to_dict(self) -> dict[str, Any]:
        """Return the fields, ready for JSON."""
        return {
            "log_slope_per_sample": self.slope,
            "significance": self.significance,
            "factor_over_tail": self.factor,
            "blocks": self.blocks,
        }


def trend(
    values: ArrayLike,
    extreme: Literal["largest", "smallest"] = "largest",
    memory: float = 1.0,
) -> Trend:
    """Test the extremes of a positive series for drift over the second half of the record.

    Parameters
    ----------
    values : (T,)
        Positive numbers, one a sample.
    extreme : {"largest", "smallest"}
        Which extreme of a block stands for it.
    memory : float >= 1
        Samples over which the series remembers, 1/(1-λ): blocks are made twice as long where
        the record is long enough for 8 of them.

    Returns
    -------
    Trend

    Raises
    ------
    InvalidInput
        For a series that is not one-dimensional and positive, or a memory below 1.
    ImportError
        Without SciPy.

    Examples
    --------
    >>> import numpy as np
    >>> k = np.arange(1000)
    >>> found = trend(0.99 ** -k)
    >>> found.rises, round(found.slope, 5)
    (True, 0.01005)
    >>> trend(2 + np.sin(k)).rises
    False
    """
    series = numbers("values", values)
    if series.ndim != 1 or not (series > 0).all():
        raise refuse("values", series.shape, "a one-dimensional series of positive numbers")
    tail = np.log(series[int(series.size * (1 - TAIL)) :])
    if tail.size < FEWEST:
        return Trend(0.0, 1.0, 1.0, tail.size)
    memory = real("memory", memory, 1.0, math.inf)
    count = int(np.clip(tail.size / (MEMORIES * memory), FEWEST, BLOCKS))
    count = min(count, tail.size)
    length = tail.size // count
    blocks = tail[tail.size - count * length :].reshape(count, length)
    levels = blocks.max(axis=1) if extreme == "largest" else blocks.min(axis=1)
    stats = extra("scipy.stats", "the trend of a bound")
    order = np.arange(count)
    slope = float(stats.theilslopes(levels, order).slope)
    # Without a tie the probability is exact; blocks that are all alike have none: no trend.
    chance = float(stats.kendalltau(order, levels).pvalue)
    significance = 1.0 if math.isnan(chance) else min(chance, 1.0)
    factor = math.exp(min(slope * count, 700.0))
    return Trend(slope / length, significance, factor, count)
