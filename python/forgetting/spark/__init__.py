"""Many streams on Spark: a `TableFleet` in every partition of a table and every shard of a stream.

`identify` takes a table, `stateful` a stream of Structured Streaming; `load` and `states` read what
they have kept. Needs a Java runtime and PySpark: ``pip install forgetting[spark]``.
"""

from forgetting.extras import extra

extra("pyspark", "forgetting.spark", "spark")  # says what to install, where it is missing

from forgetting.spark.batch import Identified, identify, load  # noqa: E402
from forgetting.spark.checkpoint import states  # noqa: E402
from forgetting.spark.streaming import stateful  # noqa: E402

__all__ = ["Identified", "identify", "load", "stateful", "states"]
