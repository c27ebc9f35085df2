"""Estimates of an estimator on a record: θ after every sample, P after chosen ones."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

import forgetting as fg

from .eigenvalues import eigenpairs

Array = NDArray[Any]


@dataclass(frozen=True, eq=False)
class Path:
    """Estimates and covariances; index 0 is the start, before any sample.

    Attributes
    ----------
    theta : (T + 1, n)
        θ_0 ... θ_T.
    error : (T,) or (T, rows)
        y_k - φ_k θ_k, the tutorial's -z_k.
    factor : (T,)
        λ_k that was used.
    used : (T,)
        False where the rule left the sample out.
    samples : (m,)
        The k at which P_k was kept, 0 and T among them.
    values, vectors : (m, n), (m, n, n)
        Eigenvalues of P_k, descending, and eigenvectors, each to full relative accuracy.
    covariance : (m, n, n)
        P_k itself.
    """

    theta: Array
    error: Array
    factor: Array
    used: NDArray[np.bool_]
    samples: NDArray[np.int64]
    values: Array
    vectors: Array
    covariance: Array

    @property
    def condition(self) -> Array:
        """Condition number of each P_k, (m,)."""
        return np.asarray(self.values[:, 0] / self.values[:, -1])

    @property
    def information(self) -> Array:
        """P_k⁻¹ at the kept samples, (m, n, n)."""
        turned = self.vectors / self.values[:, np.newaxis, :]
        return np.asarray(turned @ np.swapaxes(self.vectors, 1, 2))


def follow(
    rule: fg.Rule,
    phi: Array,
    y: Array,
    *,
    initial_covariance: ArrayLike = 1.0,
    initial_theta: ArrayLike | None = None,
    every: int = 1,
) -> Path:
    """Run an estimator over a record and keep P every so many samples.

    Parameters
    ----------
    rule : Rule
    phi : (T, n) or (T, rows, n)
    y : (T,) or (T, rows)
    initial_covariance, initial_theta : optional
        As in `RLS`; here P_0 = I and θ_0 = 0 unless said otherwise.
    every : int >= 1

    Examples
    --------
    >>> path = follow(fg.rule("none"), np.ones((4, 1)), np.ones(4))
    >>> path.values[:, 0].round(3).tolist()
    [1.0, 0.5, 0.333, 0.25, 0.2]
    """
    n, rows = phi.shape[-1], 1 if phi.ndim == 2 else phi.shape[1]
    start = np.zeros(n) if initial_theta is None else initial_theta
    est = fg.RLS(
        n, rule=rule, rows=rows, initial_covariance=initial_covariance, initial_theta=start
    )
    theta = est.theta
    ends = [*range(every, len(phi), every), len(phi)]
    runs, kept = [], [est.factor()]
    for begin, end in zip([0, *ends], ends, strict=False):
        runs.append(est.run(phi[begin:end], y[begin:end]))
        kept.append(est.factor())
    error = np.concatenate([np.asarray(run.error) for run in runs])
    upper, diagonal = (np.stack(parts) for parts in zip(*kept, strict=True))
    values, vectors = eigenpairs(upper, diagonal)
    covariance = np.einsum("tij,tj,tkj->tik", upper, diagonal, upper)
    return Path(
        np.concatenate([theta[np.newaxis], *(run.theta for run in runs)]),
        error.reshape(len(error), -1)[:, 0] if rows == 1 else error,
        np.concatenate([run.forgetting_factor for run in runs]),
        np.concatenate([run.skipped == 0 for run in runs]),
        np.array([0, *ends]),
        values,
        vectors,
        covariance,
    )
