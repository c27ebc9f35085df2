"""Theorem 1 for every rule: the estimate minimises the cost (4), computed from all the data."""

from __future__ import annotations

import numpy as np

from ..claim import Check, Finding, largest_gap
from .every_rule import NAMES, Array, Course, course, data, make

GAP = 1e-8
"""Largest gap accepted: the normal equations are summed and solved with a condition of 1e6."""


def minimiser(found: Course) -> Array:
    """argmin J_k of (4) after the whole record, from its normal equations."""
    theta, forgotten = found.path.theta[:-1], found.forgetting
    hessian = found.path.information[0] + (found.measured - forgotten).sum(axis=0)
    right = found.path.information[0] @ theta[0] - np.einsum("tij,tj->i", forgotten, theta)
    right += np.einsum("t,ti,t->i", found.weight, found.phi, found.y)
    return np.linalg.solve(hessian, right)


def check(name: str) -> Check:
    """The theorem for one rule, on noisy data."""

    def minimises() -> Finding:
        phi, y, _ = data("excited", 150)
        noisy = y + np.random.default_rng(1).standard_normal(len(y))
        found = course(make(name), phi, noisy)
        gap = largest_gap(minimiser(found), found.path.theta[-1])
        kept = np.linalg.eigvalsh(found.path.information[:-1] - found.forgetting)[:, 0].min()
        measured = f"θ is the minimiser to {gap:.0e}; R − F ≥ {kept:.1e}"
        return measured, gap < GAP and bool(kept > 0)

    printed = "θ_{k+1} is the unique minimiser of (4), and R_k − F_k > 0 (12)"
    return Check(f"GF-RLS Theorem 1, {name}", printed, "reproduced", "", minimises, name)


CHECKS = tuple(check(name) for name in NAMES)
