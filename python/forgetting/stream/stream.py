"""A stream: blocks of lines in, lines of estimates and alarms out."""

from __future__ import annotations

import io
from codecs import BOM_UTF8
from itertools import islice
from typing import Any

import numpy as np

from forgetting.record.formats.dialect import is_aside
from forgetting.record.half_life import counts, rule_for
from forgetting.record.trace import MISSING, USED
from forgetting.stream import fields as field_names
from forgetting.stream.blocks import decoded, first_cells, pieces
from forgetting.stream.clock import Marks, StreamClock
from forgetting.stream.estimates import Estimates
from forgetting.stream.form import Form, recognised
from forgetting.stream.known import KnownParameters
from forgetting.stream.learner import Learner, in_bank
from forgetting.stream.model import Model, make_model
from forgetting.stream.output import Batch, Output, with_alarms
from forgetting.stream.parse import Parser
from forgetting.stream.position import Position
from forgetting.stream.rows import Rows
from forgetting.stream.samples import Samples
from forgetting.stream.settings import Settings
from forgetting.stream.signals import Signals
from forgetting.stream.stamps import Stamps, find_stamps
from forgetting.stream.tally import Tally
from forgetting.stream.watch import Watch
from forgetting.stream.writing import Writer
from forgetting.words.errors import RecordError


