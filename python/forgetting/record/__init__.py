"""From a measured record on disk to an identified model.

`read` loads CSV or Parquet or takes a data frame of any library, `identify` runs a model over it
and returns an `Identification`, `tune` chooses its settings. pandas reads the files and holds the
table, because the formula language (formulaic) needs pandas frames anyway; pyarrow serves Parquet,
narwhals brings frames of other libraries. All come with ``pip install 'forgetting[cli]'``.
"""

from forgetting.record.identification import Identification
from forgetting.record.identify import identify
from forgetting.record.rates import at_one_rate
from forgetting.record.read import Record, read
from forgetting.record.tune import tune
from forgetting.words.errors import RecordError

__all__ = [
    "Identification",
    "Record",
    "RecordError",
    "at_one_rate",
    "identify",
    "read",
    "tune",
]
