"""Component discounting (West & Harrison): a factor for every parameter or block, always proper.

    Pbar = P + blkdiag((1/lambda_b - 1) P_bb),   F = R - Pbar^-1
    published: the Kalman filter whose random walk has Q_k = blkdiag((1/lambda_b - 1) P_bb)

``blocks`` and ``forgetting_factor`` as in ``multiple``. With one block of n it is ``exponential``.
With the cyclic ``schedule`` and c blocks, sample k inflates block b = k mod c alone, by
1/lambda_b^c.
"""

from __future__ import annotations

from ..linalg import Matrix, Real, block_diagonal, inverse, symmetric
from ..step import Rule, Step
from .form import PublishedForm, gain, measured
from .multiple import ranges, weights

RATED = True


def inflation(p: Matrix, members: list[range], roots: list[Real]) -> Matrix:
    """blkdiag((1/lambda_b - 1) P_bb)."""
    kept, n = block_diagonal(p, members), p.nrows()
    return Matrix(
        [[kept[i, j] * (1 / (roots[i] * roots[j]) - 1) for j in range(n)] for i in range(n)]
    ).mid()


def due(roots: list[Real], members: list[range], schedule: str, k: int) -> list[Real]:
    """sqrt(lambda) of every parameter at sample k, 1 where it is not its turn."""
    if schedule == "every_sample":
        return roots
    turn = members[k % len(members)]
    return [root ** len(members) if i in turn else Real(1) for i, root in enumerate(roots)]


class Dense(Rule):
    def __init__(
        self,
        n: int,
        blocks: list[int] | None = None,
        forgetting_factor: list[float] | None = None,
        schedule: str = "every_sample",
    ) -> None:
        self.members, self.factors = ranges(n, blocks), forgetting_factor
        self.schedule = schedule

    def forgetting(self, step: Step) -> Matrix:
        """Q as embedded by (E2): F = R - (P + Q)^-1."""
        roots = weights(self.members, step.factor, self.factors)
        roots = due(roots, self.members, self.schedule, step.k)
        q = inflation(step.covariance, self.members, roots)
        return (step.information - inverse(step.covariance + q)).mid()


class Published(PublishedForm):
    def __init__(
        self,
        theta: Matrix,
        covariance: Matrix,
        blocks: list[int] | None = None,
        forgetting_factor: list[float] | None = None,
        schedule: str = "every_sample",
    ) -> None:
        super().__init__(theta, covariance)
        self.members, self.factors = ranges(theta.nrows(), blocks), forgetting_factor
        self.schedule, self.k = schedule, 0

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        roots = weights(self.members, factor, self.factors)
        roots = due(roots, self.members, self.schedule, self.k)
        wider = symmetric(self.covariance + inflation(self.covariance, self.members, roots))
        error = (y - phi * self.theta).mid()
        self.theta = (self.theta + gain(wider, phi) * error).mid()
        self.covariance = measured(wider, phi)
        self.k += 1


def cases(n: int) -> list[dict[str, object]]:
    different = [0.9 + 0.09 * i / n for i in range(n)]
    some: list[dict[str, object]] = [{}, {"forgetting_factor": different}]
    if n >= 4:
        some.append({"blocks": [n - 3, 3], "forgetting_factor": [0.95, 0.99]})
    some += [{**case, "schedule": "cyclic"} for case in some]
    return some
