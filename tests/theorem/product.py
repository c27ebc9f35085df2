"""Estimators of the package from the parameter sets of the references."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import forgetting as fg
import numpy as np
from reference.linalg import matrix, to_float

RULES = {about["name"]: about for about in fg.rules()}
RATES = {about["name"]: about for about in fg.rates()}
WEIGHTINGS = {about["name"]: about for about in fg.weightings()}


def rule(name: str, case: Mapping[str, object], factor: object) -> fg.Rule:
    """The package's rule for a reference's parameter set; ``factor`` is a float or a rate."""
    values = dict(case)
    if name == "custom":
        values["forgetting_matrix"] = _plain(values.pop("function"))
    if name == "multiple":  # whose factors are its own, a rate cannot set them
        alike = getattr(factor, "parameters", {}).get("forgetting_factor", factor)
        values["factors"] = values.pop("forgetting_factor", alike)
    if "rule" in values:  # (name, parameters) of an inner rule
        inner, parameters = values["rule"]
        values["rule"] = rule(inner, parameters, factor)
    if RULES[name]["forgetting_factor"]:
        values.setdefault("forgetting_factor", factor)
    return fg.rule(name, **values)


def _plain(function: Callable[[object, object], object]) -> Callable[..., np.ndarray]:
    """A reference's F (of 256-bit matrices) for arrays."""
    return lambda information, phi, error: to_float(
        function(matrix(np.asarray(information)), matrix(np.atleast_2d(phi)))
    )


def rate(name: str, case: Mapping[str, object]) -> fg.Rate:
    if name == "function":
        start, step = case["start"], case["step"]
        return fg.Function(lambda evidence: min(1.0, start + step * evidence.samples))
    return getattr(fg, RATES[name]["type_name"])(**case)


def weighting(name: str, case: Mapping[str, object]) -> fg.Weighting:
    return getattr(fg, WEIGHTINGS[name]["type_name"])(**case)


def rows(name: str, wanted: int) -> int:
    """``wanted`` rows, or as many as the rule takes."""
    largest = RULES[name]["largest_rows"]
    return wanted if largest is None else min(wanted, largest)


def feed(est: fg.RLS, phi: np.ndarray, y: np.ndarray, gamma: np.ndarray | None) -> fg.Run:
    """A stretch of a reference record, phi (T, p, n) and y (T, p, targets), through ``run``."""
    samples, p, _ = phi.shape
    shape = (samples,) + ((p,) if p > 1 else ()) + ((est.targets,) if est.targets > 1 else ())
    return est.run(
        phi if p > 1 else phi[:, 0],
        y.reshape(shape),
        gamma=gamma,
        outputs=("error", "forgetting_factor", "skipped"),
    )
