"""What a polynomial model is given: polynomials, covariance and names."""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from forgetting._core import InvalidInput, numbers
from forgetting.polynomials.checks import real
from forgetting.polynomials.coefficients import covariance_of, labels, parameters_of
from forgetting.polynomials.estimate import Array
from forgetting.polynomials.structure import Structure

Self = TypeVar("Self", bound="Polynomials")


class Polynomials:
    """The polynomials and the parameters that they are made of; see `PolynomialModel`."""

    def __init__(
        self,
        A: ArrayLike = (1.0,),
        B: Any = (),
        C: ArrayLike = (1.0,),
        D: ArrayLike = (1.0,),
        F: Any = None,
        *,
        delay: Any = 1,
        offset: float | None = None,
        sample_time: float = 1.0,
        noise_variance: float | None = None,
        covariance: ArrayLike | None = None,
        input_names: Any = None,
        input_units: Any = None,
        output_name: str = "y",
        output_unit: str = "",
    ) -> None:
        self.structure, self.theta = parameters_of(A, B, C, D, F, delay, offset)
        self.covariance = covariance_of(covariance, self.structure.parameters)
        self.sample_time = real("sample_time", sample_time, 0.0, np.inf)
        self.noise_variance = noise_variance
        if noise_variance is not None:
            self.noise_variance = real("noise_variance", noise_variance, 0.0, np.inf, closed=True)
        inputs = self.structure.inputs
        numbered = ["u"] if inputs == 1 else [f"u{i + 1}" for i in range(inputs)]
        self.input_names = labels("input_names", input_names, numbered)
        self.input_units = labels("input_units", input_units, [""] * inputs)
        self.output_name, self.output_unit = str(output_name), str(output_unit)
        self.theta.setflags(write=False)
        self.covariance.setflags(write=False)

    @classmethod
    def from_parameters(
        cls: type[Self],
        structure: Structure,
        theta: ArrayLike,
        P: ArrayLike | None = None,
        noise_variance: float | None = None,
        **settings: Any,
    ) -> Self:
        """Make the model of the parameters of a difference equation, such as an estimator has.

        Parameters
        ----------
        structure : Structure
            The orders; they say what each parameter is.
        theta : array_like, shape (n,)
        P : array_like, shape (n, n), optional
            Such that noise_variance * P is the covariance of theta.
        noise_variance : float, optional
            Without it, or where it is NaN, the covariance is not known.
        **settings
            sample_time, input_names, input_units, output_name, output_unit.

        Examples
        --------
        >>> from forgetting.polynomials import PolynomialModel
        >>> structure = Structure(na=1, nb=1, nc=1)
        >>> print(PolynomialModel.from_parameters(structure, [0.8, 0.5, 0.3]))
        A(q) y = B(q) u + C(q) e
          A(q) = 1 − 0.8 q⁻¹
          B(q) = 0.5 q⁻¹
          C(q) = 1 + 0.3 q⁻¹
          stable, sample time 1
        """
        given = numbers("theta", theta)
        if given.shape != (structure.parameters,) or not np.isfinite(given).all():
            raise InvalidInput(
                f"theta = {given.tolist()}, allowed: {structure.parameters} finite numbers"
            )
        made: dict[str, list[Array]] = {letter: [] for letter in "ABCDF"}
        for block in structure.blocks():
            part = slice(block.lags.start, block.lags.stop) if block.letter == "b" else slice(None)
            made[block.letter.upper()].append(structure.polynomial(given, block)[part])
        if noise_variance is not None and np.isnan(noise_variance):
            noise_variance = None
        covariance = None
        if P is not None and noise_variance is not None:
            covariance = numbers("P", P) * noise_variance
        return cls(
            made["A"][0],
            made["B"],
            made["C"][0],
            made["D"][0],
            made["F"],
            delay=structure.nk,
            offset=given[-1] if structure.offset else None,
            covariance=covariance,
            noise_variance=noise_variance,
            **settings,
        )

    @property
    def A(self) -> Array:
        """A(q) in powers of q⁻¹, (na + 1,)."""
        return self._polynomials("a")[0]

    @property
    def B(self) -> tuple[Array, ...]:
        """B_i(q) of each input in powers of q⁻¹, the delay as zeros, (nk + nb,) each."""
        return self._polynomials("b")

    @property
    def C(self) -> Array:
        """C(q) in powers of q⁻¹, (nc + 1,)."""
        return self._polynomials("c")[0]

    @property
    def D(self) -> Array:
        """D(q) in powers of q⁻¹, (nd + 1,)."""
        return self._polynomials("d")[0]

    @property
    def F(self) -> tuple[Array, ...]:
        """F_i(q) of each input in powers of q⁻¹, (nf + 1,) each."""
        return self._polynomials("f")

    def _polynomials(self, letter: str) -> tuple[Array, ...]:
        blocks = [block for block in self.structure.blocks() if block.letter == letter]
        return tuple(self.structure.polynomial(self.theta, block) for block in blocks)

    @property
    def offset(self) -> float | None:
        """The constant, None where it is no parameter."""
        return float(self.theta[-1]) if self.structure.offset else None

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """What the entries of `theta` are called."""
        return self.structure.names(self.input_names)

    @property
    def standard_errors(self) -> Array:
        """Of the parameters, (n,); NaN where the covariance is not known."""
        return np.asarray(np.sqrt(np.diagonal(self.covariance)))
