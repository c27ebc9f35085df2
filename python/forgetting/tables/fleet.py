"""Many streams from tables: a row goes to the estimator of its key."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from threading import Lock
from typing import Any

import numpy as np

from forgetting._core import RLS, Bank, Fleet, InvalidInput
from forgetting.extras import extra
from forgetting.files import whole
from forgetting.models.orders import Each, Orders
from forgetting.tables import outputs as told
from forgetting.tables import restore, state
from forgetting.tables.batch import read, take
from forgetting.tables.columns import PURPOSE, table_of
from forgetting.tables.half_life import with_half_life
from forgetting.tables.model import Model, made
from forgetting.tables.streams import Streams

OUTPUTS = ("prediction", "error", "skipped")


class TableFleet:
    """A fleet fed by tables: each row is a sample of the stream that its key names.

    Streams start when their key first appears. The rows of a stream are taken in the order of
    time, and each as `RLS.update` would: up to ten parameters bit for bit what one `RLS` a key
    gives, to rounding above; of the rule "auto" what one `Bank` a key gives, bit for bit.

    Parameters
    ----------
    key : str
        Column that says whose row it is: text, whole numbers, dates, ...; never missing.
    y : str
        Column of the measurements.
    phi : str or sequence of str
        Columns of the regressors; with `arx` the inputs.
    time : str, optional
        Column of times. Within a batch rows may be in any order; a row older than the last one
        of its stream in earlier batches is late: it is counted and left out. Without times the
        given order counts.
    offset : bool
        Whether a constant regressor of 1 comes after the others.
    arx : (na, nb, nk) or Orders, optional
        Makes regressors of each stream's own past, see `forgetting.ARX`.
    model : str, optional
        In the place of `arx` the same by name: ``"arx:na=2,nb=2,nk=1"``, ``"fir:nb=3"`` or
        ``"ar:na=2"``.
    gap : str, duration or float, optional
        Longest step in time that lags reach across, such as "5min"; any if not given.
    half_life : str, duration or float, optional
        Of a rule with a forgetting factor, by the clock of each stream: "10min", or a number in
        the unit of `time` (seconds for dates). Streams then go one by one, some 20 µs each
        and batch.
    rule, forgetting_factor, weighting, gate, initial_covariance, initial_theta, dtype, threads
        As of `Fleet`, the same for all streams; with the rule "auto" each is a `Bank`.

    Raises
    ------
    InvalidInput
        Names the parameter, its value and what is allowed.

    Examples
    --------
    >>> from forgetting.tables import TableFleet
    >>> fleet = TableFleet("meter", "power", ["sun"], time="t", rule="exponential")
    >>> batch = {"meter": ["a", "b", "a"], "t": [1, 1, 2], "sun": [1.0, 2.0, 2.0],
    ...          "power": [3.0, 8.0, 6.0]}
    >>> told = fleet.update(batch)
    >>> told.column_names
    ['meter', 't', 'prediction', 'error', 'skipped']
    >>> fleet["b"].theta.round(3), len(fleet)
    (array([4.]), 2)
    """

    def __init__(
        self,
        key: str,
        y: str,
        phi: str | Sequence[str] = (),
        *,
        time: str | None = None,
        offset: bool = False,
        arx: Sequence[Each] | Orders | None = None,
        model: str | None = None,
        gap: Any = None,
        half_life: Any = None,
        rule: Any = None,
        forgetting_factor: float | None = None,
        **settings: Any,
    ) -> None:
        columns = made(key, y, phi, time, offset, arx, model, gap)
        if half_life is not None:
            if time is None or forgetting_factor is not None:
                raise InvalidInput("half_life goes with time, and without forgetting_factor")
            rule = with_half_life(rule, half_life)
        if np.ndim(0.0 if forgetting_factor is None else forgetting_factor):
            raise InvalidInput("forgetting_factor must be one number for all streams")
        chosen = {"rule": rule, "forgetting_factor": forgetting_factor, **settings}
        # two streams, so that what is given for all cannot be taken for what is given for one
        fresh = Fleet(2, len(columns.regressors), **chosen)._states()[0]
        self._take_over(Streams(columns, half_life is not None, fresh, settings.get("threads")))

    def _take_over(self, streams: Streams) -> None:
        self._streams, self._lock = streams, Lock()

    @property
    def model(self) -> Model:
        """The columns."""
        return self._streams.model

    @property
    def refused(self) -> dict[Any, str]:
        """Why the saved state of a key was refused, by key; see `from_arrow`."""
        return dict(self._streams.refused)

    def __len__(self) -> int:
        """Number of streams."""
        return len(self._streams.keys)

    def __iter__(self) -> Iterator[Any]:
        """The keys, in the order in which they first appeared."""
        return iter(self.keys())

    def __contains__(self, key: object) -> bool:
        return key in self._streams.keys

    def __getitem__(self, key: Any) -> RLS | Bank:
        """A copy of the stream of this key, an estimator that goes on from there."""
        if key not in self._streams.keys:
            raise KeyError(key)
        return self._streams.pages[self._streams.keys[key]]

    def keys(self) -> list[Any]:
        """All keys, in the order in which they first appeared."""
        return self._streams.keys.listed()

    def update(self, batch: Any, outputs: str | Iterable[str] = OUTPUTS) -> Any:
        """Take a batch of rows.

        Parameters
        ----------
        batch : object
            A table of pyarrow, or whatever exports Arrow by the PyCapsule protocol: frames of
            Polars and pandas, relations of DuckDB; a dict of columns, too.
        outputs : str or sequence of str
            What to tell of each row: "prediction", "error" (both with the estimate of before),
            "leverage", "theta" and "variance" (after it), "skipped".

        Returns
        -------
        pyarrow.Table
            One row for each of the batch, in the same order: key, time, and the outputs by
            name, as `Run` has them; theta and variance have a column a regressor,
            ``theta:sun``. `skipped` is null where the row was used, "late", "missing" (a null
            or NaN in it, or a lag that is not there), "refused" (infinite, or out of range, or
            a key whose state was refused), or the word of a rule or gate.

        Raises
        ------
        InvalidInput
            For a batch that is no table, lacks a column, or has keys, times or numbers of a
            wrong type; nothing has changed.
        """
        wanted = told.checked(outputs)
        with self._lock:
            found = read(self._streams, table_of(batch))
            return told.table(self.model, found, take(self._streams, found, wanted), wanted)

    def estimates(self) -> Any:
        """Where every stream stands: an Arrow table with a row for each key.

        Returns
        -------
        pyarrow.Table
            key, time (of the last row), rows, samples (used), missing, late, status ("ok",
            "windup" or "saturated") and ``theta:<regressor>``.
        """
        with self._lock:
            return told.standing(self._streams)

    def to_arrow(self, keys: Iterable[Any] | None = None) -> Any:
        """The state of all streams, or of some, as one Arrow table with a row for each.

        Returns
        -------
        pyarrow.Table
            key, state (the bytes of `RLS.to_bytes` or `Bank.to_bytes`, versioned and checked),
            time, taken, rows, missing, late and lags; the model and the state of a new stream are
            among the metadata.

        Raises
        ------
        KeyError
            For a key that has no stream.
        """
        with self._lock:
            return state.to_arrow(self._streams, None if keys is None else list(keys))

    def save(self, path: str | Path, metadata: Mapping[bytes, bytes] | None = None) -> None:
        """Write the state of all streams as an Arrow file, whole or not at all.

        It is the table of `to_arrow`, written page by page, so that little memory is needed.

        Parameters
        ----------
        path : str or Path
        metadata : mapping of bytes to bytes, optional
            What else to keep among the metadata of the schema.
        """
        ipc = extra("pyarrow.ipc", PURPOSE)
        with self._lock, whole(path) as made:
            parts = state.parts(self._streams)
            first = next(parts)
            schema = first.schema.with_metadata(first.schema.metadata | dict(metadata or {}))
            with ipc.new_file(str(made), schema) as file:
                for part in parts:
                    file.write_table(part.replace_schema_metadata(schema.metadata))

    @classmethod
    def from_arrow(cls, table: Any, threads: int | None = None) -> TableFleet:
        """The fleet that `to_arrow` saved; it goes on bit for bit.

        A row whose state is altered or of another model is left out, and `refused` says why: rows
        of that key are then refused, too, until `put` brings a good state. `to_arrow` hands it
        on as it was.
        """
        fleet = cls.__new__(cls)
        fleet._take_over(restore.from_arrow(table_of(table), threads))
        return fleet

    @classmethod
    def load(cls, path: str | Path, threads: int | None = None) -> TableFleet:
        """The fleet that `save` wrote, as `from_arrow`, read page by page.

        Raises
        ------
        InvalidInput
            When the file holds something else.
        """
        fleet = cls.__new__(cls)
        fleet._take_over(restore.load(str(path), threads))
        return fleet

    def put(self, table: Any) -> None:
        """Take over the streams of a saved table, in the place of those of the same key.

        Raises
        ------
        InvalidInput
            When it was saved by a fleet of other columns or another rule; nothing has changed.
        """
        with self._lock:
            restore.put(self._streams, table_of(table))

    def __repr__(self) -> str:
        return f"TableFleet({self.model.key!r}, {self.model.y!r}) of {len(self)} streams"
