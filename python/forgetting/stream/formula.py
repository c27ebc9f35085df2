"""Formulas over a stream: those that can be told of a row from it and rows before it."""

from __future__ import annotations

import ast
from typing import Any

import numpy as np
import pandas as pd
from formulaic.parser.types import Factor
from numpy.typing import NDArray

from forgetting.record.formula import BACKTICKS, PLACE, kept
from forgetting.record.lag import Lag
from forgetting.record.read import Record
from forgetting.record.regression import (
    as_floats,
    checked_columns,
    evaluate,
    factors,
    parse,
)
from forgetting.record.terms import shortened
from forgetting.stream.form import Form
from forgetting.stream.history import History
from forgetting.stream.rows import Array, Flags
from forgetting.stream.samples import Samples
from forgetting.words.errors import RecordError

ROW_BY_ROW = frozenset(("lag", "I", "Q", "log", "log10", "log2", "exp", "exp10", "exp2", "abs"))
"""Functions that need no more than the row, and those before it that `lag` names."""
OF_NUMPY = frozenset(("where", "clip", "pi", "e", "nan"))
METHODS = frozenset(("abs", "clip"))
INTERCEPT = "Intercept"
LONGEST = 10_000
"""Rows that a lag may reach back."""


class Regression:
    """A formula, evaluated batch by batch; see `forgetting.record.regression`."""

    def __init__(self, formula: str, form: Form) -> None:
        self.formula = formula
        self.parsed = parse(formula)
        reach = checked(self.parsed, formula)
        blank = pd.DataFrame({name: pd.Series(dtype=np.float64) for name in form.names})
        used = checked_columns(Record(blank, name="the stream"), self.parsed, formula)
        needed = needed_names(self.parsed)
        self.columns = tuple(str(name) for name in used.columns if name in needed)
        self.history = History(reach, len(self.columns))
        sample = pd.DataFrame(np.ones((2, len(self.columns))), columns=list(self.columns))
        made = self._matrices(sample, np.zeros(2, dtype=np.int64))
        self.regressors = tuple(map(str, made.rhs.columns))
        self.outputs = tuple(map(str, made.lhs.columns))
        if not self.regressors:
            raise RecordError(f"the formula {shortened(formula)} has no regressor on its right")
        place = self.regressors.index(INTERCEPT) if INTERCEPT in self.regressors else None
        self.constant = place

    def samples(self, values: Array, gap: Flags) -> Samples:
        """See `Model`; what is not finite is missing."""
        if not len(values):
            return Samples(np.empty((0, len(self.regressors))), np.empty((0, len(self.outputs))))
        together, stretch, before = self.history.behind(values, gap)
        made = self._matrices(pd.DataFrame(together, columns=list(self.columns)), stretch)
        phi, y = (as_floats(side, self.formula)[before:] for side in (made.rhs, made.lhs))
        phi[np.isinf(phi)] = np.nan
        y[np.isinf(y)] = np.nan
        return Samples(phi, y)

    def _matrices(self, frame: pd.DataFrame, stretch: NDArray[np.int64]) -> Any:
        return evaluate(self.parsed, self.formula, frame, Lag(len(frame), stretch))

    def state(self) -> dict[str, Any]:
        """See `Model`."""
        return self.history.state()

    def restore(self, state: dict[str, Any]) -> None:
        """See `Model`."""
        self.history.restore(state)


def needed_names(parsed: Any) -> set[str]:
    """Every name in the formula, functions included."""
    found: set[str] = set()
    for factor in factors(parsed):
        tree, names = expression(factor)
        own = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
        found |= {names.get(name, name) for name in own}
    return found


def expression(factor: Factor) -> tuple[ast.Expression, dict[str, str]]:
    """A factor as Python, and the odd names for which it has others."""
    if factor.eval_method is Factor.EvalMethod.LOOKUP:
        return ast.Expression(ast.Name(str(factor.expr))), {}
    odd: list[str] = []
    plain = BACKTICKS.sub(lambda found: kept(found[1], odd), str(factor.expr).strip())
    tree = ast.parse(plain, mode="eval")
    return tree, {f"{PLACE}{place}": name for place, name in enumerate(odd)}


def checked(parsed: Any, formula: str) -> int:
    """How many rows back the formula reaches.

    Raises
    ------
    RecordError
        When a part of it needs more of the stream than the row and its lags.
    """
    return max((depth(expression(factor)[0], formula) for factor in factors(parsed)), default=0)


def depth(node: ast.AST, formula: str) -> int:
    """Rows back that a node reaches, nested lags added up."""
    fault = beyond_the_row(node)
    if fault:
        raise RecordError(
            f"the formula {shortened(formula)} uses {fault}, which a stream cannot tell row by "
            "row; it may use arithmetic, functions of one value such as np.log, and lag(x, k)"
        )
    inner = max((depth(each, formula) for each in ast.iter_child_nodes(node)), default=0)
    return inner + (steps(node, formula) if is_lag(node) else 0)


def is_lag(node: ast.AST) -> bool:
    """Whether a node calls ``lag``."""
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "lag"


def steps(node: ast.AST, formula: str) -> int:
    """The rows that a call of ``lag`` names."""
    assert isinstance(node, ast.Call)
    given = [*node.args[1:], *(each.value for each in node.keywords if each.arg == "steps")]
    value = given[0] if given else ast.Constant(1)
    number = value.value if isinstance(value, ast.Constant) else None
    if not isinstance(number, int) or not 0 <= number <= LONGEST:
        raise RecordError(
            f"the formula {shortened(formula)} has a lag that is no whole number of rows from 0 "
            f"to {LONGEST}; a stream cannot wait for rows to come"
        )
    return number


def beyond_the_row(node: ast.AST) -> str | None:
    """The function or method that needs more than a row; None where there is none."""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        return None if node.func.id in ROW_BY_ROW else f"{node.func.id}()"
    if not isinstance(node, ast.Attribute):
        return None
    if isinstance(node.value, ast.Name) and node.value.id == "np":
        element_wise = isinstance(getattr(np, node.attr, None), np.ufunc) or node.attr in OF_NUMPY
        return None if element_wise else f"np.{node.attr}"
    return None if node.attr in METHODS else f".{node.attr}"
