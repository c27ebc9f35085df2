"""Models that turn signals into regressors and keep the estimator behind them.

`ARX` is a linear difference equation with any forgetting rule, in the shape scikit-learn users
know: constructor parameters stay as given, learned values end in an underscore.
"""

from forgetting.models.arx import ARX
from forgetting.models.orders import Orders

__all__ = ["ARX", "Orders"]
