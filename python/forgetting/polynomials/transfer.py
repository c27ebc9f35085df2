"""The transfer function from an input, or from the noise, to the output; and its derivatives.

A transfer function is used in two ways: it filters a signal, or it multiplies a complex amplitude
at a frequency. Both are a `Pass`, through(numerator, denominator, signal), so that responses,
gains and their derivatives by the parameters are computed by the same lines.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting.extras import extra
from forgetting.polynomials.structure import SIGN, Block, Structure

Array = NDArray[Any]
Pass = Callable[[Array, Array, Array], Array]


@dataclass(frozen=True)
class Transfer:
    """A quotient of polynomials of a model: B_i/(A F_i), or C/(A D) of the noise.

    Attributes
    ----------
    structure : Structure
    theta : ndarray, shape (n,)
    numerator : Block
    denominator : tuple of Block
        Its factors.
    """

    structure: Structure
    theta: Array
    numerator: Block
    denominator: tuple[Block, ...]

    def polynomials(self) -> tuple[Array, Array]:
        """Numerator and denominator, in powers of q⁻¹."""
        below = np.ones(1)
        for block in self.denominator:
            below = np.convolve(below, self.of(block))
        return self.of(self.numerator), below

    def of(self, block: Block) -> Array:
        """The polynomial of one block."""
        return self.structure.polynomial(self.theta, block)

    def response(self, through: Pass, signal: Array) -> tuple[Array, Array]:
        """What becomes of a signal, (T,), and its derivatives by all parameters, (n, T)."""
        inner = signal
        for block in self.denominator:
            inner = through(np.ones(1), self.of(block), inner)
        response = through(self.of(self.numerator), np.ones(1), inner)
        gradient = np.zeros((self.structure.parameters, *response.shape), response.dtype)
        for number, lag in enumerate(self.numerator.lags, self.numerator.start):
            gradient[number] = SIGN[self.numerator.letter] * through(delay(lag), np.ones(1), inner)
        for block in self.denominator:
            divided = through(np.ones(1), self.of(block), response)
            for number, lag in enumerate(block.lags, block.start):
                gradient[number] = -SIGN[block.letter] * through(delay(lag), np.ones(1), divided)
        return response, gradient


def transfer(structure: Structure, theta: Array, channel: int | None) -> Transfer:
    """The transfer function from input number `channel`, or from the noise if None."""
    blocks = {(block.letter, block.input): block for block in structure.blocks()}
    above, below = (
        (("c", None), ("d", None)) if channel is None else (("b", channel), ("f", channel))
    )
    return Transfer(structure, theta, blocks[above], (blocks["a", None], blocks[below]))


def delay(lag: int) -> Array:
    """q⁻ˡᵃᵍ as a polynomial."""
    return np.asarray(np.eye(1, lag + 1, lag)[0])


def filtered(numerator: Array, denominator: Array, signal: Array) -> Array:
    """Pass a signal (T,) through a filter at rest."""
    return np.asarray(extra("scipy.signal", "a response").lfilter(numerator, denominator, signal))


def at_points(z: Array) -> Pass:
    """Pass amplitudes at points of the z plane."""
    value = np.polynomial.polynomial.polyval

    def through(numerator: Array, denominator: Array, signal: Array) -> Array:
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(signal * value(1 / z, numerator) / value(1 / z, denominator))

    return through
