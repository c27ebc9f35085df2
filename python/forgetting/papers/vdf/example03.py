"""Example 3 and Figure 2: what loss of excitation does to P_k⁻¹ without and with forgetting."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from matplotlib.figure import Figure

import forgetting as fg
from forgetting.analysis import Excitation, excitation
from forgetting.plot.style import BLUE, FAINT, SKY

from ..claim import Finding, claim
from ..path import Path, follow
from ..picture import bound, figure_of, group, legend_below, panels, picture
from .systems import Array, three_sinusoids, two_lags

SAMPLES, LOST = 5000, 2500
FACTOR = 0.9


@lru_cache(maxsize=1)
def regressors() -> Array:
    """The input is (27), and 1 from sample 2500 on."""
    wave = three_sinusoids(SAMPLES)
    return two_lags(np.where(np.arange(SAMPLES) < LOST, wave, 1.0))


@lru_cache(maxsize=1)
def excited() -> Excitation:
    """F_{j,j+2}."""
    return excitation(regressors(), window=3)


@lru_cache(maxsize=2)
def path(factor: float) -> Path:
    """P_0 = I (the paper does not say)."""
    phi = regressors()
    return follow(fg.rule("exponential", forgetting_factor=factor), phi, np.zeros(SAMPLES))


@claim("VDF Example 3", "the smaller singular value of F_{j,j+2} reaches zero in machine precision")
def excitation_is_lost() -> Finding:
    """From sample 2501 on every regressor is [1, 1]."""
    after = excited().smallest[LOST + 1 :]
    before = excited().smallest[1:LOST]
    return f"{before.min():.2g} before, {after.max():.1g} after", bool(after.max() < 1e-15)


@claim("VDF Example 3, λ = 1", "one singular value of P_k⁻¹ diverges")
def without_forgetting() -> Finding:
    """Along [1, 1] it grows by |φ|² = 2 a sample; the other stands still."""
    information = 1 / path(1.0).values[LOST + 1 :]
    growth = float((information[-1, 1] - information[0, 1]) / (len(information) - 1))
    moved = float(np.ptp(information[:, 0]) / information[0, 0])
    measured = f"grows by {growth:.4f} a sample; the other moves by {moved:.2g} of itself"
    return measured, abs(growth - 2) < 1e-3 and moved < 0.01


@claim(
    "VDF Example 3, λ = 0.9",
    "one singular value of P_k⁻¹ converges to zero",
    reason="In float64 it stops near 1e-30, where the rounding of U counts as excitation.",
)
def with_forgetting() -> Finding:
    """It decays as λ^k; the other is bounded."""
    information = 1 / path(FACTOR).values[LOST:]
    decay = float((information[300, 0] / information[10, 0]) ** (1 / 290))
    measured = f"decays by {decay:.6f} a sample to {information[-1, 0]:.0e}; "
    other = information[10:, 1]
    measured += f"the other stays in {other.min():.3g} to {other.max():.3g}"
    return measured, abs(decay - FACTOR) < 1e-6 and bool(other.max() < 30 and other.min() > 10)


@picture(
    "vdf_figure_02",
    "VDF Figure 2",
    "Example 3. Singular values of F_{j,j+2}, and of P_k⁻¹ without forgetting and with λ = 0.9. "
    "Excitation is lost at k = 2500 (dotted).",
)
def figure() -> Figure:
    """Three panels."""
    axes = panels(1, 3, ("F over 3 samples", "P⁻¹, λ = 1", "P⁻¹, λ = 0.9"), height=2.8)
    values = np.stack([excited().largest, np.maximum(excited().smallest, 1e-18)], axis=1)
    curves = (values, 1 / path(1.0).values[:, ::-1], 1 / path(FACTOR).values[:, ::-1])
    for ax, curve in zip(axes, curves, strict=True):
        group(ax, np.arange(len(curve)), curve, BLUE, "larger", width=0.9)
        ax.lines[1].set(color=SKY, label="smaller")
        ax.axvline(LOST, color=FAINT, linestyle=":")
        ax.set(yscale="log", xlabel="k")
    bound(axes[0], excited().beta, "β")
    axes[0].set_xlabel("j")
    for ax in axes:
        legend_below(ax, 3)
    return figure_of(axes)
