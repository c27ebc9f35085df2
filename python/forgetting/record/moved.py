"""Samples as an estimator gets them: measured from an origin, some columns of them, piece by piece.

A long record is never there twice: what is moved is made for the rows that are asked for.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting.record.samples import Samples, pieces

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Moved:
    """Samples less a point.

    Attributes
    ----------
    samples : Samples
        As they are.
    phi, y : ndarray, shape (n,) and (m,), or None
        What is taken from regressors and outputs; None for nothing.
    columns : sequence of int, or None
        The regressors taken; None for all.
    """

    samples: Samples
    phi: Array | None = None
    y: Array | None = None
    columns: list[int] | None = None

    def __len__(self) -> int:
        return len(self.samples.y)

    @property
    def parameters(self) -> int:
        """Number n of regressors."""
        return int(self.samples.phi.shape[1]) if self.columns is None else len(self.columns)

    @property
    def targets(self) -> int:
        """Number m of outputs."""
        return int(self.samples.y.shape[1])

    @property
    def regressors(self) -> tuple[str, ...]:
        """Names of the regressors."""
        names = self.samples.regressors
        return names if self.columns is None else tuple(names[place] for place in self.columns)

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of the outputs."""
        return self.samples.outputs

    @property
    def complete(self) -> NDArray[np.bool_]:
        """Rows without any missing value, (T,)."""
        return self.samples.complete

    @property
    def silent(self) -> NDArray[np.bool_]:
        """Regressors that are zero in all complete rows, (n,)."""
        parts = [self.known_rows(part).any(axis=0) for part in pieces(len(self))]
        return np.asarray(~np.any(parts, axis=0), dtype=np.bool_)

    def rows(self, part: slice) -> tuple[Array, Array]:
        """Regressors (T', n) and outputs (T', m) of some rows; no copy where nothing is changed."""
        phi, y = self.samples.phi[part], self.samples.y[part]
        phi = phi if self.phi is None else phi - self.phi
        y = y if self.y is None else y - self.y
        return (phi if self.columns is None else phi[:, self.columns]), y

    def column(self, place: int) -> Array:
        """One regressor of all rows, (T,)."""
        place = place if self.columns is None else self.columns[place]
        values = self.samples.phi[:, place]
        return values if self.phi is None else values - self.phi[place]

    def known_rows(self, part: slice) -> Array:
        """Regressors of those of these rows that are complete."""
        complete = self.complete[part]
        phi, _ = self.rows(part)
        return phi if complete.all() else phi[complete]

    @property
    def mean_squares(self) -> Array:
        """Mean square of each regressor where it is known, (n,)."""
        total, count = np.zeros(self.parameters), np.zeros(self.parameters)
        for part in pieces(len(self)):
            phi, _ = self.rows(part)
            total += np.nansum(np.square(phi), axis=0)
            count += (~np.isnan(phi)).sum(axis=0)
        return total / count

    def last(self, count: int) -> Moved:
        """The last rows, in place of all."""
        phi, y = self.rows(slice(len(self) - min(count, len(self)), None))
        return Moved(replace(self.samples, phi=phi, y=y))

    def information(self, start: int = 0, stop: int | None = None) -> Array:
        """Σ φᵀφ over the complete of these rows, (n, n)."""
        total = np.zeros((self.parameters, self.parameters))
        for part in pieces((len(self) if stop is None else stop) - start):
            phi = self.known_rows(slice(start + part.start, start + part.stop))
            total += phi.T @ phi
        return total


def as_run(phi: Array, y: Array, dtype: Any) -> tuple[NDArray[Any], NDArray[Any]]:
    """Regressors and outputs as an estimator takes them: one output has no second axis."""
    y = y if y.shape[1] > 1 else y[:, 0]
    return np.ascontiguousarray(phi, dtype=dtype), np.ascontiguousarray(y, dtype=dtype)
