"""The files of a large table, one after the other, in batches that fit into memory."""

from __future__ import annotations

import glob
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import takewhile
from pathlib import Path
from typing import Any

from forgetting.extras import extra
from forgetting.tables.columns import PURPOSE, arrow
from forgetting.words.errors import RecordError, first_line
from forgetting.words.suggestion import suggestion

KINDS = {b"PAR1": "parquet", b"ARROW1": "ipc"}
"""How files of a kind begin; what begins otherwise is text."""
SUFFIXES = (".parquet", ".pq", ".arrow", ".feather", ".ipc", ".csv")
"""What is taken of a folder."""
READ_ROWS, READ_AHEAD = 1 << 17, 4
"""Rows that are read in one go, and how many such are read ahead."""


@dataclass(frozen=True)
class Partition:
    """A file of the table.

    Attributes
    ----------
    path : Path
    name : str
        Its path below the folder that was given: what the partition is known by.
    """

    path: Path
    name: str

    @property
    def size(self) -> int:
        """Bytes of the file."""
        return self.path.stat().st_size

    def batches(self, columns: Sequence[str], rows: int) -> Iterator[Any]:
        """Tables of these columns in the file's order; all but the last of so many rows or more.

        Parts of the path such as ``region=north`` are columns, too.

        Raises
        ------
        RecordError
            When the file cannot be read, or has no such column.
        """
        source = self._dataset()
        for column in columns:
            if column not in source.schema.names:
                near = suggestion(source.schema.names, column, "it has")
                raise RecordError(f"{self.name} has no column {column!r}{near}")
        held: list[Any] = []
        schema = arrow().schema([source.schema.field(column) for column in columns])
        options = {"batch_size": READ_ROWS, "batch_readahead": READ_AHEAD}
        try:
            for batch in source.to_batches(columns=list(columns), **options):
                held.append(batch)
                if sum(map(len, held)) >= rows:
                    yield arrow().Table.from_batches(held)
                    held = []
        except (arrow().ArrowException, OSError) as error:
            raise RecordError(f"{self.name}: {first_line(error)}") from None
        yield arrow().Table.from_batches(held, schema=schema)

    def _dataset(self) -> Any:
        dataset = extra("pyarrow.dataset", PURPOSE)
        with self.path.open("rb") as stream:
            start = stream.read(8)
        kind = next((kind for mark, kind in KINDS.items() if start.startswith(mark)), "csv")
        try:
            return dataset.dataset([str(self.path)], format=kind, partitioning="hive")
        except (arrow().ArrowException, OSError) as error:
            raise RecordError(f"{self.name}: {first_line(error)}") from None


def find(patterns: Sequence[str]) -> list[Partition]:
    """The files of patterns, folders and names, each once, in the order of their names.

    Raises
    ------
    RecordError
        When one of the patterns finds nothing, or two files have one name.
    """
    found: dict[Path, Partition] = {}
    for pattern in patterns:
        for each in _of_pattern(pattern):
            found.setdefault(each.path, each)
    named: dict[str, Path] = {}
    for each in found.values():
        if (other := named.setdefault(each.name, each.path)) != each.path:
            raise RecordError(
                f"{other} and {each.path} are both {each.name}; give the folder above both"
            )
    return sorted(found.values(), key=lambda each: each.name.split("/"))


def _of_pattern(pattern: str) -> list[Partition]:
    """What one pattern finds, named from the last folder that has no wildcard in it."""
    given = Path(pattern)
    if given.is_file():
        return [Partition(given.resolve(), given.name)]
    if given.is_dir():
        root, paths = given, [p for p in given.rglob("*") if p.suffix.lower() in SUFFIXES]
    else:
        fixed = takewhile(lambda part: not glob.has_magic(part), given.parts)
        root, paths = Path(*fixed), [Path(each) for each in glob.glob(pattern, recursive=True)]
    paths = [p for p in paths if p.is_file() and not p.name.startswith((".", "_"))]
    if not paths:
        raise RecordError(f"there is no file {pattern}")
    return [Partition(path.resolve(), path.relative_to(root).as_posix()) for path in paths]
