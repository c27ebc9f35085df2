"""The estimator as one of scikit-learn: `RecursiveRegressor`."""

from forgetting.extras import extra

extra("sklearn", "forgetting.sklearn", "sklearn")  # says what to install, where it is missing

from forgetting.sklearn.regressor import RecursiveRegressor  # noqa: E402

__all__ = ["RecursiveRegressor"]
