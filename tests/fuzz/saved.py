"""Saved states, and what befalls them: the check at their end is right all the same."""

from __future__ import annotations

import struct
import zlib

import numpy as np
from hypothesis import strategies as st

import forgetting as fg

NUMBERS = (0.0, -1.0, 1e-310, 1e300, 5e-324, float("nan"), float("inf"), -0.0)
SIZES = (0, 1, 3, 255, 1 << 15, 1 << 20, (1 << 31) - 1, (1 << 32) - 1)
RULES = tuple(
    each["name"] for each in fg.rules() if not any(p["required"] for p in each["parameters"])
)


def fed(estimator: fg.RLS | fg.Bank, samples: int = 15) -> fg.RLS | fg.Bank:
    """An estimator of two parameters after some samples."""
    random = np.random.default_rng(samples)
    for phi in random.normal(size=(samples, 2)):
        estimator.update(phi, phi.sum())
    return estimator


def estimators() -> dict[str, bytes]:
    """A state of every rule that needs no function, and of some other choices."""
    made = {rule: fg.RLS(2, rule=rule) for rule in RULES}
    made["rate"] = fg.RLS(2, rule=fg.Exponential(fg.FTest()), monitor=True)
    made["weighting"] = fg.RLS(2, weighting="huber", gate="dead_zone")
    made["float32"] = fg.RLS(2, dtype="float32", initial_covariance=10.0)
    return {name: fed(estimator).to_bytes() for name, estimator in made.items()}


def banks() -> dict[str, bytes]:
    """States of banks."""
    made = {"auto": fg.Bank(2), "two": fg.Bank(2, ["subspace", "none"], mixer="best")}
    return {name: fed(bank).to_bytes() for name, bank in made.items()}


@st.composite
def changed(draw: st.DrawFn, states: dict[str, bytes]) -> bytes:
    """A state with up to three changes; mostly with a check that fits them."""
    content = bytearray(states[draw(st.sampled_from(sorted(states)))][:-4])
    for _ in range(draw(st.integers(0, 3))):
        at = draw(st.integers(0, len(content)))
        kind = draw(st.sampled_from(("byte", "number", "size", "cut", "more", "gone")))
        if kind == "cut":
            del content[at:]
        elif kind == "gone":
            del content[at : at + draw(st.integers(1, 9))]
        elif kind == "more":
            content[at:at] = draw(st.binary(max_size=30))
        else:
            put(content, at, draw(patch(kind)))
    check = zlib.crc32(content) if draw(st.integers(0, 9)) else draw(st.integers(0, 2**32 - 1))
    return bytes(content) + struct.pack("<I", check)


def patch(kind: str) -> st.SearchStrategy[bytes]:
    """Bytes to be put in the place of others."""
    if kind == "byte":
        return st.binary(min_size=1, max_size=1)
    if kind == "number":
        return st.one_of(st.sampled_from(NUMBERS), st.floats()).map(lambda x: struct.pack("<d", x))
    return st.sampled_from(SIZES).map(lambda x: struct.pack("<I", x))


def put(content: bytearray, at: int, new: bytes) -> None:
    """Write over what is there, as far as it goes."""
    new = new[: len(content) - at]
    content[at : at + len(new)] = new


def goes_on(estimator: fg.RLS | fg.Bank) -> None:
    """What was read gives finite numbers and takes more samples, or refuses them."""
    n, rows, targets = estimator.parameters, estimator.rows, estimator.targets
    phi = np.full((rows, n) if rows > 1 else n, 0.5)
    shape = (rows,) * (rows > 1) + (targets,) * (targets > 1)
    for _ in range(3):
        try:
            estimator.update(phi, np.ones(shape))
        except (fg.InvalidInput, fg.NumericalRange) as error:
            assert str(error)
        assert is_number(estimator)
    assert repr(estimator) and estimator.to_bytes() and estimator.describe()


def is_number(estimator: fg.RLS | fg.Bank) -> bool:
    """Whether θ and P are numbers, infinite where the units of the regressors leave no other."""
    with np.errstate(over="ignore", invalid="ignore"):
        units, theta, covariance = estimator.units, estimator.theta, estimator.covariance
    assert units is None or np.isfinite(units).all()
    return not np.isnan(theta).any() and not np.isnan(covariance).any()
