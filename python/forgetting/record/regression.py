"""Formula models over a record, by formulaic."""

from __future__ import annotations

import ast
import builtins
import re
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from formulaic import Formula, ModelMatrices
from formulaic.errors import FormulaicError
from formulaic.formula import SimpleFormula
from formulaic.parser.types import Factor
from formulaic.transforms import TRANSFORMS

from forgetting.record.columns import numbers, resolve
from forgetting.record.read import Record, first_line
from forgetting.record.samples import Samples
from forgetting.words.errors import RecordError

ANSI = re.compile(r"\x1b\[[0-9;]*m|[⧛⧚]")
CATEGORICAL = re.compile(r"C\s*\(")
BACKTICKS = re.compile(r"`([^`]*)`")
QUOTED = "_quoted_"
FUNCTIONS = {"lag", *TRANSFORMS, *dir(builtins)}
"""Names that a formula may use without a column of that name."""


def regression(record: Record, formula: str) -> Samples:
    """Build the samples of a formula such as ``power ~ 0 + sun + sun:warmth + lag(power, 1)``.

    The left side names one or several outputs, the right side the regressors, in the language of
    formulaic: `+`, `:`, `*`, functions, ``lag(x, k)``, ``C(x)`` for categories, backticks around
    odd names; `0 +` leaves out the constant. A lag that crosses a gap of the clock is missing.
    Text in a column that is not inside ``C(...)`` is an error, not a category.
    """
    parsed = parse(formula)
    frame = checked_columns(record, parsed, formula)
    matrices = evaluate(parsed, formula, frame, record)
    phi, y = matrices.rhs, matrices.lhs
    if phi.shape[1] == 0:
        raise RecordError(f"the formula {formula!r} has no regressor on its right side")
    samples = Samples(
        values(phi, frame, parsed),
        y.to_numpy(dtype=np.float64),
        tuple(map(str, phi.columns)),
        tuple(map(str, y.columns)),
        formula,
        record.clock,
        record.name,
    )
    refuse_infinite_outputs(samples)
    return samples.check()


def parse(formula: str) -> Any:
    """Parse a formula with two sides."""
    try:
        parsed = Formula(formula)
    except FormulaicError as error:
        raise RecordError(f"the formula {formula!r} cannot be read: {plain(error)}") from None
    sides = [getattr(parsed, side, None) for side in ("lhs", "rhs")]
    if not all(isinstance(side, SimpleFormula) and list(side) for side in sides):
        raise RecordError(f"the formula {formula!r} must read: output ~ regressors")
    return parsed


def checked_columns(record: Record, parsed: Any, formula: str) -> pd.DataFrame:
    """Return the columns that the formula uses, as numbers unless they are categories."""
    known = set(map(str, record.frame.columns))
    for factor in factors(parsed):
        for name in sorted(spoken(factor).called - FUNCTIONS - known):
            raise RecordError(f"the formula {formula!r} calls {name!r}, an unknown function")
    categories = categorical(parsed, known)
    frame = pd.DataFrame(index=record.frame.index)
    for name in sorted(set().union(*(columns(each, known) for each in factors(parsed)))):
        if name in categories:
            frame[name] = record.frame[resolve(record.frame, name, record.name)]
        else:
            frame[name] = numbers(record.frame, name, record.name)
    return frame


def factors(parsed: Any) -> list[Factor]:
    """Every factor of both sides."""
    return [factor for side in (parsed.lhs, parsed.rhs) for term in side for factor in term.factors]


def columns(factor: Factor, known: set[str]) -> set[str]:
    """Columns that a factor uses.

    A name that is both a column and a function of formulaic, such as `I` or `Q`, is the column
    unless it is called.
    """
    if factor.eval_method is Factor.EvalMethod.LOOKUP:
        return {str(factor.expr)}
    return {name for name in spoken(factor).named if name in known or name not in FUNCTIONS}


@dataclass(frozen=True)
class Spoken:
    """Names in a Python expression: those called as functions, and the others."""

    called: set[str]
    named: set[str]


def spoken(factor: Factor) -> Spoken:
    """Take the names out of a factor that is a Python expression."""
    if factor.eval_method is not Factor.EvalMethod.PYTHON:
        return Spoken(set(), set())
    quoted = BACKTICKS.findall(str(factor.expr))
    plain_names = iter(range(len(quoted)))
    text = BACKTICKS.sub(lambda _: f"{QUOTED}{next(plain_names)}", str(factor.expr))
    try:
        tree = ast.parse(text, mode="eval")
    except SyntaxError:
        # Left to formulaic, which says what is wrong when it evaluates.
        return Spoken(set(), set())
    functions = [node.func for node in ast.walk(tree) if isinstance(node, ast.Call)]
    called = [node for node in functions if isinstance(node, ast.Name)]
    named = {
        node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and node not in called
    }
    return Spoken(
        {node.id for node in called},
        {quoted[int(name[len(QUOTED) :])] if name.startswith(QUOTED) else name for name in named},
    )


def categorical(parsed: Any, known: set[str]) -> set[str]:
    """Columns that stand only inside C(...)."""
    inside: set[str] = set()
    outside: set[str] = set()
    for factor in factors(parsed):
        used = columns(factor, known)
        (inside if CATEGORICAL.match(str(factor.expr)) else outside).update(used)
    return inside - outside


def evaluate(parsed: Any, formula: str, frame: pd.DataFrame, record: Record) -> ModelMatrices:
    """Evaluate the formula; `lag` is ours, because it must stop at gaps of the clock."""
    segments = None if record.clock is None else record.clock.segments()

    def lag(column: pd.Series, steps: int = 1) -> pd.Series:
        return column.shift(steps) if segments is None else column.groupby(segments).shift(steps)

    try:
        with np.errstate(all="ignore"):
            return parsed.get_model_matrix(frame, na_action="ignore", context={"lag": lag})
    except (FormulaicError, ValueError, TypeError, KeyError, IndexError, AttributeError) as error:
        raise RecordError(f"the formula {formula!r} cannot be evaluated: {plain(error)}") from None


def values(phi: pd.DataFrame, frame: pd.DataFrame, parsed: Any) -> np.ndarray[Any, Any]:
    """Regressors as float64; a missing category makes its row missing, not all zeros."""
    table = np.array(phi.to_numpy(dtype=np.float64), order="C")
    for name in categorical(parsed, set(map(str, frame.columns))):
        table[frame[name].isna().to_numpy()] = np.nan
    return table


def refuse_infinite_outputs(samples: Samples) -> None:
    """An output such as log(0) is an error, not a missing value."""
    infinite = np.argwhere(np.isinf(samples.y))
    if len(infinite):
        row, column = infinite[0]
        raise RecordError(
            f"output {samples.outputs[column]!r} is infinite in row {row + 1} of {samples.source}"
        )


def plain(error: Exception) -> str:
    """One line of a library's message, without its colours."""
    return first_line(ValueError(ANSI.sub("", str(error))))
