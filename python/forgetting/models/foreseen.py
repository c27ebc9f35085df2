"""Forecasts from every sample of a record, with the estimate of that time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting._core import Bank, InvalidInput
from forgetting.frames.channels import paired
from forgetting.models.arx import ARX
from forgetting.models.estimator import new_estimator
from forgetting.models.gradient import Coefficients
from forgetting.models.lags import delayed, regressors
from forgetting.models.mean_square import MEMORY, MeanSquare
from forgetting.models.orders import Orders
from forgetting.models.polynomial import Polynomial

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Foreseen:
    """What is foreseen after each sample.

    Attributes
    ----------
    measured : ndarray, shape (T,)
    value : ndarray, shape (T, H)
        After sample k, of the samples k + 1 to k + H.
    deviation : ndarray, shape (T, H)
        Standard deviation of the noise in them.
    parameters : int
        Number n of parameters.
    """

    measured: Array
    value: Array
    deviation: Array
    parameters: int


def of_arx(model: ARX, u: ArrayLike | None, y: ArrayLike, steps: int) -> Foreseen:
    """By an ARX model and its kin: the difference equation, for all samples together."""
    inputs, outputs = paired(u, y)
    one_output(outputs)
    orders = model._orders(inputs)
    phi = regressors(inputs, outputs, orders)
    phi = np.hstack([phi, np.ones((len(phi), 1))]) if model.offset else phi
    settings = {name: getattr(model, name) for name in ("weighting", "gate", "dtype")}
    settings["initial_covariance"] = model.initial_covariance
    estimator = new_estimator(phi.shape[1], model.rule, **settings)
    kept = ("theta", "error", "leverage", "skipped")
    run = estimator.run(phi, outputs[:, 0], outputs=kept, missing="skip")
    theta = np.asarray(run.theta, dtype=np.float64).reshape(phi.shape)
    squares = np.asarray(run.error, dtype=np.float64).reshape(-1) ** 2
    if not isinstance(estimator, Bank):
        squares /= 1.0 + np.asarray(run.leverage, dtype=np.float64)
    noise = running(np.where(run.skipped == 0, squares, np.nan), np.ones(len(phi)), phi.shape[1])
    return by_equation(theta, inputs, outputs[:, 0], orders, steps, noise)


def by_equation(
    theta: Array, u: Array, y: Array, orders: Orders, steps: int, noise: Array
) -> Foreseen:
    """With the parameters (T, n) and the variance of the noise (T,) of each sample."""
    response = responses(-theta[:, : orders.na], np.empty((len(y), 0)), steps)
    made = difference_equation(theta, u, y, orders, steps)
    return Foreseen(y, made, deviations(noise, response), theta.shape[1])


def difference_equation(theta: Array, u: Array, y: Array, orders: Orders, steps: int) -> Array:
    """Forecasts (T, steps) after each sample, with the parameters (T, n) of that time."""
    lags = orders.input_lags(u.shape[1])
    constant = theta[:, -1] if theta.shape[1] > orders.na + len(lags) else 0.0
    ahead: list[Array] = []
    with np.errstate(over="ignore", invalid="ignore"):
        for step in range(1, steps + 1):
            made = constant + np.zeros(len(y))
            for i in range(orders.na):
                past = ahead[step - i - 2] if i < step - 1 else shifted(y, i + 1 - step)
                made = made + theta[:, i] * past
            for i, (lag, own) in enumerate(lags, orders.na):
                made = made + theta[:, i] * shifted(u[:, own], lag - step)
            ahead.append(made)
    return np.column_stack(ahead)


def of_signals(model: Polynomial, u: ArrayLike | None, y: ArrayLike, steps: int) -> Foreseen:
    """By ARMAX and its kin: the model goes on from each sample as it then was."""
    inputs, outputs = paired(u, y)
    one_output(outputs)
    output = np.ascontiguousarray(outputs[:, 0])
    course = model.course(u, y, ("theta", "error", "scale"))
    signals, estimator = model._start(inputs.shape[1])
    made, nothing = np.full((len(output), steps), np.nan), np.full(steps, np.nan)
    gaps = np.asarray(np.isnan(inputs).any(axis=1))
    for k in range(len(output)):
        signals.learn(estimator, inputs[k : k + 1], output[k : k + 1])
        gap = np.flatnonzero(gaps[k + 1 : k + 1 + steps])
        known = int(gap[0]) if len(gap) else min(steps, len(output) - k - 1)
        to_come = inputs[k + 1 : k + 1 + known]
        made[k, :known] = signals.predict(to_come, nothing[:known], from_rest=False)
    n, orders = signals.parameters, model._orders(inputs.shape[1])
    noise = running(course["error"] ** 2, course["scale"] ** 2, n)
    each = [Coefficients.of(row, orders, model.offset) for row in course["theta"]]
    below = np.zeros((len(each), orders["na"] + orders["nd"]))
    above = np.zeros((len(each), orders["nc"]))
    for k, own in enumerate(each):
        below[k], above[k] = own.noise_denominator[1:], own.c
    return Foreseen(output, made, deviations(noise, responses(below, above, steps)), n)


def one_output(outputs: Array) -> None:
    """Refuse several."""
    if outputs.shape[1] != 1:
        raise InvalidInput(f"y has {outputs.shape[1]} outputs; forecasts are judged of one")


def shifted(signal: Array, lag: int) -> Array:
    """A signal (T,) so many samples later, or before if `lag` is below 0; NaN where unknown."""
    if lag >= 0:
        return delayed(signal[:, None], lag)[:, 0]
    return np.asarray(np.r_[signal, np.full(-lag, np.nan)][-lag:][: len(signal)])


def running(squares: Array, weights: Array, skip: int) -> Array:
    """The mean square after each sample, (T,); NaN in `squares` is left out."""
    mean, found = MeanSquare(1, MEMORY, skip), np.full(len(squares), np.nan)
    for k, square in enumerate(squares):
        if not np.isnan(square):
            mean.add(squares[k : k + 1, None], weights[k : k + 1])
        found[k] = mean.value[0]
    return found


def responses(below: Array, above: Array, steps: int) -> Array:
    """Impulse responses (T, steps) of the filters above/below, each 1 + x1 q⁻¹ + ... by its row.

    Examples
    --------
    >>> responses(np.array([[-0.5]]), np.array([[0.25]]), 3).tolist()
    [[1.0, 0.75, 0.375]]
    """
    made = np.zeros((len(below), steps))
    with np.errstate(over="ignore", invalid="ignore"):
        for k in range(steps):
            made[:, k] = 1.0 if k == 0 else above[:, k - 1] if k <= above.shape[1] else 0.0
            for lag in range(1, min(k, below.shape[1]) + 1):
                made[:, k] -= below[:, lag - 1] * made[:, k - lag]
    return made


def deviations(variance: Array, response: Array) -> Array:
    """Standard deviation (T, steps) of the noise 1, 2, ... samples ahead."""
    with np.errstate(over="ignore", invalid="ignore"):
        return np.asarray(np.sqrt(variance[:, None] * np.cumsum(response**2, axis=1)))
