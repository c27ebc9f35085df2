"""Columns of Spark by their plain names, and their types."""

from __future__ import annotations

from typing import Any

from pyspark.sql import functions as F
from pyspark.sql.pandas.types import from_arrow_schema


def named(name: str) -> Any:
    """The column of this name, whatever stands in it: a dot would mean a field of a structure."""
    return F.col("`" + name.replace("`", "``") + "`")


def types(schema: Any) -> Any:
    """The types of Spark for those of Arrow; a time without a zone stays without one."""
    return from_arrow_schema(schema, prefer_timestamp_ntz=True)
