"""What needs a library that `make test` does not install is left out; see `make spark`.

Modules and tests live to the end, so the garbage collector does not look for garbage among them.
"""

import gc
from importlib.util import find_spec

collect_ignore = [] if find_spec("pyspark") else ["python/forgetting/spark"]


def pytest_collection():
    """Imports make nothing but what stays."""
    gc.disable()


def pytest_collection_finish():
    """From here on it looks at what the tests make."""
    gc.freeze()
    gc.enable()
