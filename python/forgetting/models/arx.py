"""ARX: a linear difference equation identified recursively, with any forgetting rule."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting._core import Bank, InvalidInput
from forgetting.frames import read, shaped_like
from forgetting.frames.channels import channel_names, channels, paired
from forgetting.models.constructor import Constructor
from forgetting.models.estimator import new_estimator
from forgetting.models.identified import identified
from forgetting.models.lags import names, regressors
from forgetting.models.mean_square import MEMORY, MeanSquare
from forgetting.models.orders import Orders, per_input
from forgetting.models.simulation import free_run
from forgetting.models.uncertainty import leverage, of_noise, of_parameters, root_of
from forgetting.polynomials import PolynomialModel, Structure
from forgetting.prediction import Prediction, around, quantile

Array = NDArray[np.float64]


class ARX(Constructor):
    """AutoRegressive model with eXogenous inputs, y(k) = phi(k) theta + noise.

    The regressor is ``phi(k) = [y(k-1) ... y(k-na), u(k-nk) ... u(k-nk-nb+1)]``, so that
    y(k) = a1 y(k-1) + ... + b1 u(k-nk) + ...: a first-order model has its pole at a1. (Where the
    literature writes A(q) y = B(q) u with A(q) = 1 + a1 q⁻¹ + ..., its a has the other sign.)
    Several outputs share phi and one covariance factor, so m outputs cost O(n² + n·m) a sample.

    A sample with a missing value (NaN) anywhere in phi(k) or y(k) is skipped: the estimate is held,
    and every later sample whose lags reach the gap is skipped too. To break the lags between two
    separate records, feed `Orders.reach` rows of NaN.

    Parameters
    ----------
    na, nb, nk : int
        Orders: past outputs, inputs, and delay of the newest input in samples; all >= 0. nb and nk
        may be sequences, with an order for each input.
    offset : bool, default False
        Whether there is a constant, the last parameter: for data that are not deviations from an
        operating point.
    rule : str or Rule
        Forgetting rule, by registry name or as an object such as ``fg.Subspace(0.98)``; "auto"
        mixes rules of all speeds, see `forgetting.Bank`.
    weighting, gate : optional
        As those of `RLS`.
    initial_covariance : float or array_like, optional
        P before the first sample: a scalar, the (n,) diagonal, or (n, n); in units of 1/phi². If
        not given it follows the data, and units do not matter.
    dtype : str
        "float64" or "float32", the precision of the estimator.

    Attributes
    ----------
    theta_ : ndarray, shape (n,) or (n, outputs)
        Estimate after the last sample.
    covariance_ : ndarray, shape (n, n)
        P after the last sample; times the noise variance it is the parameter covariance.
    estimator_ : forgetting.RLS or forgetting.Bank
        The estimator itself.
    samples_, used_ : int
        Rows seen since `fit`, and how many of them the estimate has used.
    n_inputs_, n_outputs_ : int
        Channels of u and y.
    names_ : list of str
        What the regressors are called, such as "V(k-1)": after the columns of data frames.

    Examples
    --------
    >>> import numpy as np
    >>> import forgetting as fg
    >>> rng = np.random.default_rng(0)
    >>> u = rng.normal(size=300)
    >>> y = np.zeros(300)
    >>> for k in range(1, 300):
    ...     y[k] = 0.8 * y[k - 1] + 0.5 * u[k - 1]
    >>> model = fg.ARX(na=1, nb=1, nk=1, rule=fg.NoForgetting(), initial_covariance=1e8).fit(u, y)
    >>> np.round(model.theta_, 6)
    array([0.8, 0.5])
    """

    def __init__(
        self,
        na: int = 1,
        nb: int | Sequence[int] = 2,
        nk: int | Sequence[int] = 0,
        rule: Any = "auto",
        initial_covariance: ArrayLike | None = None,
        dtype: str = "float64",
        *,
        offset: bool = False,
        weighting: Any = None,
        gate: Any = None,
    ) -> None:
        self.na = na
        self.nb = nb
        self.nk = nk
        self.rule = rule
        self.initial_covariance = initial_covariance
        self.dtype = dtype
        self.offset = offset
        self.weighting = weighting
        self.gate = gate

    def fit(self, u: ArrayLike | None, y: ArrayLike) -> ARX:
        """Forget everything and identify from a whole record.

        Parameters
        ----------
        u : array_like or data frame, shape (T,) or (T, inputs), or None
            Inputs; None when nb = 0. NaN is a missing value.
        y : array_like or data frame, shape (T,) or (T, outputs)
            Outputs. NaN is a missing value.

        Returns
        -------
        ARX
            This object.

        Raises
        ------
        forgetting.InvalidInput
            When shapes or indexes disagree, an order or parameter is out of range, or a value is
            infinite.
        """
        inputs, outputs = paired(u, y)
        orders = self._orders(inputs)
        estimator = new_estimator(
            orders.regressors(outputs.shape[1], inputs.shape[1]) + self.offset,
            self.rule,
            targets=outputs.shape[1],
            weighting=self.weighting,
            gate=self.gate,
            initial_covariance=self.initial_covariance,
            dtype=self.dtype,
        )
        noise = MeanSquare(outputs.shape[1], MEMORY, skip=estimator.parameters)
        used = self._learn(estimator, noise, orders, inputs, outputs)
        self.n_inputs_, self.n_outputs_ = inputs.shape[1], outputs.shape[1]
        self._labels = (
            channel_names("y", y, outputs.shape[1]),
            channel_names("u", u, inputs.shape[1]),
        )
        self.names_ = names(*self._labels, orders) + ["offset"] * self.offset
        self._single = np.ndim(y) == 1
        self._remember(orders, inputs, outputs)
        self.samples_, self.used_ = len(outputs), used
        return self

    def partial_fit(self, u: ArrayLike | None, y: ArrayLike) -> ARX:
        """Go on with the next rows; any split of a record gives the same as one `fit`.

        Parameters and errors are those of `fit`; the first call is `fit`. The last `Orders.reach`
        rows are kept, so the lags reach across calls.
        """
        if not hasattr(self, "estimator_"):
            return self.fit(u, y)
        inputs, outputs = self._checked(u, y)
        orders = self._orders(inputs)
        old_inputs, old_outputs = self._tail
        inputs, outputs = np.vstack([old_inputs, inputs]), np.vstack([old_outputs, outputs])
        used = self._learn(self.estimator_, self._noise, orders, inputs, outputs, len(old_outputs))
        self.used_ += used
        self.samples_ += len(outputs) - len(old_outputs)
        self._remember(orders, inputs, outputs)
        return self

    def predict(self, u: ArrayLike | None, y: ArrayLike, level: float | None = None) -> Any:
        """Predict each y(k) one step ahead, from measured y(k-1), y(k-2), ... and the final theta.

        Returns an array shaped like y, of pandas and xarray with their index; NaN where a lag is
        missing, so always in the first `Orders.reach` rows. With a level a `Prediction` of three,
        the interval that holds this share of y(k): see `forecast`.
        """
        inputs, outputs = self._checked(u, y)
        phi = self._phi(inputs, outputs, self._orders(inputs))
        value = phi @ self._theta()
        if level is None:
            return self._like(y, value)
        spread = 1.0 + leverage(phi, root_of(self.estimator_))
        deviation = np.sqrt(np.outer(spread, self.noise_variance_))
        made = around(value, deviation, quantile(level))
        return Prediction(*(self._like(y, each) for each in made))

    def forecast(self, u: ArrayLike | int, level: float | None = None) -> Any:
        """Predict the outputs of the next samples, going on from the last one that was learned.

        Parameters
        ----------
        u : array_like, shape (steps,) or (steps, inputs), or int
            The inputs to come; for a model without inputs how many steps.
        level : float, optional
            Share of outputs that an interval about each is to hold, between 0 and 1.

        Returns
        -------
        ndarray, shape (steps,) or (steps, outputs)
            With a level a `Prediction` of three such arrays, value, lower and upper.

        Raises
        ------
        InvalidInput
            For a missing value in u or in the last rows that were learned.

        Notes
        -----
        The interval has the noise to come, normal and white, and the uncertainty of the parameters
        by the delta method, their covariance being that of P; of a bank (``rule="auto"``) the mean
        square of its errors, in which it shows as far as it does one step ahead. Inputs are
        supposed to be known.

        Examples
        --------
        >>> import numpy as np
        >>> import forgetting as fg
        >>> rng = np.random.default_rng(0)
        >>> y = np.zeros(1000)
        >>> for k in range(1, 1000):
        ...     y[k] = 0.9 * y[k - 1] + rng.normal()
        >>> ahead = fg.AR(1, rule="none").fit(None, y).forecast(20, level=0.95)
        >>> (ahead.upper - ahead.lower)[[0, 19]].round()  # twice 1.96 times 1 and 2.3
        array([4., 9.])
        """
        self._check_is_fitted()
        inputs = np.empty((u, 0)) if isinstance(u, int) else channels("u", u)
        before, start = self._tail
        self._match(inputs, start)
        if np.isnan(before).any() or np.isnan(start).any():
            raise InvalidInput("a value in the last rows is missing; a forecast begins behind them")
        both = np.vstack([before, inputs])
        orders = self._orders(inputs)

        def run(theta: Array) -> Array:
            constant = theta[-1] if self.offset else 0.0
            coefficients = theta[: len(theta) - self.offset]
            return free_run(both, start, coefficients, orders, constant)[len(start) :]

        theta, outputs = self._theta(), self.n_outputs_
        value = run(theta)
        if level is None:
            return self._plain(value)
        feedback = theta[: self.na * outputs].reshape(self.na, outputs, outputs)
        share = of_noise(feedback.transpose(0, 2, 1), len(value))
        share = share + of_parameters(run, theta, root_of(self.estimator_))
        made = around(value, np.sqrt(share @ self.noise_variance_), quantile(level))
        return Prediction(*map(self._plain, made))

    def _plain(self, values: Array) -> Array:
        """Values (T, outputs) in the shape of the y that was learned."""
        return values[:, 0] if self._single else values

    def _like(self, y: ArrayLike, values: Array) -> Any:
        """Values (T, outputs) shaped and indexed like y."""
        return shaped_like(read("y", y), values[:, 0] if np.ndim(y) == 1 else values)

    def simulate(self, u: ArrayLike | int, y_start: ArrayLike | None = None) -> Array:
        """Run the model freely: its own past outputs stand in the lags, never measured ones.

        Parameters
        ----------
        u : array_like, shape (T,) or (T, inputs), or int
            Inputs without gaps; for a model without inputs the number of samples T.
        y_start : array_like, shape (r,) or (r, outputs), optional
            Outputs of the first r rows, copied into the result, from which the run starts.
            Everything before the record is zero (the system was at rest).

        Returns
        -------
        ndarray, shape (T,) or (T, outputs)
            Simulated outputs, shaped like the y given to `fit`.
        """
        self._check_is_fitted()
        inputs = np.empty((u, 0)) if isinstance(u, int) else channels("u", u)
        start = np.empty((0, self.n_outputs_)) if y_start is None else channels("y_start", y_start)
        self._match(inputs, start)
        theta = self._theta()
        constant = theta[-1] if self.offset else 0.0
        coefficients = theta[: len(theta) - self.offset]
        simulated = free_run(inputs, start, coefficients, self._orders(inputs), constant)
        return self._plain(simulated)

    def model(self, theta: ArrayLike | None = None, *, sample_time: float = 1.0) -> PolynomialModel:
        """Return what was identified of one output as a model: poles, gains, responses, tests.

        Parameters
        ----------
        theta : (n,) array_like, optional
            The estimate at another sample; the last if not given. What is said of standard errors
            is that of the last sample.
        sample_time : float, default 1
            Time between samples, in which times and frequencies are told.
        """
        self._check_is_fitted()
        if self.n_outputs_ != 1:
            raise InvalidInput(f"the model has {self.n_outputs_} outputs; only one can be shown so")
        nb, nk = (per_input(name, getattr(self, name), self.n_inputs_) for name in ("nb", "nk"))
        return identified(
            Structure(na=self.na, nb=nb, nk=nk, offset=self.offset),
            np.ravel(self.theta_ if theta is None else theta),
            self.covariance_,
            float(self.noise_variance_[0]),
            self._labels,
            by_lag=True,
            sample_time=sample_time,
        )

    def _orders(self, inputs: Array) -> Orders:
        orders = Orders(self.na, self.nb, self.nk)
        if (orders.nb != 0) != (inputs.shape[1] > 0):
            given = f"{inputs.shape[1]} input(s)"
            raise InvalidInput(f"nb is {orders.nb} but u has {given}; nb = 0 goes with u = None")
        return orders

    def _learn(
        self,
        estimator: Any,
        noise: MeanSquare,
        orders: Orders,
        inputs: Array,
        outputs: Array,
        skip: int = 0,
    ) -> int:
        phi = self._phi(inputs, outputs, orders)[skip:]
        target = outputs[skip:, 0] if outputs.shape[1] == 1 else outputs[skip:]
        dtype = np.dtype(self.dtype)
        phi, target = phi.astype(dtype, copy=False), target.astype(dtype, copy=False)
        run = estimator.run(phi, target, outputs=("error", "leverage", "skipped"), missing="skip")
        squares = np.asarray(run.error, dtype=np.float64).reshape(outputs[skip:].shape) ** 2
        if not isinstance(estimator, Bank):
            squares /= 1.0 + np.asarray(run.leverage, dtype=np.float64)[:, np.newaxis]
        noise.add(squares[run.skipped == 0])
        # Set only after success, so that a refused record leaves the model as it was.
        self.estimator_, self._noise = estimator, noise
        return int(run.used)

    def _phi(self, inputs: Array, outputs: Array, orders: Orders) -> Array:
        phi = regressors(inputs, outputs, orders)
        return np.hstack([phi, np.ones((len(phi), 1))]) if self.offset else phi

    def _remember(self, orders: Orders, inputs: Array, outputs: Array) -> None:
        start = max(0, len(outputs) - orders.reach)
        self._tail = inputs[start:].copy(), outputs[start:].copy()

    def _checked(self, u: ArrayLike | None, y: ArrayLike) -> tuple[Array, Array]:
        self._check_is_fitted()
        inputs, outputs = paired(u, y)
        self._match(inputs, outputs)
        return inputs, outputs

    def _match(self, inputs: Array, outputs: Array) -> None:
        for name, given, expected in (
            ("u", inputs.shape[1], self.n_inputs_),
            ("y", outputs.shape[1], self.n_outputs_),
        ):
            if given != expected:
                raise InvalidInput(f"{name} has {given} channels; the model has {expected}")

    def _theta(self) -> Array:
        return np.asarray(self.estimator_.theta, dtype=np.float64).reshape(-1, self.n_outputs_)

    def _check_is_fitted(self) -> None:
        if not hasattr(self, "estimator_"):
            raise InvalidInput("this ARX has seen no data; call fit or partial_fit first")

    @property
    def theta_(self) -> Array:
        """Estimate after the last sample, (n,) or (n, outputs)."""
        return np.asarray(self._learned("theta_").theta)

    @property
    def covariance_(self) -> Array:
        """P after the last sample, (n, n)."""
        return np.asarray(self._learned("covariance_").covariance)

    @property
    def noise_variance_(self) -> Array:
        """Variance of the noise of each output, (outputs,), over up to the last thousand samples.

        Of a rule the mean of e²/(1 + leverage), of a bank that of e². NaN while there are too few.
        """
        self._learned("noise_variance_")
        return self._noise.value

    def _learned(self, name: str) -> Any:
        # AttributeError (not InvalidInput), so that hasattr(model, "theta_") is False before fit.
        if not hasattr(self, "estimator_"):
            raise AttributeError(f"{name} exists after fit or partial_fit")
        return self.estimator_
