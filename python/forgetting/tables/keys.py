"""Which stream a key stands for: streams are numbered in the order in which their keys appear."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import repeat
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import InvalidInput
from forgetting.extras import extra
from forgetting.tables.columns import PURPOSE, arrow, column

FEW = 4
"""A batch of fewer rows than one for so many keys has its own keys looked up one by one."""
UNKNOWN = -1
"""The number of a key that has no stream because its saved state was refused."""


class Keys:
    """The numbers of all keys so far.

    Attributes
    ----------
    type : pyarrow.DataType or None
        That of the first batch; keys of other types are refused, unless they are said in that
        one without loss.
    """

    def __init__(self) -> None:
        self.type: Any = None
        self._number: dict[Any, int] = {}
        self._arrays: list[Any] = []

    def __len__(self) -> int:
        return len(self._number)

    def __contains__(self, key: object) -> bool:
        return key in self._number

    def __getitem__(self, key: Any) -> int:
        return self._number[key]

    def listed(self) -> list[Any]:
        """All keys, by number."""
        return list(self._number)

    def add(self, keys: Sequence[Any], kind: Any) -> None:
        """Number keys that are new."""
        if keys:
            self.type = kind
            self._number |= zip(keys, range(len(self), len(self) + len(keys)), strict=True)
            self._arrays.append(arrow().array(keys, type=kind))

    def read(self, table: Any, name: str, refused: dict[Any, Any]) -> Found:
        """The number of each row's key; new keys get the next numbers, and are not added yet.

        Raises
        ------
        forgetting.InvalidInput
            For a missing or NaN key, or one of another type than those before.
        """
        pa, values = arrow(), self._of_one_type(column(table, name), name)
        if values.null_count:
            row = values.is_null().index(pa.scalar(True)).as_py()
            raise InvalidInput(f"key column {name!r} is missing in row {row}, allowed: every row")
        if pa.types.is_floating(values.type) and (bad := np.isnan(values.to_numpy())).any():
            row = int(np.flatnonzero(bad)[0])
            raise InvalidInput(f"key column {name!r} is NaN in row {row}, allowed: no NaN")
        if len(values) < len(self) // FEW or not len(self):
            return self._by_distinct(values, name, refused)
        return self._by_row(values, name, refused)

    def _by_row(self, values: Any, name: str, refused: dict[Any, Any]) -> Found:
        """Look all rows up at once, which makes a table of all keys first; then those not found."""
        compute = extra("pyarrow.compute", PURPOSE)
        if len(self._arrays) > 1:
            self._arrays = [arrow().concat_arrays(self._arrays)]
        found = compute.index_in(values, value_set=self._arrays[0])
        if not found.null_count:
            return Found(found.to_numpy().astype(np.int64), [], values.type)
        rows = found.fill_null(UNKNOWN).to_numpy().astype(np.int64)
        absent = np.flatnonzero(rows == UNKNOWN)
        others = self._by_distinct(values.take(arrow().array(absent)), name, refused)
        rows[absent] = others.rows
        return Found(rows, others.added, values.type)

    def _by_distinct(self, values: Any, name: str, refused: dict[Any, Any]) -> Found:
        """Look each distinct key of the rows up, one by one."""
        try:
            encoded = values.dictionary_encode()
        except arrow().ArrowException:
            kind = f"key column {name!r} holds {values.type}"
            raise InvalidInput(f"{kind}, allowed: text, numbers or dates") from None
        whole = arrow().types.is_integer(values.type)
        distinct = encoded.dictionary
        listed: list[Any] = distinct.to_numpy().tolist() if whole else distinct.to_pylist()
        numbers = np.fromiter(map(self._number.get, listed, repeat(UNKNOWN)), np.int64, len(listed))
        new = np.flatnonzero(numbers == UNKNOWN)
        if refused:
            new = new[[listed[i] not in refused for i in new]]
        numbers[new] = len(self) + np.arange(len(new))
        added = [listed[i] for i in new.tolist()]
        return Found(numbers[encoded.indices.to_numpy()], added, values.type)

    def _of_one_type(self, values: Any, name: str) -> Any:
        pa, types = arrow(), arrow().types
        before = self.type
        if before is None or values.type == before:
            return values
        texts = [types.is_string(t) or types.is_large_string(t) for t in (values.type, before)]
        wholes = [types.is_integer(t) for t in (values.type, before)]
        stamps = [types.is_timestamp(t) for t in (values.type, before)]
        try:
            if all(texts) or all(wholes) or all(stamps):
                return values.cast(before)
        except pa.ArrowException:
            pass
        raise InvalidInput(
            f"key column {name!r} holds {values.type}, but the keys so far are {before}"
        )


class Found:
    """The keys of a batch: the number of each row's, those that are new, and their type."""

    def __init__(self, rows: NDArray[np.int64], added: list[Any], kind: Any) -> None:
        self.rows, self.added, self.type = rows, added, kind
