"""Poles and zeros, and how far they may be off.

A simple root p of P(z) = Σ c_j zⁿ⁻ʲ moves with a coefficient by dp/dc_j = -pⁿ⁻ʲ / P'(p). The nearer
two roots are to one another, the larger it is; for a double root it is infinite, and a normal
distribution says nothing about it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from forgetting.polynomials.estimate import Array, Estimate
from forgetting.polynomials.structure import SIGN, Block, Structure

Complex = NDArray[np.complex128]


@dataclass(frozen=True, eq=False)
class Roots:
    """Poles or zeros in the z plane, the largest first.

    A root z belongs to the root s = log(z) / sample_time in continuous time. What is derived from s
    is in the unit of the sample time.

    Attributes
    ----------
    value : ndarray of complex, shape (k,)
    covariance : ndarray, shape (k, 2, 2)
        Of the real and the imaginary part of each.
    sample_time : float
    """

    value: Complex
    covariance: Array
    sample_time: float = 1.0

    @property
    def standard_error(self) -> Array:
        """Standard errors of the real and the imaginary part, (k, 2)."""
        return np.asarray(np.sqrt(np.diagonal(self.covariance, axis1=1, axis2=2)))

    @property
    def modulus(self) -> Estimate:
        """|z|, (k,): below 1 for a stable pole."""
        size = np.abs(self.value)
        return Estimate(size, spread(parts(self.value) / size[:, None], self.covariance))

    @property
    def continuous(self) -> Roots:
        """The roots s = log(z) / sample_time of continuous time; -inf for z = 0."""
        with np.errstate(divide="ignore", invalid="ignore"):
            s = np.asarray(np.log(self.value), np.complex128) / self.sample_time
            slope = 1.0 / (self.value * self.sample_time)
            turned = np.array([[slope.real, -slope.imag], [slope.imag, slope.real]])
            turned = np.moveaxis(turned, -1, 0)
            covariance = turned @ self.covariance @ np.swapaxes(turned, 1, 2)
        return Roots(s, covariance, self.sample_time)

    @property
    def natural_frequency(self) -> Estimate:
        """|s| in radians per unit of time, (k,)."""
        return self.continuous.modulus

    @property
    def damping(self) -> Estimate:
        """-Re(s)/|s|, (k,): 1 without oscillation, 0 for one that never ends, < 0 if unstable."""
        s, covariance = self.continuous.value, self.continuous.covariance
        with np.errstate(invalid="ignore"):
            size = np.abs(s)
            gradient = np.column_stack([-(s.imag**2), s.real * s.imag]) / size[:, None] ** 3
            return Estimate(-s.real / size, spread(gradient, covariance))

    @property
    def time_constant(self) -> Estimate:
        """-1/Re(s) in units of time, (k,): what decays falls to 1/e in it; < 0 if unstable."""
        s = self.continuous
        with np.errstate(divide="ignore", invalid="ignore"):
            real = s.value.real
            return Estimate(-1 / real, s.standard_error[:, 0] / real**2)

    def __str__(self) -> str:
        """One line a root."""
        error, rows = self.standard_error, ["real  imaginary  (standard errors)  modulus"]
        for z, (real, imaginary) in zip(self.value, error, strict=True):
            rows.append(
                f"{z.real:+.5g}  {z.imag:+.5g}i  (±{real:.2g}, ±{imaginary:.2g}i)  {abs(z):.5g}"
            )
        return "\n".join(rows)


def roots(
    structure: Structure,
    theta: Array,
    covariance: Array,
    blocks: Iterable[Block],
    sample_time: float,
) -> Roots:
    """The roots of the polynomials of some blocks together."""
    found = [of_block(structure, theta, covariance, block) for block in blocks]
    value = np.concatenate([np.zeros(0, complex), *(each for each, _ in found)])
    spread = np.concatenate([np.zeros((0, 2, 2)), *(each for _, each in found)])
    order = np.argsort(-np.abs(value), kind="stable")
    return Roots(value[order], spread[order], sample_time)


def of_block(
    structure: Structure, theta: Array, covariance: Array, block: Block
) -> tuple[Complex, Array]:
    """The roots of one polynomial, (k,), and the covariances of their two parts, (k, 2, 2)."""
    polynomial = structure.polynomial(theta, block)
    if block.letter == "b":  # a delay is no zero
        polynomial = polynomial[block.lags.start :]
    value = np.roots(polynomial).astype(np.complex128)
    powers = len(polynomial) - 1 - (np.arange(len(polynomial))[-len(block.lags) :])
    with np.errstate(divide="ignore", invalid="ignore"):
        slope = -(value[:, None] ** powers) / np.polyval(np.polyder(polynomial), value)[:, None]
    gradient = SIGN[block.letter] * parts(slope)  # (k, parameters, 2)
    own = covariance[block.places, block.places]
    return value, np.einsum("kia,ij,kjb->kab", gradient, own, gradient)


def parts(value: Complex) -> Array:
    """Real and imaginary part along a new last axis."""
    return np.stack([value.real, value.imag], axis=-1)


def spread(gradient: Array, covariance: Array) -> Array:
    """The standard error of something real of each root, by gradients (k, 2)."""
    variance = np.einsum("ka,kab,kb->k", gradient, covariance, gradient)
    return np.asarray(np.sqrt(np.maximum(variance, 0.0)))
