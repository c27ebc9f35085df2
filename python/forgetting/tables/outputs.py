"""What is told of rows and of streams, as Arrow tables."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import SKIPPED, InvalidInput
from forgetting.tables.batch import LATE
from forgetting.tables.columns import arrow
from forgetting.tables.growing import Growing
from forgetting.tables.model import NAMES, Model
from forgetting.tables.samples import Batch
from forgetting.tables.streams import NEVER, Streams

WORDS = {code: word for code, word in (SKIPPED | {LATE: "late"}).items() if word is not None}


def checked(outputs: str | Iterable[str]) -> tuple[str, ...]:
    """The outputs that are asked for, in the order of `NAMES`."""
    asked = [outputs] if isinstance(outputs, str) else list(outputs)
    for name in asked:
        if name not in NAMES:
            raise InvalidInput(f"outputs = {name!r}, allowed: {', '.join(NAMES)}")
    return tuple(name for name in NAMES if name in asked)


def table(model: Model, batch: Batch, told: dict[str, NDArray[Any]], wanted: Sequence[str]) -> Any:
    """The rows of a batch with what was asked for."""
    pa = arrow()
    own = [name for name in (model.key, model.time) if name is not None]
    columns = {name: batch.table.column(name) for name in own}
    for name in wanted:
        values = told[name]
        if name == "skipped":
            columns[name] = words(values)
        elif values.ndim == 1:
            columns[name] = pa.array(values, from_pandas=True)
        else:
            columns |= by_regressor(model, name, values)
    return pa.table(columns)


def by_regressor(model: Model, name: str, values: NDArray[Any]) -> dict[str, Any]:
    """A column for each regressor, ``theta:sun``."""
    named = [f"{name}:{regressor}" for regressor in model.regressors]
    return {
        each: arrow().array(np.ascontiguousarray(values[:, j]), from_pandas=True)
        for j, each in enumerate(named)
    }


def words(codes: NDArray[np.uint8]) -> Any:
    """Why rows were left out, as a dictionary column of Arrow; null where they were used."""
    pa, listed = arrow(), list(WORDS)
    index = np.zeros(256, dtype=np.int8)
    index[listed] = np.arange(len(listed))
    indices = pa.array(index[codes], mask=codes == 0)
    return pa.DictionaryArray.from_arrays(indices, pa.array([WORDS[code] for code in listed]))


def standing(streams: Streams) -> Any:
    """A row for each stream; see `TableFleet.estimates`."""
    pa, model, pages = arrow(), streams.model, streams.pages
    columns = {model.key: pa.array(streams.keys.listed(), type=streams.keys.type)}
    if model.time is not None:
        columns[model.time] = times(streams, streams.seen, np.arange(len(streams.keys)))
    columns["rows"] = pa.array(streams.rows.values.copy())  # not what later batches count on
    columns["samples"] = pa.array(pages.gather(lambda fleet: fleet.samples))
    columns |= {name: pa.array(streams.counts[name].values.copy()) for name in ("missing", "late")}
    columns["status"] = pa.array(pages.gather(lambda fleet: fleet.health().status), pa.string())
    return pa.table(columns | by_regressor(model, "theta", pages.gather(lambda fleet: fleet.theta)))


def times(streams: Streams, kept: Growing | None, at: NDArray[np.int64]) -> Any:
    """Kept times of these streams in their own type; null where there is none yet."""
    pa = arrow()
    if kept is None:
        return pa.nulls(len(at))
    values = kept.values[at]
    return pa.array(values, mask=values == NEVER[values.dtype.kind]).cast(streams.time_type)
