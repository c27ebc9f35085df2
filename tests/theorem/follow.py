"""One record through the package and through the references, compared at checkpoints."""

from __future__ import annotations

from dataclasses import dataclass, field

import forgetting as fg
import numpy as np
from reference import precision, rates, rules
from reference.agreement import skipped_update
from reference.estimator import Estimator
from reference.linalg import Matrix, symmetric_parameter, to_float
from reference.signals import Record
from reference.step import MeasureThenForget
from reference.weighting import WEIGHTINGS

from . import product

# Powers of two see the start, where P is worst conditioned; then every 60 samples.
CHECKPOINTS = [1, 2, 4, 8, 16, 32, 64, *range(120, 481, 60), 500]
COVARIANCE = 100.0


@dataclass(frozen=True)
class Setting:
    """What is run: a rule's parameter set, a rate or a constant factor, a weighting."""

    rule: str
    case: dict[str, object]
    rate: tuple[str, dict[str, object]] = ("constant", {"forgetting_factor": 0.98})
    weighting: tuple[str, dict[str, object]] = ("equal", {})
    dtype: str = "float64"


@dataclass
class Gap:
    """Largest differences so far: relative, and in units of eps cond(P).

    cond(P) is the largest condition number of P at the checkpoints so far: an error made where P
    was ill-conditioned stays in theta.
    """

    eps: float
    condition: float = 1.0
    relative: dict[str, float] = field(default_factory=dict)
    scaled: dict[str, float] = field(default_factory=dict)

    def add(self, name: str, found: object, wanted: object, scale: float | None = None) -> None:
        """Largest |found - wanted| relative to ``scale`` (by default the largest |wanted|)."""
        found, wanted = np.asarray(found, dtype=float), np.asarray(wanted, dtype=float)
        scale = np.abs(wanted).max() if scale is None else scale
        off = np.abs(found - wanted).max() / (scale or 1.0)
        off = off if np.isfinite(off) else np.inf
        self.relative[name] = max(self.relative.get(name, 0.0), off)
        unit = self.eps * self.condition
        self.scaled[name] = max(self.scaled.get(name, 0.0), off / unit)


def rounded(value: object, dtype: str) -> object:
    """A parameter as a package of this precision holds it."""
    if isinstance(value, float | np.ndarray):
        near = np.asarray(value, dtype=dtype).astype(float)
        return near if near.ndim else float(near)
    if isinstance(value, list):
        return [rounded(item, dtype) for item in value]
    if isinstance(value, dict):
        return {key: rounded(item, dtype) for key, item in value.items()}
    return tuple(rounded(item, dtype) for item in value) if isinstance(value, tuple) else value


class Race:
    """The package's estimator beside the dense recursion and the published form."""

    def __init__(self, setting: Setting, record: Record) -> None:
        n, p, targets = record.phi.shape[2], record.phi.shape[1], record.y.shape[2]
        case, (rate, values) = rounded(setting.case, setting.dtype), setting.rate
        values, (robust, limits) = rounded(values, setting.dtype), setting.weighting
        limits = rounded(limits, setting.dtype)
        self.est = fg.RLS(
            n,
            rule=product.rule(setting.rule, case, product.rate(rate, values)),
            weighting=product.weighting(robust, limits),
            rows=p,
            targets=targets,
            initial_covariance=COVARIANCE,
            dtype=setting.dtype,
        )
        module = rules.load(setting.rule)
        # factors that belong to the rule, or to the rule inside it, are not the rate's to report
        own = isinstance(case.get("forgetting_factor"), list)
        self.rated = product.RULES[setting.rule]["forgetting_factor"] and not own
        adaptive = rates.load(rate).Rate(**values) if module.RATED else None
        weighting = WEIGHTINGS[robust](**limits)
        self.dense = Estimator(n, module.Dense(n, **case), adaptive, weighting, targets, COVARIANCE)
        start = symmetric_parameter(COVARIANCE, n)
        self.published = module.Published(Matrix(n, targets), start, **case)
        self.record, self.dtype = record, setting.dtype
        self.gap = Gap(float(np.finfo(setting.dtype).eps))

    def stretch(self, start: int, end: int) -> None:
        """Samples start..end-1; errors, factors and skips are compared one by one."""
        r, dtype = self.record, self.dtype
        gamma = None if r.gamma is None else r.gamma[start:end].astype(dtype)
        run = product.feed(
            self.est, r.phi[start:end].astype(dtype), r.y[start:end].astype(dtype), gamma
        )
        for i, k in enumerate(range(start, end)):
            theta = to_float(self.dense.theta)
            error = r.y[k] - r.phi[k] @ theta
            scale = np.abs(r.y[k]).max() + np.abs(r.phi[k]).sum() * np.abs(theta).max()
            self.gap.add("error", np.reshape(run.error[i], error.shape), error, scale)
            self.dense.update(r.phi[k], r.y[k], None if r.gamma is None else r.gamma[k])
            assert (run.skipped[i] != 0) == self.dense.skipped, (r.kind, k)
            if self.dense.skipped:
                skipped_update(self.published, self.dense, r, k)
                continue
            if self.rated:
                self.gap.add("factor", run.forgetting_factor[i], float(self.dense.factor), 1.0)
            self.published.update(*self.dense.whitened[-1])

    def check(self) -> None:
        """theta and P against the dense recursion, the published form and the minimiser."""
        # after the data and before any forgetting of it, which E1 moves to the next sample
        covariance = to_float(self.dense.inverted)
        spread = np.linalg.eigvalsh(covariance)
        self.gap.condition = max(self.gap.condition, spread[-1] / spread[0])
        theta = np.reshape(self.est.theta, (self.dense.theta.nrows(), -1))
        for reference in (self.dense.theta, self.published.theta, self.dense.cost.minimiser()):
            self.gap.add("theta", theta, to_float(reference))
        self.gap.add("covariance", self.est.covariance, covariance)
        if not isinstance(self.dense.rule, MeasureThenForget):
            self.gap.add("covariance", self.est.covariance, to_float(self.published.covariance))


def follow(setting: Setting, record: Record) -> Gap:
    """The largest gaps over the record, on input rounded to the setting's precision."""
    phi, y, gamma = (
        None if a is None else a.astype(setting.dtype).astype(float) for a in record[1:]
    )
    with precision.working(float(np.finfo(setting.dtype).eps)):
        race, done = Race(setting, Record(record.kind, phi, y, gamma)), 0
        for end in [c for c in CHECKPOINTS if c <= len(phi)]:
            race.stretch(done, end)
            race.check()
            done = end
    return race.gap
