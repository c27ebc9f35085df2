"""How far parameters drift and how far noise remembers: where the printed ± comes from.

P of a rule is the covariance of parameters that drift as that rule supposes, under white noise.
What a record says of both is in its one-step errors. For parameters that walk at random with steps
of variance q σ², and noise e(k) = r e(k-1) + w(k) with w of variance σ², the estimator of least
variance is the rule `random_walk` on y(k) - r y(k-1) and phi(k) - r phi(k-1) (Cochrane and Orcutt
1949), and

    log L = -1/2 Σ (log σ² + log(1 + s_k) + (ν + 1) log(1 + e_k² / (ν σ² (1 + s_k))))

is the likelihood of its one-step errors, s the leverage (Harvey 1989, section 3.4; with Student's t
of ν degrees of freedom for the normal distribution, as a few wild errors would look like a drift).
Over a grid of r and q each course is weighted by its likelihood. The estimates of those that weigh,
and σ² P of each, give mean and variance of the parameters; the estimate of any rule differs from
that mean by something that is known. ± is such that two of them hold 95.4 % of what the parameters
may be.

Regressors are measured from their means and in units of their typical size, so that neither units
nor zeros matter; q is the same for all of them. Both are chosen on the last `courses.SAMPLES`
samples, and used on all of them: ± of an early sample knows of later ones how restless the record
is.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import forgetting as fg
from forgetting.record.courses import (
    LEAST,
    OUTPUTS,
    Course,
    differenced,
    walk,
    weigh,
)
from forgetting.record.known import Known
from forgetting.record.moved import Moved, as_run
from forgetting.record.origin import Origin, constant_of, nowhere
from forgetting.record.samples import Samples
from forgetting.record.trace import AT_ONCE, USED

Array = NDArray[np.float64]

NOTED = 2000
"""Rows at which the courses are noted; ± in between is drawn straight."""
FAIR = 1.15
"""Times that ± may be too small before it is said; two of them still hold 92 %."""


@dataclass(frozen=True)
class Drift:
    """The courses that weigh, and what they say of the parameters. See this module.

    Attributes
    ----------
    courses : tuple of Course
        The heaviest first; their weights add up to 1.
    rows : ndarray, shape (K,)
        Rows after which they are noted; the last is one of them.
    mean, variance : ndarray, shape (K, n, m)
        Of the parameters after these rows.
    samples : int
        Complete samples of the record.
    """

    courses: tuple[Course, ...]
    rows: NDArray[np.int64]
    mean: Array
    variance: Array
    samples: int

    @property
    def correlation(self) -> float:
        """Of neighbouring errors, as expected."""
        return sum(course.weight * course.correlation for course in self.courses)

    @property
    def process_noise(self) -> float:
        """Variance of a step in units of the noise's, as expected."""
        return sum(course.weight * course.process_noise for course in self.courses)

    def final_standard_error(self, theta: Array) -> Array:
        """± of the last estimate `theta` (n, m): two of them hold 95.4 %."""
        return around(theta, self.mean[-1], self.variance[-1])

    def standard_error(self, theta: Array, i: int, j: int, rows: NDArray[np.int64]) -> Array:
        """± of `theta` (K,), parameter i of output j as estimated after each of the rows."""
        mean = np.interp(rows, self.rows, self.mean[:, i, j])
        return around(theta, mean, np.interp(rows, self.rows, self.variance[:, i, j]))

    def describe(self, start: str = "± counts with") -> str:
        """Say in a sentence what ± counts with."""
        r, q = self.correlation, self.process_noise
        noise = f"noise whose neighbours correlate at {r:.2f}" if r > 0.05 else "white noise"
        if q * self.samples**2 < LEAST:
            return f"{start} {noise} and parameters that stand still."
        return (
            f"{start} {noise} and parameters that drift: each moves the output by about "
            f"{(q * self.samples) ** 0.5:.2g} times the noise in the {self.samples} samples."
        )

    def to_dict(self) -> dict[str, Any]:
        """Ready for JSON."""
        return {
            "noise_correlation": self.correlation,
            "process_noise": self.process_noise,
        }


