"""Multiple forgetting (Vahidi, Stefanopoulou & Peng 2005). GF-RLS V-J, (74)-(83).

    F = R - blkdiag(lambda_b R_bb)

``blocks`` are the sizes of consecutive blocks (all ones by default: the published method, which GF
prints for n = 2, p = 1). ``forgetting_factor`` is the common lambda_k, or one number a block.
    published, one row and blocks of one: R_i <- lambda_i R_i + phi_i^2 (75)-(76),
      L = [phi_i / (lambda_i R_i)] / (1 + sum_j phi_j^2 / (lambda_j R_j)) (78), theta + L e (77)
    otherwise: R_bb <- lambda_b R_bb + phi_b^T phi_b, gain with Pbar = blkdiag((lambda_b R_bb)^-1)
The reported P is (blkdiag(lambda_b R_bb) + phi^T phi)^-1, as in (79). R_bb starts at (P_0^-1)_bb.
Rbar > 0 always; proper iff the correlation matrix of R is >= blkdiag of the lambdas (scalar
blocks: C >= diag(lambda), C = D^-1/2 R D^-1/2), which fails for lambdas near 1.
"""

from __future__ import annotations

from ..linalg import Matrix, Real, block_diagonal, inverse, symmetric, transpose
from ..step import Rule, Step
from .form import PublishedForm, gain, measured

RATED = True


def ranges(n: int, blocks: list[int] | None) -> list[range]:
    """Index ranges of consecutive blocks."""
    sizes = [1] * n if blocks is None else blocks
    ends = [sum(sizes[: i + 1]) for i in range(len(sizes))]
    return [range(end - size, end) for end, size in zip(ends, sizes, strict=True)]


def weights(members: list[range], factor: Real, own: list[float] | None) -> list[Real]:
    """sqrt(lambda) of every parameter."""
    factors = [factor] * len(members) if own is None else [Real(x) for x in own]
    return [x.sqrt() for x, r in zip(factors, members, strict=True) for _ in r]


def scaled(a: Matrix, members: list[range], roots: list[Real]) -> Matrix:
    """blkdiag(lambda_b a_bb)."""
    kept = block_diagonal(a, members)
    n = a.nrows()
    return Matrix([[roots[i] * kept[i, j] * roots[j] for j in range(n)] for i in range(n)]).mid()


class Dense(Rule):
    def __init__(
        self, n: int, blocks: list[int] | None = None, forgetting_factor: list[float] | None = None
    ) -> None:
        self.members, self.factors = ranges(n, blocks), forgetting_factor

    def forgetting(self, step: Step) -> Matrix:
        roots = weights(self.members, step.factor, self.factors)
        return (step.information - scaled(step.information, self.members, roots)).mid()


class Published(PublishedForm):
    def __init__(
        self,
        theta: Matrix,
        covariance: Matrix,
        blocks: list[int] | None = None,
        forgetting_factor: list[float] | None = None,
    ) -> None:
        super().__init__(theta, covariance)
        n = theta.nrows()
        self.members, self.factors = ranges(n, blocks), forgetting_factor
        self.diagonal = block_diagonal(inverse(covariance), self.members)

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        roots = weights(self.members, factor, self.factors)
        error = (y - phi * self.theta).mid()
        kept = scaled(self.diagonal, self.members, roots)
        self.diagonal = (kept + block_diagonal(transpose(phi) * phi, self.members)).mid()
        self.covariance = measured(inverse(kept), phi)
        if phi.nrows() == 1 and all(len(r) == 1 for r in self.members):
            ratios = [phi[0, i] / kept[i, i] for i in range(phi.ncols())]
            total = 1 + sum(phi[0, i] * x for i, x in enumerate(ratios))
            step = Matrix([[x / total] for x in ratios])
        else:
            step = gain(symmetric(inverse(kept)), phi)
        self.theta = (self.theta + step * error).mid()


def cases(n: int) -> list[dict[str, object]]:
    """Common factor, one factor a parameter, and blocks."""
    different = [0.9 + 0.09 * i / n for i in range(n)]
    some: list[dict[str, object]] = [{}, {"forgetting_factor": different}]
    if n >= 4:
        some.append({"blocks": [n - 3, 3], "forgetting_factor": [0.95, 0.99]})
    return some
