"""What a rule and a rate see of one step, and what a rule answers."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from .gf_rls import Measurement
from .linalg import Matrix, Real, identity, inverse, symmetric, trace, transpose


@dataclass
class Step:
    """Step k before its data. ``phi`` (p x n) and ``error`` (p x targets) are whitened.

    ``information`` is the R_k of Theorem 1 and ``covariance`` its inverse. ``own`` is the
    algorithm's covariance P_k: the same, except for rules that measure first and forget afterwards.
    ``forgets`` is False where P has been replaced, and nothing is forgotten beside.
    """

    k: int
    information: Matrix
    covariance: Matrix
    own: Matrix
    phi: Matrix
    error: Matrix
    factor: Real
    forgets: bool = True

    @cached_property
    def spread(self) -> Matrix:
        """phi P_k phi^T (p x p), with the algorithm's own covariance."""
        return (self.phi * self.own * transpose(self.phi)).mid()

    @property
    def rows(self) -> int:
        return self.phi.nrows()

    @property
    def parameters(self) -> int:
        return self.phi.ncols()

    @property
    def targets(self) -> int:
        return self.error.ncols()

    @cached_property
    def square(self) -> Real:
        """|e|^2 of the whitened errors, averaged over the targets."""
        return (trace(transpose(self.error) * self.error) / self.targets).mid()


class Rule:
    """A forgetting rule stated as Theorem 1 needs it. The default forgets nothing."""

    single_row = False

    def skips(self, step: Step) -> bool:
        """True: the whole sample is left out (no forgetting, no data, nothing adapts)."""
        return False

    def measurement(self, step: Step, y: Matrix) -> Measurement:
        """What is measured, in whitened units: by default phi and y with Gamma = I."""
        return Measurement(step.phi, y, identity(step.rows))

    def forgetting(self, step: Step) -> Matrix:
        """F_k (n x n)."""
        raise NotImplementedError

    def after(self, step: Step, covariance: Matrix) -> None:
        """Told P+ = R_{k+1}^-1 at the end of the step (for the rule's own state)."""

    def own_covariance(self, information: Matrix, covariance: Matrix) -> Matrix:
        """The algorithm's P_k from the R_k of Theorem 1 and its inverse."""
        return covariance


class MeasureThenForget(Rule):
    """P_{k+1} = Psi_k(P+), embedded with a one-step shift (E1).

    X_{k+1} = (P+)^-1 and G_{k+1} = X_{k+1} - Psi_k(P+)^-1, G_0 = 0, is Theorem 1 with R = X and
    F = G. Subclasses put G_{k+1} into ``pending`` at the end of step k.
    """

    def __init__(self, n: int) -> None:
        self.pending = Matrix(n, n)

    def forgetting(self, step: Step) -> Matrix:
        return self.pending

    def own_covariance(self, information: Matrix, covariance: Matrix) -> Matrix:
        return symmetric(inverse(information - self.pending))
