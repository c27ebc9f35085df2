"""What `ARMA`, `ARMAX`, `OE` and `BJ` share: signals in, an estimator behind, coefficients out."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting._core import RLS, Bank, InvalidInput, SignalModel
from forgetting.frames import read, shaped_like
from forgetting.frames.channels import channel_names, channels, paired
from forgetting.models.constructor import Constructor
from forgetting.models.estimator import new_estimator
from forgetting.models.gradient import Coefficients
from forgetting.models.identified import identified
from forgetting.models.interval import Learned
from forgetting.models.layout import Layout
from forgetting.models.mean_square import MEMORY, MeanSquare
from forgetting.models.orders import per_input, whole
from forgetting.models.signal_origin import SignalOrigin, first_values
from forgetting.polynomials import PolynomialModel, Structure
from forgetting.prediction import Prediction, around, quantile

Array = NDArray[np.float64]


class Polynomial(Constructor):
    """A model A y = sum of B/F u + C/D e with an estimator behind it.

    Subclasses say in their constructor which orders there are; what is said here holds for all.

    A sample with a missing value (NaN) is left out, with every later sample whose measured lags
    reach it; in the meantime the model runs on its own predictions and on the last input.
    """

    na: int = 0
    nb: int | Sequence[int] = 0
    nc: int = 0
    nd: int = 0
    nf: int | Sequence[int] = 0
    nk: int | Sequence[int] = 0
    offset: bool = False
    rule: Any = "auto"
    method: str = "prediction_error"
    weighting: Any = None
    gate: Any = None
    initial_covariance: Any = None
    dtype: str = "float64"

    def fit(self, u: ArrayLike | None, y: ArrayLike) -> Polynomial:
        """Forget everything and identify from a whole record.

        Parameters
        ----------
        u : array_like or data frame, shape (T,) or (T, inputs), or None
            Inputs; None for a model without. NaN is a missing value.
        y : array_like or data frame, shape (T,) or (T, 1)
            The output. NaN is a missing value.

        Returns
        -------
        Polynomial
            This object.

        Raises
        ------
        forgetting.InvalidInput
            When shapes or indexes disagree, an order or parameter is out of range, or a value is
            infinite.
        """
        inputs, outputs = self._signals(u, y)
        model, estimator = self._start(inputs.shape[1])
        noise = MeanSquare(1, MEMORY, skip=model.parameters)
        used = self._learn(model, estimator, noise, inputs, outputs)
        # set only after success, so that a refused record leaves the model as it was
        self.estimator_, self._model, self._noise, self.used_ = estimator, model, noise, used
        self._first = first_values(np.column_stack([inputs, outputs]))
        self.n_inputs_ = inputs.shape[1]
        self._labels = channel_names("y", y, 1), channel_names("u", u, inputs.shape[1])
        self.names_ = self.terms(self._labels[1], self._labels[0][0])
        return self

    def partial_fit(self, u: ArrayLike | None, y: ArrayLike) -> Polynomial:
        """Go on with the next rows; any split of a record gives the same as one `fit`.

        Parameters and errors are those of `fit`; the first call is `fit`.
        """
        if not hasattr(self, "estimator_"):
            return self.fit(u, y)
        inputs, outputs = self._checked(u, y)
        self.used_ += self._learn(self._model, self.estimator_, self._noise, inputs, outputs)
        now = first_values(np.column_stack([inputs, outputs]))
        self._first = np.where(np.isnan(self._first), now, self._first)
        return self

    def course(
        self, u: ArrayLike | None, y: ArrayLike, outputs: str | Sequence[str] = "theta"
    ) -> dict[str, Array]:
        """Identify from a whole record as `fit` does, and return what happened at each sample.

        Parameters
        ----------
        u, y
            As those of `fit`. This object does not change.
        outputs : str or sequence of str
            Of "theta" (T, n), the estimate after each sample; "error" (T,), y less its one-step
            prediction; "phi" (T, n) and "y" (T,), the linear regression that the estimator was
            given; "scale" (T,), the root of the weight of each sample in it, below 1 at the
            start; "skipped" (T,), see `forgetting.SKIPPED`. NaN where a sample was left out.

        Returns
        -------
        dict of str to ndarray

        Notes
        -----
        The estimator that `fit` leaves is, to the last bit, one that took "phi" and "y" with
        ``missing="skip"``: whatever is known of linear regressions (excitation, windup,
        certificates) can be asked of them.
        """
        inputs, measured = self._signals(u, y)
        model, estimator = self._start(inputs.shape[1])
        kept = model.learn(estimator, inputs, measured, outputs)
        return {name: kept[name] for name in kept if name != "used"}

    def predict(self, u: ArrayLike | None, y: ArrayLike, level: float | None = None) -> Any:
        """Predict each y(k) one step ahead, from everything before it and the final theta.

        The run starts at rest. Returns an array shaped like y, of pandas and xarray with their
        index; NaN in the first rows, whose lags are from before the record. With a level a
        `Prediction` of three, the interval that holds this share of y(k): see `forecast`. Where
        outputs before are missing it is as wide as they leave it.
        """
        inputs, outputs = self._checked(u, y)
        predicted = np.asarray(self._model.predict(inputs, outputs))
        shown = predicted.copy()
        shown[: self.reach] = np.nan

        def like(values: Array) -> Any:
            return shaped_like(read("y", y), values if np.ndim(y) == 1 else values[:, None])

        if level is None:
            return like(shown)
        z = quantile(level)
        deviation = self._known().of_record(inputs, outputs, predicted)
        return Prediction(*map(like, around(shown, deviation, z)))

    def simulate(self, u: ArrayLike | int, y_start: ArrayLike | None = None) -> Array:
        """Run the model freely from rest: no measured output, no noise.

        Parameters
        ----------
        u : array_like, shape (T,) or (T, inputs), or int
            Inputs without gaps; for a model without inputs the number of samples T.
        y_start : array_like, shape (r,), optional
            Outputs of the first r rows, from which the run starts.

        Returns
        -------
        ndarray, shape (T,)
        """
        self._check_is_fitted()
        inputs = self._inputs_of_run(u)
        outputs = np.full(len(inputs), np.nan)
        start = np.empty(0) if y_start is None else channels("y_start", y_start)[:, 0]
        if len(start) > len(outputs):
            raise InvalidInput(f"y_start has {len(start)} rows, more than the {len(outputs)} of u")
        outputs[: len(start)] = start
        simulated = np.asarray(self._model.predict(inputs, outputs))
        simulated[: len(start)] = start
        return simulated

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
        ndarray, shape (steps,)
            With a level a `Prediction` of three such arrays, value, lower and upper.

        Raises
        ------
        InvalidInput
            For a missing value in u; with a level also for one in the last rows that were learned.

        Notes
        -----
        The interval has the noise to come, normal and white before C/(A D), and the uncertainty of
        the parameters by the delta method, their covariance being that of P; of a bank
        (``rule="auto"``) the mean square of its errors alone. Inputs are supposed to be known.
        """
        self._check_is_fitted()
        inputs = self._inputs_of_run(u)
        nothing = np.full(len(inputs), np.nan)
        value = np.asarray(self._model.predict(inputs, nothing, from_rest=False))
        if level is None:
            return value
        z = quantile(level)
        return around(value, self._known().to_come(inputs, value), z)

    def model(self, theta: ArrayLike | None = None, *, sample_time: float = 1.0) -> PolynomialModel:
        """Return what was identified as a model: poles, gains, responses, tests of its residuals.

        Parameters
        ----------
        theta : (n,) array_like, optional
            The estimate at another sample, a row of ``course(...)["theta"]``; the last if not
            given. What is said of standard errors is that of the last sample.
        sample_time : float, default 1
            Time between samples, in which times and frequencies are told.
        """
        self._check_is_fitted()
        orders = self._orders(self.n_inputs_)
        each = np.array(orders["inputs"], dtype=int).reshape(-1, 3)
        structure = Structure(
            na=orders["na"],
            nb=each[:, 0].tolist(),
            nc=orders["nc"],
            nd=orders["nd"],
            nf=each[:, 1].tolist(),
            nk=each[:, 2].tolist(),
            offset=self.offset,
        )
        return identified(
            structure,
            self.theta_ if theta is None else theta,
            self.covariance_,
            self.noise_variance_,
            self._labels,
            sample_time=sample_time,
        )

    @property
    def theta_(self) -> Array:
        """Estimate after the last sample, (n,): a, b of each input, c, d, f of each input, offset.

        That of the estimator; or, where C or F of it is unstable, as far on the way there as they
        are stable.
        """
        return np.asarray(self._learned("theta_", "_model").theta)

    @property
    def covariance_(self) -> Array:
        """P after the last sample, (n, n); times `noise_variance_` the covariance of `theta_`."""
        covariance = np.asarray(self._learned("covariance_", "estimator_").covariance)
        origin = self.origin(self._first)
        return covariance if origin is None else origin.covariance(self.theta_, covariance)

    @property
    def noise_variance_(self) -> float:
        """Variance of e, over up to the last thousand samples; NaN while there are too few.

        The mean square of errors, each counting as much as its sample: less at the start.
        """
        return float(self._learned("noise_variance_", "_noise").value[0])

    @property
    def samples_(self) -> int:
        """Rows seen since `fit`."""
        return int(self._learned("samples_", "_model").samples)

    @property
    def reach(self) -> int:
        """Rows that must come before a sample so that every measured lag exists."""
        return self.reach_of(getattr(self, "n_inputs_", 1))

    def reach_of(self, inputs: int) -> int:
        """`reach` for so many inputs."""
        nb, nk = per_input("nb", self.nb, inputs), per_input("nk", self.nk, inputs)
        lags = [delay + order - 1 for delay, order in zip(nk, nb, strict=True)]
        return max(self.na, *lags, 0)

    def at_rest(self, inputs: int) -> SignalModel:
        """What makes regressors of so many inputs and an output, before the first sample."""
        return SignalModel(**self._orders(inputs), constant=self.offset, method=self.method)

    def origin(self, first: Array) -> SignalOrigin | None:
        """What `at_rest` measures from, by the first values of all inputs and the output, (i + 1,).

        None without a constant, as zero is the origin then.
        """
        return SignalOrigin.of(first, self.layout(len(first) - 1)) if self.offset else None

    def layout(self, inputs: int) -> Layout:
        """Where the parameters of each polynomial stand, for so many inputs."""
        orders = self._orders(inputs)
        each = [(nb, nf) for nb, nf, _ in orders["inputs"]]
        return Layout.of(orders["na"], each, orders["nc"] + orders["nd"])

    def _known(self) -> Learned:
        """What was learned, in the signals that the estimator was given."""
        theta, origin = self.theta_, self.origin(self._first)
        measured = theta if origin is None else origin.take(theta)
        first = np.nan_to_num(self._first) * self.offset
        own = Coefficients.of(measured, self._orders(self.n_inputs_), self.offset)
        known = self._model, self.estimator_, self.noise_variance_
        return Learned(*known, measured, first, own)

    def _start(self, inputs: int) -> tuple[SignalModel, RLS | Bank]:
        model = self.at_rest(inputs)
        estimator = new_estimator(
            model.parameters,
            self.rule,
            weighting=self.weighting,
            gate=self.gate,
            initial_covariance=self.initial_covariance,
            dtype=self.dtype,
        )
        return model, estimator

    def _orders(self, inputs: int) -> dict[str, Any]:
        has_inputs = np.any(np.asarray(self.nb) != 0)
        if bool(has_inputs) != (inputs > 0):
            raise InvalidInput(
                f"nb is {self.nb} but u has {inputs} input(s); nb = 0 goes with u = None"
            )
        each = [per_input(name, getattr(self, name), inputs) for name in ("nb", "nf", "nk")]
        scalars = {name: whole(name, getattr(self, name)) for name in ("na", "nc", "nd")}
        return scalars | {"inputs": list(zip(*each, strict=True))}

    def _learn(
        self, model: SignalModel, estimator: Any, noise: MeanSquare, inputs: Array, outputs: Array
    ) -> int:
        kept = model.learn(estimator, inputs, outputs, outputs=("error", "scale"))
        errors, known = kept["error"], ~np.isnan(kept["error"])
        noise.add(errors[known, None] ** 2, kept["scale"][known] ** 2)
        return int(kept["used"])

    def _signals(self, u: ArrayLike | None, y: ArrayLike) -> tuple[Array, Array]:
        inputs, outputs = paired(u, y)
        if outputs.shape[1] != 1:
            raise InvalidInput(
                f"y has {outputs.shape[1]} outputs; {type(self).__name__} has one, "
                "so make one model an output (ARX takes several)"
            )
        return inputs, np.ascontiguousarray(outputs[:, 0])

    def _checked(self, u: ArrayLike | None, y: ArrayLike) -> tuple[Array, Array]:
        self._check_is_fitted()
        inputs, outputs = self._signals(u, y)
        self._match(inputs)
        return inputs, outputs

    def _inputs_of_run(self, u: ArrayLike | int) -> Array:
        inputs = np.empty((u, 0)) if isinstance(u, int) else channels("u", u)
        self._match(inputs)
        if np.isnan(inputs).any():
            row = int(np.argwhere(np.isnan(inputs))[0][0])
            raise InvalidInput(f"u is missing in row {row}; a free run needs every value")
        return inputs

    def _match(self, inputs: Array) -> None:
        if inputs.shape[1] != self.n_inputs_:
            raise InvalidInput(f"u has {inputs.shape[1]} channels; the model has {self.n_inputs_}")

    def terms(self, inputs: Sequence[str], output: str = "y") -> list[str]:
        """What each coefficient stands at, for inputs of these names.

        Examples
        --------
        >>> import forgetting as fg
        >>> fg.ARMAX(na=1, nb=1, nc=1).terms(["u"])
        ['y(k-1)', 'u(k-1)', 'e(k-1)']
        """
        orders = self._orders(len(inputs))
        each = list(zip(inputs, orders["inputs"], strict=True))
        names = [f"{output}(k-{lag})" for lag in range(1, orders["na"] + 1)]
        for name, (nb, _, nk) in each:
            names += [f"{name}(k-{lag})" if lag else f"{name}(k)" for lag in range(nk, nk + nb)]
        names += [f"e(k-{lag})" for lag in range(1, orders["nc"] + 1)]
        names += [f"v(k-{lag})" for lag in range(1, orders["nd"] + 1)]
        for name, (_, nf, _) in each:
            names += [f"w[{name}](k-{lag})" for lag in range(1, nf + 1)]
        return names + ["offset"] * self.offset

    def _check_is_fitted(self) -> None:
        if not hasattr(self, "estimator_"):
            name = type(self).__name__
            raise InvalidInput(f"this {name} has seen no data; call fit or partial_fit first")

    def _learned(self, name: str, where: str) -> Any:
        # AttributeError (not InvalidInput), so that hasattr(model, "theta_") is False before fit.
        if not hasattr(self, "estimator_"):
            raise AttributeError(f"{name} exists after fit or partial_fit")
        return getattr(self, where)
