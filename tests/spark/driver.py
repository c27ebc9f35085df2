"""A driver that is killed: a table first, then files as they come, on from where it was stopped.

python driver.py FOLDER
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from cluster import finish, session
from rows import SETTINGS

from forgetting.spark import identify, load, stateful

DESIGN: dict[str, Any] = {"by": "meter", "y": "y", "phi": ["u"], "time": "t", **SETTINGS}
OUTPUTS = ("prediction", "error", "skipped")
SCHEMA = "meter string, t timestamp, u double, y double, row bigint"
PARTITIONS, SHARDS = 12, 3


def main(folder: Path) -> None:
    """The work of a day, and of the hours after it."""
    spark = session(folder)
    day = str(folder / "day")
    if not (folder / "day" / "_SUCCESS").exists():
        rows = spark.read.schema(SCHEMA).parquet(str(folder / "day.parquet"))
        done = identify(rows, outputs=OUTPUTS, keep="row", partitions=PARTITIONS, **DESIGN)
        done.save(day)
    hours = spark.readStream.schema(SCHEMA).option("maxFilesPerTrigger", 1)
    told = stateful(
        hours.parquet(str(folder / "hours")),
        shards=SHARDS,
        start=load(spark, day).state,
        outputs=OUTPUTS,
        keep="row",
        **DESIGN,
    )
    written = told.writeStream.option("path", str(folder / "told"))
    kept = written.option("checkpointLocation", str(folder / "checkpoint"))
    finish(kept.trigger(availableNow=True).start)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
