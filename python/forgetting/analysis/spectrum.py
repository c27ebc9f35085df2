"""Spectrum of the regressors: which frequencies the record contains."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from forgetting.extras import extra

from .information import weighted
from .validation import Array, whole


@dataclass(frozen=True, eq=False)
class Spectrum:
    """Mean squared amplitude of each regressor over frequency. See `spectrum`.

    Attributes
    ----------
    frequencies : (F,)
        Cycles per sample, 0 to 0.5.
    power : (F, n)
        Mean square in each frequency bin; a column sums to the mean square of its regressor
        (exactly for a rectangular window of one segment, closely otherwise).
    segments : int
        Segments averaged.
    """

    frequencies: Array = field(repr=False)
    power: Array = field(repr=False)
    segments: int

    def lines(self, floor: float = 1e-6) -> int:
        """Return the number of spectral peaks above `floor` of the strongest one.

        A peak is a bin not lower than its neighbours in the sum over the regressors. A
        regressor made of m sinusoids can excite at most 2 m directions, a constant one more.
        """
        power = self.power.sum(axis=1)
        padded = np.concatenate([[-np.inf], power, [-np.inf]])
        peak = (power >= padded[:-2]) & (power > padded[2:]) & (power > floor * power.max())
        return int(np.count_nonzero(peak))


def spectrum(
    regressors: ArrayLike, segment: int | None = None, gamma: ArrayLike | None = None
) -> Spectrum:
    """Average the periodograms of half-overlapping Hann-windowed segments (Welch).

    Parameters
    ----------
    regressors : (T, n) or (T, rows, n)
        Rows of a sample are averaged; NaN counts as zero.
    segment : int in [2, T], optional
        Samples in a segment. Default: the whole record up to 1024 samples, else 1024.
    gamma : optional
        Measurement weighting.

    Returns
    -------
    Spectrum

    Raises
    ------
    InvalidInput
        For a wrong shape, or a segment out of range.
    ImportError
        Without SciPy.

    Examples
    --------
    >>> import numpy as np
    >>> found = spectrum(np.sin(2 * np.pi * 0.125 * np.arange(512))[:, None])
    >>> float(found.frequencies[found.power[:, 0].argmax()])
    0.125
    """
    phibar = weighted(regressors, gamma)
    samples = len(phibar)
    if samples < 2:
        return Spectrum(np.zeros(1), np.mean(phibar**2, axis=1), 1)
    length = min(samples, 1024) if segment is None else whole("segment", segment, 2, samples)
    signal = extra("scipy.signal", "a spectrum")
    frequencies, density = signal.welch(
        phibar, nperseg=length, noverlap=length - hop(length), detrend=False, axis=0
    )
    segments = (samples - length) // hop(length) + 1
    return Spectrum(frequencies, np.mean(density, axis=1) / length, segments)


def hop(length: int) -> int:
    """Samples from one segment to the next: half of its length."""
    return max(1, length // 2)