def claim(claimed: Array, right: Array, found: Drift) -> str:
    """Compare the standard errors that a rule claims with those of the record, (n, m) each."""
    known = np.isfinite(claimed) & (claimed > 0) & np.isfinite(right)
    ratio = float(np.max(right[known] / claimed[known])) if known.any() else 1.0
    if ratio < FAIR:
        return "± is what the rule's P says; this record does not speak for more."
    return (
        f"± is what the rule's P says, up to {ratio:.2g} times too small here: "
        + found.describe("the record speaks for")
    )


def around(theta: Array, mean: Array, variance: Array) -> Array:
    """Half of what holds 95.4 % about an estimate, of parameters of this mean and variance."""
    spread = np.sqrt(variance)
    with np.errstate(divide="ignore", invalid="ignore"):
        away = np.abs(theta - mean) / spread
    known = np.asarray(spread * half_width(np.where(spread > 0, away, 0.0)) / 2)
    return np.where(spread > 0, known, np.abs(theta - mean))


def half_width(away: Array) -> Array:
    """Half of the interval about 0 that holds 95.4 % of a normal number with this mean, variance 1.

    Examples
    --------
    >>> half_width(np.array([0.0, 10.0])).round(2).tolist()  # 10 + 1.69: one side is left
    [2.0, 11.69]
    """
    widths = np.array([2.0, 2.039, 2.149, 2.309, 2.495, 2.741, 3.19, 3.69])
    at = np.array([0.0, 0.2, 0.4, 0.6, 0.8, 1.05, 1.5, 2.0])
    return np.asarray(np.where(away < at[-1], np.interp(away, at, widths), away + 1.69))


def drift(samples: Samples, settings: dict[str, Any], known: Known) -> Drift | None:
    """Weigh the courses of a record; None where it is too short, or beyond the range of numbers.

    Parameters
    ----------
    samples : Samples
    settings : dict
        Of the estimators: targets, initial_covariance and dtype.
    known : Known
        Before the first sample; its priors are those of the courses.
    """
    # a P that was given is of parameters as they are
    moves = settings["initial_covariance"] is None and not known.of_constant(samples)
    here = middle(samples, moves=moves)
    moved = here.moved(samples)
    courses = weigh(moved, settings)
    rows = ends(len(samples.y))
    try:
        found = [along(moved, here, course, rows, settings, known) for course in courses]
    except fg.NumericalRange:
        found = []
    if not found:
        return None
    weights = [course.weight for course in courses]
    mean = sum(w * theta for w, (theta, _) in zip(weights, found, strict=True))
    around_mean = sum(
        w * (spread + np.square(theta - mean))
        for w, (theta, spread) in zip(weights, found, strict=True)
    )
    complete = int(samples.complete.sum())
    return Drift(courses, rows, np.asarray(mean), np.asarray(around_mean), complete)


