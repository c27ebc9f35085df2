"""The estimator behind a model: a bank where nothing was chosen, else one rule."""

from __future__ import annotations

from typing import Any

from forgetting._core import RLS, Bank
from forgetting.choices import AXES


def new_estimator(parameters: int, rule: Any, **settings: Any) -> RLS | Bank:
    """Make the estimator of `parameters` parameters.

    Parameters
    ----------
    parameters : int
        Number n of parameters of each target.
    rule : str, Rule or None
        "auto" for `Bank`, which mixes rules of all speeds; else the rule of `RLS`.
    **settings
        What both take: targets, weighting, initial_covariance, ...

    Raises
    ------
    InvalidInput
        For a rule that does not exist; names those that are close.

    Examples
    --------
    >>> new_estimator(2, "auto", targets=3)
    Bank(2, 8 members, mixer="mlpol") after 0 samples
    """
    if isinstance(rule, str) and rule == "auto":
        return Bank(parameters, **settings)
    if isinstance(rule, str):
        rule = AXES["rule"].make(rule)
    return RLS(parameters, rule=rule, **settings)
