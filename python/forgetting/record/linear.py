"""A model that is linear in its parameters over a record, with what is known of these.

`Learned` (`forgetting.record.learned`) is the same of a model whose noise is not white: `identify`
asks both for the same things.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting.record.feedback import Feedback, feedback
from forgetting.record.known import Known
from forgetting.record.limits import Limits
from forgetting.record.moved import Moved
from forgetting.record.origin import Origin
from forgetting.record.samples import Samples
from forgetting.record.trace import Hold, Trace, errors_without_forgetting

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Linear:
    """A record as a linear model sees it.

    Attributes
    ----------
    samples : Samples
        Regressors of the parameters that are estimated, and outputs.
    known : Known
        What is known of parameters.
    past : Feedback
        Which parameters are those of past outputs.
    """

    samples: Samples
    known: Known
    past: Feedback

    @classmethod
    def of(cls, samples: Samples, known: Known) -> Linear:
        """Without the parameters that are fixed."""
        known.check(samples.regressors, samples.outputs)
        past = feedback(samples)
        if known:
            past = past.knowing(known.values(samples.regressors), known.left(samples.regressors))
        return cls(known.without_fixed(samples), known, past)

    @property
    def seen(self) -> Samples:
        """What the estimator is shown: of a parameter with a prior how far it is from there."""
        return self.known.from_priors(self.samples)

    def hold(self, limits: Limits) -> Hold | None:
        """What moves estimates inside their bounds; None where the estimator itself does."""
        return limits.hold if self.known.bounds and not self.known.feed_back else None

    def put(self, trace: Trace) -> Trace:
        """The trace with the estimates and errors of the model: those of its regression."""
        return trace

    def never_forgetting(
        self, moved: Moved, settings: dict[str, Any], teach: Callable[[Any], None]
    ) -> Array:
        """One-step errors (T, m) of the same model that never forgets."""
        return errors_without_forgetting(moved, settings, teach)

    def back(self, trace: Trace, here: Origin, limits: Limits) -> Trace:
        """The trace in terms of parameters of samples as they are; it changes in place."""
        trace = here.back(trace)
        limits.put(trace.theta)
        self.known.add_priors(trace.theta, self.samples.regressors)
        return trace
