"""What is known of parameters, for the rows of a stream; see `forgetting.record.known`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from forgetting.record.known import Known, less
from forgetting.stream.estimates import Estimates
from forgetting.stream.rows import Array
from forgetting.stream.samples import Samples


class KnownParameters:
    """Takes what is known from rows before they are learned, and puts it back behind.

    Parameters
    ----------
    known : Known
    regressors : sequence of str
        All of the model.
    by_model : bool
        Whether the model itself takes from its samples what is known, and says all of what is
        estimated.

    Attributes
    ----------
    left : list of int
        Places of the parameters that are estimated.
    names : tuple of str
        Their names.

    Examples
    --------
    >>> known = KnownParameters(Known(fixed={"b": 2.0}), ["a", "b"])
    >>> taken = known.taken(Samples(np.array([[1.0, 3.0]]), np.array([[10.0]])))
    >>> taken.phi.tolist(), taken.y.tolist()
    ([[1.0]], [[4.0]])
    """

    def __init__(self, known: Known, regressors: Sequence[str], by_model: bool = False) -> None:
        self.known, self.by_model = known, by_model
        self.left = known.left(regressors)
        self.names = tuple(regressors[i] for i in self.left)
        self._fixed = known.fixed_values(regressors)
        self._prior = known.prior_values(self.names)

    def place_of(self, constant: int | None) -> int | None:
        """Where the constant is among those estimated, if it is, and has no prior."""
        if constant not in self.left:
            return None
        place = self.left.index(constant)
        return None if self.known.from_zero(self.names[place]) else place

    @property
    def limits(self) -> tuple[Array, Array] | None:
        """Within which estimates are moved when they are told; None where they are there anyway."""
        if not self.known.bounds or (self.known.feed_back and not self.by_model):
            return None
        of = self.known.limits if self.by_model else self.known.limits_from_priors
        return of(self.names)

    @property
    def bounds(self) -> tuple[Array, Array] | None:
        """Within which the estimator itself keeps."""
        return self.known.limits_from_priors(self.names) if self.known.feed_back else None

    def taken(self, samples: Samples) -> Samples:
        """The samples as they are learned."""
        if self.by_model or not (self.known.fixed or self.known.prior):
            return samples
        rest = less(samples.y, samples.phi, self._fixed)
        phi = np.ascontiguousarray(samples.phi[:, self.left])
        return Samples(phi, less(rest, phi, self._prior))

    def put_back(self, found: Estimates, y: Array) -> Estimates:
        """What was learned, of all parameters and of the outputs `y` as they were measured."""
        if not self.known:
            return found
        if not self.by_model:
            self.known.add_priors(found.theta, self.names)
        errors = found.standard_errors
        return replace(
            found,
            theta=self._all(found.theta, self._fixed),
            prediction=y - found.error,
            standard_errors=None
            if errors is None
            else self._all(errors, np.zeros_like(self._fixed)),
        )

    def _all(self, values: Array, fixed: Array) -> Array:
        """Of all parameters, (T, n, m), those that are fixed too."""
        made = np.empty((len(values), len(fixed), values.shape[2]))
        made[:] = fixed[:, None]
        made[:, self.left] = values
        return made
