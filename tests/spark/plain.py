"""A table with no more than what a design asks of one of Spark."""

from __future__ import annotations

import pyarrow as pa

from forgetting.spark.columns import types


class Table:
    """Columns and types."""

    def __init__(self, given: pa.Table) -> None:
        self.columns = given.column_names
        self.schema = types(given.schema)
