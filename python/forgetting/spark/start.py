"""States of streams as the first values of a query's shards."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import pyarrow as pa

from forgetting.spark.shard import Layout
from forgetting.spark.standing import put


@dataclass(frozen=True)
class Start:
    """Joins the states of a shard, rows of `shard` and of what `standing` tells, to its bytes."""

    layout: Layout

    def __call__(self, states: Any) -> Any:
        """One row: `shard` and `streams`."""
        fleet = self.layout.design.fleet()
        kinds = self.layout.design.standing
        put(fleet, states.select(kinds.names).cast(kinds))
        return pa.table(
            {
                "shard": states.column("shard").slice(0, 1),
                "streams": pa.array([self.layout.kept(fleet)], pa.binary()),
            }
        )
