"""What every worker makes of rows: their columns, the settings of a stream, and what is told."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import pyarrow as pa

from forgetting._core import InvalidInput
from forgetting.spark.columns import arrow_type, named, types
from forgetting.spark.standing import OWN, standing
from forgetting.tables import Model, TableFleet
from forgetting.tables.outputs import checked
from forgetting.words.suggestion import suggestion


@dataclass(frozen=True)
class Design:
    """Sent to every worker; the same design makes the same estimates of the same rows.

    Attributes
    ----------
    settings : dict
        The arguments of `TableFleet`.
    outputs, keep : tuple of str
        What is told of each row, and which of its columns are handed on.
    rows, told, standing : pyarrow.Schema
        The columns that are read, what is told of a row, and what is kept of a stream.
    """

    settings: dict[str, Any]
    outputs: tuple[str, ...]
    keep: tuple[str, ...]
    rows: Any
    told: Any
    standing: Any

    def fleet(self) -> TableFleet:
        """A fleet that has seen nothing; the cores are shared out by Spark."""
        return TableFleet(**{"threads": 1, **self.settings})

    @cached_property
    def model(self) -> Model:
        """The columns by role."""
        return self.fleet().model

    def tell(self, fleet: TableFleet, rows: Any) -> Any:
        """Take rows, and tell of them: key, time, columns kept, outputs."""
        table = fleet.update(rows, self.outputs)
        for name in self.keep:
            table = table.append_column(name, rows.column(name))
        return table.select(self.told.names).cast(self.told)


def design_of(
    df: Any, outputs: str | Iterable[str], keep: Iterable[str], settings: dict[str, Any]
) -> Design:
    """The design for a table of Spark, checked before any worker hears of it.

    Raises
    ------
    forgetting.InvalidInput
        When a column is missing or of a wrong type, or a setting is not allowed.
    """
    if settings.get("time") is None:
        raise InvalidInput("time is missing, allowed: a column; rows on Spark have no order")
    fleet, wanted = TableFleet(**settings), checked(outputs)
    kept = _kept(fleet.model, keep)
    rows = _schema(df, list(dict.fromkeys([*fleet.model.columns, *kept])))
    nothing = rows.empty_table()
    told = _plain(fleet.update(nothing, wanted).schema)
    if taken := set(kept) & set(told.names):
        raise InvalidInput(f"keep = {sorted(taken)}, allowed: no name of an output")
    if fleet.model.key in OWN or fleet.model.time in OWN:
        raise InvalidInput(f"key or time is one of {', '.join(OWN)}, allowed: another name")
    at = len({fleet.model.key, fleet.model.time})
    for name in reversed(kept):
        told = told.insert(at, rows.field(name))
    return Design(settings, wanted, kept, rows, told, standing(fleet, rows).schema)


def states_of(state: Any, design: Design) -> Any:
    """States that a user hands back, in the types of the design.

    Raises
    ------
    forgetting.InvalidInput
        When they have other columns.
    """
    wanted = types(design.standing)
    if sorted(state.columns) != sorted(wanted.names):
        raise InvalidInput(
            f"state has the columns {', '.join(state.columns)}, allowed: {', '.join(wanted.names)}"
        )
    return state.select(*[named(each.name).cast(each.dataType).alias(each.name) for each in wanted])


def _kept(model: Model, keep: Iterable[str]) -> tuple[str, ...]:
    named = [keep] if isinstance(keep, str) else list(keep)
    return tuple(name for name in dict.fromkeys(named) if name not in (model.key, model.time))


def _schema(df: Any, columns: Sequence[str]) -> Any:
    """The Arrow types of some columns of a table of Spark."""
    there = df.columns
    for name in columns:
        if there.count(name) != 1:
            near = suggestion(there, name, "it has")
            raise InvalidInput(f"the table has {there.count(name)} columns named {name!r}{near}")
    return pa.schema([(name, arrow_type(df.schema[name].dataType)) for name in columns])


def _plain(schema: Any) -> Any:
    """Texts in the place of dictionaries, which Spark does not know."""
    kinds = [pa.string() if pa.types.is_dictionary(f.type) else f.type for f in schema]
    return pa.schema(list(zip(schema.names, kinds, strict=True)))
