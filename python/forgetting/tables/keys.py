"""Which stream a key stands for: streams are numbered in the order in which their keys appear."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import InvalidInput
from forgetting.tables.columns import arrow, column

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

    def __len__(self) -> int:
        return len(self._number)

    def __contains__(self, key: object) -> bool:
        return key in self._number

    def __getitem__(self, key: Any) -> int:
        return self._number[key]

    def listed(self) -> list[Any]:
        """All keys, by number."""
        return list(self._number)

    def add(self, keys: Iterable[Any], kind: Any) -> None:
        """Number new keys."""
        self.type = kind
        for key in keys:
            self._number.setdefault(key, len(self._number))

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
        try:
            encoded = values.dictionary_encode()
        except pa.ArrowException:
            kind = f"key column {name!r} holds {values.type}"
            raise InvalidInput(f"{kind}, allowed: text, numbers or dates") from None
        return self._found(encoded, values.type, refused)

    def _found(self, encoded: Any, kind: Any, refused: dict[Any, Any]) -> Found:
        distinct: list[Any] = encoded.dictionary.to_pylist()
        added: list[Any] = []
        numbers = np.empty(len(distinct), dtype=np.int64)
        count = len(self)
        for i, number in enumerate(map(self._number.get, distinct)):
            if number is None and distinct[i] in refused:
                number = UNKNOWN
            elif number is None:
                number = count + len(added)
                added.append(distinct[i])
            numbers[i] = number
        return Found(numbers[encoded.indices.to_numpy()], added, kind)

    def _of_one_type(self, values: Any, name: str) -> Any:
        pa, types = arrow(), arrow().types
        before = self.type
        if before is None or values.type == before:
            return values
        texts = [types.is_string(t) or types.is_large_string(t) for t in (values.type, before)]
        wholes = [types.is_integer(t) for t in (values.type, before)]
        stamps = [types.is_timestamp(t) for t in (values.type, before)]
        if hasattr(types, "is_string_view"):
            texts[0] = texts[0] or types.is_string_view(values.type)
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
