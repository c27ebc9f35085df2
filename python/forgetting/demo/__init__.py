"""Records to see the package at work, identified with three forgetting rules side by side.

That of the battery ships in this package. The two measured ones come inside two packages on the
Python package index; their files are found through the installed metadata, the packages themselves
are never imported.
"""

from forgetting.demo.battery import battery
from forgetting.demo.cycling import cycling
from forgetting.demo.solar import solar

DEMOS = {"battery": battery, "solar": solar, "cycling": cycling}

__all__ = ["DEMOS", "battery", "cycling", "solar"]
