"""What is tried, all of it independent of the units of the columns."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import InvalidInput
from forgetting.choices import AXES, Rate, Rule
from forgetting.tuning.candidate import NOISE, tuned

Array = NDArray[np.float64]

SHORTLIST = ("none", "exponential", "exponential_resetting", "subspace", "random_walk")
"""Rules that are tried when none are named: the ways to forget that `docs/choosing.md` advises."""
MEMORIES = 9
"""Memories on the first grid, from the shortest to half of the samples."""
SHORTEST = 2.0
"""Shortest memory, in samples."""
NOISES = tuple(10.0**power for power in range(-9, 4))
"""Variances of the steps of a random walk, where regressors are in units of their typical size."""
SPEEDS = (0.0, 1e-5, 1e-3, 1e-1)
"""Variances of the steps of the random walks that judge the orders of a model."""
BOUND = 1e5
"""Bound of P for a random walk, as in the default rule of `forgetting.RLS`."""
VARIANTS = {
    "threshold": (1e-4, 1e-2, 0.1),
    "information": (1e-5, 1e-3, 0.1),
    "bound": (1e2,),
}
"""Other parameters of a rule and what is tried of them, beside their defaults."""
PRIORS = (1.0, 1e2, 1e8)
"""Variances before the first sample, for regressors of mean square 1."""


def named_rules(rules: str | list[str] | tuple[str, ...]) -> list[str]:
    """The registry names of the rules to try; "shortlist", "all" that forget, or a list.

    Raises
    ------
    InvalidInput
        For a name that is not in the registry, or that of a rule that needs a function.
    """
    usable = {
        entry["name"]: entry
        for entry in AXES["rule"].entries
        if not any(parameter["required"] for parameter in entry["parameters"])
    }
    if rules == "shortlist":
        return list(SHORTLIST)
    if rules == "all":
        return ["none", *(name for name in usable if tuned(name))]
    names = [rules] if isinstance(rules, str) else list(dict.fromkeys(rules))
    for name in names:
        if name not in usable:
            raise InvalidInput(f"rule = {name!r}, allowed: shortlist, all, {', '.join(usable)}")
    if not names:
        raise InvalidInput(f"rules = {rules!r}, allowed: shortlist, all, or names of rules")
    return names


def plain_rule(name: str) -> Rule:
    """The rule with its defaults; a random walk bounded."""
    values = {"bound": BOUND} if name == "random_walk" else {}
    made: Rule = AXES["rule"].make(name, **values)
    return made


def speeds() -> list[Rule]:
    """Random walks from fixed parameters to fast ones."""
    make: Callable[..., Rule] = AXES["rule"].make
    walks = [make("random_walk", process_noise=each, bound=BOUND) for each in SPEEDS if each]
    return [make("none"), *walks]


def factor(memory: float) -> float:
    """The forgetting factor that remembers so many samples, 1 − λ to three digits.

    Examples
    --------
    >>> factor(100.0), factor(3.0), factor(12345.6)
    (0.99, 0.667, 0.999919)
    """
    forgotten = float(f"{1 / memory:.3g}")
    digits = max(0, 2 - int(np.floor(np.log10(forgotten))))
    return round(1 - forgotten, digits)


def settings(rule: str, samples: int) -> list[float]:
    """The first grid of the parameter that says how much a rule forgets."""
    if tuned(rule) == NOISE:
        return list(NOISES)
    longest = max(samples / 2, 2 * SHORTEST)
    return [factor(memory) for memory in np.geomspace(SHORTEST, longest, MEMORIES)]


def between(one: float, other: float, rule: str) -> float:
    """The setting in the middle of two: a geometric mean of memories or variances."""
    if tuned(rule) == NOISE:
        return float(f"{np.sqrt(one * other):.3g}")
    return factor(float(1 / np.sqrt((1 - one) * (1 - other))))


def variants(rule: Rule) -> Iterator[dict[str, Any]]:
    """Values of one other parameter at a time."""
    for name, values in VARIANTS.items():
        if name in rule.parameters:
            yield from ({name: value} for value in values if value != rule.parameters[name])


RATES: dict[str, tuple[str, tuple[float, ...]]] = {
    "prediction_error": ("sensitivity", (1.0, 10.0)),
    "fortescue": ("memory", (30.0, 100.0, 300.0)),
    "noise_power": ("ratio", (1.5, 3.0)),
    "gradient": ("step_size", (1e-3, 1e-2)),
    "exact_gradient": ("step_size", (1e-3, 1e-2)),
    "rms_ratio": ("sensitivity", (0.1, 1.0)),
    "f_test": ("sensitivity", (0.1, 1.0)),
    "unity_zone": ("sensitivity", (0.05, 0.5)),
}
"""Rates that are tried, with what values of which parameter: pure numbers where P is not given."""
SMALLEST = (0.9, 0.5)
"""The least factor that a rate may take: memories of ten samples and of two."""
WITHOUT_UNITS = ("f_test",)
"""Rates that also weigh several outputs without regard to their units."""
NOT_TRIED = ("constant", "schedule", "function")
"""The factor itself, and what the user must know."""


def rates(outputs: int) -> list[Rate]:
    """The rates to try."""
    make: Callable[..., Rate] = AXES["rate"].make
    return [
        make(name, **{parameter: value}, smallest=least)
        for name, (parameter, values) in RATES.items()
        if outputs == 1 or name in WITHOUT_UNITS
        for value, least in product(values, SMALLEST)
    ]


def priors(squares: Array) -> list[tuple[float, ...]]:
    """Diagonals of P before the first sample, for regressors with these mean squares, (n,)."""
    if not (squares > 0).all():
        return []
    return [tuple(rounded(prior / each) for each in squares) for prior in PRIORS]


def rounded(value: float) -> float:
    """Six digits: enough for the same predictions in all units, short enough to print."""
    return float(f"{value:.6g}")
