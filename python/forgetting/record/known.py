"""What is known of parameters before the record: values, bounds and priors, each by its name.

A fixed parameter leaves the regression: its part is taken from the output, y - phi_f theta_f, and
its column goes. A prior theta_p ± d is what one measurement of theta_p would have said,

    (σ/d) θ_p = (σ/d) theta_p + noise of standard deviation σ,

and the estimator is given it before the first sample, without any time passing: that sets the
estimate, and its variance in P to d²/σ², whatever the units. What is forgotten later is the prior
like any sample. σ, the standard deviation of the noise, is told or found in the record. Bounds are
about what is said of the estimate, see `forgetting.record.limits`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import Bank
from forgetting.record.origin import constant_of
from forgetting.record.samples import Samples
from forgetting.words.errors import RecordError
from forgetting.words.rounding import brief
from forgetting.words.suggestion import suggestion

Array = NDArray[np.float64]
Bounds = Mapping[str, tuple[float | None, float | None]]


@dataclass(frozen=True)
class Known:
    """What is known of parameters, by the names of their regressors.

    Parameters
    ----------
    bounds : mapping of str to (float or None, float or None)
        The smallest and the largest value; None where there is none.
    fixed : mapping of str to float
        Values that are known exactly.
    prior : mapping of str to (float, float)
        A value, and the standard deviation with which it is known, > 0.
    noise : float, optional
        Standard deviation of the noise of the output, > 0, which priors are weighed against.
    feed_back : bool, default False
        Whether the estimator goes on from estimates that were moved into their bounds, in place of
        not knowing of bounds.

    Raises
    ------
    RecordError
        Naming the parameter whose value is out of range.

    Examples
    --------
    >>> known = Known(bounds={"R0": (0, None)}, fixed={"b": 2.5})
    >>> known.words("R0"), known.words("b"), known.words("c")
    ('at least 0', 'given', '')
    """

    bounds: Bounds = field(default_factory=dict)
    fixed: Mapping[str, float] = field(default_factory=dict)
    prior: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    noise: float | None = None
    feed_back: bool = False

    def __post_init__(self) -> None:
        for name, pair in self.bounds.items():
            lower, upper = ends(name, pair)
            if not lower <= upper or lower == math.inf or upper == -math.inf:
                raise RecordError(
                    f"the bounds of {name!r} are {lower:g} and {upper:g}; allowed: "
                    "a smallest value, a largest value not below it, or both"
                )
        for name, value in self.fixed.items():
            finite(f"the fixed value of {name!r}", value)
            if name in self.bounds or name in self.prior:
                raise RecordError(f"{name!r} is fixed; it takes no bounds and no prior")
        for name, (value, deviation) in self.prior.items():
            finite(f"the prior of {name!r}", value)
            positive(f"the standard deviation of the prior of {name!r}", deviation)
        if self.noise is not None:
            positive("the noise", self.noise)
        if self.feed_back and not self.bounds:
            raise RecordError("what is fed back is bounds, and there are none; say bounds")

    def __bool__(self) -> bool:
        """Whether anything is known."""
        return bool(self.bounds or self.fixed or self.prior)

    def check(self, regressors: Sequence[str], outputs: Sequence[str]) -> None:
        """Refuse what is said of parameters that a model with these regressors does not have."""
        if not self:
            return
        if len(outputs) != 1:
            raise RecordError(
                f"bounds, fixed values and priors are of a model with one output; "
                f"this one has {len(outputs)}"
            )
        for name in (*self.bounds, *self.fixed, *self.prior):
            if name not in regressors:
                there = suggestion(list(regressors), name, "the parameters are")
                raise RecordError(f"there is no parameter {name!r}{there}")
        if all(name in self.fixed for name in regressors):
            raise RecordError("every parameter is fixed; there is nothing to estimate")

    def left(self, regressors: Sequence[str]) -> list[int]:
        """Places of the parameters that are estimated."""
        return [i for i, name in enumerate(regressors) if name not in self.fixed]

    def fixed_values(self, regressors: Sequence[str]) -> Array:
        """The fixed values, and 0 for parameters that are estimated, (n,)."""
        return np.array([self.fixed.get(name, 0.0) for name in regressors], dtype=np.float64)

    def prior_values(self, regressors: Sequence[str]) -> Array:
        """The values of the priors, and 0 for parameters without one, (n,)."""
        pairs = [self.prior.get(name, (0.0, 0.0)) for name in regressors]
        return np.array([value for value, _ in pairs], dtype=np.float64)

    def places(self, regressors: Sequence[str]) -> tuple[dict[int, float], dict[int, float]]:
        """Fixed values, and those from which others are measured, by their places."""
        every = list(enumerate(regressors))
        fixed = {i: self.fixed[name] for i, name in every if name in self.fixed}
        prior = {i: self.prior.get(name, (0.0,))[0] for i, name in every if self.from_zero(name)}
        return fixed, {i: prior[i] for i in prior if i not in fixed}

    def values(self, regressors: Sequence[str]) -> Array:
        """What parameters are more than is estimated `from_priors` and `without_fixed`, (n,)."""
        return self.fixed_values(regressors) + self.prior_values(regressors)

    def limits(self, regressors: Sequence[str]) -> tuple[Array, Array]:
        """Smallest and largest value of each parameter, (n,) each; infinite where there is none."""
        pairs = [ends(name, self.bounds.get(name, (None, None))) for name in regressors]
        lower, upper = np.array(pairs, dtype=np.float64).reshape(-1, 2).T
        return lower, upper

    def limits_from_priors(self, regressors: Sequence[str]) -> tuple[Array, Array]:
        """The same of samples `from_priors`, which are those of the estimator."""
        lower, upper = self.limits(regressors)
        values = self.prior_values(regressors)
        return lower - values, upper - values

    def of_constant(self, samples: Samples) -> bool:
        """Whether a constant is that of samples measured from zero, since it is known there."""
        place = constant_of(samples)[0] if self.prior or self.feed_back else None
        return place is not None and self.from_zero(samples.regressors[place])

    def from_zero(self, name: str) -> bool:
        """Whether the estimator is told something of this parameter."""
        told = name in self.prior or name in self.fixed
        return told or (self.feed_back and name in self.bounds)

    def refuse_bank(self, estimator: Any) -> None:
        """Refuse to feed bounds back to several rules at once."""
        if self.feed_back and isinstance(estimator, Bank):
            raise RecordError(
                "bounds are fed back to one rule; say which, as the bank mixes several"
            )

    def add_priors(self, theta: Array, regressors: Sequence[str]) -> None:
        """Make of estimates (T, n, 1) of samples `from_priors` those of the samples, in place.

        They stay within their bounds, to the last bit.
        """
        if self.prior:
            theta += self.prior_values(regressors)[:, None]
        if self.bounds:
            lower, upper = self.limits(regressors)
            np.clip(theta, lower[:, None], upper[:, None], out=theta)

    def without_fixed(self, samples: Samples) -> Samples:
        """The samples less what fixed parameters bring, which leave them."""
        if not self.fixed:
            return samples
        left = self.left(samples.regressors)
        return replace(
            samples,
            phi=np.ascontiguousarray(samples.phi[:, left]),
            y=less(samples.y, samples.phi, self.fixed_values(samples.regressors)),
            regressors=tuple(samples.regressors[i] for i in left),
            measured=samples.as_measured,
        )

    def from_priors(self, samples: Samples) -> Samples:
        """The samples less what parameters at the values of their priors bring.

        What is estimated is then how far parameters are from there, 0 before the first sample.
        """
        if not self.prior:
            return samples
        y = less(samples.y, samples.phi, self.prior_values(samples.regressors))
        return replace(samples, y=y, measured=samples.as_measured)

    def teach(self, estimator: Any, regressors: Sequence[str], values: Array | None = None) -> None:
        """Give the priors to an estimator that has seen no sample.

        Parameters
        ----------
        estimator : RLS or Bank
        regressors : sequence of str
            Names of its parameters.
        values : ndarray, shape (n,), optional
            What the priors say of each; 0, as samples `from_priors` have it, when absent.

        Raises
        ------
        RecordError
            When the noise is not known, or a gate or rule leaves a prior out.
        """
        for place, name in enumerate(regressors):
            if name not in self.prior:
                continue
            if self.noise is None:
                raise RecordError("a prior is weighed against the noise, which is not known")
            phi = np.zeros(len(regressors))
            phi[place] = self.noise / self.prior[name][1]
            y = 0.0 if values is None else float(phi[place] * values[place])
            if estimator.update(phi, y, elapsed=0.0).skipped is not None:
                raise RecordError(f"the rule or its gate leaves out the prior of {name!r}")

    def words(self, name: str) -> str:
        """What is known of a parameter; empty where nothing is."""
        if name in self.fixed:
            return "given"
        said = []
        if name in self.prior:
            value, deviation = self.prior[name]
            said.append(f"prior {brief(value, 6)} ± {brief(deviation, 2)}")
        lower, upper = ends(name, self.bounds.get(name, (None, None)))
        if lower > -math.inf and upper < math.inf:
            said.append(f"{brief(lower, 6)} to {brief(upper, 6)}")
        elif lower > -math.inf:
            said.append(f"at least {brief(lower, 6)}")
        elif upper < math.inf:
            said.append(f"at most {brief(upper, 6)}")
        return ", ".join(said)

    def to_dict(self) -> dict[str, Any]:
        """Ready for JSON."""
        return {
            "bounds": {name: list(pair) for name, pair in self.bounds.items()},
            "fixed": dict(self.fixed),
            "prior": {name: list(pair) for name, pair in self.prior.items()},
            "noise": self.noise,
            "feed_back": self.feed_back,
        }


def less(y: Array, phi: Array, theta: Array) -> Array:
    """y (T, m) less what parameters `theta` (n,) bring; those of 0 take nothing.

    Examples
    --------
    >>> less(np.array([[5.0]]), np.array([[1.0, np.nan]]), np.array([2.0, 0.0]))
    array([[3.]])
    """
    rest = y.copy()
    for place in np.flatnonzero(theta):  # one after the other: every grouping of rows rounds alike
        rest -= theta[place] * phi[:, place, None]
    return rest


def ends(name: str, pair: tuple[float | None, float | None]) -> tuple[float, float]:
    """Both bounds as numbers, infinite where there is none."""
    try:
        lower, upper = pair
        made = (
            (-math.inf if lower is None else float(lower)),
            (math.inf if upper is None else float(upper)),
        )
    except (TypeError, ValueError):
        raise RecordError(
            f"the bounds of {name!r} are {pair!r}; allowed: two numbers, None where there is none"
        ) from None
    return made


def finite(what: str, value: Any) -> None:
    """Refuse what is no finite number."""
    if not isinstance(value, (int, float, np.integer, np.floating)) or not math.isfinite(value):
        raise RecordError(f"{what} is {value!r}; allowed: a finite number")


def positive(what: str, value: Any) -> None:
    """Refuse what is no finite number above 0."""
    finite(what, value)
    if not value > 0:
        raise RecordError(f"{what} is {value!r}; allowed: a finite number above 0")
