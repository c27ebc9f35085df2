"""Example 11 and Figure 10: variable-direction forgetting keeps what no sample renews."""

from __future__ import annotations

from matplotlib.figure import Figure

from ..claim import Finding, claim
from ..picture import figure_of, panels, picture
from .example10 import draw_content
from .fifth import information_content, run
from .systems import fifth_order

SAMPLES, EVERY = 2500, 5
FACTORS = (0.9, 0.8)
THRESHOLD = 1e-8
"""ε of (67)."""
SMALL = (
    "They settle near 1e-9, not at order one: the start of the record excites them for a while, "
    "and that is forgotten before the content falls below ε."
)


@claim("VDF Example 11", "the information-rich subspace is six dimensional")
def six_components() -> Finding:
    """Content of the six largest directions against the other four, in the second half."""
    words, clear = [], True
    for factor in FACTORS:
        path = run("variable_direction", factor, SAMPLES, EVERY, threshold=THRESHOLD)
        content = information_content(path, fifth_order(SAMPLES)[0])
        peak = content[len(content) // 2 :].max(axis=0)
        words.append(f"λ = {factor}: six ≥ {peak[4:].min():.0e}, four ≤ {peak[:4].max():.0e}")
        clear &= bool(peak[4:].min() > 1e4 * peak[:4].max() and peak[:4].max() <= THRESHOLD)
    return "; ".join(words), clear


@claim("VDF Example 11", "the other singular values of P_k⁻¹ do not converge to zero", reason=SMALL)
def four_are_kept() -> Finding:
    """The four smallest eigenvalues of P⁻¹ stand still once their content is below ε."""
    words, kept = [], True
    for factor in FACTORS:
        path = run("variable_direction", factor, SAMPLES, EVERY, threshold=THRESHOLD)
        silent = 1 / path.values[len(path.values) // 2 :, :4]
        moved = float((silent.max(axis=0) / silent.min(axis=0)).max())
        words.append(f"λ = {factor}: {silent.min():.1e} to {silent.max():.1e}, × {moved:.4f}")
        kept &= bool(silent.min() > 1e-12 and moved < 1.01)
    return "; ".join(words), kept


@picture(
    "vdf_figure_10",
    "VDF Figure 10",
    "Example 11. Information content of ψ_k (above) and singular values of P_k⁻¹ (below) with "
    "variable-direction forgetting, ε = 1e-8, P₀ = I; inverse of the condition number in black.",
)
def figure() -> Figure:
    """One column a factor."""
    titles = [f"{what}, λ = {f:g}" for what in ("|ψ|", "P⁻¹") for f in FACTORS]
    axes = panels(2, 2, titles, height=2.4)
    draw_content(axes, "variable_direction", FACTORS, SAMPLES, threshold=THRESHOLD)
    return figure_of(axes)
