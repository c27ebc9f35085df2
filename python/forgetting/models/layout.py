"""Where the parameters of each polynomial stand: a, b of each input, c, d, f of each input."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise


@dataclass(frozen=True)
class Layout:
    """Places of the parameters of a model; a constant is last.

    Attributes
    ----------
    a, noise : slice
        Those of A, and of C and D.
    b, f : tuple of slice
        Those of B and F of each input.

    Examples
    --------
    >>> Layout.of(2, [(2, 1), (1, 0)], noise=1).f
    (slice(6, 7, None), slice(7, 7, None))
    """

    a: slice
    b: tuple[slice, ...]
    noise: slice
    f: tuple[slice, ...]

    @classmethod
    def of(cls, na: int, each: Sequence[tuple[int, int]], noise: int) -> Layout:
        """Of so many coefficients; `each` has nb and nf of an input."""
        counts = [na, *(nb for nb, _ in each), noise, *(nf for _, nf in each)]
        a, *others = (slice(*ends) for ends in pairwise(accumulate(counts, initial=0)))
        inputs = len(each)
        return cls(a, tuple(others[:inputs]), others[inputs], tuple(others[inputs + 1 :]))

    @property
    def past_outputs(self) -> range:
        """Places at which past outputs stand."""
        return range(self.a.start, self.a.stop)

    @property
    def past_inputs(self) -> range:
        """Places at which inputs stand."""
        return range(self.a.stop, self.noise.start)

    @property
    def of_noise(self) -> int:
        """Coefficients of C and D."""
        return int(self.noise.stop - self.noise.start)
