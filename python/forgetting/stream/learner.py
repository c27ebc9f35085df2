"""The estimator of a stream, and what it says of every row: estimates, errors, standard errors.

The same as `forgetting.record.identify` says of a record, with the same origin (a model with a
constant is measured from its first complete sample) and the same standard errors; that of the
constant is exact at every row.
"""

from __future__ import annotations

import base64
from typing import Any

import numpy as np
from numpy.typing import NDArray

import forgetting as fg
from forgetting.record.half_life import LastTime
from forgetting.record.identify import estimator_for
from forgetting.record.learned import inside
from forgetting.record.limits import within
from forgetting.record.origin import at_zero, weighted_sum
from forgetting.record.trace import USED
from forgetting.stream.estimates import Estimates
from forgetting.stream.noise import RunningNoise
from forgetting.stream.rows import Array
from forgetting.stream.running import run_all
from forgetting.stream.samples import Samples, Seen
from forgetting.words.errors import RecordError

ROOM = 4_000_000
"""Numbers that the covariances of one run may be."""


class Learner:
    """An estimator, the origin that it measures from, and the noise so far.

    Parameters
    ----------
    regressors, outputs : int
    constant : int or None
        The regressor that is the constant 1.
    rule, gate, initial_covariance, dtype
        See `forgetting.record.identify`.
    standard_errors : bool
        Whether they are wanted; that of the constant needs all of P at every row.
    also : tuple of str
        Further outputs of `run` that are wanted.
    makes_regressors : bool
        Whether the model makes regressors from its own estimates, and tells these by `Seen`.
    limits : pair of ndarray, shape (n,), or None
        Smallest and largest value of each parameter, within which estimates are said.
    bounds : pair of ndarray, shape (n,), or None
        Those that the estimator itself keeps to.
    """

    def __init__(
        self,
        regressors: int,
        outputs: int,
        constant: int | None,
        rule: Any,
        gate: Any,
        initial_covariance: Any,
        dtype: str,
        standard_errors: bool,
        also: tuple[str, ...],
        makes_regressors: bool = False,
        limits: tuple[Array, Array] | None = None,
        bounds: tuple[Array, Array] | None = None,
    ) -> None:
        settings = {"targets": outputs, "initial_covariance": initial_covariance, "dtype": dtype}
        self.estimator = estimator_for(regressors, rule, gate=gate, **settings)
        self.constant = constant if initial_covariance is None else None
        self.n, self.m = regressors, outputs
        self.wants_errors = standard_errors
        self.also = also
        self.makes_regressors = makes_regressors
        self.limits, self.bounds = limits, bounds
        self.phi0: Array | None = None
        self.y0 = np.zeros(outputs)
        self.last = LastTime()
        self.noise = RunningNoise(regressors, outputs)
        self.reason = ""
        """What was said of the first refused row since it was last taken."""

    def take(self, samples: Samples, time: Array | None = None) -> tuple[Estimates, Array, Array]:
        """Learn from rows; also the rows as they were measured from the origin."""
        phi, y = samples.phi, samples.y
        if samples.seen is not None:
            return self._of_model(samples.seen), phi, y
        start = self._find_origin(phi, y)
        # A difference of very large numbers is infinite, and refused like they are.
        with np.errstate(over="ignore"):
            moved = phi if self.phi0 is None else phi - self.phi0
            target = y if self.phi0 is None else y - self.y0
        pieces = [
            self._run(moved[part], target[part], None if time is None else time[part])
            for part in self._parts(len(phi))
        ]
        found = {key: np.concatenate([each[key] for each in pieces]) for key in pieces[0]}
        return self._estimates(found, y, start), moved, target

    def _find_origin(self, phi: Array, y: Array) -> int:
        """Take the first complete sample as origin; the first row that is measured from it."""
        if self.constant is None or self.phi0 is not None:
            return 0
        complete = np.flatnonzero(~(np.isnan(phi).any(axis=1) | np.isnan(y).any(axis=1)))
        if not len(complete):
            return len(phi)
        first = int(complete[0])
        self.phi0, self.y0 = phi[first].copy(), y[first].copy()
        self.phi0[self.constant] = 0.0
        return first

    def _parts(self, total: int) -> list[slice]:
        length = self.most if self._needs_covariance else total
        return [slice(start, start + length) for start in range(0, total, length)]

    @property
    def most(self) -> int:
        """Rows that one run may have where P of all of them is needed."""
        return max(ROOM // self.n**2, 1)

    @property
    def _needs_covariance(self) -> bool:
        if self.limits is not None:
            return True
        return self.wants_errors and (self.constant is not None or self.makes_regressors)

    @property
    def wanted(self) -> tuple[str, ...]:
        """Outputs of the estimator that are needed of each row, beside theta and error."""
        wanted = ["leverage", "skipped", "windup", *self.also]
        if self._needs_covariance:
            wanted.append("covariance")
        elif self.wants_errors:
            wanted.append("variance")
        return tuple(dict.fromkeys(wanted))

    def _run(self, phi: Array, y: Array, time: Array | None) -> dict[str, Any]:
        names = ("theta", "error", *self.wanted)
        brought = run_all(self.estimator, phi, y, names, time, self.last, self.bounds)
        self.reason = self.reason or brought.reason
        return as_double(brought.outputs) | {"refused": brought.refused}

    def _estimates(self, found: dict[str, Any], y: Array, start: int) -> Estimates:
        total = len(y)
        theta = found["theta"].reshape(total, self.n, self.m)
        error = found["error"].reshape(total, self.m)
        noise = self.noise.take(error, found["leverage"], found["skipped"] == USED)
        errors = None
        if self.wants_errors:
            errors = np.sqrt(self._variance(found)[:, :, None] * noise[:, None, :])
        if self.phi0 is not None:
            theta[start:, self.constant] += self.y0 - weighted_sum(self.phi0, theta[start:])
        self._hold(theta, found)
        others = {name: found[name] for name in (*self.also, "windup")}
        return Estimates(
            theta, error, y - error, errors, noise, found["skipped"], found["refused"], others
        )

    def _of_model(self, seen: Seen) -> Estimates:
        """With the estimates and errors of the model itself, not of the linear regression."""
        self.reason, found = self.reason or seen.reason, as_double(seen.outputs)
        noise = self.noise.take(seen.error, found["leverage"], found["skipped"] == USED, seen.trust)
        errors = None
        if self.wants_errors:
            variance = np.einsum("tii->ti", found["covariance"]).copy()
            if seen.origin is not None:
                change = seen.origin.gradient(seen.theta)
                products = row_sum(change, found["covariance"])
                variance[:, -1] = row_sum(change, products[:, :, None])[:, 0]
            errors = np.sqrt(variance[:, :, None] * noise[:, None, :])
        theta = seen.theta
        if self.limits is not None:
            theta = inside(theta, found["covariance"], self.limits, seen.origin)
        return Estimates(
            theta[:, :, None],
            seen.error,
            seen.measured - seen.error,
            errors,
            noise,
            found["skipped"],
            seen.refused,
            {name: found[name] for name in (*self.also, "windup")},
        )

    def _variance(self, found: dict[str, Any]) -> Array:
        """Diagonal of P for the regressors as they are, (T, n)."""
        if not self._needs_covariance:
            return np.asarray(found["variance"])
        covariance = found["covariance"]
        variance: Array = np.einsum("tii->ti", covariance).copy()
        if self.phi0 is not None:
            products = weighted_sum(self._change, covariance)
            variance[:, self.constant] = weighted_sum(self._change, products)
        return variance

    @property
    def _change(self) -> Array:
        """What makes of the parameters the constant of regressors measured from zero, (n,)."""
        assert self.phi0 is not None
        assert self.constant is not None
        change = -self.phi0
        change[self.constant] = 1.0
        return change

    def _hold(self, theta: Array, found: dict[str, Any]) -> None:
        """Move estimates (T, n, 1) into their bounds, in place."""
        if self.limits is None:
            return
        lower, upper = self.limits
        out = np.flatnonzero(((theta[:, :, 0] < lower) | (theta[:, :, 0] > upper)).any(axis=1))
        if not len(out):
            return
        covariance = found["covariance"][out]
        if self.constant is not None and self.phi0 is not None:
            covariance = at_zero(covariance, self._change, self.constant)
        theta[out, :, 0] = within(theta[out, :, 0], covariance, lower, upper)

    def state(self) -> dict[str, Any]:
        """As `restore` takes it."""
        return {
            "estimator": base64.b64encode(self.estimator.to_bytes()).decode(),
            "phi0": None if self.phi0 is None else self.phi0.tolist(),
            "y0": self.y0.tolist(),
            "last": self.last.when,
            **self.noise.state(),
        }

    def restore(self, state: dict[str, Any]) -> None:
        """Go on from a saved state.

        Raises
        ------
        RecordError
            When the saved estimator is another one.
        """
        saved = type(self.estimator).from_bytes(base64.b64decode(state["estimator"]))
        own = (self.estimator.parameters, self.estimator.targets, self.estimator.describe())
        if (saved.parameters, saved.targets, saved.describe()) != own:
            raise RecordError("the saved estimator is another than that of these settings")
        self.estimator = saved
        self.phi0 = None if state["phi0"] is None else np.array(state["phi0"])
        self.y0 = np.array(state["y0"])
        self.last = LastTime(state["last"])
        self.noise.restore(state)


def as_double(outputs: dict[str, NDArray[Any]]) -> dict[str, Any]:
    """Outputs of a run, numbers of 32 bits in 64."""
    return {
        name: values.astype(np.float64) if values.dtype.kind == "f" else values
        for name, values in outputs.items()
    }


def row_sum(weights: Array, values: Array) -> Array:
    """Sum of weights[t, i] times values[t, i], in this order; see `weighted_sum`.

    Examples
    --------
    >>> row_sum(np.array([[1.0, 2.0]]), np.array([[[3.0], [4.0]]]))
    array([[11.]])
    """
    total = weights[:, 0, None] * values[:, 0]
    for i in range(1, weights.shape[1]):
        total = total + weights[:, i, None] * values[:, i]
    return np.asarray(total)


def in_bank(estimator: Any) -> bool:
    """Whether the estimator is a bank, which has a memory and weights of its members."""
    return isinstance(estimator, fg.Bank)
