"""Where the parameters of each polynomial stand: a, b of each input, c, d, f of each input."""

from __future__ import annotations

from collections.abc import Collection, Sequence
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

    def without(self, places: Collection[int]) -> Layout:
        """Of a model that does not estimate the parameters at these places.

        Examples
        --------
        >>> Layout.of(2, [(2, 1)], noise=1).without([0, 5]).b
        (slice(1, 3, None),)
        """

        def left(part: slice) -> int:
            return sum(place not in places for place in range(part.start, part.stop))

        each = [(left(b), left(f)) for b, f in zip(self.b, self.f, strict=True)]
        return Layout.of(left(self.a), each, left(self.noise))

    @property
    def past_outputs(self) -> range:
        """Places at which past outputs stand."""
        return range(self.a.start, self.a.stop)

    @property
    def past_inputs(self) -> range:
        """Places at which inputs stand."""
        return range(self.a.stop, self.noise.start)

    @property
    def end(self) -> int:
        """The place behind all of them, where a constant stands."""
        return int(self.f[-1].stop if self.f else self.noise.stop)

    @property
    def of_noise(self) -> int:
        """Coefficients of C and D."""
        return int(self.noise.stop - self.noise.start)
