"""Formula models over a record, by formulaic."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pandas as pd
from formulaic import Formula, ModelMatrices
from formulaic.formula import SimpleFormula
from formulaic.parser.types import Factor
from formulaic.utils.variables import Variable, get_required_variables
from numpy.typing import NDArray

from forgetting.record.columns import numbers, resolve
from forgetting.record.formula import FUNCTIONS, check_code
from forgetting.record.lag import Lag
from forgetting.record.read import Record
from forgetting.record.samples import Samples
from forgetting.record.terms import check_size, check_terms, shortened
from forgetting.words.errors import RecordError, first_line

ANSI = re.compile(r"\x1b\[[0-9;]*m|[⧛⧚]")
CATEGORICAL = re.compile(r"C\s*\(")
CALLED = {Variable.Role.CALLABLE}
Array = NDArray[np.float64]


def regression(record: Record, formula: str) -> Samples:
    """Build the samples of a formula such as ``power ~ 0 + sun + sun:warmth + lag(power, 1)``.

    The left side names one or several outputs, the right side the regressors, in the language of
    formulaic: `+`, `:`, `*`, functions, ``lag(x, k)``, ``C(x)`` for categories, backticks around
    odd names; `0 +` leaves out the constant. A lag that crosses a gap of the clock is missing.
    Text in a column that is not inside ``C(...)`` is an error, not a category.
    """
    parsed = parse(formula)
    frame = checked_columns(record, parsed, formula)
    segments = None if record.clock is None else record.clock.segments()
    lag = Lag(len(record.frame), segments)
    matrices = evaluate(parsed, formula, frame, lag)
    phi, y = matrices.rhs, matrices.lhs
    if phi.shape[1] == 0:
        raise RecordError(f"the formula {shortened(formula)} has no regressor on its right side")
    regressors, outputs = as_floats(phi, formula), as_floats(y, formula)
    samples = Samples(
        without_categories(regressors, frame, parsed),
        outputs,
        tuple(map(str, phi.columns)),
        tuple(map(str, y.columns)),
        formula,
        record.clock,
        record.name,
        cut=int(lag.cut.sum()),
        found=record.found,
    )
    refuse_infinite_outputs(samples)
    return samples.check()


def parse(formula: str) -> Any:
    """Parse a formula with two sides."""
    check_size(formula)
    check_terms(formula)
    try:
        parsed = Formula(formula)
    except Exception as error:
        # The parser raises whatever a misplaced sign makes of itself.
        raise RecordError(
            f"the formula {shortened(formula)} cannot be read: {plain(error)}"
        ) from None
    sides = [getattr(parsed, side, None) for side in ("lhs", "rhs")]
    if not all(isinstance(side, SimpleFormula) and list(side) for side in sides):
        raise RecordError(f"the formula {shortened(formula)} must read: output ~ regressors")
    return parsed


def checked_columns(record: Record, parsed: Any, formula: str) -> pd.DataFrame:
    """Return the table; columns that the formula uses are numbers unless they are categories."""
    known = set(map(str, record.frame.columns))
    for factor in factors(parsed):
        if factor.eval_method is Factor.EvalMethod.PYTHON:
            for name in sorted(check_code(str(factor.expr), formula) - FUNCTIONS - known):
                resolve(record.frame, name, record.name)
    used = set().union(*(columns(each, known) for each in factors(parsed)))
    # What stands only under a method of an expression, (x + z).clip(0), goes along as it was read;
    # what bears the name of a function must not hide it.
    others = [name for name in record.frame.columns if name in used or name not in FUNCTIONS]
    categories = categorical(parsed, known)
    converted: dict[str, Any] = {}
    for name in sorted(used):
        resolve(record.frame, name, record.name)
        if name not in categories:
            converted[name] = numbers(record.frame, name, record.name)
    # no copy: a column that is numbers already stays where it is
    parts = {name: converted.get(name, record.frame[name]) for name in others}
    return pd.DataFrame(parts, index=record.frame.index, copy=False)


def factors(parsed: Any) -> list[Factor]:
    """Every factor of both sides."""
    return [factor for side in (parsed.lhs, parsed.rhs) for term in side for factor in term.factors]


def variables(factor: Factor) -> set[Variable]:
    """Names that a factor uses, each with its role.

    The factor's own `required_variables` leaves out all names of formulaic's functions, such as I,
    which is a current here as often as not.
    """
    if factor.eval_method is not Factor.EvalMethod.PYTHON:
        return set(factor.required_variables)
    try:
        return set(get_required_variables(factor.expr))
    except Exception as error:
        # It evaluates what is called: of 0.5.abs(x) the method of a number, which is none.
        raise RecordError(
            f"the term {shortened(str(factor.expr))} cannot be read: {plain(error)}"
        ) from None


def columns(factor: Factor, known: set[str]) -> set[str]:
    """Columns that a factor uses.

    A name that is both a column and a function of formulaic, such as `I` or `Q`, is the column
    unless it is called. Of ``x.clip(0)`` the column is x.
    """
    values = {name for name in variables(factor) if name.roles != CALLED or "." in name}
    if factor.eval_method is Factor.EvalMethod.LOOKUP:
        return set(map(str, values))
    roots = {str(name if name in known else name.root) for name in values}
    return {
        name for name in roots if name in known or (name.isidentifier() and name not in FUNCTIONS)
    }


def categorical(parsed: Any, known: set[str]) -> set[str]:
    """Columns that stand only inside C(...)."""
    inside: set[str] = set()
    outside: set[str] = set()
    for factor in factors(parsed):
        used = columns(factor, known)
        (inside if CATEGORICAL.match(str(factor.expr)) else outside).update(used)
    return inside - outside


def evaluate(parsed: Any, formula: str, frame: pd.DataFrame, lag: Lag) -> ModelMatrices:
    """Evaluate the formula; `lag` is ours, because it must stop at gaps of the clock."""
    try:
        with np.errstate(all="ignore"):
            return parsed.get_model_matrix(frame, na_action="ignore", context={"lag": lag})
    except Exception as error:
        # Terms are the user's code: whatever they raise is a fault of the formula.
        raise RecordError(
            f"the formula {shortened(formula)} cannot be evaluated: {plain(error)}"
        ) from None


def as_floats(table: pd.DataFrame, formula: str) -> Array:
    """What a side of the formula gives, as float64; text or complex numbers are refused."""
    kinds = {kind.kind for kind in table.dtypes}
    try:
        if "c" in kinds:
            raise ValueError("a term is complex")
        made = np.empty(table.shape)
        for place in range(table.shape[1]):  # column by column: no copy of all of them
            made[:, place] = table.iloc[:, place].to_numpy(dtype=np.float64)
        return made
    except (ValueError, TypeError, OverflowError) as error:
        raise RecordError(
            f"the formula {shortened(formula)} gives no numbers: {plain(error)}"
        ) from None


def without_categories(table: Array, frame: pd.DataFrame, parsed: Any) -> Array:
    """A missing category makes its row missing, not all zeros."""
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
    return first_line(ValueError(ANSI.sub("", str(error)))).partition(" (<unknown>")[0]
