"""Two measured records, identified with three forgetting rules side by side.

The records come inside two packages on the Python package index; their files are found through the
installed metadata, the packages themselves are never imported.
"""

from forgetting.demo.cycling import cycling
from forgetting.demo.solar import solar

DEMOS = {"solar": solar, "cycling": cycling}

__all__ = ["DEMOS", "cycling", "solar"]
