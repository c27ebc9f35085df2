"""How each choice is made in its figure and its example: the text that the page shows."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import forgetting as fg

FACTOR = 0.97
"""The forgetting factor of all figures."""

SETTINGS = {
    "custom": "lambda r, phi, error: 0.03 * r",
    "component": f"factors=[0.99, {FACTOR}]",
    "multiple": f"factors=[0.99, {FACTOR}]",
    "random_walk": "process_noise=0.003, bound=100.0",
    "covariance_resetting": 'rule="none", criterion="period", period=150',
    "data_dependent": "noise_bound=2.0",
    "schedule": f"[0.8, 0.9, {FACTOR}]",
    "function": f"lambda evidence: 0.9 if evidence.normalized_error > 9 else {FACTOR}",
    "gate_function": 'lambda evidence: "hold" if evidence.leverage < 1e-3 else "update"',
    "minimum_information": "1e-4",
    "dead_zone": "1.0",
    "gradient": "smallest=0.8",
    "exact_gradient": "smallest=0.8",
}
"""Arguments where the defaults do not show what the choice is for, or do not exist."""


def made(about: Mapping[str, Any]) -> str:
    """The Python that makes a choice.

    Examples
    --------
    >>> rules = {rule["name"]: rule for rule in fg.rules()}
    >>> print(made(rules["subspace"]), made(rules["none"]))
    fg.Subspace(0.97) fg.NoForgetting()
    """
    name = about["name"]
    usual = str(FACTOR) if about.get("forgetting_factor") else ""
    return f"fg.{about['type_name']}({SETTINGS.get(name, usual)})"


def making(about: Mapping[str, Any]) -> Any:
    """What that Python makes."""
    return eval(made(about), {"fg": fg})
