"""Columns of Spark by their plain names, and their types."""

from __future__ import annotations

from typing import Any

import pyarrow as pa
from pyspark.sql import functions as F
from pyspark.sql.pandas.types import from_arrow_schema, to_arrow_type
from pyspark.sql.types import TimestampType


def named(name: str) -> Any:
    """The column of this name, whatever stands in it: a dot would mean a field of a structure."""
    return F.col("`" + name.replace("`", "``") + "`")


def types(schema: Any) -> Any:
    """The types of Spark for those of Arrow; a time without a zone stays without one."""
    return from_arrow_schema(schema, prefer_timestamp_ntz=True)


def arrow_type(kind: Any) -> Any:
    """The type of Arrow for that of Spark; an instant is one in UTC, whatever the session shows."""
    return pa.timestamp("us", "UTC") if isinstance(kind, TimestampType) else to_arrow_type(kind)
