"""The rows of one stream as a record, on the terms of a fleet: a bad sample stops no other."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import RLS, SKIPPED, Bank, InvalidInput, NumericalRange

Array = NDArray[Any]

CODES = {word: code for code, word in SKIPPED.items()}
"""What `Fleet.update` says in numbers, by its word."""


def take_record(
    est: RLS | Bank,
    samples: tuple[Array, Array],
    clock: tuple[Array | None, float],
    told: dict[str, Array],
) -> None:
    """Take a record in one call; one by one where a sample is refused, which is then left out.

    Parameters
    ----------
    est : RLS or Bank
    samples : phi (T, n) and y (T,)
    clock : time (T,) or None, and the time of the last sample before them, or NaN
    told : dict of str to ndarray
        Where to write each output, with one row a sample.
    """
    (phi, y), (time, last) = samples, clock
    times = time if time is None or np.isnan(last) else np.r_[last, time]
    try:
        run = est.run(phi, y, outputs=list(told), missing="skip", time=times)
    except (InvalidInput, NumericalRange):
        for k in range(len(y)):
            last = _take_one(
                est, (phi[k], y[k]), (time if time is None else time[k], last), told, k
            )
        return
    for name, values in told.items():
        values[:] = getattr(run, name)


def _take_one(
    est: RLS | Bank,
    sample: tuple[Array, float],
    clock: tuple[float | None, float],
    told: dict[str, Array],
    k: int,
) -> float:
    """Take one sample, and say when the last one that was not left out was taken."""
    now, last = clock
    elapsed = 1.0 if now is None or np.isnan(last) else now - last
    found: dict[str, Any] = {"error": np.nan, "leverage": np.nan, "skipped": CODES["refused"]}
    try:
        update = est.update(*sample, elapsed=elapsed, missing="skip")
        found = {name: getattr(update, name) for name in ("error", "leverage")}
        found["skipped"] = CODES[update.skipped]
    except (InvalidInput, NumericalRange):
        pass
    found |= _standing(est)
    for name, values in told.items():
        values[k] = found[name]
    left_out = found["skipped"] in (CODES["refused"], CODES["missing"])
    return last if left_out or now is None else now


def _standing(est: RLS | Bank) -> dict[str, Any]:
    """theta and variance as they are: what a record of one missing sample tells."""
    nothing = np.full((1, est.parameters), np.nan, dtype=est.dtype)
    names = ("theta", "variance")
    run = est.run(nothing, nothing[:, 0], outputs=names, missing="skip")
    return {name: getattr(run, name)[0] for name in names}
