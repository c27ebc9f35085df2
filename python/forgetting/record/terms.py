"""How large a formula is, found before it is evaluated.

``(a + b + c)**30`` stands for more terms than a computer can hold, and brackets can be nested
deeper than a parser can follow.
"""

from __future__ import annotations

import re
from typing import Any

from formulaic.parser import DefaultFormulaParser
from formulaic.parser.types import ASTNode, Token

from forgetting.words.errors import RecordError

DEPTH = 50
"""Brackets within brackets."""
TERMS = 10_000
"""Terms that a formula may stand for."""
OPEN, CLOSE = "([{", ")]}"
QUOTED = re.compile(r"`[^`]*`|'[^']*'|\"[^\"]*\"")


def check_size(formula: str) -> None:
    """Refuse a formula that is nested too deep, or whose brackets do not match.

    Raises
    ------
    RecordError
    """
    depth = 0
    for sign in QUOTED.sub("", formula):
        depth += (sign in OPEN) - (sign in CLOSE)
        if depth > DEPTH:
            raise RecordError(f"the formula is nested more than {DEPTH} brackets deep")


def check_terms(formula: str) -> None:
    """Refuse a formula that stands for too many terms; formulas that cannot be parsed pass."""
    try:
        tree = DefaultFormulaParser().get_ast(formula)
        count = terms(tree)
    except RecordError:
        raise
    except Exception:
        # It cannot be read; parsing says so with its own words.
        return
    if count > TERMS:
        raise RecordError(
            f"the formula {shortened(formula)} stands for more than {TERMS} terms; write out those "
            "that are wanted"
        )


def terms(node: Any) -> int:
    """An upper bound of the number of terms of a part of a formula."""
    if not isinstance(node, ASTNode):
        return 1
    sign = str(node.operator.symbol)
    counts = [terms(each) for each in node.args]
    if sign in ("**", "^") and len(counts) == 2:
        # the exponent is evaluated, too, also where it is no number
        return max(power(counts[0], node.args[1]), counts[1])
    if len(counts) < 2:
        return sum(counts)
    left, right = counts[0], counts[-1]
    bound = (
        left * right + (left + right) * (sign in ("*", "/")) if sign in ("*", "/", ":") else None
    )
    return min(left + right if bound is None else bound, TERMS + 1)


def power(base: int, exponent: Any) -> int:
    """How many products a power of so many terms has."""
    text = str(exponent.token) if isinstance(exponent, Token) else str(exponent)
    if not text.isdigit():
        return base
    count = 1
    for _ in range(min(int(text), TERMS)):
        count *= max(base, 2)
        if count > TERMS:
            return TERMS + 1
    return count


def shortened(formula: str, length: int = 200) -> str:
    """The formula in quotes, cut when it is long."""
    return repr(formula if len(formula) <= length else formula[:length] + "…")
