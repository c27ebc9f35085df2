"""The gradient ψ of one-step predictions along the parameters of A y = Σ B/F u + C/D e + constant.

Each parameter stands at a signal of its own, filtered: y and the constant through D/C, u and w
through D/(C F), ε and v through 1/C, all from rest (Ljung 1999, section 10.3). The estimator is
given the same with the parameters of each moment; here they are those of the end, everywhere.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting.extras import extra

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Coefficients:
    """The parameters of a model by the polynomial that they belong to, as in its regressor.

    Attributes
    ----------
    a, c, d : ndarray, shape (na,), (nc,), (nd,)
    inputs : list of (b, f, nk)
        Of each input, (nb,) and (nf,), and its delay.
    constant : float
        Of the signals as they are given to `gradients`; 0 in a model without.
    has_constant : bool

    Examples
    --------
    >>> orders = {"na": 1, "nc": 1, "nd": 0, "inputs": [(1, 0, 1)]}
    >>> made = Coefficients.of(np.array([0.9, 2.0, 0.5]), orders, has_constant=False)
    >>> made.noise_denominator.tolist(), made.noise_numerator.tolist()
    ([1.0, -0.9], [1.0, 0.5])
    """

    a: Array
    c: Array
    d: Array
    inputs: list[tuple[Array, Array, int]]
    constant: float
    has_constant: bool

    @classmethod
    def of(cls, theta: Array, orders: dict[str, Any], has_constant: bool) -> Coefficients:
        """Parameters (n,) in the order a, b of each input, c, d, f of each input, constant."""
        each = orders["inputs"]
        counts = [orders["na"], *(nb for nb, _, _ in each), orders["nc"], orders["nd"]]
        counts += [nf for _, nf, _ in each]
        a, *others = np.split(theta[: sum(counts)], np.cumsum(counts)[:-1])
        b, (c, d), f = (
            others[: len(each)],
            others[len(each) : len(each) + 2],
            others[len(each) + 2 :],
        )
        inputs = [(*pair, nk) for *pair, (_, _, nk) in zip(b, f, each, strict=True)]
        return cls(a, c, d, inputs, float(theta[-1]) if has_constant else 0.0, has_constant)

    @property
    def noise_denominator(self) -> Array:
        """D A in powers of q⁻¹, of the noise C/(D A) e in y."""
        return np.asarray(np.convolve(monic(-self.d), monic(-self.a)))

    @property
    def noise_numerator(self) -> Array:
        """C in powers of q⁻¹."""
        return monic(self.c)


def gradients(own: Coefficients, u: Array, y: Array) -> Array:
    """ψ of every sample of a record from rest, (T, n).

    Parameters
    ----------
    own : Coefficients
        C and every F stable.
    u, y : ndarray, shape (T, inputs), (T,)
        Without missing values, measured from where the constant is.

    Examples
    --------
    >>> orders = {"na": 1, "nc": 0, "nd": 0, "inputs": [(1, 0, 1)]}
    >>> arx = Coefficients.of(np.array([0.9, 2.0]), orders, has_constant=False)
    >>> gradients(arx, np.array([[1.0], [2.0]]), np.array([3.0, 4.0])).tolist()
    [[0.0, 0.0], [3.0, 1.0]]
    """
    return np.column_stack([np.empty((len(y), 0)), *columns(own, u, y)])


def columns(own: Coefficients, u: Array, y: Array) -> Iterator[Array]:
    """The columns of `gradients`, some at a time."""
    lfilter = extra("scipy.signal", "an interval").lfilter
    one, C, D = np.ones(1), monic(own.c), monic(-own.d)
    through = [(own.inputs[i][2], monic(-f)) for i, (_, f, _) in enumerate(own.inputs)]
    parts = [
        lfilter(np.r_[np.zeros(nk), b], F, u[:, i])
        for i, ((b, _, _), (nk, F)) in enumerate(zip(own.inputs, through, strict=True))
    ]
    v = lfilter(monic(-own.a), one, y) - np.sum(parts, axis=0) - own.constant
    yield lagged(lfilter(D, C, y), range(1, len(own.a) + 1))
    for i, (b, _, nk) in enumerate(own.inputs):
        filtered = lfilter(D, np.convolve(C, through[i][1]), u[:, i])
        yield lagged(filtered, range(nk, nk + len(b)))
    yield lagged(lfilter(one, C, lfilter(D, C, v)), range(1, len(own.c) + 1))
    yield lagged(lfilter(one, C, v), range(1, len(own.d) + 1))
    for i, (_, f, _) in enumerate(own.inputs):
        filtered = lfilter(D, np.convolve(C, through[i][1]), parts[i])
        yield lagged(filtered, range(1, len(f) + 1))
    if own.has_constant:
        yield lfilter(D, C, np.ones(len(y)))


def lagged(signal: Array, lags: Iterable[int]) -> Array:
    """A signal (T,) so many samples later, a column each; 0 before the first sample.

    Examples
    --------
    >>> lagged(np.array([1.0, 2.0, 3.0]), range(1, 3)).tolist()
    [[0.0, 0.0], [1.0, 0.0], [2.0, 1.0]]
    """
    made = [np.r_[np.zeros(lag), signal][: len(signal)] for lag in lags]
    return np.array(made).reshape(-1, len(signal)).T


def monic(coefficients: Array) -> Array:
    """The polynomial 1 + x1 q⁻¹ + ..., in powers of q⁻¹."""
    return np.asarray(np.r_[1.0, coefficients])
