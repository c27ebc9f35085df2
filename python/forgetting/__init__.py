"""Recursive least squares with generalized forgetting.

Estimates the parameters of y = phi @ theta + noise from live data, sample by sample, and forgets
only what it should.

>>> import forgetting as fg
>>> est = fg.RLS(2, rule=fg.Subspace(0.98, threshold=1e-3), initial_covariance=100.0)
>>> u = est.update([1.0, 2.0], 8.0)
>>> u.error
8.0
"""

from . import registry
from ._core import (
    GATE,
    RLS,
    SKIPPED,
    Bank,
    BankUpdate,
    Evidence,
    Fleet,
    FleetUpdate,
    Intervals,
    InvalidInput,
    NumericalRange,
    Run,
    Update,
    __version__,
    bounded,
)
from .delayed import DelayedIntervals
from .fleet import FleetHealth
from .health import Health
from .meter import ExcitationMeter
from .models import AR, ARMA, ARMAX, ARX, BJ, FIR, OE, Forecasts, forecasts
from .polynomials import PolynomialModel
from .prediction import Prediction, predict
from .registry import *  # noqa: F403 (the axes and their registries)
from .tuning import Tuning, tune, tune_arx, tune_model

__all__ = [
    "AR",
    "ARMA",
    "ARMAX",
    "ARX",
    "BJ",
    "FIR",
    "GATE",
    "OE",
    "RLS",
    "SKIPPED",
    "Bank",
    "BankUpdate",
    "DelayedIntervals",
    "Evidence",
    "ExcitationMeter",
    "Fleet",
    "FleetHealth",
    "FleetUpdate",
    "Forecasts",
    "Health",
    "Intervals",
    "InvalidInput",
    "NumericalRange",
    "PolynomialModel",
    "Prediction",
    "Run",
    "Tuning",
    "Update",
    "__version__",
    "bounded",
    "forecasts",
    "predict",
    "tune",
    "tune_arx",
    "tune_model",
]
__all__ += registry.__all__
