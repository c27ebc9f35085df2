"""What an identified model is, whoever estimated it.

    A(q) y = Σ B_i(q)/F_i(q) u_i + C(q)/D(q) e + offset

`PolynomialModel` has poles, gains, responses, predictions and tests of residuals, each with its
standard error where it has one; `Structure` says which parameter is which.
"""

from forgetting.polynomials.estimate import Estimate
from forgetting.polynomials.model import PolynomialModel
from forgetting.polynomials.residual_tests import ResidualTests
from forgetting.polynomials.response import FrequencyResponse, TimeResponse
from forgetting.polynomials.roots import Roots
from forgetting.polynomials.state_space import StateSpace
from forgetting.polynomials.structure import Structure

__all__ = [
    "Estimate",
    "FrequencyResponse",
    "PolynomialModel",
    "ResidualTests",
    "Roots",
    "StateSpace",
    "Structure",
    "TimeResponse",
]
