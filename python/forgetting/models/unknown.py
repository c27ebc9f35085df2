"""What is not known of an output when those just before it are not known.

Where outputs are missing, or still to come, the model goes on with its own predictions. In
innovation form, x(k+1) = A x(k) + K e(k) and y(k) = C x(k) + e(k), the error of the state is then
driven by e; where an output is known it decays by A - K C. What parameters are off by takes the
same way: its slope along them, ψ, stands in the place of e.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from forgetting.polynomials.prediction import padded
from forgetting.polynomials.state_space import observer

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


def with_unknown(
    psi: Array, unknown: Mask, numerator: Array, denominator: Array
) -> tuple[Array, Array]:
    """How far predictions of outputs are off, where those before them may not be known.

    Parameters
    ----------
    psi : ndarray, shape (T, n)
        Slope of each one-step prediction along the parameters, with what the model put in the
        place of outputs that are not known.
    unknown : ndarray of bool, shape (T,)
        Which outputs are not known to later predictions.
    numerator, denominator : ndarray
        Those of the filter from e to y in powers of q⁻¹, both beginning with 1.

    Returns
    -------
    variance : ndarray, shape (T,)
        Of the error by noise, over that of e; 1 where all outputs before are known.
    slope : ndarray, shape (T, n)
        Of each prediction along the parameters; ψ where all outputs before are known.

    Examples
    --------
    >>> ahead = with_unknown(np.zeros((3, 1)), np.ones(3, bool), np.ones(1), np.array([1, -0.5]))
    >>> ahead[0].tolist()
    [1.0, 1.25, 1.3125]
    """
    variance, slope = np.ones(len(psi)), psi.copy()
    order = max(len(numerator), len(denominator)) - 1
    if not order or not unknown.any():
        return variance, slope
    below, above = padded(denominator, order + 1), padded(numerator, order + 1)
    gain, running, settling = (above - below)[1:, None], observer(below), observer(above)
    spread, off = np.zeros((order, order)), np.zeros((order, psi.shape[1]))
    for k in range(int(np.argmax(unknown)), len(psi)):
        variance[k] += spread[0, 0]
        slope[k] += off[0]
        if unknown[k]:
            spread = running @ spread @ running.T + gain @ gain.T
            off = running @ off + gain * psi[k]
        else:
            spread, off = settling @ spread @ settling.T, settling @ off
    return variance, slope
