"""Which rule, factor, rate, prior and orders predict best, chosen and reported on different data.

Everything is chosen on the first part of a record and reported on the rest, beside the bank, no
forgetting and the last value; a test says which differences are more than chance. The estimators
run in threads, as a run does not hold the interpreter. The test needs SciPy.
"""

from forgetting.tuning.difference import Difference, difference
from forgetting.tuning.result import Tuning
from forgetting.tuning.tune import tune, tune_arx
from forgetting.tuning.tune_model import tune_model

__all__ = ["Difference", "Tuning", "difference", "tune", "tune_arx", "tune_model"]
