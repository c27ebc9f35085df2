"""A cluster of two workers for all tests; without PySpark there is nothing to test."""

import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parent))
HAS_SPARK = find_spec("pyspark") is not None
collect_ignore_glob = [] if HAS_SPARK else ["*.py"]


def pytest_configure(config):
    """Spark's own sockets are closed by the garbage collector."""
    if HAS_SPARK:
        for kind in ("ResourceWarning", "pytest.PytestUnraisableExceptionWarning"):
            config.addinivalue_line("filterwarnings", f"ignore::{kind}")


@pytest.fixture(scope="session")
def spark(tmp_path_factory):
    from cluster import session

    started = session(tmp_path_factory.mktemp("spark"))
    yield started
    started.stop()
