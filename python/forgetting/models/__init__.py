"""Models that turn signals into regressors and keep the estimator behind them.

Linear difference equations of all usual structures with any forgetting rule, in the shape that
scikit-learn users know: constructor parameters stay as given, learned values end in an underscore.
"""

from forgetting.models.ar import AR
from forgetting.models.arma import ARMA
from forgetting.models.armax import ARMAX
from forgetting.models.arx import ARX
from forgetting.models.bj import BJ
from forgetting.models.fir import FIR
from forgetting.models.forecasts import Forecasts, forecasts
from forgetting.models.named import NamedModel
from forgetting.models.oe import OE
from forgetting.models.orders import Orders

__all__ = [
    "AR",
    "ARMA",
    "ARMAX",
    "ARX",
    "BJ",
    "FIR",
    "OE",
    "Forecasts",
    "NamedModel",
    "Orders",
    "forecasts",
]
