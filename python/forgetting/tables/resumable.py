"""A fleet over the partitions of a large table, which goes on where it was stopped."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from forgetting._core import InvalidInput
from forgetting.extras import extra
from forgetting.files import belongs, same, whole
from forgetting.tables.columns import PURPOSE
from forgetting.tables.fleet import TableFleet
from forgetting.tables.outputs import checked
from forgetting.tables.partitions import Partition
from forgetting.tables.restore import file_parts
from forgetting.words.errors import RecordError

DONE = b"forgetting.tables.done"
"""Where the state keeps the partitions that are done, among the metadata of its schema."""
ROWS = 1_000_000
"""Rows of a batch."""


@dataclass
class Work:
    """Partitions, what is written of each, and which are done.

    Parameters
    ----------
    fleet : TableFleet
        One that has seen nothing; where there is a state, the fleet of the state takes its place.
    partitions : list of Partition
    out : Path, optional
        A folder for what is told of the rows: a Parquet file for each partition, of its name
        (``a.csv.parquet`` for ``a.csv``).
    state : Path, optional
        An Arrow file, written after every partition. If it is there already, the work goes on
        from it: partitions that it calls done are left out.
    outputs : sequence of str
        What is told of each row; see `TableFleet.update`.
    batch_rows : int
        Rows that are taken at a time; late rows are those older than what earlier batches had.

    Attributes
    ----------
    done : dict of str to int
        The size in bytes of each partition that is done, by name.
    rows, seconds : int and float
        Taken by this object.

    Raises
    ------
    RecordError
        When a file cannot be written, would destroy another, or belongs to another fleet, or
        a partition that is done has changed.
    """

    fleet: TableFleet
    partitions: list[Partition]
    out: Path | None = None
    state: Path | None = None
    outputs: Sequence[str] = ("prediction", "error", "skipped")
    batch_rows: int = ROWS
    done: dict[str, int] = field(default_factory=dict)
    rows: int = 0
    seconds: float = 0.0

    def __post_init__(self) -> None:
        if self.batch_rows < 1:
            raise RecordError(f"batch_rows = {self.batch_rows}, allowed: whole numbers from 1")
        self.outputs = checked(self.outputs)
        self._check_outputs()
        if self.state is not None and self.state.exists():
            self._go_on(self.state)

    @property
    def left(self) -> list[Partition]:
        """The partitions that are not done."""
        return [each for each in self.partitions if each.name not in self.done]

    def run(self, progress: Callable[[int, int, float], None] | None = None) -> None:
        """Take all partitions that are left; `progress` is told done, all, and rows a second."""
        for partition in self.left:
            start = time.perf_counter()
            self._take(partition, start, progress)
            self.done[partition.name] = partition.size
            if self.state is not None:
                self.fleet.save(self.state, {DONE: json.dumps(self.done).encode()})
            self.seconds += time.perf_counter() - start

    def _take(
        self,
        partition: Partition,
        start: float,
        progress: Callable[[int, int, float], None] | None,
    ) -> None:
        """Take one partition, and write what is told of it."""
        with _writer(self.out, partition) as write:
            for batch in partition.batches(self.fleet.model.columns, self.batch_rows):
                try:
                    write(self.fleet.update(batch, self.outputs))
                except InvalidInput as error:
                    raise RecordError(f"{partition.name}: {error}") from None
                self.rows += len(batch)
                if progress is not None:
                    rate = self.rows / (self.seconds + time.perf_counter() - start)
                    progress(len(self.done), len(self.partitions), rate)

    def _go_on(self, path: Path) -> None:
        own = self.fleet.to_arrow().schema.metadata
        metadata = next(file_parts(str(path))).schema.metadata or {}
        if DONE not in metadata:
            raise RecordError(f"{path} is no state of a fleet over partitions")
        if any(metadata.get(name) != value for name, value in own.items()):
            raise RecordError(f"{path} is of other columns or another rule; name another file")
        self.done = json.loads(metadata[DONE])
        for part in file_parts(str(path)):
            self.fleet.put(part)
        for each in self.partitions:
            if self.done.get(each.name, each.size) != each.size:
                raise RecordError(f"{each.name} has changed since it was done; see {path}")

    def _check_outputs(self) -> None:
        if self.state is not None and not self.state.resolve().parent.is_dir():
            raise RecordError(f"state {self.state}: there is no folder {self.state.parent}")
        for each in self.partitions:
            if self.state is not None and same(self.state, each.path):
                raise RecordError(f"state {self.state} is a partition that is read")
            if self.out is not None and belongs(each.path, self.out):
                raise RecordError(f"{each.path} is read and lies in {self.out}; write elsewhere")


@contextmanager
def _writer(out: Path | None, partition: Partition) -> Iterator[Callable[[Any], None]]:
    """Yield a function that adds a table to the partition's Parquet file; whole or not at all."""
    if out is None:
        yield lambda table: None
        return
    named = out / partition.name
    path = named if named.suffix == ".parquet" else named.with_name(f"{named.name}.parquet")
    path.parent.mkdir(parents=True, exist_ok=True)
    parquet = extra("pyarrow.parquet", PURPOSE)
    with whole(path) as made, ExitStack() as opened:
        files: list[Any] = []

        def write(table: Any) -> None:
            if not files:
                files.append(opened.enter_context(parquet.ParquetWriter(str(made), table.schema)))
            files[0].write_table(table)

        yield write
