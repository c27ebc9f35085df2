"""ARX: a linear difference equation identified recursively, with any forgetting rule."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting._core import Bank
from forgetting.frames.channels import channel_names, paired
from forgetting.models.arx_forecast import ARXForecast
from forgetting.models.estimator import new_estimator
from forgetting.models.lags import names
from forgetting.models.mean_square import MEMORY, MeanSquare
from forgetting.models.orders import Orders

Array = NDArray[np.float64]


class ARX(ARXForecast):
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

    def _remember(self, orders: Orders, inputs: Array, outputs: Array) -> None:
        start = max(0, len(outputs) - orders.reach)
        self._tail = inputs[start:].copy(), outputs[start:].copy()
