"""The trajectory of an estimator: regressors with the covariance before and after each step."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .information import weighted, weighting
from .reconstruction import prior_covariance as recomputed
from .validation import Array, numbers, positive_matrix, present, refuse, stack


@dataclass(frozen=True, eq=False, repr=False)
class Trajectory:
    """What the theory of Lai and Bernstein needs of a run, sample by sample.

    Attributes
    ----------
    phibar : (T, rows, n)
        Weighted regressors Γ^{-1/2} φ, Γ as it was used; zeros where the sample was skipped.
    before, prior, after : (T, n, n)
        P_k before the sample, P̄_k after forgetting, P_{k+1} after the measurement.
    first : int
        Sample number of row 0; at least 1 where the initial covariance was not given.
    precision : float
        Unit roundoff of the numbers, float32 runs included.
    resolved : (T,) bool or None
        Where P̄ was not recorded but recomputed from P_{k+1} and φ: whether rounding left it
        any digit. P_k stands in for it where not.
    weight : (T, rows, rows) or (1, rows, rows)
        Γ_k as it was used, one matrix when constant.
    forgetting_factor : (T,) or None
        λ_k as the rule used it.
    trust : (T,) or None
        By what weighting and rule divided the Γ given, to get the Γ used; None for 1.
    """

    phibar: Array
    before: Array
    prior: Array
    after: Array
    weight: Array
    first: int = 0
    precision: float = float(np.finfo(np.float64).eps)
    resolved: NDArray[np.bool_] | None = None
    forgetting_factor: Array | None = None
    trust: Array | None = None

    @property
    def samples(self) -> int:
        """Number of samples T."""
        return int(self.phibar.shape[0])

    @property
    def rows(self) -> int:
        """Number of rows p of a regressor."""
        return int(self.phibar.shape[1])

    @property
    def parameters(self) -> int:
        """Number of parameters n."""
        return int(self.phibar.shape[2])

    @classmethod
    def from_arrays(
        cls,
        regressors: ArrayLike,
        covariance: ArrayLike,
        *,
        prior_covariance: ArrayLike | None = None,
        forgetting: ArrayLike | None = None,
        gamma: ArrayLike | None = None,
    ) -> Trajectory:
        """Make a trajectory from arrays.

        Parameters
        ----------
        regressors : (T, n) or (T, rows, n)
        covariance : (T + 1, n, n)
            P_0, ..., P_T.
        prior_covariance : (T, n, n), optional
            P̄_k, after forgetting and before the measurement.
        forgetting : (T, n, n), optional
            F_k of GF-RLS equation (9), used when `prior_covariance` is not given.
            With neither, P̄_k is recomputed from P_{k+1} and φ_k.
        gamma : scalar, (rows, rows), (T,) or (T, rows, rows), optional
            Measurement weighting Γ_k.

        Raises
        ------
        InvalidInput
            A wrong shape, or a matrix that is not positive definite.

        Examples
        --------
        >>> import numpy as np
        >>> Trajectory.from_arrays([[1.0], [1.0]], [[[1.0]], [[0.5]], [[1 / 3]]]).prior.round(9)
        array([[[1. ]],
        <BLANKLINE>
               [[0.5]]])
        """
        phibar = weighted(regressors, gamma)
        samples, _, n = phibar.shape
        path = stack("covariance", covariance, samples + 1, n)
        prior, resolved = _prior(phibar, path, prior_covariance, forgetting, cls.precision)
        weight = weighting(gamma, samples, phibar.shape[1])
        return cls(phibar, path[:-1], prior, path[1:], weight, resolved=resolved)

    @classmethod
    def from_run(
        cls,
        run: Any,
        regressors: ArrayLike,
        *,
        gamma: ArrayLike | None = None,
        initial_covariance: ArrayLike | None = None,
    ) -> Trajectory:
        """Make a trajectory from the outputs of `RLS.run`.

        Parameters
        ----------
        run : Run
            Made with ``outputs=(..., "covariance")``; "prior_covariance" spares a
            reconstruction, "skipped" and "forgetting_factor" are used when present. "weight" is
            needed where a weighting or a rule measured with another Γ than was given.
        regressors : (T, n) or (T, rows, n)
            The regressors given to the run.
        gamma : optional
            The weighting given to the run.
        initial_covariance : scalar, (n,) or (n, n), optional
            P_0. Without it P may have followed the data: the prior of a parameter is then set in
            the first sample in which its regressor is other than 0, which changes P and is no
            forgetting. The trajectory starts behind the last of these samples, at the latest 2 n
            samples before the end. A regressor that is always 0 delays nothing.

        Examples
        --------
        >>> import numpy as np
        >>> import forgetting as fg
        >>> phi = np.ones((20, 2))
        >>> phi[:6, 1] = 0.0  # an input that is switched on at sample 6
        >>> run = fg.RLS(2).run(phi, phi.sum(axis=1), outputs=["covariance"])
        >>> Trajectory.from_run(run, phi).first
        7
        """
        phibar = weighted(regressors, gamma)
        phibar = _without_skipped(phibar, getattr(run, "skipped", None))
        samples, _, n = phibar.shape
        trust = _trust(run, samples)
        phibar = phibar * np.sqrt(trust)[:, np.newaxis, np.newaxis]
        raw = np.asarray(present(run, "covariance"))
        after = stack("run.covariance", raw, samples, n)
        recorded = getattr(run, "prior_covariance", None)
        first, start = _behind_priors(phibar), after[0]
        if initial_covariance is not None:
            first, start = 0, positive_matrix("initial_covariance", initial_covariance, n)
        path = np.concatenate([start[np.newaxis], after])
        precision = float(np.finfo(raw.dtype).eps) if raw.dtype.kind == "f" else cls.precision
        prior, resolved = _prior(phibar, path, recorded, None, precision)
        rate = getattr(run, "forgetting_factor", None)
        weight = weighting(gamma, samples, phibar.shape[1])
        if (trust != 1.0).any():
            weight = weight / trust[:, np.newaxis, np.newaxis]
        return cls(
            phibar[first:],
            path[first:-1],
            prior[first:],
            after[first:],
            weight[first:] if len(weight) > 1 else weight,
            first,
            precision,
            None if resolved is None else resolved[first:],
            None if rate is None else np.asarray(rate, dtype=np.float64)[first:],
            trust[first:],
        )


def _behind_priors(phibar: Array) -> int:
    """The sample from which on the prior of every parameter is set, if it followed the data."""
    samples, _, n = phibar.shape
    speaks = (phibar != 0).any(axis=1)
    first = int(speaks[:, speaks.any(axis=0)].argmax(axis=0).max(initial=0))
    return max(min(first + 1, int(samples - 2 * n)), 1)


def trajectory_of(
    run: Any,
    regressors: ArrayLike | None,
    gamma: ArrayLike | None,
    initial_covariance: ArrayLike | None,
) -> Trajectory:
    """Return `run` itself if it is a Trajectory, or the trajectory of a Run."""
    if isinstance(run, Trajectory):
        if regressors is not None or gamma is not None or initial_covariance is not None:
            raise refuse("regressors", "given", "nothing beside a Trajectory, which holds them")
        return run
    if regressors is None:
        raise refuse("regressors", None, "the regressors given to the run")
    return Trajectory.from_run(run, regressors, gamma=gamma, initial_covariance=initial_covariance)


def _trust(run: Any, samples: int) -> Array:
    """By what Γ of each sample was divided before it was measured."""
    if getattr(run, "weight", None) is None:
        if getattr(run, "reweighted", False):
            present(run, "weight")
        return np.ones(samples)
    trust = numbers("run.weight", run.weight)
    if trust.shape != (samples,):
        raise refuse("run.weight", trust.shape, f"shape {(samples,)}")
    return trust


def _without_skipped(phibar: Array, skipped: Any) -> Array:
    """A skipped sample moved nothing, so it informed nothing."""
    if skipped is None:
        return phibar
    used = np.asarray(skipped) == 0
    return np.asarray(phibar * used[:, np.newaxis, np.newaxis], dtype=np.float64)


def _prior(
    phibar: Array, path: Array, recorded: Any, forgetting: Any, precision: float
) -> tuple[Array, NDArray[np.bool_] | None]:
    """P̄_k recorded, from F_k, or recomputed with where that could be done."""
    samples, _, n = phibar.shape
    if recorded is not None:
        return stack("prior_covariance", recorded, samples, n), None
    if forgetting is not None:
        kept = np.linalg.inv(path[:-1]) - stack("forgetting", forgetting, samples, n)
        return np.asarray(np.linalg.inv(kept), dtype=np.float64), None
    return recomputed(phibar, path, precision)
