"""A model whose noise is not white, identified over a record with what is known of its parameters.

The model gives its estimator a linear regression, the gradient of the prediction: fixed parameters
have no place in it, and what is estimated of one with a prior is how far it is from there.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from forgetting.models.estimator import new_estimator
from forgetting.models.named import NamedModel
from forgetting.models.signal_origin import SignalOrigin
from forgetting.record.feedback import Feedback, of_layout
from forgetting.record.known import Known
from forgetting.record.limits import Limits, within
from forgetting.record.moved import Moved
from forgetting.record.noise import noise_of, refuse_functions
from forgetting.record.origin import Origin
from forgetting.record.polynomial import Array, Recorded, recorded
from forgetting.record.read import Record
from forgetting.record.samples import Samples
from forgetting.record.trace import Hold, Trace

OUTPUTS = ("phi", "y", "theta", "error", "scale")


@dataclass(frozen=True)
class Learned:
    """A record as a model with coloured noise saw it.

    Attributes
    ----------
    seen : Samples
        The linear regression that the estimator was given, with the outputs as they were measured.
    known : Known
        What is known of parameters, with the noise that priors are weighed against.
    past : Feedback
        Which parameters are those of past outputs.
    theta : ndarray, shape (T, n)
        Estimate after each sample, stable, with the constant of signals as they are, of the
        parameters that are estimated.
    error : ndarray, shape (T, 1)
        One-step errors, NaN where the sample was left out.
    error_without_forgetting : ndarray, shape (T, 1)
        Those of the same model that never forgets.
    trust : ndarray, shape (T,)
        What each sample counted, in (0, 1]: less at the start.
    """

    seen: Samples
    known: Known
    past: Feedback
    theta: Array
    error: Array
    error_without_forgetting: Array
    trust: Array

    @property
    def samples(self) -> Samples:
        """The regression in terms of parameters as they are."""
        values = self.known.prior_values(self.seen.regressors)
        return replace(self.seen, y=self.seen.y + self.seen.phi @ values[:, None])

    def put(self, trace: Trace) -> Trace:
        """The trace of the linear regression with the estimates and errors of the model."""
        theta = self.theta[:, :, np.newaxis].copy()
        return replace(trace, theta=theta, error=self.error, trust=self.trust)

    def never_forgetting(
        self, moved: Moved, settings: dict[str, Any], teach: Callable[[Any], None]
    ) -> Array:
        """One-step errors (T, 1) of the same model that never forgets."""
        return self.error_without_forgetting

    def back(self, trace: Trace, here: Origin, limits: Limits) -> Trace:
        """The trace with P of signals as they are; the variance of the offset changes in place.

        It is exact after each piece of the run, and drawn straight in between.
        """
        origin = self.seen.origin
        if origin is None:
            return trace
        path = zip(self.theta[trace.rows], trace.covariances, strict=True)
        ends = [origin.covariance(theta, each)[-1, -1] for theta, each in path]
        trace.variance[:, -1] = np.interp(np.arange(len(trace.variance)), trace.rows, ends)
        return replace(trace, covariance=origin.covariance(self.theta[-1], trace.covariance))

    def hold(self, limits: Limits) -> Hold | None:
        """What moves estimates inside their bounds, if there are any."""
        return self._hold if self.known.bounds else None

    def _hold(self, _: Array, covariance: Array, first: int) -> None:
        """Move estimates inside, in place; see `forgetting.record.limits.Limits`."""
        theta = self.theta[first : first + len(covariance)]
        theta[:] = inside(
            theta, covariance, self.known.limits(self.seen.regressors), self.seen.origin
        )


def inside(
    theta: Array, covariance: Array, limits: tuple[Array, Array], origin: SignalOrigin | None
) -> Array:
    """The nearest estimates (K, n) within limits, in the metric of each P⁻¹, (K, n, n).

    `origin` is what the signals were measured from, of which P is.
    """
    lower, upper = limits
    found = theta.copy()
    for row in np.flatnonzero(((theta < lower) | (theta > upper)).any(axis=1)):
        own = np.asarray(covariance[row], dtype=np.float64)
        own = own if origin is None else origin.covariance(theta[row], own)
        found[row] = within(theta[None, row], own[None], lower, upper)[0]
    return found


def learned(
    record: Record,
    outputs: Sequence[str],
    inputs: Sequence[str],
    named: NamedModel,
    offset: bool = True,
    known: Known | None = None,
    **settings: Any,
) -> Learned:
    """Identify a model of one output over a record; see `recorded`."""
    found, known = recorded(record, outputs, inputs, named, offset, **settings), known or Known()
    regressors = found.signals.model.terms(inputs, outputs[0])
    known.check(regressors, outputs)
    if known.prior and known.noise is None:
        refuse_functions(settings.get("rule"), settings.get("gate"))
        plain = course(found, replace(known, prior={}), settings)
        seen = found.samples(plain["phi"], plain["y"], known)
        noise = noise_of(plain["error"][:, None], Moved(seen))
        known = replace(known, noise=noise)
    kept = course(found, known, settings)
    never = course(found, replace(known, bounds={}, feed_back=False), settings | {"rule": "none"})
    left = known.left(regressors)
    past = of_layout(found.signals.model.layout(len(inputs)))
    return Learned(
        seen=found.samples(kept["phi"], kept["y"], known),
        known=known,
        past=past.knowing(known.fixed_values(regressors), left),
        theta=np.ascontiguousarray(kept["theta"][:, left]),
        error=kept["error"][:, None],
        error_without_forgetting=never["error"][:, None],
        trust=kept["scale"] ** 2,
    )


def course(found: Recorded, known: Known, settings: dict[str, Any]) -> dict[str, Array]:
    """What the estimator was given, and what the model did at each row of the record."""
    own = found.signals
    regressors = own.model.terms(found.inputs, found.output)
    model = own.model.at_rest(len(found.inputs), *known.places(regressors))
    rule, others = settings.get("rule", "auto"), {**settings}
    others.pop("rule", None)
    estimator = new_estimator(model.estimated, rule, **others)
    known.refuse_bank(estimator)
    names = [regressors[i] for i in known.left(regressors)]
    known.teach(estimator, names)
    bounds = known.limits_from_priors(names) if known.feed_back else None
    kept = model.learn(estimator, own.inputs, own.output, OUTPUTS, bounds=bounds)
    return {name: np.asarray(kept[name])[own.rows] for name in OUTPUTS}
