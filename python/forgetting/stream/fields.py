"""What is written of every row: the fields, their names in JSON and as columns of CSV."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

import forgetting as fg
from forgetting.stream.estimates import Estimates
from forgetting.stream.rows import Array
from forgetting.words.errors import RecordError
from forgetting.words.suggestion import suggestion

DEFAULT = ("row", "time", "prediction", "error", "theta", "standard_errors", "skipped")
WORDS = ("row", "time", "skipped", "gate")
"""Fields that are no floats."""
OF_RUN = ("leverage", "forgetting_factor", "memory", "weight", "weights", "gate")
"""Fields that are outputs of `run` as they stand."""
ALL = (
    "row", "time", "measured", "prediction", "error", "theta", "standard_errors",
    "noise_variance", "leverage", "forgetting_factor", "memory", "weight", "weights", "skipped",
    "gate",
)  # fmt: skip
OF_BANKS, OF_RULES = ("memory", "weights"), ("weight", "gate")
COLUMNS = {"theta": "estimate", "standard_errors": "standard_error", "prediction": "predicted"}
"""Names of columns of CSV that are those of `identify --estimates`, where the field has another."""


@dataclass(frozen=True)
class Field:
    """A field of every row.

    Attributes
    ----------
    name : str
    columns : tuple of str
        Names of its columns of CSV.
    labels : tuple
        What its numbers belong to, in their order: outputs, or pairs of output and regressor; empty
        for a single number.
    floats : callable or None
        Its numbers, (T, k), of estimates and measured outputs; None where it is no float.
    """

    name: str
    columns: tuple[str, ...]
    labels: tuple[str | tuple[str, str], ...] = ()
    floats: Callable[[Estimates, Array], Array] | None = None

    @property
    def width(self) -> int:
        """How many numbers it is."""
        return max(len(self.labels), 1)


def chosen(given: str | None, has_time: bool, bank: bool) -> tuple[str, ...]:
    """The fields asked for, with commas; without any the usual ones.

    Raises
    ------
    RecordError
        For a field that does not exist, or that such an estimator or stream does not have.
    """
    if given is None:
        return tuple(name for name in DEFAULT if has_time or name != "time")
    names = tuple(name.strip() for name in given.split(",") if name.strip())
    for name in names:
        if name not in ALL:
            raise RecordError(
                f"there is no field {name!r}{suggestion(list(ALL), name, 'the fields are')}"
            )
    own = "a bank" if bank else "a single rule"
    lacking = set(OF_RULES if bank else OF_BANKS) | (set() if has_time else {"time"})
    for name in names:
        if names.count(name) > 1:
            raise RecordError(f"--fields names {name!r} twice")
        if name in lacking:
            reason = "the stream has no clock" if name == "time" else f"{own} has none"
            raise RecordError(f"--fields names {name!r}, but {reason}")
    if not names:
        raise RecordError(f"--fields names no field; they are {', '.join(ALL)}")
    return names


def described(
    names: Sequence[str], outputs: Sequence[str], regressors: Sequence[str], members: int
) -> list[Field]:
    """The fields by name, for a model with these outputs and regressors."""
    return [field_of(name, tuple(outputs), tuple(regressors), members) for name in names]


def field_of(
    name: str, outputs: tuple[str, ...], regressors: tuple[str, ...], members: int
) -> Field:
    """One field."""
    single = len(outputs) == 1
    head = COLUMNS.get(name, name)
    pairs = tuple((output, each) for output in outputs for each in regressors)
    if name in ("theta", "standard_errors"):
        columns = tuple(f"{head}:{each}" for each in regressors)
        if not single:
            columns = tuple(f"{head}:{output}:{each}" for output, each in pairs)
        take = OF_PARAMETERS[name]
        return Field(name, columns, regressors if single else pairs, take)
    if name in OF_OUTPUTS:
        columns = tuple(f"{head}:{output}" for output in outputs)
        return Field(name, columns, () if single else outputs, OF_OUTPUTS[name])
    if name == "weights":
        columns = tuple(f"weight:{place}" for place in range(1, members + 1))
        return Field(name, columns, columns, lambda found, y: found.others["weights"])
    if name in WORDS:
        return Field(name, (head,))
    return Field(name, (head,), (), lambda found, y: found.others[name])


def by_output(values: Any) -> Array:
    """(T, n, m) as (T, m n): the parameters of one output after those of another."""
    return np.asarray(values.transpose(0, 2, 1).reshape(len(values), -1))


def wanted(names: Sequence[str]) -> tuple[str, ...]:
    """What `run` must give for these fields beside what it always gives."""
    return tuple(name for name in OF_RUN if name in names)


OF_PARAMETERS: dict[str, Callable[[Estimates, Array], Array]] = {
    "theta": lambda found, y: by_output(found.theta),
    "standard_errors": lambda found, y: by_output(found.standard_errors),
}
OF_OUTPUTS: dict[str, Callable[[Estimates, Array], Array]] = {
    "measured": lambda found, y: y,
    "prediction": lambda found, y: found.prediction,
    "error": lambda found, y: found.error,
    "noise_variance": lambda found, y: found.noise_variance,
}
SKIPPED = {code: reason or "used" for code, reason in fg.SKIPPED.items()}
