"""Conditions A1-A3: is forgetting proper, and is P bounded from both sides?"""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from .reconstruction import AMPLIFICATION, roundoffs
from .root import square_root
from .trajectory import Trajectory
from .trend import Trend, trend
from .validation import Array

Verdict = Literal["holds", "fails", "not decidable"]
Finding = tuple[Verdict, dict[str, float], "int | None", str, "Trend | None"]

#: P̄ may fall short of P by this relative amount before A1 is said to fail: 100 times the
#: largest shortfall measured on proper rules in double precision (see the tests).
TOLERANCE = 1e-9


def retained(trajectory: Trajectory) -> Array:
    """Return for each sample the smallest eigenvalue of P̄ in the metric of P, (T,).

    At least 1 when forgetting is proper: F >= 0 iff P̄ >= P. It does not depend on the
    units of the parameters. NaN where P or P̄ is not finite.
    """
    return _retained(
        trajectory, square_root(np.nan_to_num(trajectory.before), trajectory.precision)[1]
    )


def _retained(trajectory: Trajectory, inverse: Array) -> Array:
    fine = _finite(trajectory)
    ratio = inverse[fine] @ trajectory.prior[fine] @ np.swapaxes(inverse[fine], 1, 2)
    result = np.full(trajectory.samples, np.nan)
    result[fine] = np.linalg.eigvalsh((ratio + np.swapaxes(ratio, 1, 2)) / 2)[:, 0]
    return result


def _finite(trajectory: Trajectory) -> NDArray[np.bool_]:
    """Samples whose P and P̄ are finite."""
    both = np.isfinite(trajectory.before) & np.isfinite(trajectory.prior)
    return np.asarray(both.all(axis=(1, 2)), dtype=np.bool_)


def _resolution(trajectory: Trajectory, root: Array, inverse: Array) -> Array:
    """Shortfall of P̄ that rounding alone can cause at each sample, (T,)."""
    # Beside the diagonal, which scaling takes out exactly.
    scale = np.linalg.norm(root, axis=2)
    spread = np.linalg.norm(inverse * scale[:, np.newaxis, :], ord=2, axis=(1, 2))
    lost = np.linalg.norm(root / scale[:, :, np.newaxis], axis=(1, 2)) ** 2 * spread**2
    if trajectory.resolved is not None:
        again = roundoffs(trajectory.phibar, np.nan_to_num(trajectory.after), scale, spread)
        lost = np.where(trajectory.resolved, lost + again, np.inf)
    unit = AMPLIFICATION * trajectory.parameters * trajectory.precision
    return np.asarray(TOLERANCE + unit * lost, dtype=np.float64)


def memory(trajectory: Trajectory) -> float:
    """Samples the record remembers: 1 over the mean forgetting rate, ln|P̄|/|P| per parameter."""
    fine = _finite(trajectory)
    after = np.linalg.slogdet(trajectory.prior[fine])[1]
    with np.errstate(invalid="ignore"):  # a determinant lost to windup has no logarithm
        rate = (after - np.linalg.slogdet(trajectory.before[fine])[1]) / trajectory.parameters
    rate = rate[np.isfinite(rate)]
    mean = float(rate.mean()) if rate.size else 0.0
    return 1 / max(-math.expm1(-mean), 1e-12) if mean > 0 else math.inf


def proper(trajectory: Trajectory) -> Finding:
    """A1; not decidable where rounding is larger than the shortfall would be."""
    root, inverse = square_root(np.nan_to_num(trajectory.before), trajectory.precision)
    share = _retained(trajectory, inverse)
    resolution = _resolution(trajectory, root, inverse)
    short = np.flatnonzero(~(share >= 1 - resolution))
    worst = float(np.nanmin(share)) if np.isfinite(share).any() else float("nan")
    found = {"least_retained": worst}
    if short.size:
        at = trajectory.first + int(short[0])
        reason = f"forgetting adds information: P̄ is {share[short[0]]:.4g} P along a direction"
        if np.isnan(share[short[0]]):
            reason = "P or P̄ is not finite"
        return "fails", found, at, reason, None
    if (resolution > 0.5).any():
        at = trajectory.first + int(np.flatnonzero(resolution > 0.5)[0])
        reason = f"P is too ill-conditioned from sample {at} on to tell"
        return "not decidable", found, None, reason, None
    return "holds", found, None, "P̄ >= P at every sample", None


def upper_bound(trajectory: Trajectory, limit: float = float("inf")) -> Finding:
    """A2: the largest eigenvalue of P̄, its drift, and the first sample above `limit`."""
    largest = _extreme(trajectory.prior, -1)
    outside = np.flatnonzero(~(largest <= limit) | ~(largest > 0) | ~np.isfinite(largest))
    if outside.size:
        at = int(outside[0])
        reason = f"the largest eigenvalue of P̄ is {largest[at]:.4g} there, limit {limit:.4g}"
        return "fails", {"b": float(largest[at])}, trajectory.first + at, reason, None
    drift = trend(largest, "largest", memory(trajectory))
    return _bounded("b", float(largest.max()), drift, upwards=True)


def lower_bound(trajectory: Trajectory, limit: float = 0.0) -> Finding:
    """A3: the smallest eigenvalue of P, its drift, and the first sample below `limit`."""
    smallest = np.minimum(_extreme(trajectory.before, 0), _extreme(trajectory.after, 0))
    # Within rounding of the largest eigenvalue the smallest is noise, of either sign.
    noise = trajectory.parameters * trajectory.precision * np.abs(_extreme(trajectory.after, -1))
    outside = np.flatnonzero(~(smallest >= limit - noise) | ~(smallest > -noise))
    if outside.size:
        at = int(outside[0])
        reason = f"the smallest eigenvalue of P is {smallest[at]:.4g} there, limit {limit:.4g}"
        return "fails", {"a": float(smallest[at])}, trajectory.first + at, reason, None
    if not (smallest > noise).all():
        at = trajectory.first + int(np.argmin(smallest > noise))
        reason = f"P is too ill-conditioned from sample {at} on to tell"
        return "not decidable", {"a": float(max(smallest.min(), 0.0))}, None, reason, None
    drift = trend(smallest, "smallest", memory(trajectory))
    return _bounded("a", float(smallest.min()), drift, upwards=False)


def _bounded(name: str, bound: float, drift: Trend, *, upwards: bool) -> Finding:
    found = {name: bound}
    moves = drift.rises if upwards else drift.falls
    if moves:
        word = "rises" if upwards else "falls"
        change = f"it {word} by a factor {drift.factor:.3g} over the second half of the record"
        reason = f"{name} = {bound:.4g} is only where the record ends: {change}"
        return "not decidable", found, None, reason, drift
    words = "no drift" if drift.decidable else "too short to tell a drift"
    return "holds", found, None, f"{name} = {bound:.4g} over the record, {words}", drift


def _extreme(matrices: Array, which: int) -> Array:
    """An extreme eigenvalue of each matrix; NaN where a matrix is not finite."""
    fine = np.isfinite(matrices).all(axis=(1, 2))
    result = np.full(len(matrices), np.nan)
    result[fine] = np.linalg.eigvalsh(matrices[fine])[:, which]
    return result
