"""Text files: whatever their bytes, they are read or refused with one line."""

from __future__ import annotations

from pathlib import Path

from forgetting.record import identify, read

from .target import fuzz
from .texts import File, files


def test_csv(tmp_path: Path) -> None:
    path = tmp_path / "record.csv"

    def check(case: File) -> None:
        path.write_bytes(case.content)
        record = read(path, case.time, missing=case.missing, encoding=case.encoding)
        assert all(isinstance(words, str) for pair in record.describe() for words in pair)
        first, last = record.frame.columns[0], record.frame.columns[-1]
        identify(record, output=last, input=first, arx=(1, 1, 0), rule="none")

    fuzz("csv", 60, files(), check)
