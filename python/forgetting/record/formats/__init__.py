"""What a file is, found by its content, and the library that reads it.

`recognise` looks at the first bytes; the name of a file decides nothing, except that a folder is a
folder of Parquet. Delimited text and spreadsheets may have lines before the table, a row of units
and so on: `layout` finds out where the names and the numbers begin, and pandas reads them.
"""

from forgetting.record.formats.load import load
from forgetting.record.formats.table import Table

__all__ = ["Table", "load"]