class Stream:
    """Estimates a model from lines as they come.

    Parameters
    ----------
    settings : Settings
    to : str
        "json" (an object a line; alarms are objects of their own) or "csv".
    fields : str, optional
        What is written of every row, with commas; see `forgetting.stream.fields`.
    standard_errors : bool
        Whether they are found also where no field needs them, for who looks from beside.

    Examples
    --------
    >>> stream = Stream(Settings(output=["y"], input=["u"]), fields="row,error")
    >>> lines = stream.feed(b"u,y\\n1.0,2.0\\n").lines
    >>> lines
    [b'{"row":1,"error":0.0}\\n']
    """

    def __init__(
        self,
        settings: Settings,
        to: str = "json",
        fields: str | None = None,
        standard_errors: bool = False,
    ) -> None:
        self.settings, self.to, self.fields = settings, to, fields
        self.standard_errors = standard_errors
        self.position = Position()
        self.tally = Tally()
        self.form: Form | None = None
        self.stamps: Stamps | None = None
        self.pending = b""
        self.begins = True
        """Whether the next line is the first of an input."""
        self.header_due = to == "csv"

    def feed(self, block: bytes) -> Output:
        """Take whole lines.

        Raises
        ------
        RecordError
            When the first lines hold no table, or not the columns of the model.
        """
        self.position.advance(block)
        if not block.endswith(b"\n"):
            block += b"\n"
        if self.begins:
            block = block.removeprefix(BOM_UTF8)
        if self.form is None:
            self.pending += block
            if not self._begin():
                return Output()
            block, self.pending = self.pending, b""
        elif self.begins:
            self.form.check_first(decoded(block[: block.index(b"\n")]))
        self.begins = False
        made = Output()
        block = self._below_names(block)
        if self.header_due:
            made.lines.append(self.writer.header())
            self.header_due = False
        for piece in pieces(block):
            self._take(piece, made)
        return made

    def further_input(self) -> None:
        """Begin with another input, such as a file that took the place of the one before."""
        self.position.restart()
        self.begins, self.pending = True, b""

    def _below_names(self, block: bytes) -> bytes:
        """The block without names and units at its top, which would keep it from being a table."""
        assert self.form is not None
        start = 0
        while start < len(block):
            end = block.index(b"\n", start) + 1
            line = decoded(block[start:end])
            if not (self.form.is_header(line) or is_aside(line)):
                break
            start = end
        return block[start:]

    def _begin(self) -> bool:
        """Recognise the first lines; whether that was possible."""
        every = map(decoded, io.BytesIO(self.pending))
        lines = list(islice((line for line in every if not is_aside(line)), 3))
        form = recognised(lines, self.settings.separator, self.settings.names)
        if form is None:
            return False
        self._prepare(form, find_stamps(first_cells(form, lines), self.settings.time, form.units))
        return True

    def _prepare(self, form: Form, stamps: Stamps | None) -> None:
        """Make all that depends on the columns."""
        own = self.settings
        self.form, self.stamps = form, stamps
        rule = own.rule if own.half_life is None else rule_for(own.rule, own.half_life)
        self.by_clock = own.half_life is not None and not counts(own.half_life)
        if self.by_clock and stamps is None:
            raise RecordError("a half-life in time needs a clock, and the stream has none")
        model: Model = make_model(form, own)
        self.model = model
        known = own.known(model.regressors, model.outputs)
        self.known = KnownParameters(known, model.regressors, isinstance(model, Signals))
        names = field_names.chosen(self.fields, stamps is not None, own.rule == "auto")
        self.learner = Learner(
            len(self.known.names),
            len(model.outputs),
            self.known.place_of(model.constant),
            rule,
            own.gate,
            own.initial_covariance,
            own.dtype,
            self.standard_errors or "standard_errors" in names,
            field_names.wanted(names),
            isinstance(model, Signals),
            self.known.limits,
            self.known.bounds,
        )
        known.refuse_bank(self.learner.estimator)
        known.teach(self.learner.estimator, self.known.names)
        if isinstance(model, Signals):
            model.begin(known, self.learner)
        bank = self.learner.estimator if in_bank(self.learner.estimator) else None
        members = 0 if bank is None else len(bank.members)
        described = field_names.described(names, model.outputs, model.regressors, members)
        self.parser = Parser(form, model.columns, stamps, list(own.missing))
        self.clock = StreamClock(stamps, own.gap)
        self.watch = Watch(self.known.names, len(model.outputs))
        self.writer = Writer(self.to, described)

    def _take(self, block: bytes, made: Output) -> None:
        rows = self.parser.read(block)
        if not len(rows):
            return
        marks = self.clock.mark(rows)
        samples, when = self._samples(rows, marks), marks.time if self.by_clock else None
        found, moved, target = self.learner.take(self.known.taken(samples), when)
        y = samples.y if samples.seen is None else samples.seen.measured
        found = self.known.put_back(found, y)
        first = self.tally.rows + 1
        alarms = self.watch.take(moved, target, found.others["windup"])
        self._count(rows, marks, found)
        lines = self.writer.lines(first, rows, y, found, reasons(rows, marks, found))
        made.lines += lines if self.to == "csv" else with_alarms(lines, alarms, first)
        made.batches.append(Batch(first, rows, y, found, alarms))

    def _samples(self, rows: Rows, marks: Marks) -> Samples:
        """Regressors and outputs; a repeated row has none, and no lag sees it."""
        if isinstance(self.model, Signals):
            return self.model.samples(rows.values, marks.gap, marks.repeated)
        if not marks.repeated.any():
            return self.model.samples(rows.values, marks.gap)
        new = ~marks.repeated
        return self.model.samples(rows.values[new], marks.gap[new]).spread(new)

    def _count(self, rows: Rows, marks: Marks, found: Estimates) -> None:
        tally = self.tally
        tally.rows += len(rows)
        tally.used += int((found.skipped == USED).sum())
        tally.malformed += int(rows.malformed.sum())
        tally.late += int(marks.late.sum())
        tally.repeated += int(marks.repeated.sum())
        tally.gaps += int(marks.gap.sum())
        tally.out_of_range += int(found.refused.sum())
        told = rows.malformed | marks.repeated | found.refused
        tally.missing += int(((found.skipped == MISSING) & ~told).sum())

    @property
    def example(self) -> str:
        """What is wrong with the first line at fault since `forget_example`, in words."""
        return "" if self.form is None else self.parser.example or self.learner.reason

    def forget_example(self) -> None:
        """Make room for the next one."""
        self.parser.example = self.learner.reason = ""

    def state(self) -> dict[str, Any] | None:
        """All that the next line needs; None before the first row."""
        if self.form is None:
            return None
        return {
            "settings": self.settings.as_data(),
            "form": self.form.state(),
            "stamps": None if self.stamps is None else self.stamps.state(),
            "position": self.position.state(),
            "tally": self.tally.state(),
            "clock": self.clock.state(),
            "lags": self.model.state(),
            "learner": self.learner.state(),
            "watch": self.watch.state(),
        }

    def restore(self, state: dict[str, Any]) -> None:
        """Go on from a saved state, bit for bit.

        Raises
        ------
        RecordError
            When the saved estimator is another one.
        """
        stamps = None if state["stamps"] is None else Stamps(**state["stamps"])
        self._prepare(Form.restored(state["form"]), stamps)
        self.position = Position.restored(state["position"])
        self.tally = Tally(**state["tally"])
        self.clock.restore(state["clock"])
        self.model.restore(state["lags"])
        self.learner.restore(state["learner"])
        self.watch.restore(state["watch"])


def reasons(rows: Rows, marks: Marks, found: Estimates) -> dict[int, str]:
    """Why rows were left out that the estimator was not asked about, or refused."""
    told: dict[int, str] = {}
    for flags, word in (
        (found.refused, "out_of_range"),
        (rows.malformed, "malformed"),
        (marks.repeated, "repeated"),
    ):
        told |= dict.fromkeys(np.flatnonzero(flags).tolist(), word)
    return told
