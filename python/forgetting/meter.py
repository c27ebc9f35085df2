"""A live meter of excitation over a sliding window."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ._core import InformationWindow


class ExcitationMeter(InformationWindow):
    """How much the last samples excite: eigenvalues of the sum of phi.T @ inv(gamma) @ phi.

    GF-RLS (A4) and its Definition 1, with N terms: alpha I <= sum <= beta I. The sum costs
    O(n**2) a sample. It subtracts the sample that leaves the window and is replaced every
    `window` samples by one that nothing was subtracted from, so that rounding cannot pile up;
    `alpha`, `beta` and `rank` take its eigenvalues when they are asked for, O(n**3), and an
    eigenvalue within rounding of 0 is 0.

    Parameters
    ----------
    parameters : int
        Number n of parameters.
    window : int
        Number N of samples.
    rows : int, default 1
        Rows of each sample.

    Examples
    --------
    >>> import forgetting as fg
    >>> meter = fg.ExcitationMeter(2, window=10)
    >>> for k in range(30):
    ...     meter.add([1.0, k % 2])
    >>> round(meter.alpha, 3), round(meter.beta, 3), meter.rank()
    (1.91, 13.09, 2)
    >>> for k in range(10):
    ...     meter.add([1.0, 1.0])
    >>> meter.alpha, meter.rank()
    (0.0, 1)
    """

    def add(self, phi: ArrayLike, gamma: ArrayLike | None = None) -> None:
        """Take one sample.

        Parameters
        ----------
        phi : (n,) or (rows, n) array
        gamma : float or (rows, rows) array, optional
            Noise covariance of the sample, positive definite.

        Raises
        ------
        InvalidInput
            For a wrong shape, NaN or Inf, or a gamma that is not positive definite.
        """
        super().add(phi, gamma)

    def _eigenvalues(self) -> np.ndarray:
        values: np.ndarray = np.linalg.eigvalsh(self.information)
        return np.where(values > self.noise, values, 0.0)

    @property
    def alpha(self) -> float:
        """Smallest eigenvalue: the least information of the window along any direction."""
        return float(self._eigenvalues()[0])

    @property
    def beta(self) -> float:
        """Largest eigenvalue: the most information of the window along any direction."""
        return float(self._eigenvalues()[-1])

    def rank(self, threshold: float = 0.0) -> int:
        """Count the directions with more information than `threshold` (in units of phi**2)."""
        return int((self._eigenvalues() > threshold).sum())
