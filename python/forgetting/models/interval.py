"""How far outputs may be from what `ARMA`, `ARMAX`, `OE` and `BJ` predict of them.

The noise is σ² times what is not known of it (`forgetting.models.unknown`); what the parameters are
off by is added by the delta method, σ² g P gᵀ with g the slope of a prediction along them. P of a
bank is left out, see `forgetting.models.uncertainty`.
"""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from forgetting._core import RLS, Bank, InvalidInput, SignalModel
from forgetting.choices import AXES
from forgetting.models.gradient import Coefficients, gradients
from forgetting.models.uncertainty import leverage, root_of
from forgetting.models.unknown import with_unknown

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

NOTHING = 1e-100
"""P of an estimator that learns nothing more."""


@dataclass(frozen=True)
class Learned:
    """What a model has learned.

    Attributes
    ----------
    signals : SignalModel
        Its signals after the last sample.
    estimator : RLS or Bank
    noise_variance : float
        Of e.
    theta : ndarray, shape (n,)
        The estimate, its constant that of signals measured from `origin`.
    origin : ndarray, shape (inputs + 1,)
        What each input and the output are measured from.
    own : Coefficients
        Those of `theta`.
    """

    signals: SignalModel
    estimator: RLS | Bank
    noise_variance: float
    theta: Array
    origin: Array
    own: Coefficients

    def of_record(self, inputs: Array, outputs: Array, predicted: Array) -> Array:
        """Standard deviation of each output about its one-step prediction from rest, (T,)."""
        known = ~np.isnan(outputs)
        filled = np.where(known, outputs, predicted) - self.origin[-1]
        psi = gradients(self.own, held(inputs - self.origin[:-1]), filled)
        return self._deviation(psi, ~known)

    def to_come(self, inputs: Array, forecast: Array) -> Array:
        """Standard deviation of each output after the last sample about its forecast, (steps,)."""
        psi = self._slopes_to_come(inputs, forecast)
        if np.isnan(psi).any():
            raise InvalidInput(
                "a value in the last rows is missing; a forecast with a level begins behind them"
            )
        return self._deviation(psi, np.ones(len(forecast), dtype=np.bool_))

    def _slopes_to_come(self, inputs: Array, forecast: Array) -> Array:
        """ψ where outputs are what is forecast, shown to an estimator that stays where it is."""
        still = RLS(len(self.theta), rule=AXES["rule"].make("none"), initial_covariance=NOTHING)
        still.theta = self.theta
        kept = copy(self.signals).learn(still, inputs, forecast, ("phi", "scale"))
        return np.asarray(kept["phi"] / kept["scale"][:, None])

    def _deviation(self, psi: Array, unknown: Mask) -> Array:
        noise = self.own.noise_numerator, self.own.noise_denominator
        variance, slope = with_unknown(psi, unknown, *noise)
        variance += leverage(slope, root_of(self.estimator))
        return np.asarray(np.sqrt(self.noise_variance * variance))


def held(signals: Array) -> Array:
    """Signals (T, c) whose missing values are the last ones before, 0 where there is none.

    Examples
    --------
    >>> held(np.array([[np.nan], [2.0], [np.nan]])).ravel().tolist()
    [0.0, 2.0, 2.0]
    """
    rows = np.arange(len(signals))[:, None]
    last = np.maximum.accumulate(np.where(np.isnan(signals), -1, rows), axis=0)
    before = np.take_along_axis(signals, np.maximum(last, 0), axis=0)
    return np.asarray(np.where(last < 0, 0.0, before))
