"""How Python says a choice, where `fg` is the package."""

from __future__ import annotations

from typing import Any

from forgetting.choice import Choice
from forgetting.choices import AXES, Rate
from forgetting.models.named import NamedModel
from forgetting.models.orders import Each
from forgetting.tuning.candidate import Candidate


def given(choice: Choice) -> dict[str, Any]:
    """The parameters that are not at their defaults, by name."""
    plain: Any = AXES["rate" if isinstance(choice, Rate) else "rule"].make(choice.name).arguments()
    return {name: value for name, value in choice.arguments().items() if value != plain[name]}


def code(value: Any) -> str:
    """How Python says it, where `fg` is the package.

    Examples
    --------
    >>> code(AXES["rule"].make("subspace", forgetting_factor=0.98))
    'fg.Subspace(forgetting_factor=0.98)'
    """
    if not isinstance(value, Choice):
        return repr(value)
    inner = ", ".join(f"{name}={code(each)}" for name, each in given(value).items())
    return f"fg.{type(value).__name__}({inner})"


def estimator_code(candidate: Candidate, parameters: int, targets: int) -> str:
    """The estimator as Python makes it."""
    several = f", targets={targets}" if targets > 1 else ""
    if candidate.rule is None:
        return f"fg.Bank({parameters}{several})"
    return f"fg.RLS({parameters}, rule={code(candidate.rule)}{prior_code(candidate)}{several})"


def model_code(candidate: Candidate, offset: bool = False) -> str:
    """The dynamic model as Python makes it."""
    orders = candidate.orders
    assert orders is not None
    if isinstance(orders, NamedModel):
        name = type(orders.make()).__name__
        said = {order: listed(value) for order, value in orders.orders}
    else:
        name, said = "ARX", {"na": orders.na, "nb": listed(orders.nb), "nk": listed(orders.nk)}
    lags = ", ".join(f"{order}={value}" for order, value in said.items())
    lags += ", offset=True" if offset else ""
    if candidate.rule is None:
        return f"fg.{name}({lags})"
    return f"fg.{name}({lags}, rule={code(candidate.rule)}{prior_code(candidate)})"


def listed(order: Each) -> int | list[int]:
    """An order as a constructor takes it."""
    return order if isinstance(order, int) else list(order)


def prior_code(candidate: Candidate) -> str:
    """The prior as an argument, where it does not follow the data."""
    prior = candidate.initial_covariance
    return "" if prior is None else f", initial_covariance={list(prior)!r}"
