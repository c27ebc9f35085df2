"""One way to estimate: a rule and a prior, or the bank, for one model."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import RLS, Bank
from forgetting.choices import AXES, Rule
from forgetting.tuning.problem import Problem
from forgetting.tuning.structures import ModelOrders

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Candidate:
    """What is tried.

    Attributes
    ----------
    rule : Rule or None
        The forgetting rule; None is the bank.
    initial_covariance : tuple of float or None
        The diagonal of P before the first sample; None follows the data.
    orders : Orders, NamedModel or None
        Of an ARX model, or a structure with its orders.
    """

    rule: Rule | None
    initial_covariance: tuple[float, ...] | None = None
    orders: ModelOrders | None = None

    def errors(self, problem: Problem, stop: int | None = None) -> Array:
        """One-step errors of the rows before `stop`, (T, m), each from before its sample."""
        estimator = self.estimator(problem.parameters, problem.y.shape[1])
        return problem.errors(estimator, stop, follows=self.initial_covariance is None)

    def estimator(self, parameters: int, targets: int) -> Any:
        """A new estimator."""
        if self.rule is None:
            return Bank(parameters, targets=targets)
        covariance = self.initial_covariance
        return RLS(
            parameters,
            rule=self.rule,
            targets=targets,
            initial_covariance=None if covariance is None else np.array(covariance),
        )

    def with_rule(self, **values: Any) -> Candidate:
        """The same with other parameters of its rule."""
        assert self.rule is not None
        return replace(self, rule=with_values(self.rule, **values))


NOISE = "process_noise"
"""How much a random walk forgets is the variance of its steps, no factor."""


def tuned(rule: str) -> str | None:
    """The parameter of a rule that says how much it forgets: a factor, or a noise.

    Examples
    --------
    >>> tuned("subspace"), tuned("multiple"), tuned("random_walk"), tuned("none")
    ('forgetting_factor', 'factors', 'process_noise', None)
    """
    about = AXES["rule"].classes[rule].about
    if about["forgetting_factor"]:
        return "forgetting_factor"
    names = [each["name"] for each in about["parameters"]]
    return next((name for name in ("factors", NOISE) if name in names), None)


def with_values(rule: Rule, **values: Any) -> Rule:
    """The rule with other values of some parameters."""
    made: Rule = type(rule)(**{**rule.arguments(), **values})
    return made
