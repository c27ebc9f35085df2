"""Many streams from tables: a fleet that is fed by rows with a key and a time.

`TableFleet` takes batches of any library that speaks Arrow (pyarrow, Polars, pandas, DuckDB) and
tells of each row in an Arrow table. Needs pyarrow: ``pip install forgetting[cli]``.
"""

from forgetting.tables.fleet import TableFleet
from forgetting.tables.model import Model

__all__ = ["Model", "TableFleet"]
