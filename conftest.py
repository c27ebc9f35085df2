"""What needs a library that `make test` does not install is left out; see `make spark`."""

from importlib.util import find_spec

collect_ignore = [] if find_spec("pyspark") else ["python/forgetting/spark"]
