"""The record of a command: read once, and shown when that is all that was wanted."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.markup import escape

from forgetting.cli.parse import parse_orders
from forgetting.cli.tables import console
from forgetting.words.errors import RecordError

if TYPE_CHECKING:
    from forgetting.record import Record


def told(
    record: Path,
    formula: str | None,
    output: Sequence[str] | None,
    input: Sequence[str] | None,
    arx: str | None,
    model: str | None,
    offset: bool,
    time: str | None,
    gap: str | None,
    missing: Sequence[str] | None,
    part: str | None,
    encoding: str | None,
    every: str | None,
    hold: Sequence[str] | None,
    mean: Sequence[str] | None,
    nearest: Sequence[str] | None,
    age: str | None,
    **_: Any,
) -> tuple[Callable[[], Record], dict[str, Any]]:
    """What the options of a command say of record and model, each option by its name.

    Returns
    -------
    callable
        Reads the record. It is passed on as it is, so that no caller keeps the table, which is as
        large as all that is made of it.
    dict
        The model, as functions of `forgetting.record` take it.
    """
    rates = Rates(every, hold, mean, nearest, age)
    said = {
        "formula": formula,
        "output": output or (),
        "input": input or (),
        "arx": None if arx is None else parse_orders(arx),
        "model": model,
        "offset": offset,
    }
    return partial(read_record, record, time, gap, missing, part, encoding, rates), said


def read_record(
    path: Path,
    time: str | None,
    gap: str | None,
    missing: Sequence[str] | None,
    part: str | None,
    encoding: str | None,
    rates: Rates | None = None,
) -> Record:
    """Read by the one door, `forgetting.record.read`."""
    from forgetting.record.read import read

    record = read(path, time, gap=gap, missing=missing or (), part=part, encoding=encoding)
    return record if rates is None else rates.join(record)


@dataclass(frozen=True)
class Rates:
    """How columns of several rates are joined, as the options say it."""

    every: str | None = None
    hold: Sequence[str] | None = None
    mean: Sequence[str] | None = None
    nearest: Sequence[str] | None = None
    age: str | None = None

    def join(self, record: Record) -> Record:
        """The record at one rate, if one was asked for."""
        if self.every is None:
            for name in ("hold", "mean", "nearest", "age"):
                if getattr(self, name):
                    raise RecordError(f"--{name} goes with --every, the step of the joined clock")
            return record
        from forgetting.record.rates import at_one_rate

        def names(texts: Sequence[str] | None) -> list[str]:
            return [name.strip() for text in texts or () for name in text.split(",")]

        hold, mean, nearest = names(self.hold), names(self.mean), names(self.nearest)
        return at_one_rate(record, self.every, hold=hold, mean=mean, nearest=nearest, age=self.age)


def show_record(record: Record) -> None:
    """Print what was recognised."""
    out = console()
    pairs = record.describe()
    width = max(len(word) for word, _ in pairs)
    for word, text in pairs:
        out.print(f"[bold]{word:<{width}}[/]  {escape(text)}")
