"""What a formula may say, checked before any of it is evaluated.

A formula is code: formulaic evaluates its terms as Python. So every name, attribute and call in it
must be one that models need; nothing that opens, imports, executes or formats is among them.
"""

from __future__ import annotations

import ast
import re

import numpy as np
from formulaic.transforms import TRANSFORMS

from forgetting.record.terms import shortened
from forgetting.words.errors import RecordError, first_line

BUILTINS = frozenset(("abs", "min", "max", "round", "sum", "float", "bool", "len"))
FUNCTIONS = frozenset({"lag", *TRANSFORMS}) | BUILTINS
"""Names that a formula may use without a column of that name."""

OF_NUMPY = """
where clip pi e nan cumsum cumprod diff gradient interp nan_to_num unwrap sinc angle real imag mean
median std var sum min max minimum maximum average percentile quantile ptp round isclose heaviside
select piecewise digitize searchsorted
"""
NUMPY = frozenset(OF_NUMPY.split())
"""Functions of NumPy besides its element-wise ones (ufuncs)."""

OF_COLUMNS = """
abs add between bfill clip cummax cummin cumprod cumsum diff div dt ewm expanding ffill fillna
floordiv ge gt interpolate isin isna le lt mask max mean median min mod mul ne eq notna pow quantile
rank replace rolling round rsub shift std sub sum var where year month day hour minute second
day_of_week day_of_year quarter astype real imag
"""
METHODS = frozenset(OF_COLUMNS.split())
"""Methods and attributes of a column."""

SYNTAX = (
    ast.Expression, ast.Call, ast.Name, ast.Load, ast.Attribute, ast.Constant, ast.keyword,
    ast.BinOp, ast.UnaryOp, ast.Compare, ast.BoolOp, ast.IfExp, ast.List, ast.Tuple, ast.Dict,
    ast.Subscript, ast.Slice,
    ast.Add, ast.Sub, ast.Mult, ast.Div, ast.FloorDiv, ast.Mod, ast.Pow,
    ast.USub, ast.UAdd, ast.Not, ast.Invert, ast.BitAnd, ast.BitOr, ast.BitXor, ast.And, ast.Or,
    ast.Eq, ast.NotEq, ast.Lt, ast.LtE, ast.Gt, ast.GtE, ast.In, ast.NotIn,
)  # fmt: skip

COUNT = 1000
"""Largest whole number as an exponent, or in a call, where it counts splines or powers."""
COUNTED = frozenset(("poly", "bs", "cs", "cr", "cc", "hashed", "round"))
"""Functions in which a whole number costs time and memory."""
PLACE = "_column_"
BACKTICKS = re.compile(r"`([^`]*)`")


def check_code(expression: str, formula: str) -> set[str]:
    """Refuse Python that does more than compute with columns; return the names that it uses.

    Parameters
    ----------
    expression : str
        One factor of a formula, such as ``np.log(x)``.
    formula : str
        For the message.

    Raises
    ------
    RecordError
    """
    names: list[str] = []
    plain = BACKTICKS.sub(lambda found: kept(found[1], names), expression.strip())
    try:
        tree = ast.parse(plain, mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        raise RecordError(
            f"the formula {shortened(formula)} cannot be read: {without_place(error)}"
        ) from None
    for node in ast.walk(tree):
        wrong = fault(node)
        if wrong:
            raise RecordError(f"the formula {shortened(formula)} {wrong}")
    used = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    return {names[int(name[len(PLACE) :])] if name.startswith(PLACE) else name for name in used}


def without_place(error: BaseException) -> str:
    """What Python says of its syntax, without the line of a file that is none."""
    return first_line(error).partition(" (<unknown>")[0]


def kept(name: str, names: list[str]) -> str:
    """A Python name in the place of an odd one."""
    names.append(name)
    return f" {PLACE}{len(names) - 1} "


def fault(node: ast.AST) -> str | None:
    """What is wrong with a node, as the end of a sentence; None when nothing is."""
    if not isinstance(node, SYNTAX):
        return f"uses Python that a model does not need ({type(node).__name__})"
    if isinstance(node, ast.Attribute):
        return attribute(node)
    if isinstance(node, ast.Call):
        return call(node)
    if isinstance(node, ast.BinOp):
        return operation(node)
    return None


def attribute(node: ast.Attribute) -> str | None:
    """Refuse attributes that neither NumPy's functions nor a column's methods are."""
    if isinstance(node.value, ast.Name) and node.value.id == "contr":
        return None if not node.attr.startswith("_") else "uses a private attribute"
    if isinstance(node.value, ast.Name) and node.value.id == "np":
        if node.attr in NUMPY or isinstance(getattr(np, node.attr, None), np.ufunc):
            return None
        return f"uses np.{node.attr}, which is not among the functions that a formula may use"
    if node.attr in METHODS:
        return None
    return f"uses .{node.attr}, which is not among the methods that a formula may use"


def call(node: ast.Call) -> str | None:
    """Refuse functions that are none, and a polynomial of degree 100 000, which nobody means."""
    if not isinstance(node.func, ast.Name):
        return None
    name = node.func.id
    if name not in FUNCTIONS:
        return f"calls {name!r}, an unknown function"
    if name not in COUNTED:
        return None
    for given in [*node.args, *(keyword.value for keyword in node.keywords)]:
        if is_plain(given) and not small(given):
            return f"has a number in {name}() that is too large; at most {COUNT} makes sense"
    return None


def operation(node: ast.BinOp) -> str | None:
    """Refuse text and lists in arithmetic, and powers of whole numbers that never end."""
    sides = (node.left, node.right)
    for side in sides:
        text = isinstance(side, ast.Constant) and not isinstance(side.value, int | float | complex)
        if text or isinstance(side, ast.List | ast.Tuple | ast.Dict):
            return "computes with text or lists"
    if isinstance(node.op, ast.Pow) and all(map(is_plain, sides)) and not all(map(small, sides)):
        return "has a power of numbers that is too large"
    return None


def is_plain(node: ast.AST) -> bool:
    """Whether a node is arithmetic of numbers alone."""
    parts = (ast.Constant, ast.BinOp, ast.UnaryOp, ast.operator, ast.unaryop)
    only = all(isinstance(part, parts) for part in ast.walk(node))
    return only and not (isinstance(node, ast.Constant) and not isinstance(node.value, int | float))


def small(node: ast.AST) -> bool:
    """Whether a node is a number that is not too large for a power."""
    if isinstance(node, ast.UnaryOp):
        return small(node.operand)
    if not isinstance(node, ast.Constant) or not isinstance(node.value, int | float):
        return False
    return abs(node.value) <= COUNT
