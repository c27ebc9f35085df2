"""Figure 1 and section V: which rule is a special case of which, with its F_k.

The boxes come from the registry, F_k from the header of each rule, and every arrow is measured:
both rules run over one record and must give the same estimates and covariances.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from forgetting.plot.style import BLUE, FAINT, INK, ORANGE

from ..claim import Check, Finding, claim, largest_gap
from ..picture import figure_of, panels, picture
from .every_rule import ABOUT, NAMES, course, data, make

START = [100.0, 50.0, 25.0]
"""P_0 with distinct eigenvalues, so that its eigenvectors are unique."""


@dataclass(frozen=True)
class Special:
    """`rule` (with `own`) is what `general` becomes with `parameters`."""

    rule: str
    general: str
    words: str
    parameters: dict[str, Any] = field(default_factory=dict)
    own: dict[str, Any] = field(default_factory=dict)


ONE = {"forgetting_factor": 1.0}
NEVER = {"period": 10**6}
SPECIAL_CASES = tuple(
    each
    for each in (
        Special("none", "exponential", "λ = 1", ONE),
        Special("none", "restricted", "λ = 1", ONE),
        Special("none", "directional", "λ = 1", ONE),
        Special("none", "random_walk", "Q = 0", {"process_noise": 0.0}),
        Special("none", "covariance_resetting", "no reset", NEVER),
        Special("exponential", "exponential_resetting", "R∞ = 0", {"information": 0.0}),
        Special("exponential", "cyclic_resetting", "R∞ = 0", {"information": 0.0}),
        Special("exponential", "variable_direction", "ε → 0", {"threshold": 1e-12}),
        Special("exponential", "component", "one block", {"blocks": 3}),
        Special("exponential", "multiple", "one block", {"blocks": 3, "factors": 0.95}),
        Special("directional", "oblique_projection", "one row"),
        Special("oblique_projection", "subspace", "all above ε"),
        Special(
            "exponential_resetting",
            "matrix_forgetting",
            "N = 1",
            {"information": 0.02, "power": 1},
            {"information": 0.02},
        ),
    )
    if each.rule in ABOUT and each.general in ABOUT
)


def special_case(each: Special) -> Check:
    """The two rules over one record."""

    def same() -> Finding:
        phi, y, _ = data("excited", 150)
        paths = [
            course(make(name, **values), phi, y, START).path
            for name, values in ((each.rule, each.own), (each.general, each.parameters))
        ]
        gaps = [
            largest_gap(getattr(paths[1], part), getattr(paths[0], part))
            for part in ("theta", "covariance")
        ]
        return f"θ to {gaps[0]:.0e}, P to {gaps[1]:.0e}", max(gaps) < 1e-9

    printed = f"{each.rule} is {each.general} with {each.words}"
    source = f"GF-RLS Figure 1, {each.rule}"
    return Check(source, printed, "reproduced", "", same, f"{each.rule}-{each.general}")


CHECKS = tuple(special_case(each) for each in SPECIAL_CASES)


@claim(
    "GF-RLS section V-D",
    "data-dependent updating is simply variable-rate forgetting, λ_k = (1 − μ_k)μ_{k−1}/μ_k",
    verdict="corrected",
    reason="λ_k is undefined at μ_k = 0 and exceeds 1, which is improper. As Γ_k = I/μ_k, "
    "F_k = μ_kP_k⁻¹ it is always defined and proper.",
)
def data_dependent_updating() -> Finding:
    """A record with bounded noise: samples that tell nothing have μ_k = 0."""
    phi, y, _ = data("excited", 150)
    noisy = y + np.random.default_rng(2).uniform(-1, 1, len(y))
    found = course(make("data_dependent", noise_bound=1.0, initial_radius=10.0), phi, noisy)
    weight = found.weight
    used = weight > 0
    printed = (1 - weight[used][1:]) * weight[used][:-1] / weight[used][1:]
    scaled = found.forgetting / np.maximum(weight, 1e-12)[:, np.newaxis, np.newaxis]
    gap = largest_gap(scaled[used], found.path.information[:-1][used])
    measured = f"μ = 0 at {int((~used).sum())} of 150 samples; printed λ up to "
    measured += f"{printed.max():.3g}; F = μR to {gap:.0e}"
    return measured, bool(printed.max() > 1 and (~used).any() and gap < 1e-6)


@claim(
    "GF-RLS section V-J",
    "if λ_{1,k}, λ_{2,k} are chosen sufficiently small, multiple forgetting is proper",
    verdict="corrected",
    reason="No constant is small enough: the smaller λ, the nearer R_k to φᵀφ, whose correlation "
    "is 1. λ_k ≤ 1 − |ρ_k| at each sample is.",
)
def multiple_forgetting() -> Finding:
    """Two parameters; smallest eigenvalue of F_k over R_k for constant λ, and for 1 − |ρ_k|."""
    phi, y, _ = data("excited", 150, 2)
    least = []
    for factor in (0.99, 0.5, 0.01):
        found = course(make("multiple", factors=factor), phi, y)
        least.append(float(np.linalg.eigvalsh(found.forgetting[5:])[:, 0].min()))
    r = found.path.information[5:-1]
    rho = r[:, 0, 1] / np.sqrt(r[:, 0, 0] * r[:, 1, 1])
    kept = (1 - np.abs(rho))[:, np.newaxis, np.newaxis] * r * np.eye(2)
    chosen = float(np.linalg.eigvalsh(r - kept)[:, 0].min())
    words = ", ".join(f"{value:.2g}" for value in least)
    measured = f"least eigenvalue of F: {words} for λ = 0.99, 0.5, 0.01; {chosen:.0e} for 1 − |ρ|"
    return measured, max(least) < 0 and chosen > -1e-9


def formula(name: str) -> str:
    """F_k from the header of the rule, or what it does to P where the header has no F_k."""
    block = re.search(r"```text\n(.*?)```", ABOUT[name]["header"], re.DOTALL)
    lines = [
        re.split(r"\s{2,}", line.strip())[0] for line in (block[1] if block else "").splitlines()
    ]
    for start in ("F_k =", "P_k+1 =", "P_{k+1} =", "P̄ =", ""):
        for line in lines:
            if line.startswith(start):
                return line.rstrip(",")
    return ""


def columns() -> list[list[str]]:
    """Rules by distance from the most special one, each near those it generalises."""
    depth = dict.fromkeys(NAMES, 0)
    for _ in NAMES:
        for each in SPECIAL_CASES:
            depth[each.general] = max(depth[each.general], depth[each.rule] + 1)
    linked = {name for each in SPECIAL_CASES for name in (each.rule, each.general)}
    last = max(depth.values())
    levels: list[list[str]] = []
    for level in range(last + 1):
        above = levels[-1] if levels else []
        parents = {e.general: above.index(e.rule) for e in SPECIAL_CASES if e.rule in above}
        mine = [n for n in NAMES if (depth[n] if n in linked else last) == level]
        levels.append(sorted(mine, key=lambda name: parents.get(name, len(NAMES))))
    return levels


@picture(
    "gf_figure_1",
    "GF-RLS Figure 1",
    "Every rule of the registry is GF-RLS, R̄ = R − F, with the F shown (blue: always proper). An "
    "arrow leads from a rule to one it is a special case of, and says of what. Drawn from the "
    "registry.",
)
def figure() -> Figure:
    """One column a level, the most special rule on the left."""
    (ax,) = panels(1, 1, ("GF-RLS: R̄ = R − F",), height=6.8)
    ax.axis("off")
    levels, place = columns(), {}
    for level, names in enumerate(levels):
        for row, name in enumerate(names):
            place[name] = (level * STEP, -(row + 0.5) * 10 / len(names))
    for each in SPECIAL_CASES:
        arrow(ax, place[each.rule], place[each.general], each.words, each.rule == "none")
    for name, spot in place.items():
        box(ax, name, spot)
    ax.set(xlim=(-0.5, (len(levels) - 1) * STEP + HALF), ylim=(-10, 0))
    return figure_of([ax])


STEP, HALF = 3.7, 1.05
"""Distance of the columns, and half the width of a box."""


def box(ax: Axes, name: str, spot: tuple[float, float]) -> None:
    """A rule with its F_k under its name."""
    color = BLUE if ABOUT[name]["proper"] == "always" else ORANGE
    frame = {"boxstyle": "round,pad=0.35", "facecolor": "white", "edgecolor": color, "lw": 1.3}
    words = re.sub(r"(.{20}\S*) ", r"\1\n", formula(name))
    text = f"{name}\n{words}"
    ax.text(
        spot[0],
        spot[1],
        text,
        ha="center",
        va="center",
        fontsize=6,
        bbox=frame,
        zorder=3,
        color=INK,
    )


def arrow(
    ax: Axes, start: tuple[float, float], end: tuple[float, float], words: str, first: bool
) -> None:
    """From the right of the special rule to the left of the general one."""
    begin = (start[0] + (0.45 if first else HALF), start[1])
    tip = (end[0] - HALF, end[1])
    style = {"arrowstyle": "-|>", "color": FAINT, "lw": 1.0, "shrinkA": 0, "shrinkB": 0}
    ax.annotate("", tip, begin, arrowprops=style, zorder=1)
    x, y = 0.45 * np.array(begin) + 0.55 * np.array(tip)
    patch = {"facecolor": "white", "edgecolor": "none", "pad": 0.6}
    ax.text(x, y, words, fontsize=6, color=INK, ha="center", va="center", bbox=patch, zorder=2)
