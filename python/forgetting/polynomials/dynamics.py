"""Poles, gains and responses of a polynomial model, and what other libraries make of it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from forgetting._core import InvalidInput
from forgetting.extras import extra
from forgetting.polynomials.checks import whole
from forgetting.polynomials.estimate import Array, Estimate
from forgetting.polynomials.form import Polynomials
from forgetting.polynomials.response import (
    FrequencyResponse,
    TimeResponse,
    frequencies,
    frequency_response,
    static_gain,
    time_response,
)
from forgetting.polynomials.roots import Roots, roots
from forgetting.polynomials.state_space import StateSpace, state_space
from forgetting.polynomials.structure import Block
from forgetting.polynomials.transfer import Transfer, transfer

NOISE = "noise"
"""The name of the channel from e to y."""


class Dynamics(Polynomials):
    """What follows from the polynomials alone; see `PolynomialModel`."""

    def poles(self, input: int | str | None = None) -> Roots:
        """The poles, the roots of A and F: of one input, of the noise (A and D), or of all inputs.

        Parameters
        ----------
        input : int or str, optional
            Number or name of an input, or "noise".

        Returns
        -------
        Roots
            With standard errors, and frequency, damping and time constant in continuous time.
        """
        blocks = self.structure.blocks()
        if input is None:
            return self._roots([block for block in blocks if block.letter in "af"])
        return self._roots(self._transfer(input).denominator)

    def zeros(self, input: int | str = 0) -> Roots:
        """The zeros from an input, the roots of B without its delay; of "noise" those of C."""
        return self._roots([self._transfer(input).numerator])

    def _roots(self, blocks: Iterable[Block]) -> Roots:
        kept = [block for block in blocks if len(block.lags)]
        return roots(self.structure, self.theta, self.covariance, kept, self.sample_time)

    @property
    def is_stable(self) -> bool:
        """Whether a free run forgets where it began: all poles are inside the unit circle."""
        return bool((np.abs(self.poles().value) < 1).all())

    def time_constants(self, input: int | str | None = None) -> Estimate:
        """Of the poles, in units of time, the slowest first; see `Roots.time_constant`."""
        return self.poles(input).time_constant

    def static_gain(self, input: int | str = 0) -> Estimate:
        """By how much the output changes at last for a step of 1: B(1)/(A(1) F(1))."""
        return static_gain(self._transfer(input), self.covariance)

    def step(self, samples: int = 100, input: int | str = 0) -> TimeResponse:
        """The response to a step of 1 from rest, with its standard errors."""
        return self._response("step", np.ones(whole("samples", samples, 1)), input)

    def impulse(self, samples: int = 100, input: int | str = 0) -> TimeResponse:
        """The response to a single 1, with its standard errors."""
        return self._response("impulse", np.eye(1, whole("samples", samples, 1))[0], input)

    def _response(self, what: str, signal: Array, input: int | str) -> TimeResponse:
        made = self._transfer(input), self.covariance, signal, self.sample_time
        return time_response(*made, f"{what} response, {self._from(input)}")

    def frequency_response(
        self, frequency: ArrayLike | None = None, input: int | str = 0
    ) -> FrequencyResponse:
        """Gain and phase over frequency, with their standard errors: the data of a Bode diagram.

        Parameters
        ----------
        frequency : array_like, shape (T,), optional
            In radians per unit of time, in (0, π/sample_time]; three decades if not given.
        input : int or str
            Number or name of an input, or "noise".
        """
        at = frequencies(frequency, self.sample_time)
        made = self._transfer(input), self.covariance, at, self.sample_time
        return frequency_response(*made, self._from(input))

    def _transfer(self, input: int | str) -> Transfer:
        return transfer(self.structure, self.theta, self._channel(input))

    def _from(self, input: int | str) -> str:
        number = self._channel(input)
        return f"{NOISE if number is None else self.input_names[number]} → {self.output_name}"

    def _channel(self, input: int | str) -> int | None:
        names = self.input_names
        if isinstance(input, str) and input in names:
            return names.index(input)
        if input == NOISE:
            return None
        if not isinstance(input, int | np.integer) or not 0 <= input < len(names):
            known = f"one of {', '.join(names)}, or its number" if names else "no input"
            raise InvalidInput(f"input = {input!r}, allowed: {known}, or {NOISE!r}")
        return int(input)

    def to_state_space(self) -> StateSpace:
        """Matrices A, B, C, D and K of the innovation form; an offset is no part of them."""
        return state_space(self)

    def to_control(self) -> Any:
        """The transfer functions from all inputs, as `TransferFunction` of python-control.

        Raises
        ------
        ImportError
            Without python-control (``pip install 'forgetting[control]'``).
        """
        control = extra("control", "to_control", "control")
        pairs = [
            transfer(self.structure, self.theta, i).polynomials()
            for i in range(self.structure.inputs)
        ]
        if not pairs:
            raise InvalidInput("the model has no input, allowed: at least 1")
        lengths = [max(len(b), len(f)) for b, f in pairs]
        above, below = (
            [
                [
                    np.pad(pair[k], (0, n - len(pair[k])))
                    for pair, n in zip(pairs, lengths, strict=True)
                ]
            ]
            for k in (0, 1)
        )
        names = {"inputs": list(self.input_names), "outputs": [self.output_name]}
        return control.TransferFunction(above, below, self.sample_time, **names)
