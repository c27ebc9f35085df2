"""How to use what was chosen for a record: the command line, and the line of Python."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from forgetting.choice import Choice
from forgetting.choices import Rate, Rule
from forgetting.models.named import NamedModel
from forgetting.models.orders import in_text
from forgetting.tuning.candidate import Candidate
from forgetting.tuning.code import code, given
from forgetting.tuning.result import Lines
from forgetting.tuning.structures import ModelOrders


@dataclass(frozen=True)
class Usage:
    """What a user said of a record and of its model.

    Attributes
    ----------
    path : str or None
        The file, "-" for standard input; None where the record is no file.
    formula : str or None
        Of a regression.
    outputs, inputs : sequence of str
        Columns of an ARX model.
    offset : bool
        Whether an ARX model has a constant.
    time, gap, missing, part, encoding
        How the record is read, see `forgetting.record.read`.
    """

    path: str | None
    formula: str | None
    outputs: Sequence[str]
    inputs: Sequence[str]
    offset: bool
    time: str | None = None
    gap: str | float | None = None
    missing: Sequence[str | float] = ()
    part: str | None = None
    encoding: str | None = None

    def lines(self, candidate: Candidate) -> Lines:
        """Both lines for a candidate."""
        return Lines(self.python(candidate), self.command(candidate))

    def python(self, candidate: Candidate) -> str:
        """Three statements on one line; a record that is no file is called `record`."""
        source = "record" if self.path is None else repr(self.path)
        opened = {"part": self.part, "encoding": self.encoding}
        reads = self.path is not None and any(opened.values())
        if reads:
            source = f"read({arguments(source, opened)})"
        values = {
            "formula": self.formula,
            "output": list(self.outputs),
            "input": list(self.inputs),
            **lags(candidate.orders),
            "offset": None if self.offset else False,
            "rule": candidate.rule,
            "initial_covariance": None
            if candidate.initial_covariance is None
            else list(candidate.initial_covariance),
            "time": self.time,
            "gap": self.gap,
            "missing": list(self.missing),
        }
        names = "identify, read" if reads else "identify"
        return (
            f"import forgetting as fg; from forgetting.record import {names}; "
            f"found = identify({arguments(source, values)})"
        )

    def command(self, candidate: Candidate) -> str | None:
        """A line for the shell; None where the record is no file."""
        if self.path is None:
            return None
        words = ["forgetting", "identify", self.path]
        words += option("--formula", self.formula)
        words += [word for name in self.outputs for word in ("--output", name)]
        words += [word for name in self.inputs for word in ("--input", name)]
        for name, value in lags(candidate.orders).items():
            words += [
                f"--{name}",
                value if isinstance(value, str) else ",".join(map(in_text, value)),
            ]
            words += [] if self.offset else ["--no-offset"]
        words += option("--time", self.time) + option("--gap", self.gap)
        words += [word for each in self.missing for word in ("--missing", str(each))]
        words += option("--part", self.part) + option("--encoding", self.encoding)
        words += rule_options(candidate.rule) if candidate.rule is not None else []
        prior = candidate.initial_covariance
        words += [] if prior is None else ["--initial-covariance", text(list(prior))]
        return shlex.join(words)


def lags(orders: ModelOrders | None) -> dict[str, Any]:
    """The orders by the name of their argument: `arx` or `model`."""
    if orders is None:
        return {}
    if isinstance(orders, NamedModel):
        return {"model": str(orders)}
    return {"arx": (orders.na, orders.nb, orders.nk)}


def arguments(first: str, values: dict[str, Any]) -> str:
    """The arguments of a call, without those that are not given."""
    said = [f"{name}={code(value)}" for name, value in values.items() if value not in (None, [])]
    return ", ".join([first, *said])


def option(name: str, value: Any) -> list[str]:
    """An option and its value, or nothing."""
    return [] if value is None else [name, str(value)]


def rule_options(rule: Rule) -> list[str]:
    """A rule as options of the command."""
    words = ["--rule", rule.name]
    for name, value in given(rule).items():
        if isinstance(value, Rate):
            words += ["--rate", with_parameters(value)]
        elif name in ("forgetting_factor", "threshold"):
            words += [f"--{name.replace('_', '-')}", repr(value)]
        else:
            words += ["--set", f"{name}={text(value)}"]
    return words


def with_parameters(choice: Choice) -> str:
    """``name:parameter=value,...`` with what is not at its default."""
    inner = ",".join(f"{name}={text(value)}" for name, value in given(choice).items())
    return f"{choice.name}:{inner}" if inner else choice.name


def text(value: Any) -> str:
    """A value as the command takes it."""
    if isinstance(value, list):
        return ",".join(map(text, value))
    return value if isinstance(value, str) else repr(value)
