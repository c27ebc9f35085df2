"""Recursive least squares with forgetting as a regressor of scikit-learn."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.base import BaseEstimator, MultiOutputMixin, RegressorMixin
from sklearn.utils import check_array
from sklearn.utils.validation import check_is_fitted, validate_data

from forgetting._core import InvalidInput
from forgetting.models.linear import Linear

Array = NDArray[np.float64]


class RecursiveRegressor(MultiOutputMixin, RegressorMixin, BaseEstimator):
    """Linear regression that follows its coefficients over time.

    The rows of X are samples in the order of time: `fit` is a recursion from the first to the last,
    and what it finds is the model as it is after the last. Another order of the rows is another
    fit, and a rule that forgets believes late rows more than early ones. Validate with
    ``TimeSeriesSplit``; a split that shuffles lets the model see the future.

    Parameters
    ----------
    rule : str, Rule or None, default="auto"
        How to forget. "auto" mixes random walks of all speeds, `forgetting.Bank`; else a rule by
        its name or as an object, ``forgetting.Subspace(0.98)``, or None for that of
        `forgetting.RLS`. The parameters of an object are nested: ``rule__forgetting_factor``.
    fit_intercept : bool, default=True
        Whether to estimate a constant, which may change over time as coefficients do.
    weighting : str or Weighting, default=None
        How far to trust a sample, by its innovation: ``forgetting.Huber()`` for outliers.
    initial_covariance : float or array, default=None
        P before the first sample in units of 1/X², the intercept first: a number, (n,) or (n, n).
        If not given it follows the data, and no prediction depends on the units of X or y.

    Attributes
    ----------
    coef_ : ndarray, shape (n_features,) or (n_targets, n_features)
        Coefficients after the last sample.
    intercept_ : float or ndarray, shape (n_targets,)
        Constant after the last sample; 0 with ``fit_intercept=False``.
    estimator_ : forgetting.Bank or forgetting.RLS
        The estimator; its first parameter is the constant. With a constant and no
        `initial_covariance` it measures X and y from the first sample.
    n_samples_seen_ : int
        Samples used since `fit`; those of weight 0 do not count.
    n_features_in_, feature_names_in_ : int, ndarray of str
        As in every estimator of scikit-learn.

    Notes
    -----
    The weight of a sample divides the variance of its noise; a sample of weight 0 is left out. That
    is how weighted least squares uses weights, but where the model forgets, a sample of weight 2 is
    one step of time and two samples are two. Only the ratios of weights matter, unless an initial
    covariance is given.

    Examples
    --------
    >>> import numpy as np
    >>> from forgetting.sklearn import RecursiveRegressor
    >>> x = np.linspace(0.0, 20.0, 400)[:, None]
    >>> slope = np.where(np.arange(400) < 200, 2.0, 3.0)  # changes halfway
    >>> model = RecursiveRegressor().fit(np.sin(x), 1.0 + slope * np.sin(x[:, 0]))
    >>> model.coef_.round(2), round(model.intercept_, 2)
    (array([3.]), 1.0)
    """

    def __init__(
        self,
        rule: Any = "auto",
        *,
        fit_intercept: bool = True,
        weighting: Any = None,
        initial_covariance: ArrayLike | None = None,
    ) -> None:
        self.rule = rule
        self.fit_intercept = fit_intercept
        self.weighting = weighting
        self.initial_covariance = initial_covariance

    def fit(
        self, X: ArrayLike, y: ArrayLike, sample_weight: ArrayLike | None = None
    ) -> RecursiveRegressor:
        """Forget everything and learn from all rows, in their order.

        Parameters
        ----------
        X : array_like, shape (n_samples, n_features)
            Regressors, in the order of time.
        y : array_like, shape (n_samples,) or (n_samples, n_targets)
            Measurements.
        sample_weight : array_like, shape (n_samples,), optional
            Weights >= 0, at least one > 0; 1 if not given.

        Returns
        -------
        RecursiveRegressor
            This object.

        Raises
        ------
        ValueError
            For NaN, infinity, wrong shapes, negative weights or none above 0; the regressor is then
            as it was.
        forgetting.NumericalRange
            For numbers beyond the range of the estimator; as before.
        """
        return self._take(X, y, weights(sample_weight, some=True), fresh=True)

    def partial_fit(
        self, X: ArrayLike, y: ArrayLike, sample_weight: ArrayLike | None = None
    ) -> RecursiveRegressor:
        """Go on with the next rows; any split of the rows gives what one `fit` gives.

        Parameters and errors are those of `fit`, but all weights may be 0. A call that is refused
        leaves the model as it was.
        """
        return self._take(X, y, weights(sample_weight), fresh=not hasattr(self, "_model"))

    def predict(self, X: ArrayLike, return_std: bool = False) -> Any:
        """Predict with the coefficients after the last sample.

        Parameters
        ----------
        X : array_like, shape (n_samples, n_features)
        return_std : bool, default=False
            Whether to return the standard deviation of a measurement of weight 1 as well. Of one
            rule it is sqrt(s² (1 + φPφᵀ)), s² the variance of the noise over up to the last
            thousand samples. Of "auto" it is the root of the mean squared error, one step ahead,
            over the last hundred samples, and does not grow away from the data. NaN until more
            samples than parameters have been used.

        Returns
        -------
        ndarray, shape (n_samples,) or (n_samples, n_targets)
            Predictions; a tuple of two such arrays with `return_std`.
        """
        check_is_fitted(self)
        x = validate_data(self, X, dtype=np.float64, reset=False)
        mean = self._shaped(self._model.predict(x))
        return (mean, self._shaped(self._model.deviation(x))) if return_std else mean

    def _take(
        self, X: ArrayLike, y: ArrayLike, weight: Array | None, fresh: bool
    ) -> RecursiveRegressor:
        """Learn with a fresh model or the one that is there; all of the call or nothing."""
        before = dict(self.__dict__)
        try:
            x, targets = self._checked(X, y, fresh)
            weight = np.ones(len(x)) if weight is None else weight
            if weight.shape != (len(x),):
                raise InvalidInput(f"sample_weight has shape {weight.shape}, expected ({len(x)},)")
            model = self._fresh(x, targets) if fresh else self._fitted("partial_fit")
            counts = weight > 0
            model.learn(x[counts], targets.reshape(len(x), -1)[counts], weight[counts])
            self._model, self._shape = model, targets.shape[1:]
        except Exception:
            self.__dict__ = before
            raise
        return self

    def _checked(self, X: ArrayLike, y: ArrayLike, fresh: bool) -> tuple[Array, Array]:
        x, targets = validate_data(
            self, X, y, dtype=np.float64, multi_output=True, y_numeric=True, reset=fresh
        )
        targets = np.asarray(targets, dtype=np.float64)
        if not fresh and targets.shape[1:] != self._shape:
            given = f"(n_samples{''.join(f', {size}' for size in targets.shape[1:])})"
            raise InvalidInput(f"y has shape {given}; the y of the first call had another")
        return x, targets

    def _fresh(self, x: Array, targets: Array) -> Linear:
        return Linear(
            x.shape[1],
            int(np.prod(targets.shape[1:])),
            self.rule,
            constant=self.fit_intercept,
            weighting=self.weighting,
            initial_covariance=self.initial_covariance,
        )

    def _shaped(self, values: Array) -> Array:
        return values.reshape(len(values), *self._shape)

    def __sklearn_is_fitted__(self) -> bool:
        return hasattr(self, "_model")

    def _fitted(self, name: str) -> Linear:
        if not hasattr(self, "_model"):
            raise AttributeError(f"{name} exists after fit or partial_fit")
        return self._model

    @property
    def coef_(self) -> Array:
        """Coefficients, (n_features,) or (n_targets, n_features)."""
        return self._fitted("coef_").coefficients.T.reshape(*self._shape, -1)

    @property
    def intercept_(self) -> Any:
        """Constant, a float or (n_targets,)."""
        constant = self._fitted("intercept_").constant.reshape(self._shape)
        return constant if self._shape else float(constant)

    @property
    def estimator_(self) -> Any:
        """The estimator itself."""
        return self._fitted("estimator_").estimator

    @property
    def n_samples_seen_(self) -> int:
        """Samples used since `fit`."""
        return int(self._fitted("n_samples_seen_").estimator.samples)


def weights(given: ArrayLike | None, some: bool = False) -> Array | None:
    """The weights as numbers >= 0, with `some` one of them > 0; None if none are given."""
    if given is None:
        return None
    weight = check_array(given, ensure_2d=False, dtype=np.float64, input_name="sample_weight")
    if (weight < 0).any():
        row = int(np.argmax(weight < 0))
        raise InvalidInput(f"sample_weight[{row}] = {weight[row]}, allowed: numbers >= 0")
    if some and not weight.any():
        raise InvalidInput("sample_weight is zero for every sample, allowed: one > 0 at least")
    return np.asarray(weight)
