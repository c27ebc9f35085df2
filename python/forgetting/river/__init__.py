"""The estimator as one of river: `RecursiveRegressor`."""

from forgetting.extras import extra

extra("river", "forgetting.river", "river")  # says what to install, where it is missing

from forgetting.river.regressor import RecursiveRegressor  # noqa: E402

__all__ = ["RecursiveRegressor"]