def ends(total: int) -> NDArray[np.int64]:
    """Rows after which the courses are noted: all, or `NOTED` of them with the last."""
    return np.arange(total - 1, -1, -max(1, -(-total // NOTED)))[::-1]


def along(
    samples: Moved,
    here: Origin,
    course: Course,
    rows: NDArray[np.int64],
    settings: dict[str, Any],
    known: Known,
) -> tuple[Array, Array]:
    """θ and σ² P_ii of a course after each of the rows, (K, n, m) each, as measured from zero."""
    estimator = walk(samples, course.process_noise, settings)
    known.teach(estimator, samples.regressors, known.prior_values(samples.regressors))
    at_once = len(rows) == len(samples) and samples.parameters <= AT_ONCE
    if at_once and samples.samples.origin is None:
        thetas, spreads = every_row(samples, here, course, estimator, settings)
    else:
        thetas, spreads = row_by_row(samples, here, course, rows, estimator, settings)
    return here.theta(thetas), spreads


def every_row(
    samples: Moved, here: Origin, course: Course, estimator: Any, settings: dict[str, Any]
) -> tuple[Array, Array]:
    """As `row_by_row`, in one run."""
    n, m, change = samples.parameters, samples.targets, here.change()
    phi, y = as_run(*after(samples, course, 0, len(samples)), settings["dtype"])
    found = estimator.run(phi, y, outputs=(*OUTPUTS, "theta", "covariance"), missing="skip")
    thetas = np.array(found.theta, dtype=np.float64).reshape(-1, n, m)
    spreads = ((change @ found.covariance) * change).sum(axis=2)
    return thetas, spreads[:, :, None] * variances(found, n)[:, None]


def row_by_row(
    samples: Moved,
    here: Origin,
    course: Course,
    rows: NDArray[np.int64],
    estimator: Any,
    settings: dict[str, Any],
) -> tuple[Array, Array]:
    """θ of the estimator and σ² P_ii after each of the rows, (K, n, m) each."""
    n, m, origin = samples.parameters, samples.targets, samples.samples.origin
    change = here.change()
    noise, thetas, spreads, start = Noise(n, m), [], [], 0
    for row in rows:
        phi, y = as_run(*after(samples, course, start, int(row) + 1), settings["dtype"])
        found = estimator.run(phi, y, outputs=OUTPUTS, missing="skip")
        noise.take(found)
        theta = np.asarray(estimator.theta, dtype=np.float64).reshape(n, m)
        if origin is not None:  # of a model of one output
            change, theta = origin.change(theta[:, 0]), origin.express(theta[:, 0])[:, None]
        thetas.append(theta)
        spread = ((change @ estimator.covariance) * change).sum(axis=1)
        spreads.append(spread[:, None] * noise.variance)
        start = row + 1
    return np.array(thetas), np.array(spreads)


def after(samples: Moved, course: Course, start: int, stop: int) -> tuple[Array, Array]:
    """Some rows less what the noise of the row before leaves in them."""
    before = 1 if course.correlation and start else 0
    parts = differenced(*samples.rows(slice(start - before, stop)), course.correlation)
    return parts[0][before:], parts[1][before:]


class Noise:
    """The running mean of e²/(1 + s) over the samples used but the first n."""

    def __init__(self, parameters: int, outputs: int) -> None:
        self.left, self.count, self.sum = parameters, 0, np.zeros(outputs)

    def take(self, found: Any) -> None:
        """Add the samples of a run."""
        used = np.flatnonzero(found.skipped == USED)
        first, self.left = min(self.left, len(used)), max(self.left - len(used), 0)
        used = used[first:]
        error = np.asarray(found.error, dtype=np.float64).reshape(len(found.skipped), -1)[used]
        self.count += len(used)
        self.sum = self.sum + (error**2 / (1.0 + found.leverage[used, None])).sum(axis=0)

    @property
    def variance(self) -> Array:
        """σ² of each output, (m,); NaN before there is any."""
        return self.sum / self.count if self.count else np.full_like(self.sum, np.nan)


def variances(found: Any, parameters: int) -> Array:
    """The variance of `Noise` after each sample of a run, (T, m)."""
    used = found.skipped == USED
    used &= np.cumsum(used) > parameters
    error = np.asarray(found.error, dtype=np.float64).reshape(len(used), -1)
    squares = np.where(used[:, None], error**2 / (1.0 + found.leverage[:, None]), 0.0)
    with np.errstate(invalid="ignore"):  # 0/0 before there is any
        return np.asarray(np.cumsum(squares, axis=0) / np.cumsum(used)[:, None])


def middle(samples: Samples, moves: bool) -> Origin:
    """The means of the record, if the model has a constant and `moves`; else zero."""
    constant, level = constant_of(samples) if moves else (None, 1.0)
    if constant is None:
        return nowhere(samples)
    parts = [(phi.sum(axis=0), y.sum(axis=0)) for phi, y in samples.known_pieces()]
    count = int(samples.complete.sum())
    center, output = (np.sum(sums, axis=0) / count for sums in zip(*parts, strict=True))
    center[constant] = 0.0
    return Origin(constant, level, center, output)
