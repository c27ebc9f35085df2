"""Theorem 2 for every rule: which conclusions follow with excitation, and which without."""

from __future__ import annotations

import numpy as np

from forgetting.analysis import conditions, stability

from ..claim import Check, Finding
from .every_rule import ABOUT, NAMES, course, data, make

CONCLUSIONS = (
    ("globally uniformly exponentially stable", "exponentially stable"),
    ("globally asymptotically stable", "asymptotically stable"),
    ("uniformly Lyapunov stable", "uniformly Lyapunov stable"),
    ("Lyapunov stable", "Lyapunov stable"),
)
GUARANTEES = (("A1", "proper"), ("A2", "bounded_above"), ("A3", "bounded_below"))
WINDOW = 20


def classify(name: str, kind: str) -> tuple[dict[str, str], str, float, float]:
    """Verdicts on A1-A4, the strongest conclusion, what is left of ‖θ̃‖, and of the samples."""
    phi, y, theta = data(kind)
    found = course(make(name), phi, y)
    judged = conditions(found.trajectory, window=WINDOW)
    verdicts: dict[str, str] = {each.name: each.verdict for each in judged if each.name <= "A4"}
    concluded = stability(judged)
    strongest = next(
        (short for full, short in CONCLUSIONS if concluded[full].outcome == "follows"), "nothing"
    )
    start, end = found.path.theta[0] - theta, found.path.theta[-1] - theta
    left = float(np.linalg.norm(end) / np.linalg.norm(start))
    return verdicts, strongest, left, float(found.path.used.mean())


def agrees(name: str, verdicts: dict[str, str]) -> bool:
    """Whether what the registry says always holds was found to hold."""
    promised = [key for key, word in GUARANTEES if ABOUT[name][word] == "always"]
    return all(verdicts[key] == "holds" for key in promised)


def words(verdicts: dict[str, str]) -> str:
    """The conditions that hold."""
    return " ".join(key for key, verdict in verdicts.items() if verdict == "holds") or "none"


def check(name: str) -> Check:
    """The classification of one rule."""
    about = ABOUT[name]

    def classification() -> Finding:
        excited, strong, left, used = classify(name, "excited")
        silent, weak, _, _ = classify(name, "silent")
        measured = f"excited: {words(excited)} → {strong}, error × {left:.0e}; "
        measured += f"not excited: {words(silent)} → {weak}"
        converges = left < 0.01 or "asymptotically" not in strong
        if used < 1:  # a rule that leaves samples out is not excited by them
            measured += f"; used {used:.0%} of the samples"
        exciting = (excited["A4"] == "holds" or used < 1) and silent["A4"] != "holds"
        return measured, agrees(name, excited) and agrees(name, silent) and converges and exciting

    printed = f"A1: {about['proper']}. A2: {about['bounded_above']}. A3: {about['bounded_below']}"
    reason = "Printed: what the rule's header claims. A finite record can only show that it holds."
    source = f"GF-RLS Theorem 2, {name}"
    return Check(source, printed, "reproduced", reason, classification, name)


CHECKS = tuple(check(name) for name in NAMES)
